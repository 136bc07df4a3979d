// Light inside of a medium. GLSL and C++ (tests/shader_source.hpp).

/// (1 - exp(-x)) / x for x >= 0, to a rounding or two also where the difference cancels.
real decayMean(real x) { return x < real(1e-3) ? real(1) - x * (real(0.5) - x * real(1.0 / 6.0)) : (real(1) - exp(-min(x, real(100)))) / x; }

/// Beer and Lambert: the share of light that is left after an optical depth x = sigma d, which may be infinite; 1 at 0 and 0 from 100 on, exactly.
real beerLambert(real x) {
    real depth = min(x, real(100));  // some devices make NaN of exp(-x) beside infinity, though it is not selected
    return depth < real(100) ? exp(-depth) : real(0);
}

/// What of the light taken away over an optical depth x comes back as the medium's own colour under white light: w x f(2 x) with
/// f = decayMean. Light that turns round after each distance up to the whole and is absorbed on both ways; at most w / 2.
real inscatteredShare(real x, real w) { return w * min(x, real(100)) * decayMean(real(2) * min(x, real(100))); }
