// The smoothing kernels of src/core/smoothing.h without their factors, at s = r / R >= 0; 0 beyond the support.
const KERNEL_CUBIC = 1u;
const KERNEL_QUINTIC = 2u;

fn power4(a: f32) -> f32 {
    return (a * a) * (a * a);
}

// W / kernel_factor
fn kernel_shape(s: f32) -> f32 {
    if KERNEL == KERNEL_CUBIC {
        let far = max(2.0 - 2.0 * s, 0.0);
        let near = max(1.0 - 2.0 * s, 0.0);
        return far * far * far * 0.25 - near * near * near;
    }
    if KERNEL == KERNEL_QUINTIC {
        let a = max(3.0 - 3.0 * s, 0.0);
        let b = max(2.0 - 3.0 * s, 0.0);
        let c = max(1.0 - 3.0 * s, 0.0);
        return power4(a) * a - power4(b) * b * 6.0 + power4(c) * c * 15.0;
    }
    return power4(max(1.0 - s, 0.0)) * (4.0 * s + 1.0);
}

// (dW/dr) / r / gradient_factor
fn kernel_slope(s: f32) -> f32 {
    if KERNEL == KERNEL_CUBIC {
        let far = max(2.0 - 2.0 * s, 0.0);
        let near = max(1.0 - 2.0 * s, 0.0);
        return (far * far * 0.75 - near * near * 3.0) / max(2.0 * s, 1e-6);
    }
    if KERNEL == KERNEL_QUINTIC {
        let a = max(3.0 - 3.0 * s, 0.0);
        let b = max(2.0 - 3.0 * s, 0.0);
        let c = max(1.0 - 3.0 * s, 0.0);
        return (power4(a) - power4(b) * 6.0 + power4(c) * 15.0) * 5.0 / max(3.0 * s, 1e-6);
    }
    let rest = max(1.0 - s, 0.0);
    return rest * rest * rest;
}
