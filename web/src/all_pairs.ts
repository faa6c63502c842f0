// The tutorial's fluid as its reader would write it: plain JavaScript, an array of objects, every particle against
// every other one. The method is Weir's own (`mueller` with the consistent kernel, docs/method.md), so that it can be
// compared with the engine, result for result. No page needed: it runs in Node as well.

export type Particle = {
  x: number; y: number; // m
  vx: number; vy: number; // m/s
  ax: number; ay: number; // m/s^2
  density: number; // kg/m^3
  pressure: number; // Pa
};

// The tutorial's parameters; the same names as in src/core/params.inl.
export const article = {
  particle_spacing: 0.007,
  support_radius: 0.045,
  rest_density: 1000,
  gas_constant: 2000,
  viscosity: 0.1,
  gravity: [0, -9.81] as [number, number],
  restitution: 0.5,
  time_step: 0.0008,
};

const h = article.support_radius;
// Kernels of the plane: W = 10/(pi h^5) (h-r)^3, its gradient, and the viscosity Laplacian 40/(pi h^5) (h-r).
const kernelFactor = 10 / (Math.PI * h ** 5);
const gradientFactor = 30 / (Math.PI * h ** 5);
const laplacianFactor = 40 / (Math.PI * h ** 5);

// Columns of a block of `count` particles that is about half as wide as it is high (width : height = `aspect`).
export function blockColumns(count: number, aspect: number): number {
  let columns = Math.floor(Math.sqrt(aspect * count) + 0.5);
  while (columns > 1 && count % columns !== 0) --columns;
  return columns > 1 ? columns : count;
}

export type Block = { columns: number; rows: number; min: [number, number]; max: [number, number] };

// A block of `count` particles in the lower left corner of a box that is 2 m wide, larger if it has to be.
export function benchBlock(count: number): Block {
  const spacing = article.particle_spacing;
  const columns = blockColumns(count, Math.sqrt(2 * count) * spacing <= 2 ? 0.5 : 2);
  const rows = count / columns;
  const halfOf = (length: number): number => 0.5 * Math.max(2, 1.5 * length);
  const [x, y] = [halfOf(columns * spacing), halfOf(rows * spacing)];
  return { columns, rows, min: [-x, -y], max: [x, y] };
}

// The same block as a scene document of the engine.
export function benchScene(
  count: number, search: 'grid' | 'all_pairs', viscosity = article.viscosity,
): Record<string, unknown> {
  const { columns, rows, min, max } = benchBlock(count);
  const spacing = article.particle_spacing;
  const corner = [min[0] + columns * spacing, min[1] + rows * spacing];
  return {
    version: 1,
    title: `${count} particles`,
    dimension: 2,
    method: 'mueller',
    parameters: { ...article, viscosity, search },
    domain: { min, max },
    fluid: [{ box: { min, max: corner } }],
  };
}

// Mass of a particle that gives the resting lattice its rest density.
function calibratedMass(): number {
  const spacing = article.particle_spacing;
  const reach = Math.ceil(h / spacing);
  let sum = 0;
  for (let row = -reach; row <= reach; row++) {
    for (let column = -reach; column <= reach; column++) {
      const r = spacing * Math.hypot(row, column);
      if (r < h) sum += kernelFactor * (h - r) ** 3;
    }
  }
  return article.rest_density / sum;
}

export class AllPairsFluid {
  readonly particles: Particle[] = [];
  readonly #mass = calibratedMass();
  readonly #block: Block;
  readonly #viscosity: number;

  constructor(count: number, viscosity = article.viscosity) {
    this.#viscosity = viscosity;
    this.#block = benchBlock(count);
    const { columns, rows, min } = this.#block;
    const spacing = article.particle_spacing;
    for (let row = 0; row < rows; row++) {
      for (let column = 0; column < columns; column++) {
        const x = min[0] + (column + 0.5) * spacing;
        const y = min[1] + (row + 0.5) * spacing;
        this.particles.push({ x, y, vx: 0, vy: 0, ax: 0, ay: 0, density: 0, pressure: 0 });
      }
    }
  }

