#include "plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

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

struct Box {
    double x, y, width, height;

    bool meets(const Box& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height;
    }
};

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
        for (const PlotPoint& p : plot_.points) taken_.push_back({x_.at(p.time) - kMark, yOf(p) - kMark, 2 * kMark, 2 * kMark});
        for (size_t i = plot_.points.size(); i-- > 0;) out += mark(plot_.points[i]);
        for (const PlotPoint& p : plot_.points) out += label(p);
        return out + "</svg>\n";
    }

private:
    static constexpr double kLeft = 46, kRight = 12, kTop = 22, kBottom = 40, kMark = 4.5, kText = 11;

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
        const double floor = plot_.floor > 0 ? y_.at(plot_.floor) : 0;
        if (floor > y_.to && floor < y_.from)
            out +=
                line(x_.from, floor, x_.to, floor, "floor") + text(x_.to, floor - 3, "tick", "end", "the reference's own error");
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
            out += "<circle cx=\"" + fixed(x) + "\" cy=\"" + fixed(y) + "\" r=\"" + (p.group == "own" ? "6.0" : "4.5") + "\"/>";
        return out + "</g>\n";
    }

    /// Beside its mark, at the first place that is free; farther away with a line to the mark.
    std::string label(const PlotPoint& p) {
        const std::string content = plot_.names && !p.name.empty() ? p.label + " " + p.name : p.label;
        double length = 0;
        for (char c : content) length += (static_cast<unsigned char>(c) & 0xc0) == 0x80 ? 0 : 0.6 * kText;
        const double x = x_.at(p.time);
        const double y = yOf(p);
        for (double distance = 8; distance < 120; distance += 6) {
            for (int step = 0; step < 16; ++step) {
                const int turns = (step + 1) / 2 * (step % 2 ? -1 : 1);
                const double angle = turns * 0.3927 - 0.6;  // first above to the right, clear of the bar
                const double cx = x + distance * std::cos(angle);
                const double cy = y + distance * std::sin(angle);
                const Box box = {std::cos(angle) >= -0.1 ? cx : cx - length, cy - kText / 2, length, kText};
                if (!isFree(box)) continue;
                taken_.push_back(box);
                const std::string leader = distance > 14 ? line(x, y, cx, cy, "leader") : "";
                return leader + text(box.x, cy + 4, "label", "start", content);
            }
        }
        return "";
    }

    bool isFree(const Box& box) const {
        if (box.x < x_.from || box.x + box.width > plot_.width || box.y < kTop - 8 || box.y + box.height > y_.from) return false;
        return std::none_of(taken_.begin(), taken_.end(), [&](const Box& other) { return other.meets(box); });
    }

    const Plot& plot_;
    Axis x_, y_;
    std::vector<Box> taken_;
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
