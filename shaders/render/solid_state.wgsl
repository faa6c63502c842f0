// Shared by the effects that draw walls and bodies as shapes: where the solver has them now.

// WeirSolidState (src/core/world.h).
struct SolidState {
    position: vec4f,
    orientation: vec4f,
    unused: array<vec4f, 7>,
}
@group(1) @binding(1) var<storage, read> solid_state: array<SolidState>;
