// Each particle's list (common/neighbors.wgsl). Solid particles list fluid alone.
// After a sort also the slots of solid particles, the state's ids, and the slots with those of fluid first (common/lists.wgsl).
//
// in:  coordinate, sorted_id, cell_start, control
// out: neighbor_list, control: how long lists last; solid_particle (slots), id, the end of cell_start; cell_link's heads are emptied
//      for the next count
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;
@group(0) @binding(BINDING_sorted_id) var<storage, read> sorted_id: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read_write> cell_start: array<u32>;
@group(0) @binding(BINDING_solid_particle) var<storage, read_write> solid_particle: array<SolidParticle>;
@group(0) @binding(BINDING_id) var<storage, read_write> id: array<u32>;
@group(0) @binding(BINDING_cell_link) var<storage, read_write> cell_link: array<atomic<u32>>;

var<workgroup> fluid_slots: atomic<u32>; // wgpu-native does not zero it
var<workgroup> fluid_before: atomic<u32>;
var<workgroup> solid_slots: atomic<u32>;
var<workgroup> solids_before: atomic<u32>;
var<workgroup> mixed_warp: array<atomic<u32>, WORKGROUP_SIZE / WARP>;

// Across the end of an axis runs do not come in the order of their slots, and entries count from the lowest one.
const WRAPS = DIMENSION == 3u && (PERIODIC_X || PERIODIC_Y);

fn layer_of(header: vec4u, layer: u32) -> u32 {
    return select(select(header.w, header.z, layer == 1u), header.y, layer == 0u);
}

fn with_layer(header: vec4u, layer: u32, first: u32) -> vec4u {
    return select(select(vec4u(header.xyz, first), vec4u(header.xy, first, header.w), layer == 1u),
                  vec4u(header.x, first, header.zw), layer == 0u);
}

// The way up to the step that comes, and how far particles have come from their cells.
fn way_now() -> u32 {
    return control.clock.travelled + way_of(control.maxima[control.clock.noting]);
}

fn strayed() -> u32 {
    return way_now() - control.sorted_at;
}

// What is to be done before the step that comes. From the workgroup's memory, so that browsers know all of its threads to agree.
const LISTING = 1u;
const SORTED = 2u;
var<workgroup> due: u32;

fn due_now(local: u32) -> u32 {
    if local == 0u {
        let runs = control.clock.running == 1u && is_well(control.bad_step, control.restored);
        due = select(0u, control.clock.listing * LISTING + control.clock.sorting * SORTED, runs);
    }
    return workgroupUniformLoad(&due);
}

// A header with the lowest slot of each layer.
fn first_candidates(place: Place, reach: i32) -> vec4u {
    var header = vec4u(0u, vec3u(0xffffffffu));
    var walk = walk_around(place, reach);
    while next_run(&walk) {
        let begin = cell_start[walk.first_cell];
        if begin < cell_start[walk.end_cell] {
            header = with_layer(header, walk.run_layer, min(begin, layer_of(header, walk.run_layer)));
        }
    }
    return header;
}

fn is_free(group: u32) -> bool {
    return FREE_SOLIDS && is_solid(group) && solid_table[group - GROUP_SOLID].kind == SOLID_FREE;
}

// Whether a solid other than `group` has a particle within sqrt(limit), among the next 32 candidates.
fn meets_solid(place: Place, first: u32, left: u32, limit: f32, group: u32) -> bool {
    for (var near = near_among(place, first, left, limit, 0u).bits; near != 0u; near &= near - 1u) {
        let other = u32(coordinate_at(first + firstTrailingBit(near)).w);
        if is_solid(other) && other != group {
            return true;
        }
    }
    return false;
}

// Leaves the list but for its header, which it returns. `groups` takes the bits of all candidates' groups.
fn make_list(i: u32, own: vec4i, start: u32, groups: ptr<function, u32>) -> vec4u {
    let allowance = control.clock.next_allowance;
    let reach = (1u << constants.coordinate_bits) + 2u * allowance + 8u;
    let limit = f32(reach) * f32(reach);
    // Of groups less 1, those below are solids', which solids do not see.
    let unseen = select(0u, GROUP_INLET - GROUP_SOLID, HAS_SOLIDS && is_solid(u32(own.w)));
    var part = vec4u(0u);
    var count = 0u;
    var header = vec4u(0u);
    var fits = true;
    let touching = quanta_of_spacings(CONTACT_RANGE) + 2.0 * f32(allowance) + 8.0;
    var meets = false;
    if WRAPS {
        header = first_candidates(place_of(own), i32(reach + strayed()));
    }
    var layer = 0xffffffffu;
    var walk = walk_around(place_of(own), i32(reach + strayed()));
    while next_run(&walk) {
        let begin = cell_start[walk.first_cell];
        let end = cell_start[walk.end_cell];
        if begin >= end {
            continue;
        }
        if walk.run_layer != layer {
            layer = walk.run_layer;
            if !WRAPS {
                header = with_layer(header, layer, begin);
            }
        }
        let first = layer_of(header, layer);
        fits = fits && run_fits(i, first, layer, begin, end);
        let shift = entry_shift(i, first, layer);
        for (var at = begin; at < end; at += 32u) {
            let found = near_among(walk.place, start + at, end - at, limit, unseen);
            *groups |= found.groups;
            if is_free(u32(own.w)) && !meets {
                meets = meets_solid(walk.place, start + at, end - at, touching * touching, u32(own.w));
            }
            for (var near = found.bits; near != 0u; near &= near - 1u) {
                part = pushed(part, at + firstTrailingBit(near) + shift);
                count += 1u;
                if count % 8u == 0u {
                    store_part(i, count / 8u, part);
                }
            }
        }
    }
    fits = fits && count <= 8u * LIST_PARTS && (count % 4u == 0u || own_entry(i, header) != 0xffffu);
    let listed_count = count;
    // What fills the last part is the particle itself.
    if count % 8u != 0u {
        for (; count % 8u != 0u; count++) {
            part = pushed(part, own_entry(i, header));
        }
        store_part(i, count / 8u, part);
    }
    let count_word = listed_count | select(0u, MEETS_SOLID, meets);
    return vec4u(select(NO_LIST, count_word, fits), header.yzw);
}

