#include <iostream>
#include "kernel.hpp"
int main() {
    using namespace minirtc;
    for (int all = 0; all < 2; ++all) {
        EffectSet e; if (all) includeAll(e);
        try { Kernel k = compileKernel("whitted", e); std::cout << k.spirv.size()*4 << " bytes, bindings " << std::hex << k.bindings << std::dec << "\n"; }
        catch (std::exception& x) { std::cout << x.what() << "\n"; return 1; }
    }
}
