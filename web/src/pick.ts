// Where a ray meets the fluid, on the positions last known.
import type { Triple } from './weir.ts';

export type PickSource = {
  positions: Float32Array; // x, y, z per particle, by id
  count: number; // of the fluid's slots; some may be empty, their places outside of the domain
  radius: number; // m, how near to a particle's centre the ray must pass
  min: readonly number[]; // of the domain
  max: readonly number[];
};

// Distance along the ray to the first particle that it meets; null: none. `direction` has length 1.
export function pickFluid(source: PickSource, origin: Readonly<Triple>, direction: Readonly<Triple>): number | null {
  const { positions, count, radius, min, max } = source;
  const [ox, oy, oz] = origin;
  const [dx, dy, dz] = direction;
  const [x0 = 0, y0 = 0, z0 = 0] = min;
  const [x1 = 0, y1 = 0, z1 = 0] = max;
  let nearest = Infinity;
  for (let i = 0; i < count; i++) {
    const px = positions[3 * i] as number, py = positions[3 * i + 1] as number, pz = positions[3 * i + 2] as number;
    const rx = px - ox, ry = py - oy, rz = pz - oz;
    const distance = rx * dx + ry * dy + rz * dz;
    if (distance <= 0 || distance >= nearest) continue;
    if (rx * rx + ry * ry + rz * rz - distance * distance > radius * radius) continue;
    if (px < x0 || px > x1 || py < y0 || py > y1 || pz < z0 || pz > z1) continue;
    nearest = distance;
  }
  return nearest < Infinity ? nearest : null;
}
