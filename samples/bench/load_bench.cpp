#include "load_bench.hpp"

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "device_copy.hpp"
#include "minirt.h"

namespace bench {
namespace {

double loadMs(minirt_context* context, const std::filesystem::path& blob) {
    minirt_scene* scene = nullptr;
    const double begin = nowMs();
    if (minirt_load_file(context, blob.c_str(), &scene)) throw std::runtime_error(minirt_last_message(context));
    const double ms = nowMs() - begin;
    minirt_unload(scene);
    return ms;
}

}  // namespace

LoadResult benchLoad(minirt_context* context, const std::filesystem::path& blob, int rounds) {
    std::ifstream file(blob, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
    std::vector<char> own(bytes.size());
    DeviceCopy again(context, bytes.size());
    const auto copyMs = [&](DeviceCopy* target) {
        const double begin = nowMs();
        std::memcpy(own.data(), bytes.data(), bytes.size());
        if (target) {
            target->write(own.data());
            return nowMs() - begin;
        }
        DeviceCopy fresh(context, bytes.size());
        fresh.write(own.data());
        return nowMs() - begin;
    };
    const std::vector<Contender> contenders = {{"load", [&] { return loadMs(context, blob); }},
                                               {"copy", [&] { return copyMs(nullptr); }},
                                               {"copy again", [&] { return copyMs(&again); }}};
    const std::vector<Times> times = takeTurns(contenders, rounds);
    return {bytes.size(),
            spreadOf(times[0].ms),
            spreadOf(times[1].ms),
            spreadOf(times[2].ms),
            ratioTo(times[1].ms, times[0].ms),
            ratioTo(times[2].ms, times[0].ms)};
}

}  // namespace bench
