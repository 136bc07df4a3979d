#include "plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "figures.hpp"
#include "html.hpp"
#include "plot_labels.hpp"

namespace cost {
namespace {

std::string fixed(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

std::string plain(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", value);
    return text;
}

/// An axis by logarithm.
struct Axis {
    double low = 0, high = 1;  // logarithms to base 10
    double from = 0, to = 1;   // where they lie

    double at(double value) const { return from + (std::log10(value) - low) / (high - low) * (to - from); }
    bool shows(double value) const { return value > 0 && std::log10(value) > low && std::log10(value) < high; }
};

/// Holds all values, and so much around them that none lies on the edge.
Axis axisAround(const std::vector<double>& values, double from, double to) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    constexpr double kMargin = 0.07;
    constexpr double kLeastSpan = 0.4;
    const double low = std::log10(*least);
    const double high = std::log10(*most);
    const double more = std::max((high - low) * kMargin, (kLeastSpan - (high - low)) / 2);
    return {low - more, high + more, from, to};
}

/// 1, 2 and 5 of each power of ten, fewer where the axis spans many.
std::vector<double> ticksOf(const Axis& axis) {
    const double span = axis.high - axis.low;
    const std::vector<double> steps = span > 2.5   ? std::vector<double>{1}
                                      : span > 1.2 ? std::vector<double>{1, 2, 5}
                                                   : std::vector<double>{1, 1.5, 2, 3, 5, 7};
    std::vector<double> ticks;
    for (double power = std::floor(axis.low); power <= axis.high; power += 1)
        for (double step : steps)
            if (axis.shows(step * std::pow(10.0, power))) ticks.push_back(step * std::pow(10.0, power));
    return ticks;
}

/// Of a text in the plot's letters, at most.
double lengthOf(const std::string& content) {
    constexpr double kLetter = 6.4;
    return kLetter * static_cast<double>(letterCount(content));
}

std::string percentOf(double time) {
    return plain(100 * time) + " %";
}

/// 0 of 1 and its powers of ten, 1 of 2 and 5, 2 of all that are less round.
int roundness(double tick) {
    const double step = tick / std::pow(10.0, std::floor(std::log10(tick) + 1e-9));
    const auto is = [&](double value) { return std::abs(step - value) < 1e-6; };
    return is(1) ? 0 : is(2) || is(5) ? 1 : 2;
}

/// Those ticks whose texts neither meet nor leave the picture: where there is no room for all, the rounder ones. `sizeOf`: of a tick's text along the axis.
template <typename SizeOf>
std::vector<double> ticksThatFit(const Axis& axis, const SizeOf& sizeOf, double most) {
    constexpr double kApart = 6;
    std::vector<double> ticks = ticksOf(axis);
    std::stable_sort(ticks.begin(), ticks.end(), [](double a, double b) { return roundness(a) < roundness(b); });
    std::vector<double> fitting;
    for (double t : ticks) {
        const double half = sizeOf(t) / 2;
        const bool leaves = axis.at(t) - half < 0 || axis.at(t) + half > most;
        const bool meets = std::any_of(fitting.begin(), fitting.end(), [&](double other) {
            return std::abs(axis.at(other) - axis.at(t)) < half + sizeOf(other) / 2 + kApart;
        });
        if (!leaves && !meets) fitting.push_back(t);
    }
    return fitting;
}

std::string text(double x, double y, const std::string& cssClass, const std::string& anchor, const std::string& content) {
    return "<text x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" class=\"" + cssClass + "\" text-anchor=\"" + anchor + "\">" +
           escaped(content) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& cssClass) {
    return "<line x1=\"" + fixed(x1) + "\" y1=\"" + fixed(y1) + "\" x2=\"" + fixed(x2) + "\" y2=\"" + fixed(y2) + "\" class=\"" +
           cssClass + "\"/>\n";
}

/// Five points, within a circle of `radius` around x and y, as the data of a path.
std::string starPath(double x, double y, double radius) {
    constexpr double kPi = 3.14159265358979;
    constexpr double kInner = 0.45;
    std::string path;
    for (int i = 0; i < 10; ++i) {
        const double r = i % 2 ? kInner * radius : radius;
        const double angle = kPi * i / 5;
        path += (i ? "L" : "M") + fixed(x + r * std::sin(angle)) + " " + fixed(y - r * std::cos(angle));
    }
    return path + "z";
}

class Drawing {
public:
    explicit Drawing(const Plot& plot) : plot_(plot) {
        std::vector<double> times;
        std::vector<double> errors;
        for (const PlotPoint& p : plot.points) {
            times.push_back(p.time);
            errors.push_back(std::max(p.error, kLeastError));
            if (!p.pale) times.insert(times.end(), {p.timeLower, p.timeUpper});
        }
        x_ = axisAround(times, kLeft, plot.width - kRight);
        y_ = axisAround(errors, plot.height - kBottom, kTop);
    }

