#include "plot_labels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cost {
namespace {

constexpr double kGap = 2;          // between a mark and its label
constexpr double kStep = 3;         // between two places that are tried
constexpr double kLeaderFrom = 7;   // a label farther than this from its mark has a leader
constexpr double kFarthest = 60;    // that a long label may be from its mark
constexpr double kOffLine = 30;     // by so much farther off a label may be to keep off a line
constexpr double kWithLeader = 10;  // likewise to do without a leader

struct Segment {
    double x1, y1, x2, y2;
};

/// By clipping the segment with the four sides.
bool crosses(const Segment& s, const Box& box) {
    double from = 0;
    double to = 1;
    const auto clip = [&](double start, double along, double low, double high) {
        if (along == 0) return start > low && start < high;
        const double a = (low - start) / along;
        const double b = (high - start) / along;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
        return from < to;
    };
    return clip(s.x1, s.x2 - s.x1, box.x, box.x + box.width) && clip(s.y1, s.y2 - s.y1, box.y, box.y + box.height);
}

bool meetsAny(const Box& box, const std::vector<Box>& others) {
    return std::any_of(others.begin(), others.end(), [&](const Box& other) { return box.meets(other); });
}

/// What leaders keep off: labels and other marks, or only what makes a leader point to the wrong label.
enum class Avoid { all, labels, none };

class Placing {
public:
    Placing(const std::vector<LabelWish>& wishes, const Box& area, double height, std::vector<Box> lines)
        : area_(area), height_(height), lines_(std::move(lines)) {
        for (const LabelWish& wish : wishes) marks_.push_back(wish.mark);
    }

    LabelPlace place(const LabelWish& wish) {
        LabelPlace place;
        if (wish.width <= 0) return place;
        const double everywhere = area_.width + area_.height;
        place = best(wish.mark, wish.width, kFarthest, Avoid::all);
        if (!place.placed) place = best(wish.mark, wish.shortWidth, kFarthest, Avoid::all);
        for (const Avoid avoid : {Avoid::labels, Avoid::none})
            if (!place.placed) place = best(wish.mark, wish.shortWidth, everywhere, avoid);
        place.shortened = place.placed && place.box.width < wish.width;
        if (place.placed) labels_.push_back(place.box);
        if (place.leader) leaders_.push_back(leaderOf(wish.mark, place));
        return place;
    }

private:
    static Segment leaderOf(const Box& mark, const LabelPlace& place) {
        return {mark.middleX(), mark.middleY(), place.leaderX, place.leaderY};
    }

    /// The cheapest place on rings around the mark, of equal ones the first: from the right, first above, then below.
    LabelPlace best(const Box& mark, double width, double farthest, Avoid avoid) const {
        LabelPlace found;
        double least = std::numeric_limits<double>::infinity();
        for (double off = kGap; off <= farthest && off < least; off += kStep)
            for (const Box& box : ring(mark, width, off)) {
                const LabelPlace place = at(mark, box, avoid);
                const double cost = off + (place.leader ? kWithLeader : 0) + (meetsAny(box, lines_) ? kOffLine : 0);
                if (!place.placed || cost >= least) continue;
                least = cost;
                found = place;
            }
        return found;
    }

    std::vector<Box> ring(const Box& mark, double width, double off) const {
        std::vector<Box> boxes;
        const double above = mark.y - off - height_;
        const double below = mark.y + mark.height + off;
        const double right = mark.x + mark.width + off;
        const double left = mark.x - off - width;
        const double middle = mark.middleY() - height_ / 2;
        for (double y : {middle, middle - off / 2, middle + off / 2, above, below})
            for (double x : {right, left}) boxes.push_back({x, y, width, height_});
        for (double y : {above, below})
            for (double shift = 0; shift <= width + off; shift += kStep)
                for (double x : {mark.middleX() - width / 2 + shift / 2, mark.middleX() - width / 2 - shift / 2})
                    boxes.push_back({x, y, width, height_});
        return boxes;
    }

    /// Not placed where a label cannot be.
    LabelPlace at(const Box& mark, const Box& box, Avoid avoid) const {
        LabelPlace place;
        const auto under = [&](const Segment& leader) { return crosses(leader, box); };
        if (!area_.holds(box) || meetsAny(box, marks_) || meetsAny(box, labels_)) return place;
        if (avoid != Avoid::none && std::any_of(leaders_.begin(), leaders_.end(), under)) return place;
        place.box = box;
        place.leaderX = std::clamp(mark.middleX(), box.x, box.x + box.width);
        place.leaderY = std::clamp(mark.middleY(), box.y, box.y + box.height);
        place.leader = distance(mark, box) > kLeaderFrom || !nearestTo(mark, box);
        place.placed = !place.leader || leaderSuits(mark, leaderOf(mark, place), avoid);
        return place;
    }

    /// Whether nobody could take the label for another mark's.
    bool nearestTo(const Box& mark, const Box& box) const {
        constexpr double kClearly = 2;
        const auto closer = [&](const Box& other) {
            const bool itself = other.x == mark.x && other.y == mark.y;
            return !itself && distance(other, box) < distance(mark, box) + kClearly;
        };
        return std::none_of(marks_.begin(), marks_.end(), closer);
    }

    bool leaderSuits(const Box& mark, const Segment& leader, Avoid avoid) const {
        if (avoid == Avoid::none) return true;
        if (std::any_of(labels_.begin(), labels_.end(), [&](const Box& label) { return crosses(leader, label); })) return false;
        const auto inTheWay = [&](const Box& other) { return !other.meets(mark) && crosses(leader, other); };
        return avoid == Avoid::labels || std::none_of(marks_.begin(), marks_.end(), inTheWay);
    }

    Box area_;
    double height_;
    std::vector<Box> lines_;
    std::vector<Box> marks_;
    std::vector<Box> labels_;
    std::vector<Segment> leaders_;
};

}  // namespace

double distance(const Box& a, const Box& b) {
    const double dx = std::max({a.x - b.x - b.width, b.x - a.x - a.width, 0.0});
    const double dy = std::max({a.y - b.y - b.height, b.y - a.y - a.height, 0.0});
    return std::hypot(dx, dy);
}

std::vector<LabelPlace> placeLabels(const std::vector<LabelWish>& wishes, const Box& area, double height,
                                    std::vector<Box> lines) {
    Placing placing(wishes, area, height, std::move(lines));
    std::vector<LabelPlace> places;
    places.reserve(wishes.size());
    for (const LabelWish& wish : wishes) places.push_back(placing.place(wish));
    return places;
}

}  // namespace cost
