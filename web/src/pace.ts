// How many steps a frame may take, from the time that the last ones took. A frame costs something without any step
// (drawing) and something per step; both are fitted to the last frames, so that costly drawing does not pass for
// costly steps.

const mostSteps = 1024;
const memory = 0.95; // weight of a frame relative to the next one
const probeEvery = 8; // frames; a few more steps then, or all frames would be alike and the fit could not tell

export class Pace {
  maxSteps = 2; // careful at the start: a step may be slow here
  stepMs = 0; // milliseconds per step; 0: not known yet
  #limit = 2;
  #frames = 0;
  // Weighted sums over the last frames: number, steps, their square, milliseconds, product.
  #n = 0;
  #x = 0;
  #xx = 0;
  #y = 0;
  #xy = 0;

  // A frame with `steps` steps took `ms`; it may spend `budgetMs`.
  measured(steps: number, ms: number, budgetMs: number): void {
    if (!(ms >= 0)) return;
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
    // Where drawing alone eats the budget, the fluid still gets its share.
    const affordable = Math.floor(Math.max(budgetMs - fixed, 0.6 * budgetMs) / this.stepMs);
    // Grows gently, because a few steps say little about many; shrinks at once.
    this.#limit = Math.max(1, Math.min(affordable, Math.ceil(1.5 * this.#limit), mostSteps));
    const probe = this.#frames % probeEvery === 0 ? Math.max(1, this.#limit >> 2) : 0;
    this.maxSteps = Math.min(this.#limit + probe, mostSteps);
  }

  reset(): void {
    this.maxSteps = this.#limit = 2;
    this.stepMs = this.#frames = this.#n = this.#x = this.#xx = this.#y = this.#xy = 0;
  }
}
