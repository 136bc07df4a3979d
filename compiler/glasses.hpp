// Indices of refraction over the visible spectrum: glasses by the dispersion formulas of their papers, and KHR_materials_dispersion.
#pragma once
#include <string>
#include <vector>

#include "scene.hpp"

namespace minirtc {

/// The visible spectrum here, and the Fraunhofer lines at which catalogues give indices; micrometres.
constexpr double kVisibleFrom = 0.38;
constexpr double kVisibleTo = 0.78;
constexpr double kLineF = 0.4861327;  // hydrogen, blue
constexpr double kLineD = 0.5875618;  // helium, yellow: n_d
constexpr double kLineC = 0.6562725;  // hydrogen, red

struct Glass;

/// In the order of the documentation.
std::vector<std::string> glassNames();

/// By its name or its other name; case, '-', '_' and ' ' do not count. nullptr where there is none.
const Glass* findGlass(const std::string& name);

/// The nearest names for a message.
std::string suggestGlass(const std::string& name);

/// By the formula of the glass, at a wavelength in micrometres.
double indexOf(const Glass& glass, double wavelength);

/// The formula as the runtime has it: channels at the lines C, d and F, and a curve within 1e-5 of it over the visible spectrum.
Dispersion disperse(const Glass& glass);

/// KHR_materials_dispersion: `dispersion` is 20 over the Abbe number. The curve is exact; red and blue lie (ior - 1) * dispersion / 40
/// to the sides of green.
Dispersion disperse(double ior, double dispersion);

/// The index that a curve gives, at a wavelength in micrometres.
double indexOn(const IndexCurve& curve, double wavelength);

}  // namespace minirtc
