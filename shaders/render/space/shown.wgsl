// Shared by the effects that draw the particles that can be seen: their numbers.

@group(1) @binding(4) var<storage, read> shown: array<u32>; // crowd_gather