// A part with an entry more; its first one falls out.
fn pushed(part: vec4u, entry: u32) -> vec4u {
    return (part >> vec4u(16u)) | (vec4u(part.yzw, entry) << vec4u(16u));
}

fn store_part(i: u32, part: u32, entries: vec4u) {
    if part <= LIST_PARTS {
        set_list_part(part_index(i, part), entries);
    }
}

@compute @workgroup_size(WORKGROUP_SIZE)
fn neighbors(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
             @builtin(local_invocation_index) local: u32) {
    let work = due_now(local);
    if (work & LISTING) == 0u {
        return;
    }
    let sorted = (work & SORTED) != 0u;
    let first_thread = workgroup_index(workgroup, workgroups) * WORKGROUP_SIZE;
    let threads = workgroups.x * workgroups.y * WORKGROUP_SIZE;
    if first_thread + local == 0u {
        control.listed_at = way_now();
        control.allowance = control.clock.next_allowance;
    }
    if sorted {
        for (var cell = first_thread + local; cell < constants.cell_count; cell += threads) {
            atomicStore(&cell_link[cell], 0u);
        }
    }
    for (var first = first_thread; first < constants.particle_count; first += threads) {
        if FLUID_FIRST && sorted {
            put_fluid_first(first + local, local);
        }
        var mixed = false;
        var header = vec4u(NO_LIST);
        if first + local < constants.particle_count {
            if sorted {
                note_slot(first + local);
            }
            header = list_of(first + local, &mixed);
        }
        if LISTS && MARKS_MIXED && any_of_warp(mixed, local) {
            header.x |= MIXED_LIST;
        }
        if LISTS && first + local < constants.particle_count {
            set_list_part(part_index(first + local, 0u), header);
        }
    }
}

// Which thread of `forces` or `walls` takes a particle is the same to its sums, so workgroups come in any order.
fn put_fluid_first(i: u32, local: u32) {
    if local == 0u {
        atomicStore(&fluid_slots, 0u);
        atomicStore(&solid_slots, 0u);
    }
    workgroupBarrier();
    let is_particle = i < constants.particle_count;
    var is_solid_slot = false;
    var rank = 0u;
    if is_particle {
        is_solid_slot = sorted_id[i] >= constants.first_solid;
        if is_solid_slot {
            rank = atomicAdd(&solid_slots, 1u);
        } else {
            rank = atomicAdd(&fluid_slots, 1u);
        }
    }
    workgroupBarrier();
    if local == 0u {
        atomicStore(&fluid_before, atomicAdd(&cell_link[fluid_put_at()], atomicLoad(&fluid_slots)));
        atomicStore(&solids_before, constants.first_solid + atomicAdd(&cell_link[solids_put_at()], atomicLoad(&solid_slots)));
    }
    workgroupBarrier();
    if is_particle {
        rank += select(atomicLoad(&fluid_before), atomicLoad(&solids_before), is_solid_slot);
        cell_start[fluid_first_at(rank)] = i;
    }
}

// Where the particle is now.
fn note_slot(i: u32) {
    id[i] = sorted_id[i];
    if sorted_id[i] >= constants.first_solid {
        solid_particle[sorted_id[i] - constants.first_solid].slot = i;
        if !FLUID_FIRST {
            cell_start[fluid_first_at(sorted_id[i])] = i;
        }
    }
}

// Its list's header, and whether not all that it lists may be of fluid.
fn list_of(i: u32, mixed: ptr<function, bool>) -> vec4u {
    let start = side_start(control.clock.side);
    let own = coordinate_at(start + i);
    if !LISTS || u32(own.w) == GROUP_EMPTY {
        return vec4u(NO_LIST);
    }
    var groups = 0u;
    let header = make_list(i, own, start, &groups);
    *mixed = groups != GROUP_FLUID;
    return header;
}

// Whether it is so for one of the WARP threads.
fn any_of_warp(mixed: bool, local: u32) -> bool {
    if local % WARP == 0u {
        atomicStore(&mixed_warp[local / WARP], 0u);
    }
    workgroupBarrier();
    if mixed {
        atomicStore(&mixed_warp[local / WARP], 1u);
    }
    workgroupBarrier();
    let is_mixed = atomicLoad(&mixed_warp[local / WARP]) == 1u;
    workgroupBarrier();
    return is_mixed;
}
