// Of minirt-cost what needs no device: metrics, statistics, the front, sentences, budgets, the page.
#include <doctest/doctest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "../samples/cost/action.hpp"
#include "../samples/cost/better_picture.hpp"
#include "../samples/cost/commands.hpp"
#include "../samples/cost/confirmation.hpp"
#include "../samples/cost/figures.hpp"
#include "../samples/cost/glossary.hpp"
#include "../samples/cost/half_time.hpp"
#include "../samples/cost/html.hpp"
#include "../samples/cost/page.hpp"
#include "../samples/cost/page_pictures.hpp"
#include "../samples/cost/pareto.hpp"
#include "../samples/cost/plot.hpp"
#include "../samples/cost/plot_labels.hpp"
#include "../samples/cost/recommendation.hpp"
#include "../samples/cost/report_json.hpp"
#include "../samples/cost/search.hpp"
#include "../samples/cost/spending.hpp"

namespace {

Picture constantPicture(float value, uint32_t width = 40, uint32_t height = 30) {
    return {width, height, std::vector<float>(size_t{width} * height * 4, value)};
}

Picture noisyPicture(float mean, float deviation, uint32_t seed) {
    Picture picture = constantPicture(mean, 200, 150);
    std::mt19937 random(seed);
    std::normal_distribution<float> noise(0, deviation);
    for (float& value : picture.rgba) value += noise(random);
    return picture;
}

cost::Lever fresnelLever() {
    return {cost::LeverKind::baked,
            "fresnel",
            "Fresnel",
            {{"none", "no Fresnel reflection", 0}, {"schlick", "Schlick's Fresnel", 0}, {"exact", "exact Fresnel", 0}},
            2,
            2,
            false,
            ""};
}

cost::Lever samplesLever() {
    return {cost::LeverKind::samples,
            "samples",
            "Samples a pixel",
            {{"2", "2 samples", 2}, {"4", "4 samples", 4}, {"8", "8 samples", 8}},
            1,
            2,
            true,
            ""};
}

cost::Lever idleLever() {
    cost::Lever lever{cost::LeverKind::baked,
                      "dispersion",
                      "Dispersion",
                      {{"off", "no dispersion", 0}, {"rgb", "dispersion", 0}},
                      1,
                      1,
                      false,
                      ""};
    lever.idle = "no medium disperses light";
    return lever;
}

cost::Measurement measured(cost::Configuration configuration, double slowdown, double relMse, double wrongPixels) {
    cost::Measurement m;
    m.configuration = std::move(configuration);
    m.repeats = 5;
    m.ms = {10 * slowdown, 9.9 * slowdown, 10.1 * slowdown};
    m.slowdown = {slowdown, slowdown * 0.99, slowdown * 1.01};
    m.error.relMse = relMse;
    m.relMse = {relMse, relMse, relMse};
    m.sameSamples.wrongPixels = wrongPixels;
    m.sameSamples.relMse = std::max(relMse - 0.01, 0.0);  // the rest is the noise of few samples
    m.error.ofPixels.assign(1200, static_cast<float>(relMse));
    m.picture = constantPicture(0.25f);
    return m;
}

/// Exact Fresnel costs 2 % over Schlick's and removes 80 %; twice the samples take twice the time and halve the error.
cost::Report sampleReport() {
    cost::Report report;
    report.device.is_cpu = 1;
    report.scene = "glass & <ice>";
    report.file = "glass & <ice>.json";
    report.baked = true;
    report.command = "minirt-cost \"a b.json\" -o a.html";
    report.date = "2026-01-01";
    report.width = 40, report.height = 30;
    report.sceneSamples = 4;
    report.levers = {fresnelLever(), idleLever(), samplesLever()};
    report.measurements = {measured({2, 1, 1}, 1, 0.01, 0.01),        measured({0, 1, 1}, 0.5, 0.03, 0.2),
                           measured({1, 1, 1}, 1 / 1.02, 0.05, 0.13), measured({2, 1, 0}, 0.5, 0.02, 0.01),
                           measured({2, 1, 2}, 2, 0.005, 0.01),       measured({1, 1, 0}, 0.49, 0.06, 0.13)};
    report.singles = 5;
    report.reference.samples = 256;
    report.reference.configuration = {2, 1, 2};
    report.reference.mean = constantPicture(0.3f);
    report.reference.relMse = 1e-4;
    report.compareSingles();
    report.front = cost::surelyOnFront(report);
    return report;
}

/// The same of a scene that takes 64 samples, of which 4 were measured.
cost::Report manySamplesReport() {
    cost::Report report = sampleReport();
    report.sceneSamples = 64;
    report.compareSingles();
    report.front = cost::surelyOnFront(report);
    return report;
}

/// A scene with these settings of Fresnel and four samples, and the same scene with another setting of Fresnel, which takes `slowdown` times as long.
cost::Report twoSettings(size_t own, size_t other, double slowdown, double ownError, double otherError, double otherPixels = 0) {
    cost::Report report = sampleReport();
    report.levers[0].initial = own;
    report.measurements = {measured({own, 1, 1}, 1, ownError, 0), measured({other, 1, 1}, slowdown, otherError, otherPixels)};
    report.singles = 2;
    report.comparisons = cost::compareLevers(report.levers, report.measurements, 1);
    report.front = cost::surelyOnFront(report);
    return report;
}

/// Points around the middle of `area`, `spread` of its sides apart, with labels `width` wide.
std::vector<cost::LabelWish> crowd(int count, const cost::Box& area, double spread, double width) {
    std::mt19937 random(7);
    std::normal_distribution<double> unit;
    std::vector<cost::LabelWish> wishes;
    for (int i = 0; i < count; ++i) {
        const double x = area.middleX() + area.width * spread * unit(random);
        const double y = area.middleY() + area.height * spread * unit(random);
        wishes.push_back({{x, y, 9, 9}, width, 13});
    }
    return wishes;
}

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The first tag that does not close what is open, or "".
std::string firstUnbalancedTag(const std::string& html) {
    std::vector<std::string> open;
    for (size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
        const size_t end = html.find('>', at);
        if (end == std::string::npos) return html.substr(at, 40);
        const std::string tag = html.substr(at + 1, end - at - 1);
        const std::string name = tag.substr(0, tag.find_first_of(" \n"));
        if (name == "!DOCTYPE" || name == "meta" || name == "img" || tag.back() == '/') continue;
        if (name[0] != '/') {
            open.push_back(name);
        } else {
            if (open.empty() || open.back() != name.substr(1)) return tag;
            open.pop_back();
        }
    }
    return open.empty() ? "" : open.back();
}

}  // namespace

TEST_CASE("relMSE, largest error and wrong pixels of a constant offset are their closed forms") {
    const float r = 0.5f;
    const float x = 0.6f;
    const cost::Errors errors = cost::compare(constantPicture(x), constantPicture(r));
    const double d = static_cast<double>(x) - r;
    CHECK(errors.relMse == doctest::Approx(d * d / (r * r + cost::kRelMseEpsilon)).epsilon(1e-6));
    CHECK(errors.largest == doctest::Approx(d));
    CHECK(errors.wrongPixels == 1);
    const cost::Errors none = cost::compare(constantPicture(r), constantPicture(r));
    CHECK(none.relMse == 0);
    CHECK(none.largest == 0);
    CHECK(none.wrongPixels == 0);
}

TEST_CASE("black references keep relMSE finite, and two steps of eight bits are not wrong yet") {
    CHECK(cost::compare(constantPicture(0.1f), constantPicture(0)).relMse == doctest::Approx(1));
    const auto linear = [](int step) { return std::pow((step / 255.0f + 0.055f) / 1.055f, 2.4f); };
    CHECK(cost::compare(constantPicture(linear(102)), constantPicture(linear(100))).wrongPixels == 0);
    CHECK(cost::compare(constantPicture(linear(103)), constantPicture(linear(100))).wrongPixels == 1);
}

TEST_CASE("one spark in a thousand pixels does not decide relMSE, but is the largest error") {
    Picture picture = constantPicture(0.5f);
    picture.rgba[0] = 1000;
    const cost::Errors errors = cost::compare(picture, constantPicture(0.5f));
    CHECK(errors.relMse == 0);
    CHECK(errors.largest == doctest::Approx(999.5));
}

TEST_CASE("the estimate of the bias finds an offset under noise, and none where there is none") {
    const Picture r1 = noisyPicture(0.5f, 0.02f, 1);
    const Picture r2 = noisyPicture(0.5f, 0.02f, 2);
    const Picture mean = constantPicture(0.5f, 200, 150);
    const cost::Estimate biased = cost::squaredBias(noisyPicture(0.52f, 0.2f, 3), noisyPicture(0.52f, 0.2f, 4), r1, r2, mean);
    CHECK(std::abs(biased.value - 0.0004 / 0.26) < 4 * biased.standardError);
    const cost::Estimate unbiased = cost::squaredBias(noisyPicture(0.5f, 0.05f, 5), noisyPicture(0.5f, 0.05f, 6), r1, r2, mean);
    CHECK(std::abs(unbiased.value) < 4 * unbiased.standardError);
    CHECK(biased.standardError > 0);
    CHECK(cost::relMseOfMean(r1, r2) == doctest::Approx(0.02 * 0.02 / 2 / 0.26).epsilon(0.05));
}

TEST_CASE("quartiles lie between their neighbours") {
    const Spread spread = spreadOf({5, 1, 3, 2, 4});
    CHECK(spread.median == 3);
    CHECK(spread.lower == 2);
    CHECK(spread.upper == 4);
    CHECK(spreadOf({1, 2}).median == 1.5);
    CHECK(spreadOf({7}).upper == 7);
    CHECK(covers(spread, 2));
    CHECK_FALSE(covers(spread, 1.9));
}

TEST_CASE("a device that slows down in some rounds changes no ratio") {
    const double drift[] = {1, 3, 1.5};
    std::vector<std::vector<cost::Timing>> settings(4);
    for (uint32_t round = 0; round < 3; ++round)
        for (size_t i = 0; i < settings.size(); ++i)
            settings[i].push_back({round, 10.0 * static_cast<double>(i + 1) * drift[round]});
    cost::removeDrift(settings, 3);
    const Spread ratio = cost::ratioOf(settings[2], settings[0]);
    CHECK(ratio.lower == doctest::Approx(3));
    CHECK(ratio.upper == doctest::Approx(3));
}