    DrawnPlot draw() {
        DrawnPlot drawn;
        drawn.svg = "<svg class=\"plot " + plot_.cssClass + "\" viewBox=\"0 0 " + fixed(plot_.width) + " " + fixed(plot_.height) +
                    "\" role=\"img\" aria-label=\"Error against time, both by their logarithm\">\n" + axes() + front();
        const std::vector<LabelPlace> places = labelPlaces();
        for (const bool hollow : {false, true})  // what a hollow mark surrounds shows
            for (size_t i = plot_.points.size(); i-- > 0;)
                if (isHollow(plot_.points[i]) == hollow) drawn.svg += mark(plot_.points[i]);
        for (size_t i = 0; i < places.size(); ++i) drawn.svg += leader(plot_.points[i], places[i]);
        for (size_t i = 0; i < places.size(); ++i) {
            if (!places[i].placed) continue;
            const PlotPoint& p = plot_.points[i];
            const std::string content = places[i].shortened ? p.number : p.text;
            drawn.svg += label(p, places[i].box, content);
            if (content == p.number) drawn.numbersAlone.push_back(i);
        }
        drawn.svg += "</svg>\n";
        return drawn;
    }

private:
    static constexpr double kLeft = 46, kRight = 12, kTop = 22, kBottom = 40, kText = 11;
    static constexpr double kApart = 5;  // two labels side by side, so that numbers do not run together
    static constexpr double kLeastError = 1e-9;
    static constexpr double kHalf = 0.5;  // of the time
    static constexpr const char* kFloorText = "the reference's own error";
    static constexpr const char* kHalfText = "half the time";

    double yOf(const PlotPoint& p) const { return y_.at(std::max(p.error, kLeastError)); }

    static bool isHollow(const PlotPoint& p) { return p.mark == Mark::hollowDiamond || p.mark == Mark::hollowSquare; }

    static double radiusOf(const PlotPoint& p) {
        if (p.pale) return 2.5;
        if (p.mark == Mark::star) return 10;
        if (p.mark == Mark::hollowDiamond) return 7;
        return p.mark != Mark::disc || p.group == "own" ? 6 : 4.5;
    }

    std::string axes() const {
        std::string out;
        for (double t : ticksThatFit(
                 x_, [](double value) { return lengthOf(percentOf(value)); }, plot_.width)) {
            out += line(x_.at(t), y_.to, x_.at(t), y_.from, "grid");
            out += text(x_.at(t), y_.from + 15, "tick", "middle", percentOf(t));
        }
        for (double t : ticksThatFit(
                 y_, [](double) { return kText; }, plot_.height)) {
            out += line(x_.from, y_.at(t), x_.to, y_.at(t), "grid");
            out += text(x_.from - 5, y_.at(t) + 4, "tick", "end", plain(t));
        }
        out += text((x_.from + x_.to) / 2, plot_.height - 6, "axis", "middle",
                    "time for a picture: 100 % is the scene's own settings");
        out += text(4, 12, "axis", "start", "error: less is better");
        if (y_.shows(plot_.floor)) {
            out += line(x_.from, y_.at(plot_.floor), x_.to, y_.at(plot_.floor), "floor");
            out += text(x_.to, y_.at(plot_.floor) - 3, "tick", "end", kFloorText);
        }
        if (x_.shows(kHalf)) {
            out += line(x_.at(kHalf), y_.to, x_.at(kHalf), y_.from, "halfway");
            out += text(x_.at(kHalf) + 3, y_.from - 4, "tick", "start", kHalfText);
        }
        return out;
    }

    std::string front() const {
        std::string path;
        for (size_t i : plot_.front) {
            const PlotPoint& p = plot_.points[i];
            path += path.empty() ? "M" + fixed(x_.at(p.time)) + " " + fixed(yOf(p))
                                 : "H" + fixed(x_.at(p.time)) + "V" + fixed(yOf(p));
        }
        return "<path class=\"front\" d=\"" + path + "\"/>\n";
    }

    std::string mark(const PlotPoint& p) const {
        const double x = x_.at(p.time);
        const double y = yOf(p);
        std::string out =
            "<g class=\"" + p.group + (p.pale ? " pale" : "") + "\"><title>" + escaped(p.number + ": " + p.name) + "</title>";
        if (!p.pale)
            out += "<path class=\"spread\" d=\"M" + fixed(x_.at(p.timeLower)) + " " + fixed(y) + "H" + fixed(x_.at(p.timeUpper)) +
                   "\"/>";
        return out + markSvg(p.mark, x, y, radiusOf(p)) + "</g>\n";
    }

