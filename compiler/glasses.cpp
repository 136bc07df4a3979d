#include "glasses.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "json_fields.hpp"

namespace minirtc {

enum class Formula {
    sellmeier,  // n^2 = 1 + sum of b l^2 / (l^2 - c), as pairs b, c; l in micrometres
    cauchy      // n = a0 + a1 / l^2 + a2 / l^4 + a3 l^2
};

struct Glass {
    const char* name;
    const char* alias;  // or nullptr
    Formula formula;
    std::array<double, 8> coefficients;
};

namespace {

/// Some papers give the wavelength of a resonance, others its square.
constexpr double squared(double x) {
    return x * x;
}

// Each by its page on refractiveindex.info (a database in the public domain), which names the paper.
const std::vector<Glass> kGlasses = {
    // SCHOTT N-BK7: Zemax catalogue of SCHOTT, 2017-01-20b.
    {"bk7", "n-bk7", Formula::sellmeier, {1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653}},
    // SCHOTT F2: the same catalogue.
    {"f2", nullptr, Formula::sellmeier, {1.34533359, 0.00997743871, 0.209073176, 0.0470450767, 0.937357162, 111.886764}},
    // SCHOTT SF11, with lead: the same catalogue.
    {"sf11", nullptr, Formula::sellmeier, {1.73848403, 0.0136068604, 0.311168974, 0.0615960463, 1.17490871, 121.922711}},
    // SCHOTT N-SF11, without: the same catalogue.
    {"n-sf11", nullptr, Formula::sellmeier, {1.73759695, 0.013188707, 0.313747346, 0.0623068142, 1.89878101, 155.23629}},
    // SCHOTT N-SF66: the same catalogue.
    {"n-sf66", "sf66", Formula::sellmeier, {2.0245976, 0.0147053225, 0.470187196, 0.0692998276, 2.59970433, 161.817601}},
    // SiO2, Malitson: Malitson, J. Opt. Soc. Am. 55, 1205 (1965), 20 degrees C.
    {"fused_silica",
     "quartz_glass",
     Formula::sellmeier,
     {0.6961663, squared(0.0684043), 0.4079426, squared(0.1162414), 0.8974794, squared(9.896161)}},
    // C, Peter: Peter, Zeitschrift fuer Physik 15, 358 (1923).
    {"diamond", nullptr, Formula::sellmeier, {0.3306, squared(0.1750), 4.3356, squared(0.1060)}},
    // Al2O3, Malitson-o: Malitson and Dodge, J. Opt. Soc. Am. 62, 1405 (1972), the ordinary ray at 20 degrees C.
    {"sapphire",
     "ruby",
     Formula::sellmeier,
     {1.4313493, squared(0.0726631), 0.65054713, squared(0.1193242), 5.3414021, squared(18.028251)}},
    // ZrO2, Wood: Wood and Nassau, Appl. Opt. 21, 2978 (1982), stabilised with 12 % yttria.
    {"cubic_zirconia",
     "zirconia",
     Formula::sellmeier,
     {1.347091, squared(0.062543), 2.117788, squared(0.166739), 9.452943, squared(24.320570)}},
    // H2O, Daimon-20.0C: Daimon and Masumura, Appl. Opt. 46, 3811 (2007).
    {"water",
     nullptr,
     Formula::sellmeier,
     {0.5684027565, 0.005101829712, 0.1726177391, 0.01821153936, 0.02086189578, 0.02620722293, 0.1130748688, 10.69792721}},
    // H2O, Warren-2008: Warren and Brandt, J. Geophys. Res. 113, D14220 (2008), -7 degrees C. They give a table with four decimals; this is
    // its least squares fit from 0.39 to 0.78 um, nowhere off by more than 8e-5.
    {"ice", nullptr, Formula::cauchy, {1.3035314, 0.0026354933, 0, -0.0041513851}},
    // C2H6O, Rheims: Rheims, Koeser and Wriedt, Meas. Sci. Technol. 8, 601 (1997), 20 degrees C; measured from 0.4765 um.
    {"ethanol", "alcohol", Formula::cauchy, {1.35265, 0.00306, 0.00002}},
};

std::string plain(const std::string& name) {
    std::string out;
    for (const char c : name)
        if (c != '-' && c != '_' && c != ' ') out += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

constexpr size_t kTerms = std::tuple_size_v<IndexCurve>;

/// The powers of c = 1 / wavelength^2 that a curve is made of: from -1.
std::array<double, kTerms> powersOf(double c) {
    std::array<double, kTerms> powers{};
    for (size_t k = 0; k < kTerms; ++k) powers[k] = k == 0 ? 1 / c : std::pow(c, static_cast<double>(k) - 1);
    return powers;
}

/// Solves the normal equations of a fit, which are symmetric and positive definite, by elimination.
IndexCurve solve(std::array<std::array<double, kTerms + 1>, kTerms> rows) {
    for (size_t i = 0; i < kTerms; ++i) {
        for (size_t j = 0; j < kTerms; ++j) {
            if (i == j) continue;
            const double factor = rows[j][i] / rows[i][i];
            for (size_t k = i; k <= kTerms; ++k) rows[j][k] -= factor * rows[i][k];
        }
    }
    IndexCurve curve{};
    for (size_t i = 0; i < kTerms; ++i) curve[i] = rows[i][kTerms] / rows[i][i];
    return curve;
}

/// Least squares on Chebyshev's nodes in c, which spreads the error evenly.
IndexCurve fit(const Glass& glass) {
    constexpr int kNodes = 64;
    const double from = 1 / squared(kVisibleTo), to = 1 / squared(kVisibleFrom);
    std::array<std::array<double, kTerms + 1>, kTerms> rows{};
    for (int node = 0; node < kNodes; ++node) {
        const double c = (from + to) / 2 + (to - from) / 2 * std::cos((node + 0.5) * glm::pi<double>() / kNodes);
        const double index = indexOf(glass, 1 / std::sqrt(c));
        const std::array<double, kTerms> powers = powersOf(c);
        for (size_t i = 0; i < kTerms; ++i) {
            for (size_t j = 0; j < kTerms; ++j) rows[i][j] += powers[i] * powers[j];
            rows[i][kTerms] += powers[i] * index;
        }
    }
    return solve(rows);
}

}  // namespace

std::vector<std::string> glassNames() {
    std::vector<std::string> names;
    names.reserve(kGlasses.size());
    for (const Glass& glass : kGlasses) names.emplace_back(glass.name);
    return names;
}

const Glass* findGlass(const std::string& name) {
    const auto is = [&](const Glass& glass) {
        return plain(glass.name) == plain(name) || (glass.alias && plain(glass.alias) == plain(name));
    };
    const auto found = std::find_if(kGlasses.begin(), kGlasses.end(), is);
    return found == kGlasses.end() ? nullptr : &*found;
}

std::string suggestGlass(const std::string& name) {
    std::string lower = name;
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return suggest(lower, glassNames());
}

double indexOf(const Glass& glass, double wavelength) {
    const double l2 = squared(wavelength);
    const auto& a = glass.coefficients;
    if (glass.formula == Formula::cauchy) return a[0] + a[1] / l2 + a[2] / (l2 * l2) + a[3] * l2;
    double n2 = 1;
    for (size_t k = 0; k < a.size(); k += 2) n2 += a[k] * l2 / (l2 - a[k + 1]);
    return std::sqrt(n2);
}

Dispersion disperse(const Glass& glass) {
    return {{indexOf(glass, kLineC), indexOf(glass, kLineD), indexOf(glass, kLineF)}, fit(glass)};
}

Dispersion disperse(double ior, double dispersion) {
    const double perAbbe = (ior - 1) * dispersion / 20;
    const double half = perAbbe / 2;
    return {{ior - half, ior, ior + half}, {0, ior - perAbbe * 1.5168, perAbbe * 0.523655}};
}

double indexOn(const IndexCurve& curve, double wavelength) {
    const std::array<double, kTerms> powers = powersOf(1 / squared(wavelength));
    double index = 0;
    for (size_t k = 0; k < kTerms; ++k) index += curve[k] * powers[k];
    return index;
}

}  // namespace minirtc