TEST_CASE("nothing beats a point of the front, and something is as good as each other point") {
    cost::Report report = sampleReport();
    report.comparisons.clear();
    report.measurements = {measured({2, 1, 1}, 1, 0.01, 0)};
    std::mt19937 random(1);
    std::uniform_real_distribution<double> logarithm(-1, 1);
    for (int i = 0; i < 200; ++i) {
        report.measurements.push_back(measured({1, 1, 1}, std::exp(logarithm(random)), 0.01 * std::exp(logarithm(random)), 0));
        cost::Measurement& m = report.measurements.back();
        m.bias.value = m.sameSamples.relMse = m.error.relMse;
        m.slowdown.lower = m.slowdown.upper = m.slowdown.median;
    }
    report.measurements[0].bias.value = 0.01;
    const std::vector<size_t> front = cost::surelyOnFront(report);
    REQUIRE(front.size() > 3);
    for (size_t i = 0; i < report.measurements.size(); ++i) {
        const auto asGood = [&](size_t k, double share) {
            return k != i && report.measurements[k].slowdown.median < report.measurements[i].slowdown.median * share &&
                   report.errorOf(k) < report.errorOf(i) * share;
        };
        const bool onFront = std::find(front.begin(), front.end(), i) != front.end();
        bool beaten = false;
        bool equalled = false;
        for (size_t k = 0; k < report.measurements.size(); ++k) {
            beaten = beaten || asGood(k, 1 - 0.03);
            equalled = equalled || asGood(k, 1 + 0.03);
        }
        CAPTURE(i);
        if (onFront) CHECK_FALSE(beaten);
        if (!onFront) CHECK(equalled);
    }
}

TEST_CASE("nothing is on the front of the measurements by chance") {
    cost::Report report = sampleReport();
    report.comparisons.clear();
    std::vector<cost::Measurement>& all = report.measurements;
    all = {measured({2, 1, 1}, 1, 0.01, 0), measured({1, 1, 1}, 0.8, 0.02, 0), measured({2, 1, 2}, 2, 0.005, 0),
           measured({0, 1, 1}, 0.99, 0.0101, 0)};
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{1, 0, 2});
    all[1].slowdown.upper = 1.1;  // as slow as the scene's own settings
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{0, 2});
    all[1] = measured({1, 1, 1}, 0.8, 0.009, 0);
    all[1].sameSamples.relMse = all[1].bias.value = 0;
    all[0] = measured({2, 1, 1}, 1, 0.01, 0);
    all[0].sameSamples.relMse = all[0].bias.value = 0.002;  // more wrong, and slower
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{1, 2});
}

TEST_CASE("a tie with the scene's own settings is not on the front, nor is a time that many comparisons make by chance") {
    cost::Report report = sampleReport();
    report.comparisons.clear();
    std::vector<cost::Measurement>& all = report.measurements;
    all = {measured({2, 1, 1}, 1, 0.01, 0), measured({1, 1, 1}, 1.6, 0.00999, 0), measured({2, 1, 2}, 2, 0.005, 0)};
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{0, 2});  // a tenth of a percent less error is none
    all[1] = measured({0, 1, 1}, 0.8, 0.03, 0);
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{1, 0, 2});
    all[1].slowdown = {0.8, 0.7, 0.95};  // faster than the scene's own settings by its quartiles, but twice as wide not
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{0, 2});
    all[1] = measured({0, 1, 1}, 0.8, 0.01, 0.02);  // as little error, but pixels that look wrong
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{1, 0, 2});
    all[1] = measured({0, 1, 1}, 0.8, 0.01, 0);
    CHECK(cost::surelyOnFront(report) == std::vector<size_t>{1, 2});
}

TEST_CASE("sentences give the cost of the accurate setting and what the cheap one does") {
    const cost::Report report = sampleReport();
    REQUIRE(report.comparisons.size() == 4);
    const cost::Comparison& fresnel = report.comparisons[0];
    CHECK(report.levers[fresnel.lever].name == "fresnel");
    CHECK(
        cost::sentence(report.levers[0], fresnel, 0) ==
        "Exact Fresnel instead of Schlick's Fresnel costs 2 % of the time (0.98 to 2.9 %) and removes 80 % of the error (0.0100 "
        "instead of 0.0500); without it 12 % of the pixels visibly change.");
    CHECK(cost::verdict(fresnel) == "keep");
    CHECK(cost::idleSentence(idleLever()) == "Dispersion: left alone, since no medium disperses light.");
}

TEST_CASE("sentences say where nothing changes, and where nothing can be told") {
    const std::vector<cost::Lever> levers = {samplesLever()};
    const auto compared = [&](double slowdown, double error) {
        return cost::compareLevers(levers, {measured({1}, 1, 0.01, 0), measured({2}, slowdown, error, 0)}, 1).front();
    };
    const auto said = [&](double slowdown, double error) { return cost::sentence(levers[0], compared(slowdown, error), 0); };
    CHECK(said(1.21, 0.01) ==
          "8 samples instead of 4 would cost 21 % more time (20 to 22 %) and change nothing that could be measured in the "
          "picture.");
    CHECK(cost::verdict(compared(1.21, 0.01)) == "spare");
    CHECK(said(1.004, 0.01) ==
          "8 samples instead of 4 would make no difference that could be measured, neither in time nor in the picture.");
    CHECK(cost::verdict(compared(1.004, 0.01)) == "either");
    CHECK(said(1.004, 0.005) ==
          "8 samples instead of 4 would have no measurable cost and remove 50 % of the error (0.00500 instead of 0.0100).");
    CHECK(said(3, 0.005) ==
          "8 samples instead of 4 would take 3.00 times as long (2.97 to 3.03) and remove 50 % of the error (0.00500 instead of "
          "0.0100).");
    CHECK(cost::verdict(compared(3, 0.005)) == "trade");
    CHECK(
        said(0.8, 0.012) ==
        "8 samples instead of 4 would save 20 % of the time (19 to 21 %) and add 20 % to the error (0.0120 instead of 0.0100).");
}

TEST_CASE("what to do is said of the setting that the scene has") {
    constexpr size_t kNone = 0, kSchlick = 1, kExact = 2;
    const auto advice = [](const cost::Report& report) { return cost::adviceOn(report, report.comparisons.front()); };
    CHECK(advice(twoSettings(kExact, kSchlick, 0.98, 0.01, 0.05, 0.12)).action == cost::Action::keep);
    CHECK(advice(twoSettings(kSchlick, kExact, 1.02, 0.05, 0.01)).action == cost::Action::upgrade);
    CHECK(advice(twoSettings(kExact, kSchlick, 0.8, 0.01, 0.01)).action == cost::Action::switchTo);
    const cost::Advice needless = advice(twoSettings(kSchlick, kExact, 1.3, 0.01, 0.01));
    CHECK(needless.action == cost::Action::notNeeded);
    CHECK(needless.reason == "slower for nothing");
    CHECK(advice(twoSettings(kExact, kNone, 0.5, 0.01, 0.015)).action == cost::Action::choose);
    CHECK(advice(twoSettings(kNone, kExact, 2, 0.015, 0.01)).action == cost::Action::choose);
    CHECK(advice(twoSettings(kExact, kNone, 0.96, 0.01, 0.0101)).action == cost::Action::keep);  // too little time to choose
    CHECK(advice(twoSettings(kExact, kSchlick, 1.002, 0.01, 0.01)).reason == "no measured difference");
    CHECK(advice(twoSettings(kSchlick, kExact, 1, 0.0103, 0.01)).reason == "only a little better");
    CHECK(advice(twoSettings(kSchlick, kExact, 1, 0.013, 0.01)).reason == "better, and not surely slower");
    cost::Report mixed = twoSettings(kSchlick, kExact, 1.5, 0.01, 0.012, 0);
    mixed.measurements[0].sameSamples.wrongPixels = 0.05;
    mixed.comparisons = cost::compareLevers(mixed.levers, mixed.measurements, 1);
    CHECK(advice(mixed).action == cost::Action::choose);
    CHECK(advice(mixed).reason == "fewer wrong pixels, but more error");
    CHECK(advice(twoSettings(kExact, kSchlick, 0.97, 0.01, 0.01)).action == cost::Action::hardlyMatters);
    CHECK(advice(twoSettings(kExact, kSchlick, 0.97, 0.01, 0.01)).reason == "not surely 5 % faster");
}

TEST_CASE("what the repeats scatter by is never called slower or faster") {
    constexpr size_t kSchlick = 1, kExact = 2;
    const auto reasonOf = [](cost::Report report, const Spread& time) {
        report.measurements[1].slowdown = time;
        report.compareSingles();
        return cost::adviceOn(report, report.comparisons.front()).reason;
    };
    const cost::Report same = twoSettings(kSchlick, kExact, 1, 0.01, 0.01);
    CHECK(reasonOf(same, {1.08, 1.03, 1.12}) == "not surely slower");  // beyond its quartiles, but not by what these spread
    CHECK(reasonOf(same, {1.08, 1.06, 1.1}) == "slower for nothing");
    CHECK(reasonOf(same, {1.06, 1.04, 1.08}) == "a little slower");
    CHECK(reasonOf(same, {1.08, 0.99, 1.12}) == "no measured difference");
    CHECK(reasonOf(twoSettings(kSchlick, kExact, 1, 0.013, 0.01), {1.08, 1.03, 1.12}) == "better, and not surely slower");
    CHECK(reasonOf(twoSettings(kExact, kSchlick, 1, 0.01, 0.013), {0.92, 0.88, 0.97}) == "worse, and not surely faster");
    CHECK(reasonOf(twoSettings(kExact, kSchlick, 1, 0.01, 0.013), {1.36, 1.35, 1.39}) == "worse, and slower");
    cost::Report longer = twoSettings(kExact, kSchlick, 1, 0.01, 0.05);
    longer.measurements[1].slowdown = {1.08, 1.03, 1.12};
    longer.compareSingles();
    CHECK(contains(cost::sentence(longer.levers[0], longer.comparisons.front(), 0), " has no measurable cost and removes"));
}

