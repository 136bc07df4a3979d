#include "plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

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
};

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
                                      : span > 1.2 ? std::vector<double>{1, 3}
                                                   : std::vector<double>{1, 1.5, 2, 3, 5, 7};
    std::vector<double> ticks;
    for (double power = std::floor(axis.low); power <= axis.high; power += 1) {
        for (double step : steps) {
            const double value = step * std::pow(10.0, power);
            if (std::log10(value) >= axis.low && std::log10(value) <= axis.high) ticks.push_back(value);
        }
    }
    return ticks;
}

/// Of a text in the plot's letters, at most.
double lengthOf(const std::string& content) {
    constexpr double kLetter = 7;
    double length = 0;
    for (char c : content) length += (static_cast<unsigned char>(c) & 0xc0) == 0x80 ? 0 : kLetter;
    return length;
}

std::string text(double x, double y, const std::string& cssClass, const std::string& anchor, const std::string& content) {
    return "<text x=\"" + fixed(x) + "\" y=\"" + fixed(y) + "\" class=\"" + cssClass + "\" text-anchor=\"" + anchor + "\">" +
           escaped(content) + "</text>\n";
}

std::string line(double x1, double y1, double x2, double y2, const std::string& cssClass) {
    return "<line x1=\"" + fixed(x1) + "\" y1=\"" + fixed(y1) + "\" x2=\"" + fixed(x2) + "\" y2=\"" + fixed(y2) + "\" class=\"" +
           cssClass + "\"/>\n";
}

class Drawing {
public:
    explicit Drawing(const Plot& plot) : plot_(plot) {
        std::vector<double> times;
        std::vector<double> errors;
        for (const PlotPoint& p : plot.points) times.push_back(p.time), errors.push_back(std::max(p.error, 1e-9));
        x_ = axisAround(times, kLeft, plot.width - kRight);
        y_ = axisAround(errors, plot.height - kBottom, kTop);
    }

    std::string svg() {
        std::string out = "<svg class=\"plot " + plot_.cssClass + "\" viewBox=\"0 0 " + fixed(plot_.width) + " " +
                          fixed(plot_.height) + "\" role=\"img\" aria-label=\"Error against time, both by their logarithm\">\n";
        out += axes() + front();
        const std::vector<LabelPlace> places = labelPlaces();
        for (size_t i = 0; i < places.size(); ++i) out += leader(plot_.points[i], places[i]);
        for (size_t i = plot_.points.size(); i-- > 0;) out += mark(plot_.points[i]);
        for (size_t i = 0; i < places.size(); ++i) out += label(plot_.points[i], places[i]);
        return out + "</svg>\n";
    }

private:
    static constexpr double kLeft = 46, kRight = 12, kTop = 22, kBottom = 40, kMark = 4.5, kOwnMark = 6, kText = 11;
    static constexpr double kApart = 5;  // two labels side by side, so that numbers do not run together
    static constexpr const char* kFloorText = "the reference's own error";

    double floorAt() const { return plot_.floor > 0 ? y_.at(plot_.floor) : 0; }
    bool floorShows() const { return floorAt() > y_.to && floorAt() < y_.from; }

    double yOf(const PlotPoint& p) const { return y_.at(std::max(p.error, 1e-9)); }

