import * as THREE from "three";
import { replaceIn, checkHardShadowsOnce } from "./chunks";
import { isSeen } from "./display";
import { cornersOf, firstDirection } from "./first_view";
import { Floor } from "./floor";
import { Labels } from "./labels";
import { Lights } from "./lights";
import { WideLines } from "./lines";
import type { CameraMessage, AppearanceMessage } from "./messages";
import { drawsInSoftware, Quality } from "./quality";
import { FreeRotation } from "./rotation";
import { type Camera, Viewpoint } from "./viewpoint";

/** A point on a shape. */
export interface Hit {
  id: number; // of the frame
  point: THREE.Vector3;
  normal: THREE.Vector3; // of the surface, world
}

const SHADOW_PERIOD = 3; // pictures
const FOG_FROM = 9,
  FOG_TO = 28; // m, for usual scenes
/** Directions towards (0, 0, 0.9). */
const FIRST_VIEW: CameraMessage = {
  kind: "camera",
  pose: [1.5, 2.6, 1.8, -0.15442, 0.20751, 0.77494, -0.57667],
  distance: 3.134,
  focal: 0,
  ortho: 0,
  aspect: 1,
  near: 0,
  far: 0,
};
const LEFT = 0,
  RIGHT = 2; // buttons
const STILL = 5; // pixels: a shorter pointer motion is a click

const colorOf = (rgb: number[]): THREE.Color =>
  new THREE.Color().setRGB(rgb[0]!, rgb[1]!, rgb[2]!, THREE.SRGBColorSpace);

/** Shows colors unchanged, except that values above 0.8 bend towards white, which keeps their shades distinguishable.
 * */
function bentAtWhite(): THREE.ToneMapping {
  replaceIn(
    "tonemapping_pars_fragment",
    "vec3 CustomToneMapping( vec3 color ) { return color; }",
    /* glsl */ `vec3 CustomToneMapping(vec3 color) {
      float peak = max(color.r, max(color.g, color.b));
      return peak < 0.8 ? color : color * (1.0 - 0.04 / (peak - 0.6)) / peak;
    }`,
  );
  return THREE.CustomToneMapping;
}

/** Canvas, camera, lights and floor: everything but the scene itself. Draws only after changes. */
export class Stage {
  readonly scene = new THREE.Scene();
  readonly frames = new THREE.Group();
  readonly renderer: THREE.WebGLRenderer;
  readonly viewpoint: Viewpoint;
  private readonly labels: Labels;
  private readonly floor = new Floor();
  private ground: THREE.Color | null = null; // background color, if the program sets one
  private readonly lights = new Lights();
  private readonly ticks: ((seconds: number) => void)[] = [];
  private readonly moves: (() => void)[] = [];
  private readonly preparations: (() => void)[] = [];
  private readonly squareListeners: ((square: number) => void)[] = [];
  private readonly timer = new THREE.Timer();
  private readonly quality: Quality;
  private dirty = true; // the next picture differs from the last
  private shadowsAreOld = true;
  private picture = 0;
  private ball = new THREE.Sphere(new THREE.Vector3(), 1); // around everything visible
  private isPlaced = false; // the program or a user has set the camera
  cut: THREE.Plane | null = null; // points behind it are not seen
  /** Groups with the shapes of the scene. */
  readonly shapes: THREE.Object3D[] = [this.frames];
  private square = 0; // m, size of the floor's squares

