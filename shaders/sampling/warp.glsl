// Points of the unit square as directions and points, with their densities, and the weights that combine them.
// GLSL and C++ (tests/shader_source.hpp).
//
// `u` lies in [0,1)^2. Directions are of unit length, about +z where nothing else is said; densities of directions are per steradian.

/// (cos, sin) of t quarter turns, |t| <= 1/2: the Taylor series, to 2e-9 and to the rounding of float; devices' own are only good to 2^-11.
vec2 cosSinNearZero(real t) {
    real s = t * t;
    real even = real(0.0208634807633530) - s * (real(0.00091926027483943) - s * real(0.0000252020423730606));
    even = real(1.2337005501361697) - s * (real(0.2536695079010480) - s * even);
    real odd = real(0.0796926262461670) - s * (real(0.0046817541353187) - s * real(0.00016044118478736));
    odd = real(1.5707963267948966) - s * (real(0.6459640975062463) - s * odd);
    return vec2(real(1) - s * even, t * odd);
}

/// (cos, sin) of u turns, u in [0,1].
vec2 cosSinTurns(real u) {
    real quarter = floor(real(4) * u + real(0.5));
    vec2 p = cosSinNearZero(real(4) * u - quarter);
    int k = int(quarter) & 3;
    vec2 odd = vec2(-p.y, p.x);
    vec2 turned = (k & 1) != 0 ? odd : p;
    return k >= 2 ? -turned : turned;
}

/// Uniform in the unit disk, neighbours stay neighbours (Shirley and Chiu 1997).
vec2 concentricDisk(vec2 u) {
    vec2 a = u * real(2) - vec2(1);
    bool wide = abs(a.x) > abs(a.y);
    real longer = wide ? a.x : a.y;
    real shorter = wide ? a.y : a.x;
    vec2 p = cosSinNearZero(longer != real(0) ? real(0.5) * shorter / longer : real(0)) * longer;
    return wide ? p : vec2(p.y, p.x);
}

/// Distributed as the cosine over the upper hemisphere (Malley). z is 0 where u lies on the rim of the square.
vec3 cosineHemisphere(vec2 u) {
    vec2 p = concentricDisk(u);
    real r = max(abs(real(2) * u.x - real(1)), abs(real(2) * u.y - real(1)));
    return vec3(p.x, p.y, sqrt((real(1) - r) * (real(1) + r)));
}

/// Density of cosineHemisphere.
real cosineHemispherePdf(real cosTheta) { return max(cosTheta, real(0)) * real(INV_PI); }

/// Uniform on the unit sphere; the density is 1 / (4 pi).
vec3 uniformSphere(vec2 u) {
    vec2 p = cosSinTurns(u.y) * (real(2) * sqrt(u.x * (real(1) - u.x)));
    return vec3(p.x, p.y, real(1) - real(2) * u.x);
}

/// Density of uniformSphere.
real uniformSpherePdf() { return real(0.5) * real(INV_TWO_PI); }

/// Uniform in the cone of directions with cos(theta) >= 1 - `height`, 0 < height <= 2. The height, rather than a cosine, keeps narrow
/// cones exact.
vec3 uniformCone(vec2 u, real height) {
    real h = u.x * height;
    vec2 p = cosSinTurns(u.y) * sqrt(h * (real(2) - h));
    return vec3(p.x, p.y, real(1) - h);
}

/// Density of uniformCone inside of the cone.
real uniformConePdf(real height) { return real(INV_TWO_PI) / height; }

/// Barycentrics of the second and the third vertex, uniform over a triangle's area; neighbours stay neighbours (Heitz 2019, A Low-Distortion Map
/// Between Triangle and Square).
vec2 uniformTriangle(vec2 u) {
    vec2 middle = u * real(0.5);
    return u.y > u.x ? vec2(middle.x, u.y - middle.x) : vec2(u.x - middle.y, middle.y);
}

/// The density over directions of a point that is drawn with density `pdf` over area, seen over `distance` under the cosine `cosLight` at the
/// light; 0 edge-on, where no direction meets it.
real directionPdf(real pdf, real distance, real cosLight) {
    return cosLight > real(0) ? pdf * distance * distance / cosLight : real(0);
}

