// Layers of new particles, one support radius upstream of their nozzle, in the empty slots of the lowest ids. One look
// for slots serves all layers of a step, in order; a layer that finds too few waits, whole. One workgroup.
//
// in:  vacancy, nozzle (places of birth), schedule, control
// out: coordinate, motion, vacancy, schedule, control
@group(0) @binding(BINDING_vacancy) var<storage, read_write> vacancy: array<u32>;
@group(0) @binding(BINDING_nozzle) var<storage, read> nozzle: array<vec4i>;
// By emitter: when its next layer is due, xy, and when it stops, zw.
@group(0) @binding(BINDING_schedule) var<storage, read_write> schedule: array<vec4u>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

const NEVER = vec2u(0xffffffffu);

// Particles that the emitters' layers want; then how many are born before theirs.
var<workgroup> layers: array<u32, EMITTERS + 1u>;
var<workgroup> sums: array<u32, WORKGROUP_SIZE>;
var<workgroup> earliest: array<vec2u, WORKGROUP_SIZE>;
var<workgroup> shared_count: u32;

// For half a spacing of flow: so much layers may be early, and are put off if they must wait.
fn share_of(n: u32) -> vec2u {
    return ticks_of(min(0.5 * parameters.particle_spacing / emitters[n].speed, 1000.0));
}

fn takes_part(n: u32) -> bool {
    let due = schedule[n].xy;
    let stop = schedule[n].zw;
    let time = middle_of_step(control.clock);
    return !is_before(add_ticks(time, share_of(n)), due) && !is_before(stop, due) && !is_before(stop, time);
}

// How far a layer of emitter n has come since it was due, m; negative where it is early.
fn way_since_due(n: u32) -> f32 {
    let due = schedule[n].xy;
    let time = middle_of_step(control.clock);
    let early = is_before(time, due);
    let ticks = subtract_ticks(select(time, due, early), select(due, time, early));
    return select(1.0, -1.0, early) * emitters[n].speed * seconds_of(ticks);
}

// sums[k]: the sum of the threads' values up to thread k (Hillis and Steele 1986).
fn sum_up(local: u32, value: u32) {
    sums[local] = value;
    workgroupBarrier();
    for (var distance = 1u; distance < WORKGROUP_SIZE; distance *= 2u) {
        var other = 0u;
        if local >= distance {
            other = sums[local - distance];
        }
        workgroupBarrier();
        sums[local] += other;
        workgroupBarrier();
    }
}

// In `vacancy`: the slots by id, the blocks' counts, the places found.
fn first_block() -> u32 {
    return constants.first_solid;
}

fn block_count() -> u32 {
    return (constants.first_solid + VACANCY_BLOCK - 1u) / VACANCY_BLOCK;
}

fn first_found() -> u32 {
    return first_block() + block_count();
}

// Lists the places of a block's empty slots from `rank` on.
fn list_block(block: u32, rank: u32, wanted: u32) {
    let end = min((block + 1u) * VACANCY_BLOCK, constants.first_solid);
    var next = rank;
    for (var k = block * VACANCY_BLOCK; k < end && next < wanted; k++) {
        let place = vacancy[k];
        if place != 0u {
            vacancy[first_found() + next] = place - 1u;
            next += 1u;
        }
    }
}

fn bear(k: u32) {
    // The last layer that begins at or before k.
    var n = 0u;
    var end = EMITTER_COUNT;
    while end - n > 1u {
        let middle = (n + end) / 2u;
        if layers[middle] <= k {
            n = middle;
        } else {
            end = middle;
        }
    }
    let i = vacancy[first_found() + k];
    let speed = emitters[n].speed;
    let late = way_since_due(n);
    let way = select(0.0, late, late < parameters.particle_spacing); // 0: it is very late
    let direction = vector_of(emitters[n].direction);
    let born = place_of(nozzle[emitters[n].point_first + k - layers[n]]) + quanta_of(way * direction);
    set_coordinate(i, vec4i(wide_place(born), i32(GROUP_INLET + n)));
    set_motion(i, vec4f(wide(speed * direction), 0.0));
}

// Plans emitter n's next layer; returns when it is due.
fn plan(n: u32) -> vec2u {
    let now = middle_of_step(control.clock);
    var due = schedule[n].xy;
    if layers[n + 1u] > layers[n] {
        let spacing = parameters.particle_spacing;
        let last = select(now, due, way_since_due(n) < spacing);
        due = add_ticks(last, ticks_of(min(spacing / emitters[n].speed, 2000.0)));
    } else if takes_part(n) {
        due = add_ticks(due, share_of(n));
    }
    schedule[n] = vec4u(due, schedule[n].zw);
    return select(due, NEVER, is_before(schedule[n].zw, due) || is_before(schedule[n].zw, now));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn emit(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        shared_count = select(0u, 1u, is_emitting(control.bad_step));
    }
    if workgroupUniformLoad(&shared_count) == 0u {
        return;
    }
    var own = 0u;
    for (var n = local; n < EMITTER_COUNT; n += WORKGROUP_SIZE) {
        layers[n] = select(0u, emitters[n].point_count, takes_part(n));
        own += layers[n];
    }
    sum_up(local, own);
    if local == 0u {
        shared_count = sums[WORKGROUP_SIZE - 1u];
    }
    let wanted = workgroupUniformLoad(&shared_count);

    var found = 0u;
    for (var base = 0u; base < block_count() && found < wanted; base += WORKGROUP_SIZE) {
        let block = base + local;
        var count = 0u;
        if block < block_count() {
            count = vacancy[first_block() + block];
        }
        sum_up(local, count);
        if count > 0u {
            list_block(block, found + sums[local] - count, wanted);
        }
        if local == WORKGROUP_SIZE - 1u {
            shared_count = sums[local];
        }
        found += workgroupUniformLoad(&shared_count);
    }

    if local == 0u {
        var born = 0u;
        for (var n = 0u; n < EMITTER_COUNT; n++) {
            let fitting = select(0u, layers[n], layers[n] <= found - born);
            layers[n] = born;
            born += fitting;
        }
        layers[EMITTER_COUNT] = born;
        control.emitted += born;
    }
    storageBarrier();
    workgroupBarrier();
    for (var k = local; k < layers[EMITTER_COUNT]; k += WORKGROUP_SIZE) {
        bear(k);
    }
    for (var block = local; block < block_count(); block += WORKGROUP_SIZE) {
        vacancy[first_block() + block] = 0u;
    }
    storageBarrier();
    workgroupBarrier();

    var next = NEVER;
    for (var n = local; n < EMITTER_COUNT; n += WORKGROUP_SIZE) {
        let due = plan(n);
        next = select(next, due, is_before(due, next));
    }
    earliest[local] = next;
    for (var half = WORKGROUP_SIZE / 2u; half > 0u; half /= 2u) {
        workgroupBarrier();
        if local < half && is_before(earliest[local + half], earliest[local]) {
            earliest[local] = earliest[local + half];
        }
    }
    workgroupBarrier();
    if local == 0u {
        control.next_due = earliest[0];
    }
}
