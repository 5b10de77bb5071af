const SLOW = 25,
  FAST = 15; // ms between two pictures of a moving scene
const STILL = 150,
  MAX_WAIT = 1500; // ms without a change before a picture in full resolution: lower and upper bound
const QUIET = 2; // animation frames without a change before it, because changes may wait behind a slow frame
const COUNTED = 3; // animation frames counted after it, because the display may lag behind
const LARGEST = 2; // drawn pixels per pixel of the page and direction
const FEWEST = 240; // lower bound of drawn rows per page, within a third to a half of the page's pixels

/** Returns whether the processor draws, without a graphics card. */
export function drawsInSoftware(): boolean {
  const context = document.createElement("canvas").getContext("webgl2");
  const named = context?.getExtension("WEBGL_debug_renderer_info");
  const name = named ? String(context!.getParameter(named.UNMASKED_RENDERER_WEBGL)) : "";
  context?.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}

/**
 * Chooses the resolution: coarser while the scene moves on a slow machine, and full when it stands still. Without a
 * graphics card, pictures of a scene at rest are drawn with more pixels than the page has, to smooth edges.
 */
export class Quality {
  private readonly finest: number;
  private moving: number;
  private now: number;
  private pictures = 0;
  private spent = 0; // ms of these pictures
  private changed = -Infinity; // time of the last drawn change
  private quiet = 0; // animation frames since then
  private rested = true; // no motion since then
  private full = 0; // time of the last picture in full resolution after a motion
  private counted = COUNTED; // animation frames since then
  private patience = STILL; // ms without a change before the next one
  private tick = 0; // time of the last animation frame
  private drew = false; // whether that frame drew a change
  private isHeld = false; // full resolution even in motion

  constructor(private readonly software: boolean) {
    this.finest = software ? LARGEST : Math.min(devicePixelRatio, LARGEST);
    this.moving = software ? Math.min(devicePixelRatio, LARGEST) : this.finest;
    this.now = this.moving;
  }

  /** Drawn pixels per pixel of the page and direction. */
  get ratio(): number {
    return this.now;
  }

  get isFull(): boolean {
    return this.now === this.finest;
  }

  /** The resolution relative to that of a scene at rest. */
  get share(): number {
    return this.now / this.finest;
  }

  /** True while the scene moves and the machine is too slow for the resolution of the screen. */
  get hurries(): boolean {
    return !this.isFull && this.now < Math.min(devicePixelRatio, LARGEST);
  }

  /** Draws all pictures in full resolution, however slow; or resumes the usual choice. */
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
    this.drew = !this.rested; // the first picture of a motion says nothing of the drawing time
    if (!this.rested || this.software) this.now = this.moving;
    this.changed = time;
    this.quiet = 0;
    this.rested = false;
  }

  /** Call in an animation frame without a change. Returns whether a picture in full resolution is due. */
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

  /** Adapts the waiting time. A picture in full resolution resizes the canvas twice, and is slow in software. It delays
   * changes that arrive meanwhile; if changes keep arriving, the next one waits for a longer pause. */
  private disturb(time: number): void {
    this.patience = Math.min(Math.max(2 * this.patience, time - this.full), MAX_WAIT);
    this.counted = COUNTED;
  }

  /** Measures the time of a picture until the next animation frame, or until a later one. */
  private begin(time: number): void {
    if (this.drew) this.measure(time - this.tick);
    this.tick = time;
    this.drew = false;
    if (this.counted < COUNTED && ++this.counted === COUNTED) this.patience = STILL;
  }

  /** Draws the next picture in the lowest resolution. */
  setLeast(): void {
    this.now = this.least();
    this.changed = performance.now();
    this.quiet = 0;
    this.rested = false;
  }

  /** Draws the next picture in full resolution. */
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