  step(): void {
    this.#density();
    this.#forces();
    this.#integrate();
  }

  #density(): void {
    const { particles } = this;
    for (const i of particles) {
      let sum = 0;
      for (const j of particles) {
        const dx = i.x - j.x;
        const dy = i.y - j.y;
        const r2 = dx * dx + dy * dy;
        if (r2 < h * h) {
          const q = h - Math.sqrt(r2);
          sum += q * q * q;
        }
      }
      i.density = this.#mass * kernelFactor * sum;
      i.pressure = Math.max(article.gas_constant * (i.density - article.rest_density), 0);
    }
  }

  #forces(): void {
    const { particles } = this;
    for (const i of particles) {
      let [pressureX, pressureY, viscosityX, viscosityY] = [0, 0, 0, 0];
      const termI = i.pressure / (i.density * i.density);
      for (const j of particles) {
        const dx = i.x - j.x;
        const dy = i.y - j.y;
        const r2 = dx * dx + dy * dy;
        if (i !== j && r2 < h * h && r2 > 0) {
          const r = Math.sqrt(r2);
          const q = h - r;
          const pressure = ((termI + j.pressure / (j.density * j.density)) * q * q) / r;
          pressureX += pressure * dx;
          pressureY += pressure * dy;
          viscosityX += (q / j.density) * (j.vx - i.vx);
          viscosityY += (q / j.density) * (j.vy - i.vy);
        }
      }
      const pressureScale = this.#mass * gradientFactor;
      const viscosityScale = (this.#mass * this.#viscosity * laplacianFactor) / i.density;
      i.ax = pressureScale * pressureX + viscosityScale * viscosityX + article.gravity[0];
      i.ay = pressureScale * pressureY + viscosityScale * viscosityY + article.gravity[1];
    }
  }

  // Semi-implicit Euler; a wall mirrors what went through it, scaled by the restitution.
  #integrate(): void {
    const { min, max } = this.#block;
    const { time_step: dt, restitution } = article;
    for (const i of this.particles) {
      i.vx += dt * i.ax;
      i.vy += dt * i.ay;
      i.x += dt * i.vx;
      i.y += dt * i.vy;
      if (i.x < min[0]) [i.x, i.vx] = [min[0] + restitution * (min[0] - i.x), restitution * Math.abs(i.vx)];
      if (i.x > max[0]) [i.x, i.vx] = [max[0] - restitution * (i.x - max[0]), -restitution * Math.abs(i.vx)];
      if (i.y < min[1]) [i.y, i.vy] = [min[1] + restitution * (min[1] - i.y), restitution * Math.abs(i.vy)];
      if (i.y > max[1]) [i.y, i.vy] = [max[1] - restitution * (i.y - max[1]), -restitution * Math.abs(i.vy)];
    }
  }

  // x0, y0, x1, y1, ...
  positions(): Float32Array {
    return Float32Array.from(this.particles.flatMap(({ x, y }) => [x, y]));
  }
}

export type Measured = { steps: number; msPerStep: number };

// Takes steps for about `seconds`, at least one, in batches that are long for the coarse clocks of browsers; the
// median of the batches after a warm-up.
export function measureSteps(step: (count: number) => void, seconds: number): Measured {
  const times: number[] = [];
  const end = performance.now() + 1000 * seconds;
  let [batch, steps, now] = [1, 0, performance.now()];
  do {
    const begin = now;
    step(batch);
    now = performance.now();
    steps += batch;
    const tooShort = now - begin < Math.min(25, 100 * seconds) && batch < 1 << 20;
    if (!tooShort || now >= end) times.push((now - begin) / batch);
    if (tooShort) batch *= 2;
  } while (now < end);
  times.sort((a, b) => a - b);
  return { steps, msPerStep: times[times.length >> 1] ?? Infinity };
}

export function benchAllPairs(count: number, seconds: number): Measured {
  const fluid = new AllPairsFluid(count);
  return measureSteps((steps) => {
    for (let n = 0; n < steps; n++) fluid.step();
  }, seconds);
}