/// Three unit vectors at right angles.
struct Basis {
    vec3 t;
    vec3 b;
    vec3 n;
};

/// A right-handed basis around the unit vector n (Duff et al. 2017, Building an Orthonormal Basis, Revisited). It turns over
/// where no surface of a box lies: rounding of a z that should be 0 must not choose between two bases.
Basis basisAround(vec3 n) {
    real side = n.z < real(-0.37) ? real(-1) : real(1);
    real a = real(-1) / (side + n.z);
    real b = n.x * n.y * a;
    Basis basis;
    basis.t = vec3(real(1) + side * n.x * n.x * a, side * b, -side * n.x);
    basis.b = vec3(b, side + n.y * n.y * a, -n.y);
    basis.n = n;
    return basis;
}

/// The vector with components v along the basis.
vec3 fromBasis(Basis basis, vec3 v) { return basis.t * v.x + basis.b * v.y + basis.n * v.z; }

/// The components of v along the basis.
vec3 intoBasis(Basis basis, vec3 v) { return vec3(dot(v, basis.t), dot(v, basis.b), dot(v, basis.n)); }

/// 1 - cos of the half angle under which a sphere of `radius` is seen over `distance` from its centre, distance >= radius.
/// Without cancellation for small and far spheres; distance - radius carries what is known of a point near the surface.
real sphereConeHeight(real distance, real radius) {
    real sine = radius / distance;
    real cosine = sqrt(max((distance - radius) / distance * (real(1) + sine), real(0)));
    return sine * sine / (real(1) + cosine);
}

/// Density with which sampleSphereLight at p draws any direction that meets the sphere. Finite down to radius / distance = 1e-18.
real sphereLightPdf(vec3 p, vec3 center, real radius) {
    real distance = length(center - p);
    return distance > radius ? uniformConePdf(sphereConeHeight(distance, radius)) : uniformSpherePdf();
}

/// A direction towards a light.
struct SphereLightSample {
    vec3 wi;
    real distance;  // from p to the light along wi
    real pdf;
};

/// A direction from p to a sphere, uniform over the solid angle that it fills: a cone from outside, all directions from inside.
SphereLightSample sampleSphereLight(vec3 p, vec3 center, real radius, vec2 u) {
    vec3 toCenter = center - p;
    real distance = length(toCenter);
    SphereLightSample light;
    if (distance > radius) {
        real height = sphereConeHeight(distance, radius);
        light.wi = fromBasis(basisAround(toCenter / distance), uniformCone(u, height));
        // Half the chord over the distance: sqrt(sin^2 of the cone - sin^2 of wi), as a product.
        real halfChord = sqrt(height * (real(1) - u.x) * (real(2) - height * (real(1) + u.x)));
        real nearShare = (distance - radius) / distance * (real(1) + radius / distance);
        light.distance = distance * nearShare / (real(1) - u.x * height + halfChord);
        light.pdf = uniformConePdf(height);
    } else {
        light.wi = uniformSphere(u);
        real along = dot(toCenter, light.wi);
        vec3 across = toCenter - light.wi * along;
        light.distance = max(along + sqrt(max(radius * radius - dot(across, across), real(0))), real(0));
        light.pdf = uniformSpherePdf();
    }
    return light;
}

/// Densities above this count as this: a mirror's or a point light's infinity then outweighs all others, and two of them share.
const real GREATEST_PDF = real(1e36);

/// Weight of a sample drawn with density a that another technique draws with density b (Veach 1997, balance heuristic). Both >= 0, or infinite;
/// 0 where a is 0, and the weights of the two techniques add up to 1.
real balanceWeight(real a, real b) {
    a = min(a, GREATEST_PDF);
    b = min(b, GREATEST_PDF);
    return a > real(0) ? a / (a + b) : real(0);
}

/// The same by the power heuristic with exponent 2.
real powerWeight(real a, real b) {
    a = min(a, GREATEST_PDF);
    b = min(b, GREATEST_PDF);
    real q = min(a, b) / max(max(a, b), real(1e-36));
    real lesser = q * q / (real(1) + q * q);
    return a > real(0) ? (a >= b ? real(1) - lesser : lesser) : real(0);
}
