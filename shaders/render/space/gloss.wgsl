// Shared by the effects that draw solid things: how their surface looks in the light.

// Linear light of a surface without gloss.
fn matte(color: vec3f, normal: vec3f, light: vec3f) -> vec3f {
    let wrapped = clamp(0.62 * dot(normal, sun) + 0.38, 0.0, 1.0);
    let ambient = mix(vec3f(0.16, 0.20, 0.28), vec3f(0.62, 0.70, 0.80), 0.5 * normal.y + 0.5);
    return color * (0.62 * ambient * mix(vec3f(0.55), vec3f(1.0), light) + vec3f(1.02, 0.98, 0.92) * (wrapped * light));
}

// Of a smooth one. `view` points to the eye.
fn shade(color: vec3f, gloss: f32, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    let halfway = normalize(sun + view);
    let shine = pow(max(dot(normal, halfway), 0.0), 70.0);
    let fresnel = 0.03 + 0.97 * pow(1.0 - clamp(dot(normal, view), 0.0, 1.0), 5.0);
    return matte(color, normal, light)
        + gloss * (0.55 * shine * light + 0.35 * fresnel * surroundings(reflect(-view, normal)) * mix(vec3f(0.4), vec3f(1.0), light));
}

// Light that arrives at a point of a wall or body. The shadow map knows its face too, as steps of a texel: looked up from
// as far before it as those reach.
fn light_on_solid(point: vec3f, normal: vec3f) -> vec3f {
    let texel = 2.0 / (shadow_size * length(frame.light_rows[0].xyz));
    let lit = lit_share_within(point + normal * (4.0 * texel), 1.0) * smoothstep(-0.05, 0.15, dot(normal, sun));
    return mix(0.25, 1.0, lit) * sunlight_at(point);
}
