// How many steps a frame may take. Where the device tells what a step takes, they fill the frame's budget, less while frames
// come late. Else from the time that the last frames took: a frame costs something without any step (drawing) and
// something per step; both are fitted, so that costly drawing does not pass for costly steps.

const mostSteps = 1024;
const leastShare = 0.6; // of the budget: where drawing alone eats it, the fluid still gets that
const lateness = 1.35; // of the budget, which is less than a frame
const memory = 0.95; // weight of a frame relative to the next one
const probeEvery = 8; // frames; a few more steps then, or all frames would be alike and the fit could not tell

export class Pace {
  maxSteps = 2; // careful at the start: a step may be slow here
  stepMs = 0; // milliseconds per step; 0: not known yet
  #limit = 2;
  #share = 1; // of the budget that is filled
  #meanMs = 0; // of the last frames
  #frames = 0;
  // Weighted sums over the last frames: number, steps, their square, milliseconds, product.
  #n = 0;
  #x = 0;
  #xx = 0;
  #y = 0;
  #xy = 0;

  // A frame with `steps` steps took `ms`; it may spend `budgetMs`. `deviceMs`: of a step, by the device's clock; 0: not known.
  measured(steps: number, ms: number, budgetMs: number, deviceMs = 0): void {
    if (!(ms >= 0)) return;
    if (deviceMs > 0) {
      this.#frames++;
      this.stepMs = deviceMs;
      // What a frame takes besides, and how late the browser tells of its end, nobody knows: where frames come late, they get
      // fewer steps.
      this.#meanMs += 0.1 * (Math.min(ms, 4 * budgetMs) - this.#meanMs);
      const isLate = this.#meanMs > lateness * budgetMs && 2 * steps > this.maxSteps;
      this.#share = Math.min(Math.max(this.#share * (isLate ? 0.98 : 1.005), leastShare), 1);
      this.#grow(Math.floor((this.#share * budgetMs) / deviceMs));
      this.maxSteps = this.#limit;
      return;
    }
    const mean = this.#n > 0 ? this.#y / this.#n : ms;
    const kept = this.#frames > 4 ? Math.min(ms, 4 * mean) : ms; // a hiccup says nothing about steps
    this.#n = memory * this.#n + 1;
    this.#x = memory * this.#x + steps;
    this.#xx = memory * this.#xx + steps * steps;
    this.#y = memory * this.#y + kept;
    this.#xy = memory * this.#xy + steps * kept;
    this.#frames++;
    this.#fit();
    if (this.stepMs > 0) this.#limitSteps(budgetMs);
  }

  #fit(): void {
    const meanSteps = this.#x / this.#n;
    if (meanSteps <= 0) return;
    const meanMs = this.#y / this.#n;
    const variance = this.#xx / this.#n - meanSteps * meanSteps;
    const most = meanMs / meanSteps; // if drawing cost nothing
    if (variance > 0.01 * meanSteps * meanSteps + 0.02) {
      const slope = (this.#xy / this.#n - meanSteps * meanMs) / variance;
      this.stepMs = Math.min(Math.max(slope, 0.02 * most), most);
    } else if (this.stepMs === 0) {
      this.stepMs = most;
    }
    this.stepMs = Math.max(this.stepMs, 1e-4);
  }

  #limitSteps(budgetMs: number): void {
    const fixed = Math.max((this.#y - this.stepMs * this.#x) / this.#n, 0);
    this.#grow(Math.floor(Math.max(budgetMs - fixed, leastShare * budgetMs) / this.stepMs));
    const probe = this.#frames % probeEvery === 0 ? Math.max(1, this.#limit >> 2) : 0;
    this.maxSteps = Math.min(this.#limit + probe, mostSteps);
  }

  // Gently, because a few steps say little about many; shrinks at once.
  #grow(affordable: number): void {
    this.#limit = Math.max(1, Math.min(affordable, Math.ceil(1.5 * this.#limit), mostSteps));
  }

  reset(): void {
    this.maxSteps = this.#limit = 2;
    this.#share = 1;
    this.#meanMs = 0;
    this.stepMs = this.#frames = this.#n = this.#x = this.#xx = this.#y = this.#xy = 0;
  }
}
