// Fluid that probes look at: what is near points and lines, the farthest along a direction, how much is in a box.
//
// in:  coordinate, motion (the state), id, looks
// out: gathered, in no order; found: what each look found, and how many were gathered, with those that had no room

// WeirLook in src/core/probe.h.
struct Look {
    point: vec3f, // m; the lowest corner of a box
    kind: u32,
    direction: vec3f, // the highest corner of a box
    unused: u32,
}
const LOOK_POINT = 0u;
const LOOK_LINE = 1u;
const LOOK_FARTHEST = 2u;
const LOOK_BOX = 3u;

// WeirGpuGathered in src/gpu/wcsph_probe.c.
struct Gathered {
    place: vec3i, // quanta
    excess: f32, // density less rest density
    velocity: vec3f,
    pressure: f32,
    id: u32,
}

@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_looks) var<storage, read> looks: array<Look>;
@group(0) @binding(BINDING_gathered) var<storage, read_write> gathered: array<Gathered>;
@group(0) @binding(BINDING_found) var<storage, read_write> found: array<atomic<u32>, MOST_LOOKS + 1>;

var<workgroup> own_found: array<atomic<u32>, MOST_LOOKS>; // wgpu-native does not zero them

// In support radii, a little more than one: the host leaves out again what is no nearer.
const REACH = 1.001;

fn is_near(look: Look, place: Place) -> bool {
    let origin = coordinate_of(look.point - constants.origin.xyz);
    var way = wide(Vector(shortest(place - origin)));
    if look.kind == LOOK_LINE {
        way -= dot(way, look.direction) * look.direction;
    }
    return length(way) * constants.inverse_support < REACH;
}

// Bits in the order of the numbers; never 0.
fn order_of(x: f32) -> u32 {
    let bits = bitcast<u32>(x);
    return select(bits | 0x80000000u, ~bits, (bits & 0x80000000u) != 0u);
}

// Whether a point or line is near.
fn look_at(place: Place) -> bool {
    let at = wide(position_of(place));
    var near = false;
    for (var k = 0u; k < min(arrayLength(&looks), MOST_LOOKS); k++) {
        let look = looks[k];
        switch look.kind {
            case LOOK_POINT, LOOK_LINE: {
                near = near || is_near(look, place);
            }
            case LOOK_FARTHEST: {
                let order = order_of(dot(at, look.direction));
                if order > atomicLoad(&own_found[k]) {
                    atomicMax(&own_found[k], order);
                }
            }
            case LOOK_BOX: {
                if all(at >= look.point) && all(at <= look.direction) {
                    atomicAdd(&own_found[k], 1u);
                }
            }
            default: {
            }
        }
    }
    return near;
}

fn gather_particle(i: u32, particle: Particle) {
    let slot = atomicAdd(&found[MOST_LOOKS], 1u);
    if slot < arrayLength(&gathered) {
        let own = particle.motion;
        gathered[slot] = Gathered(wide_place(place_of(particle.coordinate)), own.w, wide(vector_of(own)),
                                  pressure_of(own.w), id[i]);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn gather(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
          @builtin(local_invocation_index) local: u32) {
    if local < MOST_LOOKS {
        atomicStore(&own_found[local], 0u);
    }
    workgroupBarrier();
    let share = particle_share(workgroup_index(workgroup, workgroups), workgroups);
    for (var i = share.x + local; i < share.y; i += WORKGROUP_SIZE) {
        let particle = particle_at(i);
        if is_fluid(u32(particle.coordinate.w)) && look_at(place_of(particle.coordinate)) {
            gather_particle(i, particle);
        }
    }
    workgroupBarrier();
    if local < min(arrayLength(&looks), MOST_LOOKS) {
        let own = atomicLoad(&own_found[local]);
        if looks[local].kind == LOOK_BOX {
            atomicAdd(&found[local], own);
        } else {
            atomicMax(&found[local], own);
        }
    }
}
