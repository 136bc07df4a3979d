#include "confirmation.hpp"

#include <algorithm>
#include <set>

#include "recommendation.hpp"

namespace cost {

uint32_t affordableRounds(const Report& report, size_t measurement, uint32_t wanted, double seconds) {
    const double slowRound = (report.measurements.front().ms.upper + report.measurements[measurement].ms.upper) / 1000;
    const double fitting = (seconds - wakeSeconds(report.device)) / (slowRound * kBesideDevice) - 1;  // one warms up
    if (fitting < kLeastRounds) return 0;
    return static_cast<uint32_t>(std::min<double>(wanted, fitting));
}

void confirmRecommendation(const MeasureAgain& measureAgain, uint32_t rounds, const std::function<double()>& secondsLeft,
                           Report& report) {
    std::set<size_t> timed = {0};
    for (size_t i = recommended(report); timed.insert(i).second; i = recommended(report)) {
        const uint32_t fitting = affordableRounds(report, i, rounds, secondsLeft());
        report.confirmed = false;
        if (fitting == 0) return;
        const std::optional<Measurement> again = measureAgain(report.measurements[i].configuration, fitting);
        if (!again) return;
        report.measurements[i].ms = again->ms;
        report.measurements[i].slowdown = again->slowdown;
        report.compareSingles();
    }
    report.confirmed = recommended(report) != 0;
}

}  // namespace cost