TEST_CASE("an instruction names the setting to take") {
    const auto said = [](const cost::Report& report) { return cost::instruction(report, report.comparisons.front()); };
    CHECK(said(twoSettings(2, 1, 0.98, 0.01, 0.05, 0.12)) == "Keep exact Fresnel");
    CHECK(said(twoSettings(1, 2, 1.02, 0.05, 0.01)) == "Upgrade to exact Fresnel");
    CHECK(said(twoSettings(2, 1, 0.8, 0.01, 0.01)) == "Switch to Schlick's Fresnel");
    CHECK(said(twoSettings(1, 2, 1.3, 0.01, 0.01)) == "No need for exact Fresnel");
    CHECK(said(twoSettings(2, 0, 0.5, 0.01, 0.015)) == "Your choice");
}

TEST_CASE("a sentence says costs of what the scene has, and would cost of what it does not") {
    const auto said = [](const cost::Report& report) {
        return cost::sentence(report.levers[0], report.comparisons.front(), report.floor());
    };
    CHECK(said(twoSettings(2, 1, 0.7, 0.01, 0.05)) ==
          "Exact Fresnel instead of Schlick's Fresnel costs 30 % of the time (29 to 31 %) and removes 80 % of the error (0.0100 "
          "instead of 0.0500).");
    CHECK(said(twoSettings(1, 2, 1.3, 0.05, 0.01)) ==
          "Exact Fresnel instead of Schlick's Fresnel would cost 30 % more time (29 to 31 %) and remove 80 % of the error "
          "(0.0100 instead of 0.0500).");
    CHECK(said(twoSettings(2, 1, 1.3, 0.01, 0.05)) ==
          "Exact Fresnel instead of Schlick's Fresnel costs no time: without it a picture takes 30 % longer (29 to 31 %), and "
          "removes 80 % of the error (0.0100 instead of 0.0500).");
}

TEST_CASE("errors that the reference cannot tell apart are not compared") {
    const cost::Report report = twoSettings(2, 1, 0.7, 0.01, 0.05);
    CHECK(cost::sentence(report.levers[0], report.comparisons.front(), 0.06) ==
          "Exact Fresnel instead of Schlick's Fresnel costs 30 % of the time (29 to 31 %) and changes less of the error than can "
          "be told "
          "(≤ 0.0600).");
    cost::Report many = manySamplesReport();
    CHECK(many.floor() == doctest::Approx(many.reference.relMse / 16));
}

TEST_CASE("settings that save as much are switched to only where they are what is recommended") {
    cost::Report report = sampleReport();
    report.measurements[1] = measured({0, 1, 1}, 0.6, 0.01, 0.01);
    report.measurements[2] = measured({1, 1, 1}, 0.8, 0.01, 0.01);
    report.compareSingles();
    REQUIRE(cost::recommended(report) == 1);
    CHECK(cost::adviceOn(report, *report.comparisonOf(1)).action == cost::Action::switchTo);
    CHECK(cost::adviceOn(report, *report.comparisonOf(2)).action == cost::Action::couldSwitch);
    const std::vector<size_t> found = cost::findings(report);
    REQUIRE(found.size() == 2);
    CHECK(report.comparisons[found[0]].measurement == 1);
}

TEST_CASE("how much of the error only more samples reduce") {
    cost::Report report = twoSettings(1, 2, 1.02, 0.05, 0.01);
    report.measurements.front().bias.value = 0.04;
    CHECK(cost::samplingShare(report) == doctest::Approx(0.2));
    CHECK(cost::betterPictureSentence(report) ==
          "Take exact Fresnel: 2 % more time (0.98 to 3 %), and the error falls from 0.0500 to 0.0100. 20 % of the error "
          "(0.0500) is jagged "
          "edges and missed detail of 4 samples a pixel: more samples reduce no more than that.");
    REQUIRE(cost::betterPicture(report));
    CHECK(cost::betterPicture(report)->configuration[0] == 2);
    CHECK(cost::betterPicture(report)->samples == 4);
    report = sampleReport();
    report.reference.random = true;
    CHECK(cost::betterPictureSentence(report) ==
          "Nearly all of the error (0.0100) is the noise of 4 samples a pixel, which more samples reduce. With all else as "
          "it is, take 8 samples: "
          "2.00 times the time (1.98 to 2.02), and the error falls from 0.0100 to 0.00500.");
    REQUIRE(cost::betterPicture(report));
    CHECK(cost::betterPicture(report)->samples == 8);
    CHECK(contains(cost::page(report), "For a better picture"));
    CHECK(cost::commandsFor(report, *cost::betterPicture(report)).back() ==
          "minirt-render 'glass & <ice>.mrt' -o 'glass & <ice>.png' --spp 8");
}

TEST_CASE("more samples are no better picture where the error was seen to rise with them") {
    cost::Report report = sampleReport();
    report.measurements[4] = measured({2, 1, 2}, 2, 0.012, 0.01);
    report.compareSingles();
    CHECK_FALSE(cost::betterPicture(report));
    CHECK_FALSE(contains(cost::betterPictureSentence(report), "take 8 samples"));
}

TEST_CASE("more samples never count as a better picture for no time") {
    cost::Report report = sampleReport();
    report.measurements[4] = measured({2, 1, 2}, 1.1, 0.005, 0.004);
    report.measurements[4].slowdown = {1.1, 0.9, 1.8};  // an unsteady machine
    report.compareSingles();
    const cost::Comparison* samples = report.comparisonOf(4);
    REQUIRE(samples);
    CHECK(cost::adviceOn(report, *samples).action == cost::Action::choose);
    CHECK(contains(cost::betterPictureSentence(report), "take 8 samples: more time, how much could not be told, and the error"));
}

TEST_CASE("of upgrades the one that gains the most is named") {
    cost::Report report = twoSettings(0, 1, 1.05, 0.05, 0.04);
    report.measurements.push_back(measured({2, 1, 1}, 1.1, 0.01, 0));
    report.singles = 3;
    report.compareSingles();
    CHECK(contains(cost::betterPictureSentence(report), "Take exact Fresnel: "));
}

TEST_CASE("a setting that saves time and makes a better picture is named for both, and typed once") {
    cost::Report report = twoSettings(1, 2, 0.8, 0.05, 0.01);
    report.measurements.front().bias.value = 0.04;
    REQUIRE(cost::recommended(report) == 1);
    CHECK(cost::adviceOn(report, report.comparisons.front()).action == cost::Action::switchTo);
    CHECK(contains(cost::betterPictureSentence(report),
                   "Take exact Fresnel: 20 % less time (19 to 21 %), and the error falls from 0.0500 to 0.0100."));
    REQUIRE(cost::betterPicture(report));
    CHECK(cost::betterPicture(report)->configuration[0] == 2);
    CHECK(contains(cost::page(report), "For the same picture in less time"));
    CHECK_FALSE(contains(cost::page(report), "For a better picture"));
    report = twoSettings(1, 2, 0.8, 0.0102, 0.01);  // hardly better
    REQUIRE(cost::recommended(report) == 1);
    CHECK_FALSE(contains(cost::betterPictureSentence(report), "exact Fresnel"));
}

TEST_CASE("what is recommended is not said once more for half the time") {
    cost::Report report = manySamplesReport();
    report.measurements[1] = measured({0, 1, 1}, 0.48, 0.01, 0.01);
    report.compareSingles();
    REQUIRE(cost::recommended(report) == 1);
    CHECK(cost::halfTime(report).measurement == 1);  // 66 samples fit half the time: about as many as were measured
    CHECK_FALSE(cost::halfTime(report).isShown());
    CHECK(cost::halfTimeSentence(report) == "The same: it halves the time already.");
    report.measurements[1] = measured({0, 1, 1}, 0.52, 0.01, 0.01);
    REQUIRE(cost::recommended(report) == 1);
    CHECK_FALSE(cost::halfTime(report).measurement);
    CHECK(cost::halfTime(report).isShown());
    CHECK(contains(cost::halfTimeSentence(report), "Take no Fresnel reflection and 61 samples a pixel: about 50 % less time"));
}

TEST_CASE("what was measured and takes over half of the time does not halve it") {
    cost::Report report = manySamplesReport();
    report.measurements[1] = measured({0, 1, 1}, 0.5, 0.3, 0.2);  // no choice
    const auto half = [&] { return cost::halfTime(report); };
    const auto fits = [&] { return half().fits && half().choice->ms <= half().own.ms / 2 * (1 + 1e-9); };
    for (const double time : {0.501, 0.52, 0.56, 0.7, 0.97}) {
        CAPTURE(time);
        report.measurements[3] = measured({2, 1, 0}, time, 0.02, 0.01);  // 2 samples of 4, for 32 of 64
        CHECK_FALSE(half().measurement);
        CHECK(half().choice->samples == static_cast<uint32_t>(32 * 0.5 / time));
        CHECK(half().choice->configuration == report.measurements[0].configuration);
        CHECK(half().choice->relMse == doctest::Approx(0.01 * 4 / half().choice->samples));
        CHECK(fits());
    }
    report.measurements[3] = measured({2, 1, 0}, 0.53, 0.02, 0.01);
    report.measurements[2] = measured({1, 1, 1}, 1.002, 0.01, 0.01);  // in the same time the same picture: no way round
    CHECK(half().choice->samples == 30);
    CHECK(half().choice->configuration == report.measurements[0].configuration);
    report.measurements[3].slowdown = {0.8, 0.4, 1.4};  // as long as the scene's own settings, for all that is known
    CHECK(half().choice->samples == 16);
    CHECK(fits());
    report.measurements[3] = measured({2, 1, 0}, 0.56, 0.02, 0.01);
    report.measurements[1] = measured({0, 1, 1}, 0.45, 0.011, 0.01);  // fits, with less error than 28 samples have
    CHECK(half().measurement == 1);
    CHECK(fits());
    report.measurements[1] = measured({0, 1, 1}, 0.5, 0.3, 0.2);
    report.measurements[3] = measured({2, 1, 0}, 0.5, 0.02, 0.01);
    CHECK(half().measurement == 3);
    CHECK(fits());
}

