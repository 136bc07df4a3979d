// Where the labels of a plot's points go.
#pragma once
#include <vector>

namespace cost {

/// Lengths in the units of the plot; y grows downwards.
struct Box {
    double x = 0, y = 0;  // top left
    double width = 0, height = 0;

    bool meets(const Box& other) const {
        return x < other.x + other.width && other.x < x + width && y < other.y + other.height && other.y < y + height;
    }
    bool holds(const Box& other) const {
        return x <= other.x && other.x + other.width <= x + width && y <= other.y && other.y + other.height <= y + height;
    }
    double middleX() const { return x + width / 2; }
    double middleY() const { return y + height / 2; }
};

/// Between two boxes, 0 where they meet.
double distance(const Box& a, const Box& b);

struct LabelWish {
    Box mark;               // of the point
    double width = 0;       // of the label; 0: the point has none
    double shortWidth = 0;  // of what stands for it where it finds no room near its point
};

struct LabelPlace {
    Box box;
    bool placed = false;  // false where none is wished for, and where `area` has no room left
    bool shortened = false;
    bool leader = false;              // a line to the mark is needed: it is far off, or another mark is as near
    double leaderX = 0, leaderY = 0;  // where that line ends at the box
};

/// Places labels in the order of the wishes, each as near to its mark as it can be within `area`: no two labels meet, nor does one meet a mark, and a label
/// without a leader is nearest to its own mark. Where there is room, no leader crosses a label or another mark. Labels go a little farther to keep off
/// `lines`. The same wishes have the same places.
std::vector<LabelPlace> placeLabels(const std::vector<LabelWish>& wishes, const Box& area, double height, std::vector<Box> lines);

}  // namespace cost
