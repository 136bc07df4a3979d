#include "lever.hpp"

namespace cost {

Configuration initialConfiguration(const std::vector<Lever>& levers) {
    Configuration configuration;
    configuration.reserve(levers.size());
    for (const Lever& lever : levers) configuration.push_back(lever.initial);
    return configuration;
}

Configuration bestConfiguration(const std::vector<Lever>& levers) {
    Configuration configuration;
    configuration.reserve(levers.size());
    for (const Lever& lever : levers) configuration.push_back(lever.best);
    return configuration;
}

Configuration with(Configuration configuration, size_t lever, size_t setting) {
    configuration[lever] = setting;
    return configuration;
}

size_t findLever(const std::vector<Lever>& levers, LeverKind kind) {
    size_t i = 0;
    while (i < levers.size() && levers[i].kind != kind) ++i;
    return i;
}

}  // namespace cost