  constructor(readonly canvas: HTMLCanvasElement) {
    const software = drawsInSoftware();
    this.quality = new Quality(software);
    this.renderer = new THREE.WebGLRenderer({ canvas, antialias: !software, stencil: true });
    this.renderer.localClippingEnabled = true;
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.autoUpdate = false;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    this.renderer.toneMapping = bentAtWhite();
    checkHardShadowsOnce();
    this.labels = new Labels(canvas);
    this.viewpoint = new Viewpoint(
      canvas,
      () => (this.dirty = true),
      () => {
        this.isPlaced = true;
        this.moves.forEach((move) => move());
      },
    );
    new FreeRotation(canvas, this.viewpoint);
    this.scene.add(this.lights.group);
    this.scene.add(this.frames, this.floor.group);
    this.viewpoint.set(FIRST_VIEW);
    this.fitScene();
    new ResizeObserver(() => this.resize()).observe(canvas);
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paper());
    canvas.addEventListener("dblclick", (event) => this.focus(event));
    this.onClick((event) => this.focus(event), RIGHT);
    this.paper();
    this.resize();
    this.renderer.setAnimationLoop((time) => {
      this.timer.update(time);
      const seconds = this.timer.getDelta();
      for (const tick of this.ticks) tick(seconds);
      this.viewpoint.glide(seconds);
      if (this.dirty) this.quality.change(time);
      else if (this.quality.rest(time)) this.redraw();
      this.draw();
    });
  }

  /** Registers a listener before every picture; its argument is the time since the previous one. */
  onTick(tick: (seconds: number) => void): void {
    this.ticks.push(tick);
  }

  /** Registers a listener before pictures that differ from the last. */
  onDraw(prepare: () => void): void {
    this.preparations.push(prepare);
  }

  /** Registers a listener of camera motions by users. */
  onMove(move: () => void): void {
    this.moves.push(move);
  }

  get camera(): Camera {
    return this.viewpoint.camera;
  }

  /** Registers a listener of clicks and taps on the canvas without a drag. */
  onClick(click: (event: PointerEvent) => void, button = LEFT): void {
    let down: PointerEvent | null = null;
    this.canvas.addEventListener("pointerdown", (event) => {
      down = event.isPrimary && event.button === button ? event : null;
    });
    this.canvas.addEventListener("pointerup", (event) => {
      if (down && Math.hypot(event.clientX - down.clientX, event.clientY - down.clientY) < STILL) click(event);
      down = null;
    });
  }

  /** Sets the program's camera. */
  setCamera(camera: CameraMessage): void {
    this.isPlaced = true;
    this.viewpoint.set(camera);
    this.redraw();
  }

  /** Views the whole scene from a direction; the camera glides there. */
  lookAlong(direction: THREE.Vector3): void {
    this.viewpoint.lookAlong(direction, this.corners());
    this.redraw();
  }

  private visible(): (THREE.Mesh | THREE.Points)[] {
    this.frames.updateMatrixWorld();
    const objects: (THREE.Mesh | THREE.Points)[] = [];
    this.frames.traverse((object) => {
      if ((object instanceof THREE.Mesh || object instanceof THREE.Points) && isSeen(object)) objects.push(object);
    });
    return objects;
  }

  /** Returns the corners of boxes around everything visible, or of a cube of 2 m in an empty scene. */
  private corners(): THREE.Vector3[] {
    const corners = cornersOf(this.visible());
    return corners.length > 0 ? corners : [new THREE.Vector3(-1, -1, 0), new THREE.Vector3(1, 1, 1)];
  }

  /** Returns a box around everything visible. */
  bounds(): THREE.Box3 {
    return new THREE.Box3().setFromPoints(this.corners());
  }

  /** Marks the camera as set: new frames do not move it. */
  keepCamera(): void {
    this.isPlaced = true;
  }

  /** Call when frames have been added or removed: adapts camera and shadows to the whole scene. Until the program or a
   * user has set the camera, it views the whole scene from the side that shows most of it. */
  fitScene(): void {
    const corners = this.corners();
    new THREE.Box3().setFromPoints(corners).getBoundingSphere(this.ball);
    this.lights.fitShadows(this.ball.center, this.ball.radius);
    if (!this.isPlaced) {
      const seen = this.visible();
      const meshes = seen.filter((object) => object instanceof THREE.Mesh && !(object instanceof WideLines));
      this.viewpoint.start(firstDirection(meshes as THREE.Mesh[]), corners);
      if (seen.length > 0) this.moves.forEach((move) => move()); // else the program's camera may not have arrived yet
    }
    this.redraw();
  }

  /** Distance from the camera to the farthest shape, m, at most. */
  private get reach(): number {
    return this.camera.position.distanceTo(this.ball.center) + this.ball.radius;
  }

  /** Adapts the range of sight, fog and the floor's squares to the camera and the size of the scene. */
  private fitView(): void {
    const { reach } = this;
    this.viewpoint.fitRange(reach);
    const fog = this.scene.fog as THREE.Fog;
    fog.near = Math.max(FOG_FROM, reach);
    fog.far = (FOG_TO / FOG_FROM) * fog.near;
    const square = 10 ** Math.floor(Math.log10(Math.max(this.viewpoint.distance, 1e-6)));
    if (square === this.square) return;
    this.square = square;
    this.floor.setSquare(square);
    for (const listener of this.squareListeners) listener(square);
  }

  /** Registers a listener of the floor's square size, in m. */
  onSquare(listener: (square: number) => void): void {
    this.squareListeners.push(listener);
  }

  get isOrthographic(): boolean {
    return this.viewpoint.isOrthographic;
  }

  /** Switches between a perspective picture and one in which parallel lines stay parallel. */
  setOrthographic(on: boolean): void {
    this.viewpoint.setOrthographic(on);
    this.redraw();
  }

  home(): void {
    this.viewpoint.home();
    this.redraw();
  }

  /** Draws immediately, in full resolution. */
  drawFully(): void {
    this.quality.setFull();
    this.redraw();
    this.draw();
  }

  /** Draws all pictures in full resolution, as for a video; or resumes the usual choice. */
  holdResolution(on: boolean): void {
    this.quality.hold(on);
    this.redraw();
    this.draw();
  }

  /** Draws immediately, like a slow machine during a motion. */
  drawHurriedly(): void {
    this.quality.setLeast();
    this.redraw();
    this.draw();
  }

  /** Call after any change except of the camera. */
  redraw(): void {
    this.dirty = this.shadowsAreOld = true;
  }

  /** Returns whether the screen is up to date. */
  get idle(): boolean {
    return !this.dirty && this.quality.isFull && !this.viewpoint.glides;
  }

  /** Returns the visible point at a place of the canvas. */
  pick(event: MouseEvent): Hit | null {
    const at = new THREE.Vector2(
      (2 * event.offsetX) / this.canvas.clientWidth - 1,
      1 - (2 * event.offsetY) / this.canvas.clientHeight,
    );
    const ray = new THREE.Raycaster();
    ray.layers.enableAll();
    ray.setFromCamera(at, this.camera);
    const hit = ray
      .intersectObject(this.frames, true)
      .find(({ object, point }) => object instanceof THREE.Mesh && isSeen(object) && !(this.cut && this.cut.distanceToPoint(point) < 0));
    for (let object = hit?.object ?? null; object; object = object.parent) {
      if (typeof object.userData.id === "number")
        return {
          id: object.userData.id,
          point: hit!.point,
          normal: hit!.face!.normal.clone().transformDirection(hit!.object.matrixWorld),
        };
    }
    return null;
  }

  /** Sets the appearance. Colors are rgb in 0..1; [] is the page's default, and a floor of length 1 is none. */
  setAppearance(appearance: AppearanceMessage): void {
    const { background, floor } = appearance;
    this.ground = background.length === 3 ? colorOf(background) : null;
    this.floor.setColor(floor.length === 3 ? colorOf(floor) : null);
    this.floor.group.visible = floor.length === 0 || floor.length === 3;
    this.lights.setAppearance(appearance.lights, appearance.flat !== 0, appearance.shadows !== 0);
    this.renderer.toneMapping = appearance.flat !== 0 ? THREE.NoToneMapping : THREE.CustomToneMapping;
    this.paper();
  }

  private paper(): void {
    const color = this.ground ?? getComputedStyle(document.documentElement).getPropertyValue("--paper").trim();
    this.scene.background = new THREE.Color(color);
    document.body.style.background = this.ground ? `#${this.ground.getHexString(THREE.SRGBColorSpace)}` : "";
    this.floor.setPaper(this.scene.background);
    this.scene.fog = new THREE.Fog(color, FOG_FROM, FOG_TO);
    this.redraw();
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    this.renderer.setSize(width, height, false);
    this.labels.setSize(width, height);
    this.viewpoint.fit(width / Math.max(height, 1));
    if (!this.isPlaced) this.fitScene();
    this.redraw();
  }

  /** Updates shadows in every picture, except on slow machines during motions. */
  private updateShadows(): void {
    if (!this.shadowsAreOld || (!this.quality.isFull && ++this.picture % SHADOW_PERIOD !== 0)) return;
    this.renderer.shadowMap.needsUpdate = true;
    this.shadowsAreOld = false;
  }

  /** Drawn pixels per pixel of the page and direction. */
  get resolution(): number {
    return this.quality.ratio;
  }

  /** True while the scene moves on a slow machine: pictures may be coarse. */
  get hurries(): boolean {
    return this.quality.hurries;
  }

  /** Returns the pixels per meter at a place. */
  pixelsPerMeter(at: THREE.Vector3): number {
    return this.viewpoint.pixelsPerMeter(at, this.canvas.clientHeight * this.renderer.getPixelRatio());
  }

  /** A double click, or a click with the right button, makes the hit point the center of rotation. */
  private focus(event: MouseEvent): void {
    const hit = this.pick(event);
    if (!hit) return;
    this.viewpoint.focus(hit.point);
    this.redraw();
  }

  /** Draws if anything has changed. */
  draw(): void {
    if (!this.dirty) return;
    this.dirty = false;
    if (this.renderer.getPixelRatio() !== this.quality.ratio) this.renderer.setPixelRatio(this.quality.ratio);
    for (const prepare of this.preparations) prepare();
    this.fitView();
    this.floor.follow(this.camera.position, this.quality.share, this.reach, this.camera.far);
    if (this.lights.setCoarse(this.hurries)) this.renderer.shadowMap.needsUpdate = true;
    else this.updateShadows();
    this.renderer.render(this.scene, this.camera);
    this.labels.render(this.scene, this.camera);
  }
}