TEST_CASE("a setting of which fewer samples do not halve the time leaves room for others, or for none") {
    cost::Report report = sampleReport();
    report.sceneSamples = 2;
    report.levers[2].settings = {{"1", "1 sample", 1}, {"2", "2 samples", 2}};
    report.measurements = {measured({2, 1, 1}, 1, 0.01, 0.01), measured({0, 1, 1}, 0.5, 0.03, 0.2),
                           measured({2, 1, 0}, 0.6, 0.02, 0.01)};
    report.singles = 3;
    report.compareSingles();
    CHECK(cost::halfTime(report).measurement == 1);
    report.measurements[1].slowdown = {0.6, 0.55, 0.65};
    report.measurements[1].ms.median = 6;  // a sample alone is expected to fit
    CHECK(cost::halfTime(report).choice->configuration[0] == 0);
    CHECK(cost::halfTime(report).choice->samples == 1);
    report.measurements.push_back(measured({0, 1, 0}, 0.55, 0.06, 0.2));
    CHECK_FALSE(cost::halfTime(report).fits);
    CHECK(contains(cost::halfTimeSentence(report), "Nothing that was measured halves the time."));
}

TEST_CASE("a cheap setting that misses bright sparks has less noise, and is wrong all the same") {
    cost::Measurement accurate = measured({2, 1, 1}, 1, 0.01, 0);
    cost::Measurement cheap = measured({0, 1, 1}, 0.5, 0.004, 0.01);
    cheap.bias.value = cheap.sameSamples.relMse = 0.01 / 9;
    const cost::Comparison compared =
        cost::compareLevers({fresnelLever(), idleLever(), samplesLever()}, {accurate, cheap}, 1).front();
    CHECK(compared.change == cost::ErrorChange::less);
    CHECK(compared.removed == doctest::Approx(0.1));
}

TEST_CASE("differences that chance could make are none") {
    const std::vector<cost::Lever> levers = {samplesLever()};
    cost::Measurement own = measured({1}, 1, 0.010, 0);
    cost::Measurement other = measured({2}, 1, 0.011, 0);
    std::mt19937 random(1);
    std::normal_distribution<float> noise(0.01f, 0.05f);
    for (float& error : other.error.ofPixels) error = noise(random);
    const auto change = [&] { return cost::compareLevers(levers, {own, other}, 1).front().change; };
    CHECK(change() == cost::ErrorChange::none);
}

TEST_CASE("a bias counts as it will at the scene's own samples, where noise has gone") {
    cost::Lever depth = samplesLever();
    depth.kind = cost::LeverKind::depth;
    const std::vector<cost::Lever> levers = {depth, samplesLever()};
    cost::Measurement own = measured({1, 1}, 1, 0.012, 0);
    cost::Measurement other = measured({0, 1}, 1, 0.010, 0);
    own.bias = other.bias = {0, 0.001};
    other.shift = {0.004, 0.001};
    CHECK(cost::compareLevers(levers, {own, other}, 1).front().change == cost::ErrorChange::more);
    const cost::Comparison many = cost::compareLevers(levers, {own, other}, 100).front();
    CHECK(many.change == cost::ErrorChange::less);
    CHECK(many.removed == doctest::Approx(1 - 0.00012 / 0.00406));
}

TEST_CASE("percentages have two significant digits at most, and none but 0 and 1 are written as if they were these") {
    CHECK(cost::percent(0.021) == "2.1 %");
    CHECK(cost::percent(0.02) == "2 %");
    CHECK(cost::percent(0.004) == "0.4 %");
    CHECK(cost::percent(-0.0314) == "-3.1 %");
    CHECK(cost::percent(0.09949) == "9.9 %");
    CHECK(cost::percent(0.0996) == "10 %");
    CHECK(cost::percent(0.12345) == "12 %");
    CHECK(cost::percent(1.5) == "150 %");
    CHECK(cost::percent(0) == "0 %");
    CHECK(cost::percent(0.000123) == "0.012 %");
    CHECK(cost::percent(1e-5) == "under 0.01 %");
    CHECK(cost::percent(0.9904) == "99 %");
    CHECK(cost::percent(0.996) == "99.6 %");
    CHECK(cost::percent(0.9997) == "99.97 %");
    CHECK(cost::percent(0.99999) == "over 99.99 %");
    CHECK(cost::percent(1) == "100 %");
}

TEST_CASE("numbers have three significant digits") {
    CHECK(cost::number(0.00123) == "0.00123");
    CHECK(cost::number(1234) == "1234");
    CHECK(cost::number(0) == "0");
    CHECK(cost::number(2.5e-7) == "2.5e-07");
    CHECK(cost::number(6.9e-5) == "0.0000690");
}

TEST_CASE("letters are counted, not their bytes, and times are written against those of the scene") {
    CHECK(cost::letterCount("2 × Möller–Trumbore") == 19);
    CHECK(cost::relativeTime(0.7) == "−30 %");
    CHECK(cost::relativeTime(1.041) == "+4.1 %");
    CHECK(cost::relativeTime(2.06) == "2.06 ×");
    CHECK(cost::timeDifference({0.81, 0.75, 0.88}) == "19 % less time (12 to 25 %)");
    CHECK(cost::timeDifference({1.9, 1.8, 2.2}) == "90 % more time (80 to 120 %)");
    CHECK(cost::timeDifference({2.06, 1.98, 2.11}) == "2.06 times the time (1.98 to 2.11)");
    CHECK(cost::timeDifference({0.81, 0.8099, 0.8101}) == "19 % less time");
    CHECK(cost::errorChange(0.01, 0.02, 0) == "the error rises from 0.0100 to 0.0200");
    CHECK(cost::errorChange(0.01, 0.001, 0.002) == "the error falls from 0.0100 to ≤ 0.00200");
    CHECK(cost::errorChange(0.01, 0.010001, 0) == "the error stays at 0.0100");
}

TEST_CASE("each lever moves alone, and idle ones not at all") {
    const std::vector<cost::Lever> levers = {fresnelLever(), idleLever(), samplesLever()};
    const std::vector<cost::Configuration> all = cost::oneAtATime(levers);
    CHECK(all == std::vector<cost::Configuration>{{2, 1, 1}, {0, 1, 1}, {1, 1, 1}, {2, 1, 0}, {2, 1, 2}});
}

TEST_CASE("combinations are few, new, and begin with what saves time for nothing") {
    const std::vector<cost::Lever> levers = {fresnelLever(), idleLever(), samplesLever()};
    const std::vector<cost::Measurement> singles = {measured({2, 1, 1}, 1, 0.01, 0), measured({1, 1, 1}, 0.9, 0.01, 0),
                                                    measured({2, 1, 0}, 0.5, 0.02, 0), measured({2, 1, 2}, 2, 0.005, 0)};
    const std::vector<cost::Comparison> comparisons = cost::compareLevers(levers, singles, 1);
    const std::vector<cost::Configuration> found = cost::combinations(levers, comparisons, 12);
    CHECK(found == std::vector<cost::Configuration>{{1, 1, 2}, {1, 1, 0}});
    CHECK(cost::combinations(levers, comparisons, 1).size() <= 1);
}

TEST_CASE("combinations begin with what saves time and differs in its error by chance alone") {
    const std::vector<cost::Lever> levers = {fresnelLever(), idleLever(), samplesLever()};
    std::vector<cost::Measurement> singles = {measured({2, 1, 1}, 1, 0.01, 0), measured({0, 1, 1}, 0.8, 0.03, 0.1),
                                              measured({1, 1, 1}, 0.9, 0.0102, 0), measured({2, 1, 2}, 2, 0.005, 0)};
    singles[2].sameSamples.relMse = 0;  // the noise of few samples
    const auto found = [&] { return cost::combinations(levers, cost::compareLevers(levers, singles, 1), 12); };
    REQUIRE_FALSE(found().empty());
    CHECK(found().front() == cost::Configuration{1, 1, 2});
    singles[2] = measured({1, 1, 1}, 0.9, 0.0102, 0);  // its own doing
    CHECK(found().empty());
}

TEST_CASE("a budget buys the least error that fits, and says what it gives up") {
    const cost::Report report = sampleReport();
    const auto rich = cost::chooseWithin(80.5, report.levers, report.measurements, 1);
    REQUIRE(rich);
    CHECK(rich->samples == 32);
    CHECK(rich->configuration[0] == 2);
    CHECK(rich->ms <= 80.5);
    CHECK(cost::givenUp(report.levers, *rich, 4).empty());
    CHECK(cost::givenUpSentence(report.levers, *rich, 64) == "Given up: 32 samples a pixel instead of 64.");
    const auto poor = cost::chooseWithin(1.3, report.levers, report.measurements, 1);
    REQUIRE(poor);
    CHECK(poor->configuration[0] == 0);
    CHECK(poor->ms <= 1.3);
    CHECK(cost::givenUpSentence(report.levers, *poor, 4) ==
          "Given up: no Fresnel reflection instead of exact Fresnel, 1 sample a pixel instead of 4.");
    CHECK_FALSE(cost::chooseWithin(1.2, report.levers, report.measurements, 1));
    CHECK(cost::fastestMs(report.levers, report.measurements, 2) == doctest::Approx(2.5));
}

TEST_CASE("what more or fewer samples give is told by the scene's own number of them where that was measured") {
    cost::Report report = sampleReport();
    const auto error = [&] { return cost::chooseWithin(20.5, report.levers, report.measurements, 1)->relMse; };
    const double before = error();
    report.measurements[4].error.relMse =
        0.0005;  // twice the samples, a twentieth of the error: sparks that outnumber four samples
    report.measurements[4].bias.standardError = report.measurements[0].bias.standardError = 1e-9;  // random noise
    CHECK(error() == doctest::Approx(before));
    CHECK(error() == doctest::Approx(0.01 * 4 / 8));
}

TEST_CASE(
    "of budgets that buy about the same error, the one with the fewest changes is taken, and no time that is less by chance") {
    cost::Report report = sampleReport();
    report.measurements.push_back(measured({1, 1, 1}, 0.97, 0.01, 0.01));
    const auto choice = [&] { return cost::chooseWithin(40.5, report.levers, report.measurements, 1); };
    REQUIRE(choice());
    CHECK(choice()->configuration[0] == 2);  // 16 samples; Schlick's would be 16 too, with as much error
    report.measurements.back() = measured({1, 1, 1}, 0.6, 0.01, 0.01);
    CHECK(choice()->configuration[0] == 1);
    report.measurements.back().slowdown = {0.6, 0.5, 1.1};
    CHECK(choice()->configuration[0] == 2);
    CHECK(choice()->samples == 16);
    report.measurements.back() = measured({1, 1, 2}, 1.01, 0.004, 0.01);  // 8 samples in the time of 4
    const double own = report.measurements.front().ms.median;
    CHECK(cost::expected(report.levers, report.measurements, report.measurements.back(), 8).ms == doctest::Approx(own));
}

