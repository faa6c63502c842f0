// The smoothing kernels of src/core/smoothing.h without their factors, at q = 1 - r / R, 0 from the support on.
const KERNEL_CUBIC = 1u;
const KERNEL_QUINTIC = 2u;

fn power4(a: f32) -> f32 {
    return (a * a) * (a * a);
}

// q of a distance in quanta.
fn within_support(r: f32) -> f32 {
    return saturate(1.0 - r * constants.inverse_support);
}

// W / kernel_factor
fn kernel_shape(q: f32) -> f32 {
    if KERNEL == KERNEL_CUBIC {
        let far = 2.0 * q;
        let near = max(far - 1.0, 0.0);
        return far * far * far * 0.25 - near * near * near;
    }
    if KERNEL == KERNEL_QUINTIC {
        let a = 3.0 * q;
        let b = max(a - 1.0, 0.0);
        let c = max(a - 2.0, 0.0);
        return power4(a) * a - power4(b) * b * 6.0 + power4(c) * c * 15.0;
    }
    return power4(q) * (5.0 - 4.0 * q);
}

// (dW/dr) / r / gradient_factor
fn kernel_slope(q: f32) -> f32 {
    if KERNEL == KERNEL_CUBIC {
        let far = 2.0 * q;
        let near = max(far - 1.0, 0.0);
        return (far * far * 0.75 - near * near * 3.0) / max(2.0 - far, 1e-6);
    }
    if KERNEL == KERNEL_QUINTIC {
        let a = 3.0 * q;
        let b = max(a - 1.0, 0.0);
        let c = max(a - 2.0, 0.0);
        return (power4(a) - power4(b) * 6.0 + power4(c) * 15.0) * 5.0 / max(3.0 - a, 1e-6);
    }
    return q * q * q;
}
