// Moves the whole particle data into its cell's run, and places that left a periodic domain back into it. Within a cell
// the order is by id, so that sums have one order and two runs give equal bits.
//
// in:  coordinate, motion (the state), id, cell_link, cell_start, control
// out: coordinate, motion (the working copy), sorted_id, control: where on their way they are
@group(0) @binding(BINDING_id) var<storage, read> id: array<u32>;
@group(0) @binding(BINDING_cell_link) var<storage, read> cell_link: array<u32>;
@group(0) @binding(BINDING_cell_start) var<storage, read> cell_start: array<u32>;
@group(0) @binding(BINDING_sorted_id) var<storage, read_write> sorted_id: array<u32>;
@group(0) @binding(BINDING_control) var<storage, read_write> control: Control;

@compute @workgroup_size(WORKGROUP_SIZE)
fn scatter(@builtin(workgroup_id) workgroup: vec3u, @builtin(num_workgroups) workgroups: vec3u,
           @builtin(local_invocation_index) local: u32) {
    let sorts = control.clock.sorting == 1u && control.clock.running == 1u && is_well(control.bad_step, control.restored);
    if !sorts {
        return;
    }
    let thread = thread_index(workgroup, workgroups, local);
    if thread == 0u {
        control.sorted_at = control.clock.travelled + way_of(control.maxima[control.clock.noting]);
    }
    for (var i = thread; i < constants.particle_count; i += workgroups.x * workgroups.y * WORKGROUP_SIZE) {
        move_particle(i);
    }
}

fn move_particle(i: u32) {
    let at = coordinate_at(i);
    let place = wrapped(place_of(at));
    let own = id[i];
    var slot: u32;
    if u32(at.w) == GROUP_EMPTY {
        slot = cell_start[constants.cell_count] + cell_link[link_at(own)];
    } else {
        let cell = grid_cell(place);
        slot = cell_start[cell];
        // The rank in the cell: how many of its ids are lower.
        for (var link = cell_link[cell]; link != 0u; link = cell_link[link_at(link - 1u)]) {
            slot += select(0u, 1u, link < own + 1u);
        }
    }
    let start = side_start(control.clock.side);
    set_coordinate(start + slot, vec4i(wide_place(place), at.w));
    set_motion(start + slot, motion_at(i));
    sorted_id[slot] = own;
    if HAS_SOLIDS && is_solid(u32(at.w)) && solid_table[u32(at.w) - GROUP_SOLID].kind == SOLID_FIXED {
        let other = side_start(1u - control.clock.side) + slot; // so that no step need carry it over
        set_coordinate(other, vec4i(wide_place(place), at.w));
        set_motion(other, motion_at(i));
    }
}
