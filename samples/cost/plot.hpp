// Error against time, both by their logarithm, as SVG.
#pragma once
#include <string>
#include <vector>

namespace cost {

enum class Mark { disc, star, square, hollowSquare, hollowDiamond };

struct PlotPoint {
    std::string number;  // as in the tables: the label where `text` finds no room
    std::string name;    // for pointers that hover
    std::string text;    // the label; "": none
    std::string group;   // class of its mark: "own", "lever", "combination", "half"
    Mark mark = Mark::disc;
    bool important = false;  // its label is bold
    bool pale = false;       // a small mark without a bar: nothing to look at
    double time = 0;         // share of that of the scene's own settings
    double timeLower = 0, timeUpper = 0;
    double error = 0;
};

struct Plot {
    double width = 0, height = 0;  // in units of which text takes 11
    std::string cssClass;
    std::vector<PlotPoint> points;  // the most important first: it has the best place for its label, and lies on top
    std::vector<size_t> front;      // of the points, by growing time
    double floor = 0;               // the reference's own error
};

struct DrawnPlot {
    std::string svg;
    std::vector<size_t> numbersAlone;  // points whose label is no more than their number
};

/// Text and colours are the page's style: classes axis, grid, tick, front, floor, halfway, own, lever, combination, half, pale, label, solid, hollow.
DrawnPlot drawPlot(const Plot& plot);

/// The inside of an SVG: a mark around x and y, as large as `radius`, in the colour of the text.
std::string markSvg(Mark mark, double x, double y, double radius);

}  // namespace cost