    std::string axes() const {
        std::string out;
        for (double t : ticksOf(x_)) {
            out += line(x_.at(t), y_.to, x_.at(t), y_.from, "grid");
            out += text(x_.at(t), y_.from + 15, "tick", "middle", plain(t));
        }
        for (double t : ticksOf(y_)) {
            out += line(x_.from, y_.at(t), x_.to, y_.at(t), "grid");
            out += text(x_.from - 5, y_.at(t) + 4, "tick", "end", plain(t));
        }
        out += text((x_.from + x_.to) / 2, plot_.height - 6, "axis", "middle", "time for a picture, ms");
        out += text(4, 12, "axis", "start", "error (relMSE): less is better");
        if (floorShows())
            out += line(x_.from, floorAt(), x_.to, floorAt(), "floor") + text(x_.to, floorAt() - 3, "tick", "end", kFloorText);
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
        const auto inside = [&](double at) { return fixed(std::clamp(at, x_.from, x_.to)); };
        std::string out = "<g class=\"" + p.group + "\"><title>" + escaped(p.label + ": " + p.name) + "</title>";
        out += "<path class=\"spread\" d=\"M" + inside(x_.at(p.timeLower)) + " " + fixed(y) + "H" + inside(x_.at(p.timeUpper)) +
               "\"/>";
        if (p.group == "combination")
            out += "<path d=\"M" + fixed(x - kMark) + " " + fixed(y) + "l4.5-4.5 4.5 4.5-4.5 4.5z\"/>";
        else
            out += "<circle cx=\"" + fixed(x) + "\" cy=\"" + fixed(y) + "\" r=\"" + fixed(p.group == "own" ? kOwnMark : kMark) +
                   "\"/>";
        return out + "</g>\n";
    }

    std::string contentOf(const PlotPoint& p) const { return plot_.names && !p.name.empty() ? p.label + " " + p.name : p.label; }

    /// A bar that only spreads the time is no mark: labels keep off it only where there is room.
    Box markOf(const PlotPoint& p) const {
        const double half = p.group == "own" ? kOwnMark : kMark;
        return {x_.at(p.time) - half, yOf(p) - half, 2 * half, 2 * half};
    }

    std::vector<LabelPlace> labelPlaces() const {
        std::vector<LabelWish> wishes;
        wishes.reserve(plot_.points.size());
        for (const PlotPoint& p : plot_.points)
            wishes.push_back({markOf(p), lengthOf(contentOf(p)) + kApart, lengthOf(p.label) + kApart});
        const Box area = {x_.from + 1, kTop - 8, plot_.width - x_.from - 2, y_.from - kTop + 8};
        return placeLabels(wishes, area, kText, lines());
    }

    /// What crosses labels out if it runs through them: the bars, the front, and the text of the reference's own error.
    std::vector<Box> lines() const {
        std::vector<Box> boxes;
        const auto add = [&](double x1, double y1, double x2, double y2) {
            boxes.push_back({std::min(x1, x2) - 1, std::min(y1, y2) - 1, std::abs(x2 - x1) + 2, std::abs(y2 - y1) + 2});
        };
        for (const PlotPoint& p : plot_.points) add(x_.at(p.timeLower), yOf(p), x_.at(p.timeUpper), yOf(p));
        for (size_t i = 1; i < plot_.front.size(); ++i) {
            const PlotPoint& before = plot_.points[plot_.front[i - 1]];
            const PlotPoint& after = plot_.points[plot_.front[i]];
            add(x_.at(before.time), yOf(before), x_.at(after.time), yOf(before));
            add(x_.at(after.time), yOf(before), x_.at(after.time), yOf(after));
        }
        if (floorShows()) add(x_.to - lengthOf(kFloorText), floorAt() - kText - 2, x_.to, floorAt());
        return boxes;
    }

    std::string leader(const PlotPoint& p, const LabelPlace& place) const {
        return place.placed && place.leader ? line(x_.at(p.time), yOf(p), place.leaderX, place.leaderY, "leader") : "";
    }

    std::string label(const PlotPoint& p, const LabelPlace& place) const {
        constexpr double kDescent = 2;  // of letters, under their line
        if (!place.placed) return "";
        return text(place.box.x + kApart / 2, place.box.y + place.box.height - kDescent, "label", "start",
                    place.shortened ? p.label : contentOf(p));
    }

    const Plot& plot_;
    Axis x_, y_;
};

}  // namespace

std::string plotSvg(const Plot& plot) {
    return Drawing(plot).svg();
}

std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

}  // namespace cost
