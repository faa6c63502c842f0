// Layers of new particles, one support radius upstream of their nozzle, in the empty slots of the lowest ids. One look
// for slots serves all layers that are due, in order; a layer that finds too few waits, whole. One workgroup.
//
// in:  vacancy, nozzle (places of birth), schedule, control
// out: coordinate, motion, vacancy, schedule, control
@group(0) @binding(BINDING_vacancy) var<storage, read_write> vacancy: array<u32>;
@group(0) @binding(BINDING_nozzle) var<storage, read> nozzle: array<vec4i>;
// By emitter: when its next layer is due, xy, and when it stops, zw.
@group(0) @binding(BINDING_schedule) var<storage, read_write> schedule: array<vec4u>;
@group(0) @binding(BINDING_coordinate) var<storage, read_write> coordinate: array<vec4i>;
@group(0) @binding(BINDING_motion) var<storage, read_write> motion: array<vec4f>;

const NEVER = vec2u(0xffffffffu);

// Particles that the emitters' layers want; then how many are born before theirs.
var<workgroup> layers: array<u32, EMITTERS + 1u>;
var<workgroup> sums: array<u32, WORKGROUP_SIZE>;
var<workgroup> earliest: array<vec2u, WORKGROUP_SIZE>;
var<workgroup> shared_count: u32;

fn is_due(n: u32) -> bool {
    let time = middle_of_step();
    return !is_before(time, schedule[n].xy) && !is_before(schedule[n].zw, time);
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
    let late = speed * seconds_of(subtract_ticks(middle_of_step(), schedule[n].xy));
    let way = select(0.0, late, late < parameters.particle_spacing); // 0: it waited
    let direction = vector_of(emitters[n].direction);
    let born = place_of(nozzle[emitters[n].point_first + k - layers[n]]) + quanta_of(way * direction);
    coordinate[i] = vec4i(wide_place(born), i32(GROUP_INLET + n));
    motion[i] = vec4f(wide(speed * direction), 0.0);
}

// When emitter n may have its next layer, after the ones that are due now.
fn plan(n: u32) -> vec2u {
    let now = middle_of_step();
    if is_before(schedule[n].zw, now) {
        return NEVER;
    }
    if layers[n + 1u] == layers[n] {
        // Slots only become free where fluid can leave.
        return select(schedule[n].xy, NEVER, is_due(n) && !CAN_EMPTY);
    }
    let spacing = parameters.particle_spacing;
    let speed = emitters[n].speed;
    let late = speed * seconds_of(subtract_ticks(now, schedule[n].xy));
    let last = select(now, schedule[n].xy, late < spacing);
    let next = add_ticks(last, ticks_of(min(spacing / speed, 2000.0)));
    schedule[n] = vec4u(next, schedule[n].zw);
    return select(next, NEVER, is_before(schedule[n].zw, next));
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn emit(@builtin(local_invocation_index) local: u32) {
    if local == 0u {
        shared_count = select(0u, 1u, any_layer_due());
    }
    if workgroupUniformLoad(&shared_count) == 0u {
        return;
    }
    var own = 0u;
    for (var n = local; n < EMITTER_COUNT; n += WORKGROUP_SIZE) {
        layers[n] = select(0u, emitters[n].point_count, is_due(n));
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
