// How many pixels the picture has: the display's, or fewer where a graphics card has no time to draw them all beside the
// fluid's steps, as small ones on dense displays. Whether fewer help is seen by trying.

const shares = [1, 0.8, 0.64, 0.5, 0.4, 0.32]; // of the display's pixels, along each side
const leastRatio = 0.78; // pixels per CSS pixel
const settleMs = 1200; // until means are those of the new picture
const usable = 0.95; // of a frame
const leastRoom = 0.45; // of a frame, for drawing: steps take what is left of it
const spare = 0.8; // of that room, which a sharper picture must fit
const fastestFrameMs = 15; // more than 60 frames per second are not worth a blur

export type Load = { drawMs: number; stepsMs: number }; // of a frame, on the device; drawMs 0: not known

export class Sharpness {
  #level = 0;
  #lowest = shares.length - 1; // that was of use
  #since = 0; // when the level changed
  #stepsMs = 0; // averaged
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

  // Once per frame; `ratio`: the display's pixels per CSS pixel. True if the share has changed.
  update(now: number, { drawMs, stepsMs }: Load, intervalMs: number, ratio: number): boolean {
    this.#stepsMs += 0.03 * (stepsMs - this.#stepsMs);
    if (!(drawMs > 0)) this.#since = now;
    if (now - this.#since < settleMs) return false;
    const frameMs = Math.max(intervalMs, fastestFrameMs);
    const room = Math.max(usable * frameMs - this.#stepsMs, leastRoom * frameMs);
    let level = this.#level;
    if (this.#wasOfNoUse(drawMs)) {
      level = this.#lowest = this.#before.level;
    } else if (drawMs > room) {
      while (level < this.#lowest && this.#expected(drawMs, level) > room && this.#isFine(level + 1, ratio)) level++;
    } else if (level > 0 && this.#expected(drawMs, level - 1) < spare * room) {
      level--;
    }
    while (level > 0 && !this.#isFine(level, ratio)) level--; // on a display less dense than the last one
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
