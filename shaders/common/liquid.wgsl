// Equation of state of `wcsph`, and the move of a particle (docs/wcsph.md).
fn pressure_of(excess: f32) -> f32 {
    let stiffness = constants.sound_speed * constants.sound_speed;
    if TAIT {
        // (1 + x)^7 - 1 as a polynomial: no small difference of large numbers, and no division.
        let x = excess * (1.0 / parameters.rest_density);
        let sum = 7.0 + x * (21.0 + x * (35.0 + x * (35.0 + x * (21.0 + x * (7.0 + x)))));
        return parameters.rest_density * stiffness / 7.0 * x * sum + parameters.background_pressure;
    }
    return linear_pressure(excess);
}

// Of solid particles, whose density stands for their pressure.
fn linear_pressure(excess: f32) -> f32 {
    let stiffness = constants.sound_speed * constants.sound_speed;
    return stiffness * excess + parameters.background_pressure;
}

fn wrap(x: i32, period: u32) -> i32 {
    let p = i32(period);
    return select(select(x, x - p, x >= p), x + p, x < 0);
}

fn wrapped(place: Place) -> Place {
    var to = place;
    if PERIODIC_X {
        to.x = wrap(to.x, constants.period_x);
    }
    if PERIODIC_Y {
        to.y = wrap(to.y, constants.period_y);
    }
    if PERIODIC_Z {
        to = wrap_z(to);
    }
    return to;
}

// Whole quanta of a way in metres; what is absurd does not move.
fn quanta_of(way: Vector) -> Place {
    let steps = round(way * constants.inverse_quantum);
    return select(Place(0), Place(steps), abs(steps) < Vector(1e9));
}

// A difference of two places, less than a period, to the nearest image.
fn nearest(way: Place) -> Place {
    var near = way;
    if PERIODIC_X {
        near.x = near_image(way.x, constants.period_x);
    }
    if PERIODIC_Y {
        near.y = near_image(way.y, constants.period_y);
    }
    if PERIODIC_Z {
        near = nearest_z(near);
    }
    return near;
}

fn near_image(way: i32, period: u32) -> i32 {
    let p = i32(period);
    return select(select(way, way - p, 2 * way > p), way + p, 2 * way < -p);
}

// Square of a way's length, as bits, which have the order of lengths.
fn way_bits(way: Place) -> u32 {
    return bitcast<u32>(dot(Vector(way), Vector(way)));
}

fn quanta_of_spacings(count: f32) -> f32 {
    return count * parameters.particle_spacing * constants.inverse_quantum;
}

// weir_coordinate_of() of a place that is `away` metres from the origin.
fn coordinate_of(away: vec3f) -> Place {
    var steps = vector_of(vec4f(away, 0.0)) * constants.inverse_quantum;
    if any(periodic_axes()) {
        let period = Vector(periods());
        steps -= period * floor(steps / max(period, Vector(1.0)));
    }
    return Place(clamp(round(steps), Vector(-2e9), Vector(2e9)));
}

// Way in quanta of a solid's particle, from `place` to where the solid's state has it. `start` is its place in the
// solid at the beginning.
fn way_to(state: SolidState, start: vec3f, place: Place) -> Place {
    let away = state.position.xyz - constants.origin.xyz + state.rest.xyz + rotate(state.orientation, start);
    return shortest(coordinate_of(away) - place);
}

// A way in quanta of any length; across a periodic border the short one. Without `%`: of negative numbers it is undefined in Vulkan,
// wgpu-native does not work around that (gfx-rs/wgpu, issue 9578), and NVIDIA's cards give another result.
fn shortest(way: Place) -> Place {
    let period = periods();
    return nearest(way - period * (way / max(period, Place(1))));
}

// m. Places are wrapped when they are sorted, and may lie a little outside until then.
fn position_of(place: Place) -> Vector {
    return vector_of(constants.origin) + Vector(wrapped(place)) * constants.quantum;
}
