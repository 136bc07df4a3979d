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

std::vector<size_t> surelyOnFront(const std::vector<Measurement>& measurements) {
    const Measurement& own = measurements.front();
    std::vector<size_t> numbers;
    std::vector<Tradeoff> points;
    for (size_t i = 0; i < measurements.size(); ++i) {
        const Measurement& m = measurements[i];
        if (i > 0 && !standsOut(m, own)) continue;
        numbers.push_back(i);
        points.push_back({covers(m.slowdown, 1) ? own.ms.median : m.ms.median, m.error.relMse});
    }
    std::vector<size_t> front = paretoFront(points);
    for (size_t& i : front) i = numbers[i];
    return front;
}

}  // namespace cost