TEST_CASE("a setting that misses bright sparks is not expected to have less noise for it") {
    cost::Report report = sampleReport();
    report.measurements.push_back(measured({1, 1, 2}, 1.9, 0.004, 0.13));  // 8 samples
    report.measurements.back().bias = {0.0038, 0};
    const auto error = [&] { return cost::expected(report.levers, report.measurements, report.measurements.back(), 4).relMse; };
    CHECK(error() == doctest::Approx(0.0138));              // the noise of exact Fresnel at 4 samples, and the bias
    report.measurements.front().bias.standardError = 1e-5;  // of random pictures settings do differ in their noise
    CHECK(error() == doctest::Approx(0.0042));
}

TEST_CASE("random noise is expected to fall as the number of samples, whatever a few of them showed") {
    cost::Report report = sampleReport();
    report.measurements[3].error.relMse = 0.04;  // 2 samples: a power of 2
    report.measurements[4].error.relMse = 0.0025;
    const auto error = [&] { return cost::expected(report.levers, report.measurements, report.measurements[0], 64).relMse; };
    CHECK(error() == doctest::Approx(0.01 / 256));
    report.measurements[0].bias.standardError = 1e-5;
    CHECK(error() == doctest::Approx(0.01 / 16));
}

TEST_CASE("half the time is bought with the least error, or it is said that nothing measured halves it") {
    cost::Report report = manySamplesReport();
    CHECK(cost::halfTimeSentence(report) ==
          "Take 32 samples a pixel: 50 % less time, and the error rises from 0.000625 to 0.00125.");
    CHECK(cost::commandsFor(report, *cost::halfTime(report).choice).back() ==
          "minirt-render 'glass & <ice>.mrt' -o 'glass & <ice>.png' --spp 32");
    report = sampleReport();
    report.measurements[3].sameSamples.wrongPixels = 0.05;  // at 2 samples, which are no lever's doing
    CHECK(contains(cost::halfTimeSentence(report),
                   "Take 2 samples a pixel: 50 % less time, and the error rises from 0.0100 to 0.0200."));
    CHECK(cost::halfTime(report).wrongPixels == 0);
    report.measurements.front().bias.standardError = 1e-5;
    report.measurements.push_back(measured({1, 1, 0}, 0.5, 0.01, 0.01));
    CHECK(cost::recommended(report) == 6);
    CHECK(cost::halfTime(report).advised);
    CHECK(cost::halfTimeSentence(report) == "The same: it halves the time already.");
}

TEST_CASE("where not even one sample fits half the time, the fastest that surely saves some is named") {
    cost::Report report = sampleReport();
    report.levers[2].settings = {{"1", "1 sample", 1}, {"2", "2 samples", 2}};
    report.levers[2].initial = 0;
    report.sceneSamples = 1;
    report.measurements = {measured({2, 1, 0}, 1, 0.01, 0.01), measured({0, 1, 0}, 0.8, 0.03, 0.2),
                           measured({1, 1, 0}, 0.81, 0.02, 0.13), measured({2, 1, 1}, 2, 0.005, 0.01)};
    report.comparisons = cost::compareLevers(report.levers, report.measurements, 1);
    CHECK(cost::halfTimeSentence(report) ==
          "Nothing that was measured halves the time. What surely saves the most is Schlick's Fresnel: 19 % less time (18 to 20 "
          "%), "
          "and the error rises from 0.0100 to 0.0200; 12 % of the pixels visibly change, over the limit of 0.2 % for a "
          "recommendation.");
    CHECK_FALSE(cost::halfTime(report).fits);
    report.measurements[1] = measured({0, 1, 0}, 0.8, 0.0101, 0.01);
    report.measurements[1].sameSamples.relMse = 0;  // the noise of few samples: as accurate as the scene's own settings
    report.measurements[2] = measured({1, 1, 0}, 0.81, 0.01005, 0.01);
    report.measurements[2].sameSamples.relMse = 0.001;
    report.singles = 4;
    report.compareSingles();
    CHECK(cost::halfTime(report).measurement == 1);
    for (cost::Measurement& m : report.measurements) m.slowdown.upper = 0.96;
    CHECK(cost::halfTimeSentence(report) == "Nothing that was measured halves the time, or surely saves 5 % of it.");
    for (cost::Measurement& m : report.measurements) m.slowdown = {0.82, 0.62, 0.94};  // less than the repeats scatter
    CHECK(cost::halfTimeSentence(report) == "Nothing that was measured halves the time, or surely saves 5 % of it.");
    CHECK_FALSE(cost::halfTime(report).choice);
}

TEST_CASE("what is recommended is the fastest that keeps the quality, with the fewest settings changed") {
    cost::Report report = sampleReport();
    CHECK(cost::recommended(report) == 0);
    CHECK(contains(cost::recommendationSentence(report), "Keep the scene's own settings"));
    CHECK(cost::sceneKeys(report, cost::recommendedChoice(report)).empty());
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.0104, 0.011));
    CHECK(cost::recommended(report) == 6);
    CHECK(cost::recommendationSentence(report) ==
          "Take Schlick's Fresnel: 20 % less time (19 to 21 %), and the error rises from 0.0100 to 0.0104.");
    report.measurements.push_back(measured({0, 1, 2}, 0.79, 0.0104, 0.011));  // as fast, but changes more
    CHECK(cost::recommended(report) == 6);
    report.measurements.back().slowdown = {0.7, 0.69, 0.71};
    CHECK(cost::recommended(report) == 7);
    report.measurements.back().sameSamples.wrongPixels = 0.02;  // which is seen
    CHECK(cost::recommended(report) == 6);
    report.measurements[6].error.relMse = 0.0106;
    CHECK(cost::recommended(report) == 0);
    report.measurements[6].error.relMse = 0.0104;
    report.measurements[6].slowdown = {0.8, 0.7, 0.96};  // repeats differ by more
    CHECK(cost::recommended(report) == 0);
}

TEST_CASE("where a few pixels alone speak against a setting it is named, with what it would save") {
    cost::Report report = sampleReport();
    report.measurements.push_back(measured({1, 1, 1}, 0.6, 0.0104, 0.0155));
    CHECK(cost::recommended(report) == 0);
    CHECK(contains(
        cost::recommendationSentence(report),
        "The closest that just fails is Schlick's Fresnel: 40 % less time (39 to 41 %), but 0.55 % of the pixels visibly change; "
        "the limit is 0.2 %."));
    report.measurements.back().error.relMse = 0.02;
    CHECK_FALSE(contains(cost::recommendationSentence(report), "closest"));
    report.measurements.back() = measured({1, 1, 1}, 0.6, 0.0104, 0.05);  // far more than a few
    CHECK_FALSE(contains(cost::recommendationSentence(report), "closest"));
}

TEST_CASE("beside the plot stands why a point that looks as good as what is recommended is not") {
    cost::Report report = sampleReport();
    const auto why = [&] { return cost::whyNotRecommended(report, 6); };
    const auto isListed = [&](const std::string& reason) {
        const std::string html = cost::page(report);
        const size_t from = html.find("Several changed, as good as ★ or better by the looks of the plot, but not recommended:");
        if (from == std::string::npos) return false;
        const std::string list = html.substr(from, html.find("</ul>", from) - from);
        return contains(list, "<b class=\"combination\">6</b> " + report.nameOf(6) + ": " + cost::prose(reason));
    };
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.01, 0.0155));
    CHECK(why() == "0.55 % of the pixels visibly change (limit 0.2 %)");
    CHECK(isListed(why()));
    report.measurements.back() = measured({1, 1, 1}, 0.8, 0.0107, 0.01);
    CHECK(why() == "7 % more error (limit 5 %)");
    report.measurements.back() = measured({1, 1, 1}, 0.8, 0.02, 0.01);  // far above in the plot
    CHECK(why().empty());
    report.measurements.back() = measured({1, 1, 1}, 0.9, 0.01, 0.01);
    report.measurements.back().slowdown = {0.9, 0.8, 0.97};
    CHECK(why() == "not surely 5 % faster than the scene's own settings");
    CHECK(isListed(why()));
    report.measurements.back() = measured({1, 1, 2}, 0.79, 0.01, 0.01);
    report.measurements.push_back(measured({0, 1, 1}, 0.8, 0.01, 0.01));
    REQUIRE(cost::recommended(report) == 7);
    CHECK(why() == "a tie with what is recommended, which changes no more settings");
    CHECK(isListed(why()));
    CHECK(cost::whyNotRecommended(report, 7).empty());
    CHECK(cost::whyNotRecommended(report, 0).empty());
    report.measurements[6].slowdown = {0.9, 0.89, 0.91};
    CHECK(why().empty());  // right of it, and no better
    CHECK_FALSE(contains(cost::page(report), "but not recommended:"));
}

TEST_CASE("nothing is recommended for a time that is less by no more than repeats scatter") {
    cost::Report report = sampleReport();
    report.measurements.push_back(measured({1, 1, 1}, 0.82, 0.01, 0.01));
    CHECK(cost::recommended(report) == 6);
    report.measurements.back().slowdown = {0.82, 0.62, 0.94};
    CHECK(cost::recommended(report) == 0);
}

TEST_CASE("what is fast by chance shuts nothing else out") {
    cost::Report report = sampleReport();
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.01, 0.01));
    report.measurements.push_back(measured({0, 1, 2}, 0.6, 0.01, 0.01));
    CHECK(cost::recommended(report) == 7);
    report.measurements.back().slowdown = {0.6, 0.55, 0.85};  // repeats differ by more than it is faster
    CHECK(cost::recommended(report) == 6);
    report.measurements.back().slowdown.upper = 0.79;
    CHECK(cost::recommended(report) == 7);
    report.measurements[6].slowdown.lower = 0.78;
    CHECK(cost::recommended(report) == 6);
}

