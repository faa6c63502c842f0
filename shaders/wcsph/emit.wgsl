// Layers of new particles, one support radius upstream of their nozzle, in the empty slots of the lowest ids. A layer
// that finds too few waits, whole. One workgroup.
//
// in:  vacancy, nozzle (places of birth), control
// out: coordinate, motion, vacancy, control
@group(0) @binding(BINDING_vacancy) var<storage, read_write> vacancy: array<u32>;
@group(0) @binding(BINDING_nozzle) var<storage, read> nozzle: array<vec4i>;
@group(0) @binding(BINDING_coordinate) var<storage, read_write> coordinate: array<vec4i>;
@group(0) @binding(BINDING_motion) var<storage, read_write> motion: array<vec4f>;

const IDS_PER_THREAD = 32u;
var<workgroup> due_layer: u32;
var<workgroup> total: u32; // empty slots among the ids looked through last
var<workgroup> counts: array<u32, WORKGROUP_SIZE>;

// Ids with an empty slot among those of this thread.
fn count_empty(first: u32) -> u32 {
    var count = 0u;
    for (var k = first; k < min(first + IDS_PER_THREAD, constants.first_solid); k++) {
        count += select(0u, 1u, vacancy[k] != 0u);
    }
    return count;
}

// Writes the empty slots' ids behind the table, by rank.
fn list_empty(first: u32, rank: u32, wanted: u32) {
    var next = rank;
    for (var k = first; k < min(first + IDS_PER_THREAD, constants.first_solid); k++) {
        if vacancy[k] != 0u && next < wanted {
            vacancy[constants.first_solid + next] = k;
            next += 1u;
        }
    }
}

fn bear(n: u32, k: u32, way: f32) {
    let own_id = vacancy[constants.first_solid + k];
    let i = vacancy[own_id] - 1u;
    let velocity = flows.emitters[n].speed * vector_of(flows.emitters[n].direction);
    let born = place_of(nozzle[flows.emitters[n].point_first + k])
        + quanta_of(way * vector_of(flows.emitters[n].direction));
    coordinate[i] = vec4i(wide_place(born), i32(GROUP_INLET + n));
    motion[i] = vec4f(wide(velocity), 0.0);
    vacancy[own_id] = 0u;
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn emit(@builtin(local_invocation_index) local: u32) {
    for (var n = 0u; n < EMITTER_COUNT; n++) {
        if local == 0u {
            due_layer = select(0u, 1u, layer_due(n));
        }
        if workgroupUniformLoad(&due_layer) == 0u {
            continue;
        }
        let wanted = flows.emitters[n].point_count;
        var found = 0u;
        for (var base = 0u; base < constants.first_solid && found < wanted; base += WORKGROUP_SIZE * IDS_PER_THREAD) {
            let first = base + local * IDS_PER_THREAD;
            counts[local] = count_empty(first);
            workgroupBarrier();
            var before = 0u;
            for (var k = 0u; k < local; k++) {
                before += counts[k];
            }
            list_empty(first, found + before, wanted);
            if local == WORKGROUP_SIZE - 1u {
                total = before + counts[local];
            }
            found += workgroupUniformLoad(&total);
        }
        storageBarrier();
        workgroupBarrier();
        if found < wanted {
            continue;
        }
        let spacing = parameters.particle_spacing;
        let speed = flows.emitters[n].speed;
        let late = speed * seconds_of(subtract_ticks(middle_of_step(), control.due[n].xy));
        let way = select(0.0, late, late < spacing); // 0: it waited
        for (var k = local; k < wanted; k += WORKGROUP_SIZE) {
            bear(n, k, way);
        }
        storageBarrier();
        workgroupBarrier();
        if local == 0u {
            let last = select(middle_of_step(), control.due[n].xy, late < spacing);
            let next = add_ticks(last, ticks_of(min(spacing / speed, 2000.0)));
            control.due[n] = vec4u(next, control.due[n].zw);
            control.emitted += wanted;
        }
        storageBarrier();
        workgroupBarrier();
    }
}
