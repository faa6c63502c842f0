// How many steps a frame may take: what fits beside all else that a frame takes (drawing above all), so that frames keep to
// the display's. Where that is too little, a frame lasts two of the display's, or three: better fewer frames than slow
// motion. What steps and drawing take the device tells, or the last frames do: they take something without any step and
// something per step, and a line is fitted to both.

const mostSteps = 1024;
const usable = 0.95; // of a frame
const lateMs = 5; // that a browser may tell of a frame's end too late
// Shares of a frame for its steps. Between the first two it stays as long as it is: how late a browser tells of a frame's end
// depends on whether the device waits for the display.
const tooLittle = 0.35;
const plenty = 0.65;
const leastShare = 0.5; // of a frame that may not last longer
const memory = 0.95; // weight of a frame relative to the next one
const probeEvery = 8; // frames; a few more steps then, or all frames would be alike and the fit could not tell

export class Pace {
  maxSteps = 2; // careful at the start: a step may be slow here
  stepMs = 0; // milliseconds per step; 0: not known yet
  readonly #longestMs: number;
  #limit = 2;
  #intervals = 1; // of the display that a frame lasts
  #frames = 0;
  #told = false; // by the device
  // Weighted sums over the last frames: number, steps, their square, milliseconds, product.
  #n = 0;
  #x = 0;
  #xx = 0;
  #y = 0;
  #xy = 0;

  // `longestMs`: up to which frames may last longer than the display's.
  constructor(longestMs = 0) {
    this.#longestMs = longestMs;
  }

  // A frame with `steps` steps took `ms`. By the device's clock, 0 where not known: `deviceMs`, of a step; `drawMs`, of drawing.
  measured(steps: number, ms: number, intervalMs: number, deviceMs = 0, drawMs = 0): void {
    if (!(ms >= 0)) return;
    if (deviceMs > 0 && !this.#told) this.#forget(); // frames until then were busy with other things
    this.#told = deviceMs > 0;
    this.#add(steps, ms);
    if (this.#told) this.stepMs = deviceMs;
    else this.#fit();
    if (this.stepMs > 0) this.#limitSteps(intervalMs, drawMs);
  }

  #add(steps: number, ms: number): void {
    const mean = this.#n > 0 ? this.#y / this.#n : ms;
    const kept = this.#frames > 4 ? Math.min(ms, 4 * mean) : ms; // a hiccup says nothing about steps
    this.#n = memory * this.#n + 1;
    this.#x = memory * this.#x + steps;
    this.#xx = memory * this.#xx + steps * steps;
    this.#y = memory * this.#y + kept;
    this.#xy = memory * this.#xy + steps * kept;
    this.#frames++;
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

  #limitSteps(intervalMs: number, drawMs: number): void {
    const besides = Math.max((this.#y - this.stepMs * this.#x) / this.#n, 0);
    const fixed = drawMs > 0 ? Math.max(drawMs, besides - lateMs) : besides;
    const affordable = Math.floor(this.#roomBeside(fixed, intervalMs) / this.stepMs);
    // Grows gently, because a few steps say little about many; shrinks at once.
    this.#limit = Math.max(1, Math.min(affordable, Math.ceil(1.5 * this.#limit), mostSteps));
    const probe = !this.#told && this.#frames % probeEvery === 0 ? Math.max(1, this.#limit >> 2) : 0;
    this.maxSteps = Math.min(this.#limit + probe, mostSteps);
  }

  // Milliseconds for steps in a frame that takes `fixedMs` without any.
  #roomBeside(fixedMs: number, intervalMs: number): number {
    const share = (intervals: number): number => usable - fixedMs / (intervals * intervalMs);
    const isLongest = (): boolean => (this.#intervals + 1) * intervalMs > this.#longestMs;
    while (share(this.#intervals) < tooLittle && !isLongest()) this.#intervals++;
    while (this.#intervals > 1 && share(this.#intervals - 1) > plenty) this.#intervals--;
    const room = share(this.#intervals);
    return this.#intervals * intervalMs * (isLongest() ? Math.max(room, leastShare) : room);
  }

  #forget(): void {
    this.#frames = this.#n = this.#x = this.#xx = this.#y = this.#xy = 0;
  }

  reset(): void {
    this.maxSteps = this.#limit = 2;
    this.#intervals = 1;
    this.#told = false;
    this.stepMs = 0;
    this.#forget();
  }
}