TEST_CASE("what is recommended is timed again, and replaced where it was fast by chance") {
    cost::Report report = sampleReport();
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.01, 0.01));
    report.measurements.push_back(measured({0, 1, 2}, 0.6, 0.01, 0.01));  // by chance
    std::vector<cost::Configuration> timed;
    const auto again = [&](const cost::Configuration& configuration, uint32_t rounds) -> std::optional<cost::Measurement> {
        CHECK(rounds == 5);
        timed.push_back(configuration);
        return measured(configuration, timed.size() == 1 ? 0.9 : 0.81, 0.01, 0.01);
    };
    cost::confirmRecommendation(
        again, 5, [] { return 60.0; }, report);
    CHECK(timed == std::vector<cost::Configuration>{{0, 1, 2}, {1, 1, 1}});
    CHECK(cost::recommended(report) == 6);
    CHECK(report.confirmed);
    CHECK(report.measurements[6].slowdown.median == 0.81);
    CHECK(contains(cost::recommendationRule(report), "timed once more"));
}

TEST_CASE("what is recommended in the end has been timed again, also where it was another's turn in between") {
    cost::Report report = sampleReport();
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.01, 0.01));
    report.measurements.push_back(measured({0, 1, 2}, 0.6, 0.01, 0.01));
    size_t calls = 0;
    const auto again = [&](const cost::Configuration& configuration, uint32_t) -> std::optional<cost::Measurement> {
        return measured(configuration, ++calls == 1 ? 0.85 : 0.9, 0.01, 0.01);
    };
    cost::confirmRecommendation(
        again, 5, [] { return 60.0; }, report);
    CHECK(calls == 2);
    CHECK(cost::recommended(report) == 7);
    CHECK(report.confirmed);
}

TEST_CASE("no recommendation is timed again beyond the time") {
    cost::Report report = sampleReport();
    report.measurements.front().bias.standardError = 1e-5;  // random
    for (size_t samples : {0, 1, 2}) report.measurements.push_back(measured({1, 1, samples}, 0.5, 0.01, 0.01));
    double clock = 0;
    size_t calls = 0;
    // Each turns out slow, so that the next one is to be timed; a picture takes what the device does and half as long beside it.
    const auto again = [&](const cost::Configuration& configuration, uint32_t rounds) -> std::optional<cost::Measurement> {
        clock += (rounds + 1) * 1.5 * 15.25e-3;
        ++calls;
        return measured(configuration, 1, 0.01, 0.01);
    };
    for (const double seconds : {0.0, 0.05, 0.1, 0.15, 0.2, 0.3, 1.0}) {
        CAPTURE(seconds);
        clock = 0, calls = 0;
        cost::Report copy = report;
        cost::confirmRecommendation(
            again, 5, [&] { return seconds - clock; }, copy);
        CHECK(clock <= seconds);
        CHECK_FALSE(copy.confirmed);
        CHECK(calls == (seconds < 0.1 ? 0 : seconds < 0.3 ? 1 : seconds < 1 ? 2 : 3));
    }
    CHECK(cost::affordableRounds(report, 6, 5, 0.1) == 3);
    CHECK(cost::affordableRounds(report, 6, 5, 0.09) == 0);
    CHECK(cost::affordableRounds(report, 6, 5, 0.12) == 4);
    CHECK(cost::affordableRounds(report, 6, 5, 100) == 5);
}

TEST_CASE("what wakes a GPU counts as time that is taken") {
    cost::Report report = sampleReport();
    report.prepareSeconds = 4;
    report.pipelines = 8;  // half a second each
    const auto rounds = [&](double seconds) { return cost::affordableRounds(report, 2, 5, seconds); };
    const auto combinations = [&](double seconds) { return cost::affordableCombinations(report, 5, seconds); };
    CHECK(rounds(1) == 5);
    CHECK(combinations(2) == 3);
    report.device.is_cpu = 0;
    CHECK(rounds(1) == 0);
    CHECK(rounds(2) == 5);
    CHECK(combinations(0.9) == 0);
    CHECK(combinations(2) == 1);
    CHECK(combinations(3) == 3);
}

TEST_CASE("of noisy pictures the error counts that the scene's own samples leave") {
    cost::Report report = manySamplesReport();
    report.reference.random = true;
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.0102, 0));
    report.measurements.back().bias = {0.0004, 0.0001};
    CHECK(cost::recommended(report) == 0);  // at 64 samples instead of 4 the bias is more than the noise
    report.sceneSamples = 4;
    report.comparisons = sampleReport().comparisons;
    CHECK(cost::recommended(report) == 6);
}

TEST_CASE("what is recommended can be typed, or written into the scene file") {
    cost::Report report = manySamplesReport();
    report.measurements.front().bias.standardError = 1e-5;  // random
    report.measurements.push_back(measured({1, 1, 0}, 0.5, 0.01, 0.01));
    CHECK(cost::commandsFor(report, cost::recommendedChoice(report)) ==
          std::vector<std::string>{"minirtc bake 'glass & <ice>.json' -o 'glass & <ice>.mrt' --set fresnel=schlick",
                                   "minirt-render 'glass & <ice>.mrt' -o 'glass & <ice>.png' --spp 32"});
    CHECK(cost::sceneKeys(report, cost::recommendedChoice(report)) ==
          R"("render": {"spp": 32, "accuracy": {"fresnel": "schlick"}})");
    CHECK(contains(cost::recommendationSentence(report), "Take Schlick's Fresnel and 32 samples a pixel: 50 % less time"));
    report.baked = false;
    report.file = "it's.mrt";
    CHECK(cost::commandsFor(report, cost::recommendedChoice(report)) ==
          std::vector<std::string>{R"(minirt-render 'it'\''s.mrt' -o 'glass & <ice>.png' --spp 32)"});
    CHECK(cost::sceneKeys(report, cost::recommendedChoice(report)).empty());
    CHECK(cost::shellWord("scenes/a-b_1.json") == "scenes/a-b_1.json");
    CHECK(cost::shellWord("") == "''");
}

TEST_CASE("no two labels of a crowded plot meet, nor do labels and points") {
    for (const double width : {300.0, 820.0}) {
        CAPTURE(width);
        const cost::Box area = {46, 14, width, 290};
        const std::vector<cost::LabelWish> wishes = crowd(60, area, 0.08, width > 500 ? 120 : 13);
        const std::vector<cost::LabelPlace> places = cost::placeLabels(wishes, area, 11, {});
        for (size_t i = 0; i < places.size(); ++i) {
            REQUIRE(places[i].placed);
            CHECK(area.holds(places[i].box));
            CHECK(places[i].box.width == (places[i].shortened ? 13 : wishes[i].width));
            for (size_t k = 0; k < places.size(); ++k) {
                CHECK_FALSE(places[i].box.meets(wishes[k].mark));
                if (k != i) CHECK_FALSE(places[i].box.meets(places[k].box));
            }
        }
    }
}

TEST_CASE("a label without a leader is nearest to its own point") {
    for (const double spread : {0.02, 0.05, 0.15}) {
        CAPTURE(spread);
        const cost::Box area = {46, 14, 820, 420};
        const std::vector<cost::LabelWish> wishes = crowd(25, area, spread, 120);
        const std::vector<cost::LabelPlace> places = cost::placeLabels(wishes, area, 11, {});
        size_t beside = 0;
        for (size_t i = 0; i < places.size(); ++i) {
            if (!places[i].placed || places[i].leader) continue;
            ++beside;
            for (size_t k = 0; k < wishes.size(); ++k)
                if (k != i) CHECK(cost::distance(wishes[k].mark, places[i].box) > cost::distance(wishes[i].mark, places[i].box));
        }
        if (spread > 0.1) CHECK(beside >= 3);
    }
}

TEST_CASE("the most important label is beside its point, also where lines run through that") {
    const cost::Box area = {0, 0, 400, 300};
    const cost::LabelWish own = {{196, 146, 9, 9}, 100, 13};
    const cost::LabelWish unnamed = {{150, 146, 9, 9}, 0, 13};
    const std::vector<cost::Box> lines = {{100, 149, 250, 3}};
    const std::vector<cost::LabelPlace> places = cost::placeLabels({own, unnamed}, area, 11, lines);
    CHECK(places[0].placed);
    CHECK_FALSE(places[0].leader);
    CHECK(cost::distance(own.mark, places[0].box) < 8);
    CHECK_FALSE(places[0].box.meets(lines[0]));
    CHECK_FALSE(places[1].placed);
}

TEST_CASE("where there is room, no leader crosses a label") {
    const cost::Box area = {46, 14, 820, 420};
    const std::vector<cost::LabelWish> wishes = crowd(25, area, 0.15, 120);
    const std::vector<cost::LabelPlace> places = cost::placeLabels(wishes, area, 11, {});
    for (size_t i = 0; i < places.size(); ++i)
        for (size_t k = 0; k < places.size(); ++k)
            for (double t = 0; places[i].leader && k != i && t <= 1; t += 0.01) {
                const cost::Box& mark = wishes[i].mark;
                const double x = mark.middleX() + t * (places[i].leaderX - mark.middleX());
                const double y = mark.middleY() + t * (places[i].leaderY - mark.middleY());
                CHECK_FALSE(places[k].box.meets({x, y, 0, 0}));
            }
}

TEST_CASE("base64 is that of RFC 4648") {
    const auto encoded = [](const std::string& text) { return cost::base64({text.begin(), text.end()}); };
    CHECK(encoded("") == "");
    CHECK(encoded("f") == "Zg==");
    CHECK(encoded("fo") == "Zm8=");
    CHECK(encoded("foo") == "Zm9v");
    CHECK(encoded("foobar") == "Zm9vYmFy");
}

