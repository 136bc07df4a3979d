#include "pareto.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

namespace cost {

std::vector<size_t> paretoFront(const std::vector<Tradeoff>& points) {
    std::vector<size_t> order(points.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return points[a].time != points[b].time ? points[a].time < points[b].time : points[a].error < points[b].error;
    });
    std::vector<size_t> front;
    double least = std::numeric_limits<double>::infinity();
    for (size_t i : order) {
        if (!(points[i].error < least)) continue;
        least = points[i].error;
        front.push_back(i);
    }
    return front;
}

}  // namespace cost
