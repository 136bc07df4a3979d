// Error against time, both by their logarithm, as SVG.
#pragma once
#include <string>
#include <vector>

namespace cost {

struct PlotPoint {
    std::string label;  // a number, as in the table
    std::string name;   // for plots that have room for names, and for pointers that hover
    std::string group;  // class of its mark: "own", "lever", "combination"
    double time = 0;    // ms
    double timeLower = 0, timeUpper = 0;
    double error = 0;
};

struct Plot {
    double width = 0, height = 0;  // in units of which text takes 11
    bool names = false;
    std::string cssClass;
    std::vector<PlotPoint> points;
    std::vector<size_t> front;  // by growing time
    double floor = 0;           // the reference's own error
};

/// Text and colours are the page's style: classes axis, grid, tick, front, floor, own, lever, combination, label.
std::string plotSvg(const Plot& plot);

/// For text and attributes.
std::string escaped(const std::string& text);

}  // namespace cost
