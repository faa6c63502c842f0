// For solvers and pictures.
// v turned by the unit quaternion q.
fn rotate(q: vec4f, v: vec3f) -> vec3f {
    let once = cross(q.xyz, v);
    return v + 2.0 * (q.w * once + cross(q.xyz, once));
}
