// Shared by the effects that draw solid things: how a smooth surface looks in the light.

// Linear light of a surface. `view` points to the eye.
fn shade(color: vec3f, gloss: f32, normal: vec3f, view: vec3f, light: vec3f) -> vec3f {
    let facing = dot(normal, sun);
    let wrapped = clamp(0.62 * facing + 0.38, 0.0, 1.0);
    let ambient = mix(vec3f(0.16, 0.20, 0.28), vec3f(0.62, 0.70, 0.80), 0.5 * normal.y + 0.5);
    var seen = color * (0.62 * ambient * mix(vec3f(0.55), vec3f(1.0), light) + vec3f(1.02, 0.98, 0.92) * (wrapped * light));
    let halfway = normalize(sun + view);
    let shine = pow(max(dot(normal, halfway), 0.0), 70.0);
    let fresnel = 0.03 + 0.97 * pow(1.0 - clamp(dot(normal, view), 0.0, 1.0), 5.0);
    seen += gloss * (0.55 * shine * light + 0.35 * fresnel * surroundings(reflect(-view, normal)) * mix(vec3f(0.4), vec3f(1.0), light));
    return seen;
}
