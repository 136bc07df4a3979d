#include "plot_labels.hpp"

#include <algorithm>
#include <cmath>

namespace cost {
namespace {

constexpr double kGap = 2;         // between a mark and its label
constexpr double kStep = 3;        // between two places that are tried
constexpr double kLeaderFrom = 7;  // a label farther than this from its mark has a leader
constexpr double kFarthest = 60;   // that a long label may be from its mark

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

/// What labels and leaders keep off beside other labels and marks: lines and marks under leaders, or only what makes a leader point to the wrong label.
enum class Avoid { all, labels, none };

class Placing {
public:
    Placing(const std::vector<LabelWish>& wishes, const Box& area, double height, std::vector<Box> lines)
        : area_(area), height_(height), lines_(std::move(lines)) {
        for (const LabelWish& wish : wishes) marks_.push_back(wish.mark);
    }

    LabelPlace place(const LabelWish& wish) {
        LabelPlace place;
        const double everywhere = area_.width + area_.height;
        place.placed = tryAll(wish.mark, wish.width, kFarthest, Avoid::all, place);
        place.shortened = !place.placed;
        for (const Avoid avoid : {Avoid::all, Avoid::labels, Avoid::none})
            place.placed = place.placed || tryAll(wish.mark, wish.shortWidth, everywhere, avoid, place);
        if (!place.placed) return place;
        labels_.push_back(place.box);
        if (place.leader) leaders_.push_back(leaderOf(wish.mark, place));
        return place;
    }

private:
    static Segment leaderOf(const Box& mark, const LabelPlace& place) {
        return {mark.middleX(), mark.middleY(), place.leaderX, place.leaderY};
    }

    /// Rings of places around the mark, from the nearest; on each from the right, first above, then below.
    bool tryAll(const Box& mark, double width, double farthest, Avoid avoid, LabelPlace& place) const {
        for (double off = kGap; off <= farthest; off += kStep) {
            const double above = mark.y - off - height_;
            const double below = mark.y + mark.height + off;
            const double right = mark.x + mark.width + off;
            const double left = mark.x - off - width;
            const double middle = mark.middleY() - height_ / 2;
            for (double y : {middle, middle - off / 2, middle + off / 2, above, below})
                for (double x : {right, left})
                    if (suits(mark, {x, y, width, height_}, avoid, place)) return true;
            for (double y : {above, below})
                for (double shift = 0; shift <= width + off; shift += kStep)
                    for (double x : {mark.middleX() - width / 2 + shift / 2, mark.middleX() - width / 2 - shift / 2})
                        if (suits(mark, {x, y, width, height_}, avoid, place)) return true;
        }
        return false;
    }

    /// Whether a label can be there, and if so puts it into `place`.
    bool suits(const Box& mark, const Box& box, Avoid avoid, LabelPlace& place) const {
        const auto free = [&](const std::vector<Box>& others) {
            return std::none_of(others.begin(), others.end(), [&](const Box& other) { return box.meets(other); });
        };
        const auto under = [&](const Segment& leader) { return crosses(leader, box); };
        if (!area_.holds(box) || !free(marks_) || !free(labels_)) return false;
        if (avoid == Avoid::all && !free(lines_)) return false;
        if (avoid != Avoid::none && std::any_of(leaders_.begin(), leaders_.end(), under)) return false;
        place.box = box;
        place.leaderX = std::clamp(mark.middleX(), box.x, box.x + box.width);
        place.leaderY = std::clamp(mark.middleY(), box.y, box.y + box.height);
        const double dx = std::max({mark.x - place.leaderX, place.leaderX - mark.x - mark.width, 0.0});
        const double dy = std::max({mark.y - place.leaderY, place.leaderY - mark.y - mark.height, 0.0});
        place.leader = std::hypot(dx, dy) > kLeaderFrom;
        return !place.leader || leaderSuits(mark, leaderOf(mark, place), avoid);
    }

    bool leaderSuits(const Box& mark, const Segment& leader, Avoid avoid) const {
        if (avoid == Avoid::none) return true;
        if (std::any_of(labels_.begin(), labels_.end(), [&](const Box& label) { return crosses(leader, label); })) return false;
        const auto inTheWay = [&](const Box& other) { return !other.meets(mark) && crosses(leader, other); };
        return avoid != Avoid::all || std::none_of(marks_.begin(), marks_.end(), inTheWay);
    }

    Box area_;
    double height_;
    std::vector<Box> lines_;
    std::vector<Box> marks_;
    std::vector<Box> labels_;
    std::vector<Segment> leaders_;
};

}  // namespace

std::vector<LabelPlace> placeLabels(const std::vector<LabelWish>& wishes, const Box& area, double height,
                                    std::vector<Box> lines) {
    Placing placing(wishes, area, height, std::move(lines));
    std::vector<LabelPlace> places;
    places.reserve(wishes.size());
    for (const LabelWish& wish : wishes) places.push_back(placing.place(wish));
    return places;
}

}  // namespace cost