    Box markOf(const PlotPoint& p) const {
        const double half = radiusOf(p);
        return {x_.at(p.time) - half, yOf(p) - half, 2 * half, 2 * half};
    }

    std::vector<LabelPlace> labelPlaces() const {
        std::vector<LabelWish> wishes;
        wishes.reserve(plot_.points.size());
        for (const PlotPoint& p : plot_.points) {
            const double width = p.text.empty() ? 0 : lengthOf(p.text) + kApart;
            wishes.push_back({markOf(p), width, lengthOf(p.number) + kApart});
        }
        const Box area = {x_.from + 1, kTop - 8, plot_.width - x_.from - 2, y_.from - kTop + 8};
        return placeLabels(wishes, area, kText, lines());
    }

    /// What labels keep off where there is room: bars, the front, and the texts of the lines.
    std::vector<Box> lines() const {
        std::vector<Box> boxes;
        const auto add = [&](double x1, double y1, double x2, double y2) {
            boxes.push_back({std::min(x1, x2) - 1, std::min(y1, y2) - 1, std::abs(x2 - x1) + 2, std::abs(y2 - y1) + 2});
        };
        constexpr double kBesideBar = 6;  // a label at the end of a bar seems to belong to it
        for (const PlotPoint& p : plot_.points)
            if (!p.pale) add(x_.at(p.timeLower) - kBesideBar, yOf(p), x_.at(p.timeUpper) + kBesideBar, yOf(p));
        for (size_t i = 1; i < plot_.front.size(); ++i) {
            const PlotPoint& before = plot_.points[plot_.front[i - 1]];
            const PlotPoint& after = plot_.points[plot_.front[i]];
            add(x_.at(before.time), yOf(before), x_.at(after.time), yOf(before));
            add(x_.at(after.time), yOf(before), x_.at(after.time), yOf(after));
        }
        const double floor = y_.at(plot_.floor);
        const double half = x_.at(kHalf);
        if (y_.shows(plot_.floor)) add(x_.to - lengthOf(kFloorText), floor - kText - 2, x_.to, floor);
        if (!x_.shows(kHalf)) return boxes;
        add(half, y_.to, half, y_.from);
        add(half, y_.from - kText - 4, half + lengthOf(kHalfText), y_.from);
        return boxes;
    }

    std::string leader(const PlotPoint& p, const LabelPlace& place) const {
        return place.leader ? line(x_.at(p.time), yOf(p), place.leaderX, place.leaderY, "leader") : "";
    }

    /// A content that is shorter than its box stays at its mark.
    std::string label(const PlotPoint& p, const Box& box, const std::string& content) const {
        constexpr double kDescent = 2;  // of letters, under their line
        const std::string cssClass = p.important ? "label important" : "label";
        const double y = box.y + box.height - kDescent;
        const double left = box.x + kApart / 2;
        const double right = box.x + box.width - kApart / 2;
        if (left >= x_.at(p.time)) return text(left, y, cssClass, "start", content);
        if (right <= x_.at(p.time)) return text(right, y, cssClass, "end", content);
        return text(box.middleX(), y, cssClass, "middle", content);
    }

    const Plot& plot_;
    Axis x_, y_;
};

}  // namespace

DrawnPlot drawPlot(const Plot& plot) {
    return Drawing(plot).draw();
}

std::string markSvg(Mark mark, double x, double y, double radius) {
    const auto path = [](const std::string& cssClass, const std::string& data) {
        return "<path class=\"" + cssClass + "\" d=\"" + data + "\"/>";
    };
    const std::string r = fixed(radius);
    if (mark == Mark::star) return path("solid star", starPath(x, y, radius));
    if (mark == Mark::hollowDiamond)
        return path("hollow",
                    "M" + fixed(x - radius) + " " + fixed(y) + "l" + r + " -" + r + " " + r + " " + r + " -" + r + " " + r + "z");
    if (mark == Mark::disc) return "<circle class=\"solid\" cx=\"" + fixed(x) + "\" cy=\"" + fixed(y) + "\" r=\"" + r + "\"/>";
    const std::string side = fixed(2 * radius - 1);
    return path(mark == Mark::square ? "solid" : "hollow",
                "M" + fixed(x - radius + 0.5) + " " + fixed(y - radius + 0.5) + "h" + side + "v" + side + "h-" + side + "z");
}

}  // namespace cost
