// Workgroups are counted row by row: a dispatch may be two-dimensional, because one dimension ends at 65,535.
fn workgroup_index(workgroup: vec3u, workgroups: vec3u) -> u32 {
    return workgroup.y * workgroups.x + workgroup.x;
}

fn thread_index(workgroup: vec3u, workgroups: vec3u, local: u32) -> u32 {
    return workgroup_index(workgroup, workgroups) * WORKGROUP_SIZE + local;
}

// The column, row or layer of a grid of `count` lines that a line of the domain shares with those `count` apart.
fn folded(line: u32, count: u32) -> u32 {
    if line < count {
        return line;
    }
    return line % count;
}

// Particles of a workgroup's share: the first, and the end.
fn particle_share(group: u32, workgroups: vec3u) -> vec2u {
    let groups = workgroups.x * workgroups.y;
    let share = (constants.particle_count + groups - 1u) / groups;
    return min(vec2u(group * share, group * share + share), vec2u(constants.particle_count));
}
