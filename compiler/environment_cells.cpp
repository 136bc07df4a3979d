#include "environment_cells.hpp"

#include <cmath>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "pick_rows.hpp"
#include "shining.hpp"

namespace minirtc {
namespace {

constexpr uint32_t kMostColumns = 1024;
constexpr uint32_t kMostRows = 512;

/// How much a row or column of texels counts in a cell.
struct Share {
    uint32_t texel;
    double weight;
};

using Density = std::function<double(double)>;  // over [0, 1]

/// The integrals of (1 - f) * density and f * density over [from, to], where f rises from 0 at `start` by 1 each 1 / texels.
glm::dvec2 integrate(double from, double to, double start, uint32_t texels, const Density& density) {
    static constexpr double kNodes[] = {0.1127016653792583, 0.5, 0.8872983346207417};  // Gauss' rule
    static constexpr double kWeights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    constexpr double kLongest = 1.0 / 64;  // of a part: the sine is a polynomial there as far as double can tell
    const int parts = std::max(1, static_cast<int>(std::ceil((to - from) / kLongest)));
    glm::dvec2 sum(0);
    for (int part = 0; part < parts; ++part) {
        for (int k = 0; k < 3; ++k) {
            const double x = from + (to - from) * (part + kNodes[k]) / parts;
            const double f = (x - start) * texels;
            sum += kWeights[k] * density(x) * glm::dvec2(1 - f, f);
        }
    }
    return sum * ((to - from) / parts);
}

/// What each of `cells` equal parts of [0, 1] sees of `texels` texels, which are filtered linearly between their centres.
std::vector<std::vector<Share>> sharesOf(uint32_t cells, uint32_t texels, bool wraps, const Density& density) {
    std::vector<std::vector<Share>> shares(cells);
    const auto at = [&](int64_t k) {
        const auto n = static_cast<int64_t>(texels);
        return static_cast<uint32_t>(wraps ? (k + n) % n : std::clamp<int64_t>(k, 0, n - 1));
    };
    for (uint32_t cell = 0; cell < cells; ++cell) {
        const double begin = static_cast<double>(cell) / cells, end = (cell + 1.0) / cells;
        // Between the centres of texels k - 1 and k.
        for (auto k = static_cast<int64_t>(std::floor(begin * texels + 0.5)); k <= texels; ++k) {
            const double start = (static_cast<double>(k) - 0.5) / texels;
            const double from = std::max(begin, start), to = std::min(end, start + 1.0 / texels);
            if (from >= end) break;
            if (from >= to) continue;
            const glm::dvec2 weights = integrate(from, to, start, texels, density);
            shares[cell].push_back({at(k - 1), weights.x});
            shares[cell].push_back({at(k), weights.y});
        }
    }
    return shares;
}

/// A row of cells: the rows of texels that it sees, weighed, then its columns.
void addRow(const Image& image, const std::vector<Share>& rows, const std::vector<std::vector<Share>>& columns,
            std::vector<double>& weights) {
    std::vector<double> seen(image.width, 0.0);
    for (const Share& row : rows) {
        const glm::vec4* texels = image.texels.data() + static_cast<size_t>(row.texel) * image.width;
        for (uint32_t x = 0; x < image.width; ++x) seen[x] += row.weight * luminance(glm::dvec3(texels[x]));
    }
    for (const std::vector<Share>& column : columns) {
        double sum = 0;
        for (const Share& share : column) sum += share.weight * seen[share.texel];
        weights.push_back(sum);
    }
}

}  // namespace

EnvironmentCells environmentCells(const Scene& scene) {
    const double pi = glm::pi<double>();
    EnvironmentCells cells;
    if (scene.background.image == kNone) {
        cells.weights = {4 * pi * luminance(glm::dvec3(scene.background.color))};
    } else {
        const Image& image = scene.images[scene.background.image];
        cells.columns = std::min(image.width, kMostColumns);
        cells.rows = std::min(image.height, kMostRows);
        const auto columns = sharesOf(cells.columns, image.width, true, [](double) { return 1.0; });
        const auto rows = sharesOf(cells.rows, image.height, false, [&](double v) { return 2 * pi * pi * std::sin(pi * v); });
        for (const std::vector<Share>& row : rows) addRow(image, row, columns, cells.weights);
        for (double& weight : cells.weights) weight *= scene.background.strength;
    }
    for (const double weight : cells.weights) cells.total += weight;
    return cells;
}

std::vector<minirt_pick> environmentTable(const EnvironmentCells& cells) {
    const std::vector<uint32_t> zeros(cells.weights.size(), 0);
    const bool black = cells.total == 0;
    return pickRows(zeros, black ? std::vector<double>(zeros.size(), 1.0) : cells.weights);
}

}  // namespace minirtc
