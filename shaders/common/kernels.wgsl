// Shapes of the smoothing kernels; their normalisations and the particle mass are in constants.*_factor. Formulas
// and sources: src/core/kernel.h. h is the support radius and r < h the distance, both in metres.

// Density, spiky: (h - r)^3; the tutorial's poly6: (h^2 - r^2)^3.
fn density_kernel(r_squared: f32) -> f32 {
    let h = parameters.support_radius;
    var q: f32;
    if TUTORIAL_KERNELS {
        q = h * h - r_squared;
    } else {
        q = h - sqrt(r_squared);
    }
    return q * q * q;
}
