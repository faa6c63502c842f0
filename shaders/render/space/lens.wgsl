// Shared by the effects of sunlight in water: the surface as a height over the floor, and what it absorbs.

// Place in the maps of the domain's floor, 0 to 1.
fn on_floor(point: vec3f) -> vec2f {
    return (point.xz - frame.domain_min.xz) / (frame.domain_max.xz - frame.domain_min.xz);
}

// Heights are kept as sums of exp(steepness * height), of which the highest particles make the most: a smooth maximum.
// Half floats span too little for a domain, so each channel holds a band of heights.
const band_span = 8.0; // in units of 1 / steepness

fn height_steepness() -> f32 {
    return min(1.2 / frame.spacing, 30.0 / (frame.domain_max.y - frame.domain_min.y));
}

const height_radius = 1.6; // of the blob of a particle, spacings

fn encoded_height(height: f32) -> vec4f {
    let place = height_steepness() * height - band_span * vec4f(0.0, 1.0, 2.0, 3.0);
    return select(exp(min(place, vec4f(7.0))), vec4f(0.0), place < vec4f(-9.0));
}

// Above the domain's bottom, m; 0: no water.
fn decoded_height(sums: vec4f) -> f32 {
    let steepness = height_steepness();
    var place = -9.0;
    for (var band = 0; band < 4; band++) {
        let found = log(max(sums[band], 1e-6));
        if band == 0 || found > -3.5 { place = found + band_span * f32(band); }
    }
    // A flat surface lies half a spacing above the highest layer, and the layers below it add a geometric series.
    let layers = 1.0 - exp(-steepness * frame.spacing);
    return max((place + log(layers)) / steepness + 0.5 * frame.spacing, 0.0);
}

const into_water = 0.752; // 1 / 1.33

// Sunlight in water that lies still.
fn sun_in_water() -> vec3f {
    return refract(-sun, vec3f(0.0, 1.0, 0.0), into_water);
}

// Absorption of light on its way through the water: red goes first. Per metre in a domain of one metre; scenes of all
// sizes show the same blue.
const water_absorption = vec3f(1.25, 0.215, 0.105);

fn water_left(way: f32) -> vec3f {
    return exp(-water_absorption * (frame.absorption * way));
}
