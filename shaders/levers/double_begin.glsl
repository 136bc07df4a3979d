// Lever `precision`, set to double: what follows, up to levers/double_end.glsl, is compiled in doubles, as the tests do. Its callers pass floats.

#ifdef PRECISION_DOUBLE

/// A SurfacePoint in doubles.
struct DoublePoint {
    dvec3 p;
    dvec3 pError;
    dvec3 ng;
};

double doubleGamma(int n) { return double(n) * 1.1102230246251565e-16lf; }

dvec3 unitVector(dvec3 v) {
    double size = max(abs(v.x), max(abs(v.y), abs(v.z)));
    return size > 0.0lf ? normalize(v / size) : v;
}

#undef real
#define real double
#define vec3 dvec3
#define SurfacePoint DoublePoint
#define errorGamma doubleGamma

#endif
