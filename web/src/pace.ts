// How many steps a frame may take, from the time that the last ones took.

const mostSteps = 256;

export class Pace {
  maxSteps = 2; // careful at the start: a step may be slow here
  stepMs = 0; // milliseconds per step, averaged; 0: not known yet

  // `steps` took `ms`; a frame may spend `budgetMs`.
  measured(steps: number, ms: number, budgetMs: number): void {
    if (steps < 1 || !(ms >= 0)) return;
    const stepMs = ms / steps;
    this.stepMs = this.stepMs === 0 ? stepMs : this.stepMs + 0.2 * (stepMs - this.stepMs);
    const affordable = Math.floor(budgetMs / Math.max(this.stepMs, 1e-3));
    // Grows gently, because a few steps hide what many cost; shrinks at once.
    this.maxSteps = Math.max(1, Math.min(affordable, Math.ceil(1.5 * this.maxSteps), mostSteps));
  }

  reset(): void {
    this.maxSteps = 2;
    this.stepMs = 0;
  }
}
