// Error against time, both by their logarithm, as SVG.
#pragma once
#include <string>
#include <vector>

namespace cost {

struct PlotPoint {
    std::string number;    // as in the table: the label where `text` finds no room
    std::string name;      // for pointers that hover
    std::string text;      // the label; "": none
    std::string group;     // class of its mark: "own", "lever", "combination"
    bool advised = false;  // its mark is a star
    bool pale = false;     // a small mark without a bar: nothing to look at
    double time = 0;       // ms
    double timeLower = 0, timeUpper = 0;
    double error = 0;
};

struct Plot {
    double width = 0, height = 0;  // in units of which text takes 11
    std::string cssClass;
    std::vector<PlotPoint> points;  // the most important first: it has the best place for its label, and lies on top
    std::vector<size_t> front;      // of the points, by growing time
    double floor = 0;               // the reference's own error
    double halfTime = 0;            // of the scene's own settings, ms
};

struct DrawnPlot {
    std::string svg;
    std::vector<size_t> numbersAlone;  // points whose label is no more than their number
};

/// Text and colours are the page's style: classes axis, grid, tick, front, floor, half, own, lever, combination, pale, label.
DrawnPlot drawPlot(const Plot& plot);

/// Five points, within a circle of `radius` around x and y, as the data of a path.
std::string starPath(double x, double y, double radius);

}  // namespace cost