TEST_CASE("figures in a sentence are those of its row in the table, of the plot and of the JSON") {
    cost::Report report = sampleReport();
    report.compareSingles();
    const std::string html = cost::page(report);
    const auto json = nlohmann::json::parse(cost::reportJson(report));
    const auto rowOf = [&](const std::string& from) {
        const size_t at = html.find(from, html.find("class=\"settings\""));
        REQUIRE(at != std::string::npos);
        return html.substr(at, html.find("</tr>", at) - at);
    };
    for (const cost::Comparison& c : report.comparisons) {
        const std::string row = rowOf("<b class=\"lever\">" + std::to_string(c.measurement) + "</b>");
        const std::string then = cost::number(c.errorThen());
        const std::string now = cost::number(report.errorOf(0));
        const std::string sentence = cost::sentence(report.levers[c.lever], c, report.floor());
        CAPTURE(sentence);
        CHECK(contains(row, "data-label=\"Error\">" + then + "<"));
        CHECK(contains(rowOf("<b class=\"own\">0</b>"), ">" + now + "<"));
        CHECK(contains(sentence,
                       c.sceneHasAccurate ? "(" + now + " instead of " + then + ")" : "(" + then + " instead of " + now + ")"));
        const std::string time = cost::relativeTime(c.relativeTime.median);
        CHECK(contains(row, time.substr(0, time.find(' '))));
        const std::string size = time.substr(0, 1) < "0" ? time.substr(1) : time.find("−") == 0 ? time.substr(3) : time;
        CHECK(contains(sentence, size.substr(0, size.find(' '))));
        CHECK(json["measurements"][c.measurement]["expected_relmse"] == c.errorThen());
    }
    CHECK(cost::number(report.errorOf(2)) == "0.0500");
}

TEST_CASE("a row says what the scene has, how far its time is known, and what to do") {
    const std::string html = cost::page(twoSettings(1, 2, 1.3, 0.01, 0.01));
    CHECK(contains(html, "Fresnel<small>now: Schlick's Fresnel</small>"));
    CHECK(contains(html, "+30\u00a0%<small>+29\u00a0% to +31\u00a0%</small>"));
    CHECK(contains(html, "<span class=\"chip not-needed\">not needed</span><small>slower for nothing</small>"));
    CHECK_FALSE(contains(html, "spare"));
}

TEST_CASE("an error below that of the reference is marked as not to be believed") {
    cost::Report report = twoSettings(2, 1, 0.9, 0.001, 0.05);
    report.reference.relMse = 0.002;
    CHECK(cost::errorFigure(0.001, 0.002) == "≤ 0.00200");
    CHECK(cost::errorFigure(0.0021, 0.002) == "0.00210");
    const std::string html = cost::page(report);
    CHECK(contains(html, "data-label=\"Error\">≤\u00a00.00200<"));
    CHECK(contains(html, "(≤\u00a00.00200 instead of 0.0500)"));
    CHECK_FALSE(contains(html, "data-label=\"Error\">0.00100<"));
}

TEST_CASE("what halves the time is marked in the plot and in the table, hollow where it is only expected") {
    cost::Report report = manySamplesReport();
    REQUIRE(cost::halfTime(report).measurement == 3);  // 2 samples of 4, for 32 of 64
    std::string html = cost::page(report);
    CHECK(contains(html, "<g class=\"half\"><title>3: 2 samples"));
    const auto inSettings = [&](const std::string& part) {
        const size_t from = html.find("class=\"choices\"");
        return contains(html.substr(from, html.find("</tbody>", from) - from), part);
    };
    CHECK(inSettings("<b class=\"half\">3</b> 32 samples a pixel <span class=\"badge\">■ half the time"));
    CHECK(inSettings("−50\u00a0%"));
    CHECK(inSettings(">" + cost::number(report.errorOf(3)) + "<"));
    CHECK_FALSE(contains(html, "□"));
    cost::Report slower = report;
    slower.measurements[3].slowdown = {0.56, 0.55, 0.57};
    CHECK(contains(cost::halfTimeSentence(slower), "Take 28 samples a pixel: about 51 % less time"));
    cost::Report unsteady = report;
    unsteady.measurements[3].slowdown = {0.5, 0.4, 1.4};  // which the table calls the same time
    unsteady.measurements[1].error.relMse = 0.3;
    CHECK_FALSE(cost::halfTime(unsteady).measurement);
    CHECK(contains(cost::halfTimeSentence(unsteady), "about 50 % less time"));
    report.measurements.erase(report.measurements.begin() + 5);
    report.measurements.erase(report.measurements.begin() + 3);
    report.singles = 4;
    report.comparisons = cost::compareLevers(report.levers, report.measurements, 16);
    report.front = cost::surelyOnFront(report);
    const cost::HalfTime half = cost::halfTime(report);
    REQUIRE_FALSE(half.measurement);
    html = cost::page(report);
    CHECK(contains(html, "<g class=\"half\"><title>½: 32 samples a pixel"));
    CHECK(inSettings("<b class=\"half\">½</b> 32 samples a pixel <span class=\"badge\">□ half the time, expected"));
    CHECK(inSettings(">" + cost::number(half.choice->relMse) + "<"));
    CHECK(contains(html, "expected, not measured"));
    CHECK_FALSE(contains(html, "<li><b class=\"half\">½"));  // once is enough
    CHECK_FALSE(contains(html, "■"));
    CHECK(contains(html, "<td>" + cost::number(half.choice->relMse) + "</td>"));
    CHECK(contains(cost::halfTimeSentence(report), "Take 32 samples a pixel: about 50 % less time"));
}

TEST_CASE("pixels that change are told alike in all rows of a measurement") {
    cost::Report report = sampleReport();
    const auto cells = [&](const std::string& row) {
        const std::string html = cost::page(report);
        std::vector<std::string> found;
        for (size_t at = html.find(row); at != std::string::npos; at = html.find(row, at + 1)) {
            const std::string label = "data-label=\"Visibly changed pixels\">";
            const size_t end = html.find("</tr>", at);
            const size_t from = html.find(label, at);
            if (from < end) found.push_back(html.substr(from + label.size(), html.find("</td>", from) - from - label.size()));
        }
        return found;
    };
    const std::string schlick = "<b class=\"lever\">2</b> Schlick's Fresnel";
    using Cells = std::vector<std::string>;
    for (const double wrong : {0.01, 0.005, 0.0115}) {  // as many as of the scene's own, fewer, and too few more to count
        CAPTURE(wrong);
        report.measurements[2] = measured({1, 1, 1}, 0.8, 0.01, wrong);
        report.compareSingles();
        REQUIRE(cost::recommended(report) == 2);
        CHECK(cells(schlick) == Cells{"none", "none"});
    }
    report.measurements[2].sameSamples.wrongPixels = 0.05;
    report.compareSingles();
    CHECK(cells(schlick) == Cells{"<a href=\"#picture-2\">4\u00a0%</a>"});
    report.measurements[5] = measured({0, 1, 2}, 0.5, 0.01, 0.005);
    REQUIRE(cost::recommended(report) == 5);
    CHECK(cells("<b class=\"combination\">5</b>") == Cells{"none"});
    report = manySamplesReport();
    CHECK(cells("<b class=\"half\">3</b>") == Cells{"–"});
}

TEST_CASE("the sign for what is not to be believed is explained wherever a row of the table has it") {
    const std::string key = "<b>≤</b>";
    cost::Report report = sampleReport();
    CHECK_FALSE(contains(cost::page(report), key));
    report.reference.relMse = 0.005;  // of twice the samples, too
    CHECK(contains(cost::page(report), key));
    report.reference.relMse = 0.001;
    report.measurements[5] = measured({1, 1, 0}, 0.45, 0.0004, 0.01);
    report.measurements[5].sameSamples.relMse = 0;
    report.measurements.front().bias.standardError = 1e-5;
    report.compareSingles();
    REQUIRE(cost::recommended(report) == 5);  // of which there is no row but the one at the top
    CHECK(contains(cost::page(report), key));
    report.measurements[5].error.relMse = 0.002;
    CHECK_FALSE(contains(cost::page(report), key));
    CHECK_FALSE(contains(cost::page(report), "≤"));
}

TEST_CASE("a sign that is nowhere on the page is nowhere explained") {
    cost::Report report = twoSettings(2, 1, 0.45, 0.01, 0.01);
    std::string html = cost::page(report);
    CHECK(contains(html, "smaller errors are not to be believed."));
    CHECK_FALSE(contains(html, "≤"));
    CHECK_FALSE(contains(html, "<b>–</b>"));  // no row has other samples
    CHECK(contains(cost::page(sampleReport()), "<b>–</b>"));
    report.measurements.push_back(measured({1, 1, 0}, 0.85, 0.0004, 0.01));
    report.measurements.back().sameSamples.relMse = 0;
    report.measurements.front().bias.standardError = 1e-5;
    report.reference.relMse = 0.001;
    html = cost::page(report);
    const size_t figures = html.find("id=\"figures\"");
    REQUIRE_FALSE(contains(html.substr(0, html.find("id=\"settings\"")), "≤"));
    CHECK(contains(html.substr(figures, html.find("id=\"method\"") - figures), "<b>≤</b>: no larger than"));
    CHECK(contains(html, "smaller errors are not to be believed, and marked ≤."));
}

TEST_CASE("beside both columns of errors stands how they relate") {
    const auto key = [](const cost::Report& report) {
        const std::string html = cost::page(report);
        const size_t figures = html.find("id=\"figures\"");
        return html.substr(figures, html.find("id=\"method\"") - figures);
    };
    CHECK(contains(key(sampleReport()),
                   "<b>Error as measured</b>: of the picture as it was rendered. <b>Error</b>, as on the rest of "));
    const std::string many = key(manySamplesReport());
    CHECK(contains(many, "as it was rendered, with 4 samples a pixel in place of the scene's own 64. <b>Error</b>"));
    CHECK(contains(many, "what other settings surely add or take, estimated for the scene's own 64."));
}

TEST_CASE("of several larger numbers of samples one is advised, everywhere the same") {
    cost::Report report = sampleReport();
    report.levers[2].settings.push_back({"16", "16 samples", 16});
    report.measurements.insert(report.measurements.begin() + 5, measured({2, 1, 3}, 4, 0.0005, 0.01));  // gains more for its time
    report.singles = 6;
    report.compareSingles();
    CHECK(contains(cost::betterPictureSentence(report), "take 8 samples: "));
    const auto reason = [&](size_t measurement) { return cost::adviceOn(report, *report.comparisonOf(measurement)).reason; };
    CHECK(reason(4) == "better, but slower");
    CHECK(reason(5) == "only if 8 samples are too few");
    CHECK(report.comparisonOf(4)->leading);
    CHECK_FALSE(report.comparisonOf(5)->leading);
    CHECK(contains(cost::page(report), "only if 8 samples are too few"));
}

