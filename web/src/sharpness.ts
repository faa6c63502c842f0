// How many pixels the picture has: the display's, or fewer where a graphics card would need most of each frame to draw them
// all, as small ones do on dense displays. Whether fewer help is seen by trying.

const shares = [1, 0.8, 0.64, 0.5, 0.4, 0.32]; // of the display's pixels, along each side
const leastRatio = 0.62; // pixels per CSS pixel
const settleMs = 1200; // until the mean of what frames take is that of the new picture
const tooMuch = 0.6; // of a frame, for drawing
const enough = 0.45; // that a sharper picture may take
const fastestFrameMs = 15; // more than 60 frames per second are not worth a blur

export class Sharpness {
  #level = 0;
  #lowest = shares.length - 1; // that was of use
  #since = 0; // when the level changed
  #before = { level: 0, drawMs: 0 };

  // Of the display's pixels, along each side.
  get share(): number {
    return shares[this.#level] as number;
  }

  // Another picture is drawn from now on: `isCard`, by a graphics card.
  restart(now: number, isCard: boolean): void {
    if (!isCard) this.#level = 0;
    this.#lowest = shares.length - 1;
    this.#since = now;
    this.#before = { level: this.#level, drawMs: 0 };
  }

  // Once per frame, with what a frame takes besides its steps and the display's pixels per CSS pixel. True if the share has
  // changed.
  update(now: number, drawMs: number, intervalMs: number, ratio: number): boolean {
    if (!(drawMs > 0)) this.#since = now;
    if (now - this.#since < settleMs) return false;
    const frameMs = Math.max(intervalMs, fastestFrameMs);
    let level = this.#level;
    if (this.#wasOfNoUse(drawMs)) {
      level = this.#lowest = this.#before.level;
    } else if (drawMs > tooMuch * frameMs) {
      while (level < this.#lowest && this.#expected(drawMs, level) > enough * frameMs && this.#isFine(level + 1, ratio)) level++;
    } else if (level > 0 && this.#expected(drawMs, level - 1) < enough * frameMs) {
      level--;
    }
    this.#before = { level: this.#level, drawMs };
    this.#since = now;
    const changed = level !== this.#level;
    this.#level = level;
    return changed;
  }

  #isFine(level: number, ratio: number): boolean {
    return (shares[level] as number) * ratio >= leastRatio;
  }

  #area(level: number): number {
    return (shares[level] as number) ** 2;
  }

  #expected(drawMs: number, level: number): number {
    return (drawMs * this.#area(level)) / this.#area(this.#level);
  }

  // Whether fewer pixels brought less than a third of what they should have.
  #wasOfNoUse(drawMs: number): boolean {
    const { level, drawMs: before } = this.#before;
    if (level >= this.#level) return false;
    const hoped = before * (1 - this.#area(this.#level) / this.#area(level));
    return before - drawMs < hoped / 3;
  }
}
