// minirt-compare: how much two linear pictures differ, such as one blob's on two devices.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "../common/command_line.hpp"
#include "../common/picture_file.hpp"

namespace {

struct Difference {
    double rmse = 0;  // over all channels
    double largest = 0;
    size_t pixels = 0;  // that differ by more than the tolerance in a channel
};

Difference compare(const Picture& a, const Picture& b, double tolerance) {
    Difference result;
    double squares = 0;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        double worst = 0;
        for (size_t k = i; k < i + 3; ++k) {
            const double d = std::abs(static_cast<double>(a.rgba[k]) - static_cast<double>(b.rgba[k]));
            squares += d * d;
            worst = std::max(worst, d);
        }
        result.largest = std::max(result.largest, worst);
        if (worst > tolerance) ++result.pixels;
    }
    const size_t pixels = a.rgba.size() / 4;
    result.rmse = std::sqrt(squares / (3.0 * static_cast<double>(pixels)));
    return result;
}

Picture read(const std::string& path) {
    Picture picture;
    const std::string problem = readPfm(path, picture);
    if (!problem.empty()) throw std::runtime_error(problem);
    return picture;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("minirt-compare prints how much two linear pictures differ; it exits with 1 beyond --max-rmse",
                 "minirt-compare");
    app.footer("Example:\n  minirt-compare cpu.pfm gpu.pfm --max-rmse 5e-3");
    std::string first;
    std::string second;
    double tolerance = 1e-3;
    double maxRmse = -1;
    app.add_option("first", first, "Picture (.pfm)")->required();
    app.add_option("second", second, "Picture of the same size (.pfm)")->required();
    app.add_option("--tolerance", tolerance, "Count pixels that differ by more than this in a channel")->capture_default_str();
    app.add_option("--max-rmse", maxRmse, "Fail when the root mean square error is larger")->check(CLI::NonNegativeNumber);
    app.failure_message(oneLineFailure);
    CLI11_PARSE(app, argc, argv);
    try {
        const Picture a = read(first);
        const Picture b = read(second);
        if (a.width != b.width || a.height != b.height) throw UsageError(second + ": not of the same size as " + first);
        const Difference d = compare(a, b, tolerance);
        std::printf("rmse %.6g  largest %.6g  pixels over %g: %zu of %zu\n", d.rmse, d.largest, tolerance, d.pixels,
                    a.rgba.size() / 4);
        return maxRmse < 0 || d.rmse <= maxRmse ? 0 : 1;  // a NaN fails
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
}
