#include "driver_pipeline.hpp"
namespace bench {
struct DriverPipeline::Insides {};
std::unique_ptr<DriverPipeline> DriverPipeline::open(const std::string&, std::string& whyNot) {
    whyNot = "not there yet";
    return nullptr;
}
DriverPipeline::~DriverPipeline() = default;
void DriverPipeline::setMesh(const Triangles&) {}
double DriverPipeline::buildMs() const {
    return 0;
}
uint64_t DriverPipeline::structureBytes() const {
    return 0;
}
void DriverPipeline::setRays(const std::vector<Ray>&) {}
double DriverPipeline::trace(bool) {
    return 0;
}
std::vector<Hit> DriverPipeline::hits() {
    return {};
}
}  // namespace bench
