const SLOW = 25,
  FAST = 15; // ms from one picture to the next, while things move
const STILL = 150,
  MAX_WAIT = 1500; // ms without a change before a picture in full resolution: at least, at most
const QUIET = 2; // animation frames without a change before it: behind one that was slow, changes may wait
const COUNTED = 3; // animation frames after it that wait for it: who draws lags behind
const LARGEST = 2; // pixels drawn per pixel of the page, across and down
const FEWEST = 240; // pixels drawn from top to bottom of a page, if that is between a third and a half of its pixels

/** True where no graphics card draws, but the processor. */
export function drawsInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  const named = context?.getExtension("WEBGL_debug_renderer_info");
  const name = named ? String(context!.getParameter(named.UNMASKED_RENDERER_WEBGL)) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/**
 * How finely to draw: coarser while things move and the machine is slow, and again in full when they stand still.
 * Without a graphics card edges are smoothed by drawing more pixels than there are, then.
 */
export class Quality {
  private readonly finest: number;
  private moving: number;
  private now: number;
  private pictures = 0;
  private spent = 0; // ms, of these pictures
  private changed = -Infinity; // when the last change was drawn
  private quiet = 0; // animation frames since
  private rested = true; // nothing has moved since
  private full = 0; // when the last picture in full resolution was drawn, after a movement
  private counted = COUNTED; // animation frames since
  private patience = STILL; // ms without a change before the next one
  private tick = 0; // when the last animation frame was
  private drew = false; // and whether it drew a change
  private isHeld = false; // in full resolution, whatever moves

  constructor(private readonly software: boolean) {
    this.finest = software ? LARGEST : Math.min(devicePixelRatio, LARGEST);
    this.moving = software ? Math.min(devicePixelRatio, LARGEST) : this.finest;
    this.now = this.moving;
  }

  /** Pixels drawn per pixel of the page, across and down. */
  get ratio(): number {
    return this.now;
  }

  get isFull(): boolean {
    return this.now === this.finest;
  }

  /** Of the resolution of a picture that stands still. */
  get share(): number {
    return this.now / this.finest;
  }

  /** True while things move, and the machine is too slow to draw them in the resolution of the screen. */
  get hurries(): boolean {
    return !this.isFull && this.now < Math.min(devicePixelRatio, LARGEST);
  }

  /** All pictures are in full resolution, however long they take; or as usual again. */
  hold(on: boolean): void {
    this.isHeld = on;
    if (on) this.now = this.finest;
  }

  /** Call in an animation frame that is about to draw a change. */
  change(time: number): void {
    this.begin(time);
    if (this.isHeld) return;
    if (this.rested) this.pictures = this.spent = 0;
    if (this.counted < COUNTED) this.disturb(time);
    this.drew = !this.rested; // the first of a movement says nothing of how long pictures take
    if (!this.rested || this.software) this.now = this.moving;
    this.changed = time;
    this.quiet = 0;
    this.rested = false;
  }

  /** Call in an animation frame where nothing has changed. True if it is time for a picture in full resolution. */
  rest(time: number): boolean {
    this.begin(time);
    if (++this.quiet < QUIET || time - this.changed < this.patience) return false;
    this.rested = true;
    if (this.isFull) return false;
    this.now = this.finest;
    this.full = time;
    this.counted = 0;
    return true;
  }

  /** A picture in full resolution sizes the canvas anew, twice, and takes long where processors draw. It does no harm unless a
   * change has to wait for it: then changes keep coming, and there is none before they have paused for longer. */
  private disturb(time: number): void {
    this.patience = Math.min(Math.max(2 * this.patience, time - this.full), MAX_WAIT);
    this.counted = COUNTED;
  }

  /** How long a picture takes is the time to the next animation frame, or to one that is later. */
  private begin(time: number): void {
    if (this.drew) this.measure(time - this.tick);
    this.tick = time;
    this.drew = false;
    if (this.counted < COUNTED && ++this.counted === COUNTED) this.patience = STILL;
  }

  /** The next picture is as coarse as pictures may become. */
  setLeast(): void {
    this.now = this.least();
    this.changed = performance.now();
    this.quiet = 0;
    this.rested = false;
  }

  /** The next picture is in full resolution. */
  setFull(): void {
    this.now = this.finest;
  }

  private least(): number {
    const full = Math.min(devicePixelRatio, LARGEST);
    return Math.max(full / 3, Math.min(full / 2, FEWEST / Math.max(innerHeight, 1)));
  }

  private measure(passed: number): void {
    this.spent += passed;
    if (++this.pictures < 6 && this.spent < 400) return;
    const mean = this.spent / this.pictures;
    this.pictures = this.spent = 0;
    const full = Math.min(devicePixelRatio, LARGEST);
    if (mean > SLOW) this.moving = Math.max(this.least(), Math.max(0.6, Math.sqrt(SLOW / mean)) * this.moving);
    else if (mean < FAST) this.moving = Math.min(full, 1.15 * this.moving);
  }
}
