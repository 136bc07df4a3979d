// Judges of random numbers: Pearson's chi-squared test of counts against expectations, Student's and Welch's of means.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <numeric>
#include <utility>
#include <vector>

namespace test {

/// Probability that a chi-squared variable of `dof` degrees of freedom is at least `statistic`: the upper incomplete gamma function
/// Q(dof / 2, statistic / 2), by its series below the mean and by its continued fraction above.
inline double chiSquaredTail(double statistic, double dof) {
    const double a = dof / 2;
    const double x = statistic / 2;
    if (x <= 0) return 1;
    const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1) {
        double term = 1 / a;
        double sum = term;
        for (double n = a + 1; term > sum * 1e-16; n += 1) sum += term *= x / n;
        return std::max(0.0, 1 - scale * sum);
    }
    // x + 1 - a - 1 (1 - a) / (x + 3 - a - 2 (2 - a) / (x + 5 - a - ...)), from the front after Lentz.
    double b = x + 1 - a;
    double c = 1e300;
    double d = 1 / b;
    double fraction = d;
    for (int n = 1; n < 100000; ++n) {
        const double numerator = n * (a - n);
        b += 2;
        d = 1 / (b + numerator * d);
        c = b + numerator / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < 1e-15) break;
    }
    return scale * fraction;
}

/// The regularised incomplete beta function I_x(a, b), by its continued fraction, from the front after Lentz.
inline double incompleteBeta(double a, double b, double x) {
    if (x <= 0 || x >= 1) return x <= 0 ? 0 : 1;
    if (x > (a + 1) / (a + b + 2)) return 1 - incompleteBeta(b, a, 1 - x);
    double c = 1;
    double d = 1 / (1 - (a + b) * x / (a + 1));
    double fraction = d;
    for (int m = 1; m < 100000; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        d = 1 / (1 + even * d);
        c = 1 + even / c;
        fraction *= c * d;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / (1 + odd * d);
        c = 1 + odd / c;
        fraction *= c * d;
        if (std::abs(c * d - 1) < 1e-15) break;
    }
    return std::exp(a * std::log(x) + b * std::log1p(-x) + std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b)) * fraction / a;
}

/// Probability that Student's t of `dof` degrees of freedom is at least |t| away from 0.
inline double studentTail(double t, double dof) {
    return incompleteBeta(dof / 2, 0.5, dof / (dof + t * t));
}

/// p-value of Welch's test that two lists of independent numbers have the same mean. Equal numbers throughout have p 1.
inline double welchP(const std::vector<double>& first, const std::vector<double>& second) {
    const auto moments = [](const std::vector<double>& list) {
        const auto n = static_cast<double>(list.size());
        const double mean = std::accumulate(list.begin(), list.end(), 0.0) / n;
        double squares = 0;
        for (const double x : list) squares += (x - mean) * (x - mean);
        return std::pair(mean, squares / (n * (n - 1)));
    };
    const auto [mean1, variance1] = moments(first);
    const auto [mean2, variance2] = moments(second);
    const double variance = variance1 + variance2;
    if (variance == 0) return mean1 == mean2 ? 1 : 0;
    const double terms = variance1 * variance1 / static_cast<double>(first.size() - 1) +
                         variance2 * variance2 / static_cast<double>(second.size() - 1);
    return studentTail((mean1 - mean2) / std::sqrt(variance), variance * variance / terms);
}

/// Level of each of `cases` independent tests, so that all together reject what is right with probability .01 (Sidak).
inline double sidakLevel(int cases) {
    return 1 - std::pow(0.99, 1.0 / cases);
}

/// p-value of the counts. Bins with an expectation below 5 are pooled, the smallest first.
inline double chiSquaredP(const std::vector<double>& counts, const std::vector<double>& expected) {
    std::vector<size_t> order(counts.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) { return expected[a] < expected[b]; });
    double statistic = 0;
    int bins = 0;
    double pooledCount = 0;
    double pooledExpected = 0;
    for (const size_t bin : order) {
        pooledCount += counts[bin];
        pooledExpected += expected[bin];
        if (pooledExpected < 5) continue;
        statistic += (pooledCount - pooledExpected) * (pooledCount - pooledExpected) / pooledExpected;
        ++bins;
        pooledCount = pooledExpected = 0;
    }
    return bins > 1 ? chiSquaredTail(statistic, bins - 1) : 0;
}

/// Counts over the unit square in 80 rows and 160 columns, and what fell outside.
class SquareCounts {
public:
    static constexpr int kRows = 80;
    static constexpr int kColumns = 160;
    static constexpr size_t kBins = 80 * size_t{160};