TEST_CASE("the parts of the page come in the order in which they are needed") {
    const std::string html = cost::page(sampleReport());
    size_t before = 0;
    for (const char* part : {"The same picture in less time", "What to type", "Each setting", "Error against time",
                             "Pictures, and", "All figures", "How this was measured", ">Words<"}) {
        CAPTURE(part);
        const size_t at = html.find(part, before);
        REQUIRE(at != std::string::npos);
        before = at;
    }
}

TEST_CASE("what a budget buys is measured within the time that is left") {
    for (const double seconds : {0.0, 0.02, 0.1, 1.0, 100.0})
        for (const double budget : {1.3, 40.0, 5000.0, 1e6}) {
            CAPTURE(seconds);
            CAPTURE(budget);
            cost::Report report = sampleReport();
            report.budgetMs = budget;
            double clock = 0;
            double oneSample = 0;
            const auto render = [&](const cost::Configuration& configuration, uint32_t samples) -> cost::TimedPicture {
                const double ms = samples * (configuration[0] == 0 ? 1.25 : 2.5) * 1.1;  // slower than it was
                oneSample = ms / samples * 1.5e-3;
                clock += ms * 1.5e-3;
                return {ms, 0.25};
            };
            cost::spendBudget(
                render, [&] { return seconds - clock; }, report);
            REQUIRE(report.choice);
            CHECK(clock <= seconds * 1.1 + 4 * oneSample);
            CHECK((report.choiceMs <= budget || report.choice->samples == 1));
            CHECK(report.choiceSamples >= 1);
            CHECK((report.choiceRelMse == 0.25) == (report.choiceSamples == report.choice->samples));
            CHECK(contains(cost::budgetSentence(report),
                           report.choiceSamples < report.choice->samples ? ": about " : ": measured "));
        }
    CHECK(cost::secondsToSpend(1e6, 100) == doctest::Approx(20));
    CHECK(cost::secondsToSpend(100, 100) == doctest::Approx(0.3));
    CHECK(cost::secondsToSpend(0, 100) == 0);
}

TEST_CASE("the page is balanced, loads nothing, and escapes what it is told") {
    cost::Report report = sampleReport();
    report.budgetMs = 1;
    const std::string html = cost::page(report);
    CHECK(firstUnbalancedTag(html) == "");
    for (const char* load : {"http:", "https:", "<script", "<link", "url(", "@import", "src=\"/"}) {
        CAPTURE(load);
        CHECK_FALSE(contains(html, load));
    }
    CHECK(contains(html, "glass &amp; &lt;ice&gt;"));
    CHECK_FALSE(contains(html, "<ice>"));
    CHECK(contains(html, "&quot;a b.json&quot;"));
    CHECK(contains(html, " instead of Schlick's Fresnel costs 2\u00a0% of the time"));
    CHECK(contains(html, "no medium disperses light"));
    CHECK(contains(html, "Nothing fits 1.00\u00a0ms"));
    CHECK(contains(html, "width=device-width"));
    const size_t answer = html.find("Keep the scene's own settings");
    CHECK(answer < html.find("<img"));
    CHECK(contains(html, "minirtc bake 'glass &amp; &lt;ice&gt;.json'"));
}

TEST_CASE("the page warns of times that were unsteady") {
    cost::Report report = sampleReport();
    CHECK_FALSE(contains(cost::page(report), "unsteady"));
    report.measurements[0].ms = {10, 9, 11};
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.01, 0.01));
    report.measurements.back().slowdown = {0.8, 0.72, 0.88};
    const std::string html = cost::page(report);
    CHECK(contains(html, "scatter by 20\u00a0%. How far a time is known stands in brackets behind it."));
    CHECK(contains(html, "20\u00a0% less time (12 to 28\u00a0%)"));
    CHECK(contains(html, "<b>Time</b>: in brackets behind it, the middle half of all repeats."));
}

TEST_CASE("every point is in both plots, inside of their boxes") {
    const cost::Report report = sampleReport();
    const std::string html = cost::page(report);
    for (size_t i = 0; i < report.measurements.size(); ++i) {
        const std::string mark = "<title>" + std::to_string(i) + ": ";
        const size_t first = html.find(mark);
        REQUIRE(first != std::string::npos);
        CHECK(html.find(mark, first + 1) != std::string::npos);
    }
    CHECK_FALSE(contains(html, "nan"));
    CHECK_FALSE(contains(html, "inf\""));
}

TEST_CASE("texts of ticks neither meet nor leave the plot, however narrow it is") {
    for (const double width : {340.0, 860.0})
        for (double most = 1.1; most < 500; most *= 1.02) {
            CAPTURE(width);
            CAPTURE(most);
            cost::Plot plot;
            plot.width = width, plot.height = 360;
            for (const double time : {0.4, 1.0, most}) {
                plot.points.emplace_back();
                plot.points.back().time = plot.points.back().timeLower = plot.points.back().timeUpper = time;
                plot.points.back().error = 0.01 * time;
            }
            const std::string svg = cost::drawPlot(plot).svg;
            std::vector<double> middles;
            std::vector<double> halves;
            const std::string tick = "class=\"tick\" text-anchor=\"middle\">";
            for (size_t at = svg.find(tick); at != std::string::npos; at = svg.find(tick, at + 1)) {
                const size_t from = at + tick.size();
                const size_t x = svg.rfind("x=\"", at) + 3;
                middles.push_back(std::stod(svg.substr(x)));
                halves.push_back(3 * static_cast<double>(svg.find('<', from) - from));  // of letters that are 6 wide
            }
            REQUIRE(middles.size() >= 2);
            for (size_t i = 0; i < middles.size(); ++i) {
                CHECK(middles[i] - halves[i] >= 0);
                CHECK(middles[i] + halves[i] <= width);
                for (size_t k = 0; k < i; ++k) CHECK(std::abs(middles[i] - middles[k]) > halves[i] + halves[k] + 3);
            }
            CHECK(contains(svg, ">100 %<"));
        }
}

TEST_CASE("what is recommended has a star, and what is like the scene's own settings no label") {
    cost::Report report = sampleReport();
    const auto count = [](const std::string& text, const std::string& part) {
        size_t found = 0;
        for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
        return found;
    };
    std::string html = cost::page(report);
    CHECK(count(html, "class=\"solid star\"") == 3);  // in either plot
    CHECK(contains(html, "recommended: the scene's own settings"));
    CHECK_FALSE(contains(html, "class=\"lever pale\""));
    report.measurements.push_back(measured({1, 1, 1}, 0.8, 0.01, 0.01));
    html = cost::page(report);
    CHECK(count(html, "class=\"solid star\"") == 3);
    CHECK(contains(html, "recommended: Schlick's Fresnel"));
    CHECK(contains(html, "</svg>the scene's own settings"));
    CHECK(contains(html, ">6: Schlick's Fresnel</text>"));
    report.measurements[2] = measured({1, 1, 1}, 1.01, 0.01, 0.01);
    report.compareSingles();
    html = cost::page(report);
    CHECK(count(html, "<g class=\"lever pale\">") == 2);
    CHECK_FALSE(contains(html, ">2: Schlick's Fresnel</text>"));
    CHECK(contains(html, "hardly matters"));
}

TEST_CASE("the glossary explains the words that occur, once each, and the first of them leads there") {
    cost::Glossary glossary;
    CHECK(glossary.list().empty());
    const std::string html = glossary.linked(
        "<h2>Bias</h2><pre>bias --spp</pre><p title=\"bias\">Bias and bias; Russian roulette<a href=\"#x\">noise</a>, "
        "unbiased</p>");
    CHECK(html ==
          "<h2>Bias</h2><pre>bias --spp</pre><p title=\"bias\"><a class=\"term\" href=\"#word-bias\">Bias</a> and bias; "
          "<a class=\"term\" href=\"#word-weak\">Russian roulette</a><a href=\"#x\">noise</a>, unbiased</p>");
    CHECK(glossary.linked("bias, more samples") == "bias, more <a class=\"term\" href=\"#word-sample\">samples</a>");
    CHECK(contains(glossary.list(), "id=\"word-bias\""));
    CHECK(contains(glossary.list(), "id=\"word-sample\""));
    CHECK_FALSE(contains(glossary.list(), "id=\"word-noise\""));
}

TEST_CASE("each word that the page links is explained on it") {
    const std::string html = cost::page(sampleReport());
    const std::string link = "class=\"term\" href=\"#";
    size_t links = 0;
    for (size_t at = html.find(link); at != std::string::npos; at = html.find(link, at + 1), ++links) {
        const size_t from = at + link.size();
        const std::string id = html.substr(from, html.find('"', from) - from);
        CAPTURE(id);
        CHECK(contains(html, "<dt id=\"" + id + "\">"));
    }
    CHECK(links > 5);
    CHECK(contains(html, "#word-fresnel"));
    CHECK_FALSE(contains(html, "watertight"));
}

TEST_CASE("the JSON holds every measurement with its settings by name") {
    const auto json = nlohmann::json::parse(cost::reportJson(manySamplesReport()));
    CHECK(json["measurements"].size() == 6);
    CHECK(json["measurements"][2]["settings"]["fresnel"] == "schlick");
    CHECK(json["measurements"][5]["kind"] == "combination");
    CHECK(json["findings"].size() == 2);
    CHECK(json["recommendation"]["changes"] == false);
    CHECK(json["recommendation"]["commands"].size() == 2);
    CHECK(json["half_time"]["fits"] == true);
    CHECK(json["half_time"]["choice"]["settings"]["samples"] == "32");
    CHECK(json["levers"][1]["reason"] == "no medium disperses light");
}

TEST_CASE("the JSON names samples as the page does, at the scene's own number, wherever fewer were measured") {
    cost::Report report = manySamplesReport();
    report.nameSamples();
    const auto json = nlohmann::json::parse(cost::reportJson(report));
    CHECK(json["samples"] == 4);
    CHECK(json["levers"][2]["settings"] == nlohmann::json({"32", "64", "128"}));
    CHECK(json["levers"][2]["own"] == "64");
    CHECK(json["measurements"][3]["name"] == "32 samples");
    CHECK(json["measurements"][3]["settings"]["samples"] == "32");
    for (const auto& c : json["comparisons"])
        if (c["lever"] == "samples") CHECK((c["cheap"] == "64" || c["accurate"] == "64"));
    report.sceneSamples = 2;
    report.nameSamples();
    CHECK(report.levers[2].settings[0].words == "1 sample");
}
