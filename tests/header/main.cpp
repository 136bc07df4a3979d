// A C++ unit that only uses the header, and calls the C one.
#include <cstdio>

#include "minirt.h"

extern "C" int useFromC(void);

int main() {
    alignas(16) const char text[32] = "no blob";
    const bool good = useFromC() == 1 && minirt_validate(text, sizeof text, nullptr, nullptr) == MINIRT_ERROR_NOT_A_BLOB;
    std::printf("%s\n", minirt_result_string(MINIRT_ERROR_NOT_A_BLOB));
    return good ? 0 : 1;
}