    void add(double row, double column) {
        const auto r = static_cast<size_t>(std::clamp(static_cast<int>(row * kRows), 0, kRows - 1));
        const auto c = static_cast<size_t>(std::clamp(static_cast<int>(column * kColumns), 0, kColumns - 1));
        counts_[r * kColumns + c] += 1;
        total_ += 1;
    }
    void addOutside() {
        counts_.back() += 1;
        total_ += 1;
    }

    /// Against the share of each bin, and of what lies outside as the rest.
    double p(const std::vector<double>& shares) const {
        std::vector<double> expected(shares);
        expected.push_back(std::max(0.0, 1 - std::accumulate(shares.begin(), shares.end(), 0.0)));
        for (double& e : expected) e *= total_;
        return chiSquaredP(counts_, expected);
    }
    double pUniform() const { return p(std::vector<double>(kBins, 1.0 / kBins)); }

private:
    std::vector<double> counts_ = std::vector<double>(kBins + 1);
    double total_ = 0;
};

/// The sphere as the unit square: rows count from the pole `axis`, columns around it. 1 - cos(theta) is 2 row^focus, so that a focus above 1 looks
/// closer at the pole; 1 makes bins of equal area.
class SphereGrid {
public:
    explicit SphereGrid(const glm::dvec3& axis = {0, 0, 1}, double focus = 1) : n_(axis), focus_(focus) {
        t_ = glm::normalize(glm::cross(std::abs(n_.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), n_));
        b_ = glm::cross(n_, t_);
    }

    void count(SquareCounts& counts, const glm::dvec3& w) const {
        const double x = glm::dot(w, t_);
        const double y = glm::dot(w, b_);
        const double z = glm::dot(w, n_);
        const double height = z > 0 ? (x * x + y * y) / (1 + z) : 1 - z;
        const double turn = std::atan2(y, x) / 6.283185307179586;
        counts.add(std::pow(height / 2, 1 / focus_), turn < 0 ? turn + 1 : turn);
    }

    /// The integral of pdf(direction) over each bin, by Gauss' rule, halved where that and its parts disagree.
    template <typename Pdf>
    std::vector<double> shares(const Pdf& pdf) const {
        std::vector<double> result;
        const double dr = 1.0 / SquareCounts::kRows;
        const double dc = 1.0 / SquareCounts::kColumns;
        for (int r = 0; r < SquareCounts::kRows; ++r) {
            for (int c = 0; c < SquareCounts::kColumns; ++c) {
                result.push_back(refine(pdf, r * dr, c * dc, dr, dc, gauss(pdf, r * dr, c * dc, dr, dc), 0));
            }
        }
        return result;
    }

private:
    template <typename Pdf>
    double gauss(const Pdf& pdf, double r, double c, double dr, double dc) const {
        static constexpr double kNodes[] = {0.1127016653792583, 0.5, 0.8872983346207417};
        static constexpr double kWeights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
        double sum = 0;
        for (int i = 0; i < 3; ++i) {
            const double row = r + dr * kNodes[i];
            const double height = 2 * std::pow(row, focus_);
            const double sine = std::sqrt(height * (2 - height));
            for (int j = 0; j < 3; ++j) {
                const double phi = 6.283185307179586 * (c + dc * kNodes[j]);
                const glm::dvec3 w = t_ * (sine * std::cos(phi)) + b_ * (sine * std::sin(phi)) + n_ * (1 - height);
                sum += kWeights[i] * kWeights[j] * pdf(w) * focus_ * height / row;
            }
        }
        return sum * dr * dc * 6.283185307179586;
    }
    template <typename Pdf>
    double refine(const Pdf& pdf, double r, double c, double dr, double dc, double whole, int depth) const {
        double parts[4];
        double sum = 0;
        for (int k = 0; k < 4; ++k) {
            sum += parts[k] = gauss(pdf, r + (k & 1) * dr / 2, c + (k >> 1) * dc / 2, dr / 2, dc / 2);
        }
        if (depth == 9 || std::abs(sum - whole) < 1e-9 + 1e-5 * whole) return sum;
        sum = 0;
        for (int k = 0; k < 4; ++k) {
            sum += refine(pdf, r + (k & 1) * dr / 2, c + (k >> 1) * dc / 2, dr / 2, dc / 2, parts[k], depth + 1);
        }
        return sum;
    }

    glm::dvec3 n_;
    glm::dvec3 t_;
    glm::dvec3 b_;
    double focus_;
};

}  // namespace test
