// What repeated measurements say.
#pragma once
#include <vector>

struct Spread {
    double median = 0;
    double lower = 0;  // quartiles
    double upper = 0;
};

/// Quartiles between neighbours by linear interpolation. At least one value.
Spread spreadOf(std::vector<double> values);

/// True where the values scatter around `value`: it lies between the quartiles.
bool covers(const Spread& spread, double value);
