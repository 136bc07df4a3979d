#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "support.hpp"

namespace {
bool skipped = false;
}

namespace test {

void skip(const std::string& why) {
    std::printf("SKIPPED: %s\n", why.c_str());
    skipped = true;
}

}  // namespace test

int main(int argc, char** argv) {
    doctest::Context context(argc, argv);
    const int result = context.run();
    constexpr int kSkipReturnCode = 77;
    return result == 0 && skipped ? kSkipReturnCode : result;
}
