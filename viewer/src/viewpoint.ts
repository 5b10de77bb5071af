import * as THREE from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import type { CameraMessage } from "./messages";

export type Camera = THREE.PerspectiveCamera | THREE.OrthographicCamera;

const OWN_FOCAL = Math.sqrt(3); // in heights of the picture, as of pictures that the program draws
const NEAR = 0.01,
  FAR = 200; // m, for usual scenes
const NEAR_OF_REACH = 0.002,
  NEAR_OF_DISTANCE = 0.02,
  FAR_OF_REACH = 4; // for large scenes and close views
const DISTANCE = 1.5; // m: default distance of the center of rotation
const MARGIN = 1.1; // visible size over the size of the scene
const SMALLEST = 1e-4; // m, size of a scene

/** Converts between the camera's axes (x right, y down, z forward) and those of three.js (x right, y up, z backward).
 * */
const FLIP = new THREE.Quaternion(1, 0, 0, 0);

const fromWxyz = ([w = 1, x = 0, y = 0, z = 0]: number[]): THREE.Quaternion =>
  new THREE.Quaternion(x, y, z, w).normalize();

const GLIDE = 0.3, // s
  LONGEST_STEP = 0.1; // s, on slow machines

/** A center of rotation, and the camera's place relative to it. */
interface Placement {
  away: THREE.Vector3;
  target: THREE.Vector3;
}

/** The camera, perspective or orthographic, upright or rolled, and its control by users. */
export class Viewpoint {
  readonly controls: OrbitControls;
  private readonly perspective = new THREE.PerspectiveCamera(40, 1, NEAR, FAR);
  private readonly orthographic = new THREE.OrthographicCamera(-1, 1, 1, -1, NEAR, FAR);
  private roll = 0; // rad, about the line of sight
  private focal = OWN_FOCAL;
  private height = 0; // height of an orthographic picture, m; 0: perspective
  private aspect = 0; // width over height of the picture that must fit; 0: none
  private pageAspect = 1;
  private wideness = 0; // aspect of the page when the camera was set: what was seen stays in the picture
  private reach = 0; // m
  private first: CameraMessage | null = null;
  private glideEnd: { from: Placement; to: Placement; part: number } | null = null;
  private given = { near: 0, far: 0 }; // range set by the program, m; 0: none
  private readonly listeners: ((camera: Camera) => void)[] = [];

  /** `changed`: the picture differs. `moved`: a user has moved the camera. */
  constructor(
    canvas: HTMLCanvasElement,
    changed: () => void,
    private readonly moved: () => void,
  ) {
    for (const camera of [this.perspective, this.orthographic]) camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.perspective, canvas);
    this.controls.zoomToCursor = true;
    const update = this.controls.update.bind(this.controls);
    this.controls.update = (passed) => {
      const different = update(passed); // computed with the upright camera
      this.camera.rotateZ(this.roll);
      return different;
    };
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => (this.glideEnd = null));
    this.controls.addEventListener("end", moved);
  }

  get camera(): Camera {
    return this.controls.object as Camera;
  }

  get target(): THREE.Vector3 {
    return this.controls.target;
  }

  /** Registers a listener of camera replacements. */
  onCamera(listener: (camera: Camera) => void): void {
    this.listeners.push(listener);
  }

  /** Sets the program's camera; `home` returns to it. */
  set(given: CameraMessage): void {
    const { pose, distance, focal, ortho, aspect, near, far } = given;
    this.glideEnd = null;
    this.first = given;
    if (focal > 0) this.focal = focal;
    this.height = ortho;
    this.aspect = aspect;
    this.wideness = this.pageAspect;
    this.use(ortho > 0 ? this.orthographic : this.perspective);
    this.orthographic.zoom = 1;
    const rotation = fromWxyz(pose.slice(3)).multiply(FLIP);
    this.camera.position.fromArray(pose);
    this.target
      .set(0, 0, -(distance > 0 ? distance : DISTANCE))
      .applyQuaternion(rotation)
      .add(this.camera.position);
    this.rollTo(rotation);
    this.setRange(near, far);
    this.fit(this.pageAspect);
  }

  get isOrthographic(): boolean {
    return this.height > 0;
  }

  /** Changes the kind of picture; things at the target keep their size. */
  setOrthographic(on: boolean): void {
    if (on === this.isOrthographic) return;
    this.glideEnd = null;
    const { position, quaternion } = this.camera, away = position.clone().sub(this.target);
    const seen = on ? 2 * this.halfHeight() * away.length() : (this.height / this.orthographic.zoom) * this.spread();
    this.height = on ? seen / this.spread() : 0;
    this.orthographic.zoom = 1;
    const next = on ? this.orthographic : this.perspective;
    if (!on) away.setLength(seen / (2 * this.halfHeight()));
    next.position.copy(this.target).add(away);
    next.quaternion.copy(quaternion);
    this.use(next);
    this.fit(this.pageAspect);
    this.controls.update();
    this.moved();
  }

  /** Rotates about the target in the camera's own axes, without an upright direction. */
  rotateFreely(rotation: THREE.Quaternion): void {
    const { position, quaternion } = this.camera;
    const distance = position.distanceTo(this.target),
      turned = quaternion.clone().multiply(rotation);
    position.set(0, 0, distance).applyQuaternion(turned).add(this.target);
    this.rollTo(turned);
  }

  /** Changes the focal length while objects at the target keep their size. Not for orthographic pictures. */
  widen(factor: number): void {
    if (this.height > 0) return;
    this.focal *= factor;
    this.camera.position.sub(this.target).multiplyScalar(factor).add(this.target);
    this.fit(this.pageAspect);
    this.controls.update();
    this.moved();
  }

  /** Reports that a user has moved the camera. */
  notify(): void {
    this.moved();
  }

  /** Rolls the camera, which is already directed to the target, about the line of sight to that rotation. */
  private rollTo(rotation: THREE.Quaternion): void {
    this.roll = 0;
    this.controls.update();
    const relative = this.camera.quaternion.clone().invert().multiply(rotation);
    this.roll = 2 * Math.atan2(relative.z, relative.w);
    this.controls.update();
  }

  /** Sets the visible range, m along the line of sight; 0: the whole scene. */
  private setRange(near: number, far: number): void {
    this.given = { near, far };
    this.fitRange(this.reach);
  }

  /** Adapts the range to the farthest visible point, m. Call before a picture. */
  fitRange(reach: number): void {
    this.reach = reach;
    const distance = this.camera.position.distanceTo(this.target);
    const near = this.given.near || Math.min(Math.max(NEAR, NEAR_OF_REACH * reach), NEAR_OF_DISTANCE * distance);
    const far = this.given.far || Math.max(FAR, FAR_OF_REACH * reach);
    if (this.camera.near === near && this.camera.far === far) return;
    for (const camera of [this.perspective, this.orthographic]) Object.assign(camera, { near, far });
    this.camera.updateProjectionMatrix();
  }

  /** Sets an upright camera at a position. */
  lookFrom(position: THREE.Vector3, target: THREE.Vector3): void {
    this.roll = 0;
    this.camera.position.copy(position);
    this.target.copy(target);
    this.controls.update();
  }

  /** Distance from the camera to the center of rotation, m. */
  get distance(): number {
    return this.camera.position.distanceTo(this.target);
  }

  /** Sets the view of `home`: from a direction, with all points in the picture. */
  start(direction: THREE.Vector3, points: THREE.Vector3[]): void {
    this.aim(direction, points);
    const { pose, distance } = this.describe();
    if (this.first) this.first = { ...this.first, pose, distance };
  }

  /** Moves a user's view to a direction, with all points in the picture: it glides there, unless the user's system
   * asks for less motion. */
  lookAlong(direction: THREE.Vector3, points: THREE.Vector3[]): void {
    const from = { away: this.camera.position.clone().sub(this.target), target: this.target.clone() };
    this.aim(direction, points);
    const to = { away: this.camera.position.clone().sub(this.target), target: this.target.clone() };
    this.glideEnd = null;
    if (matchMedia("(prefers-reduced-motion: reduce)").matches) return this.moved();
    this.glideEnd = { from, to, part: 0 };
    this.place(from);
  }

  /** Call before each picture; `seconds` have passed since the last. Users end the motion by any of their own. */
  glide(seconds: number): void {
    const gliding = this.glideEnd;
    if (!gliding) return;
    gliding.part = Math.min(1, gliding.part + Math.min(seconds, LONGEST_STEP) / GLIDE);
    const part = gliding.part * gliding.part * (3 - 2 * gliding.part);
    const { from, to } = gliding;
    const turn = new THREE.Quaternion().setFromUnitVectors(from.away.clone().normalize(), to.away.clone().normalize());
    const length = from.away.length() ** (1 - part) * to.away.length() ** part;
    const away = from.away.clone().applyQuaternion(new THREE.Quaternion().slerp(turn, part)).setLength(length);
    const target = from.target.clone().lerp(to.target, part);
    this.place(gliding.part < 1 ? { away, target } : to);
    if (gliding.part < 1) return;
    this.glideEnd = null;
    this.moved();
  }

  get glides(): boolean {
    return this.glideEnd !== null;
  }

  private place({ away, target }: Placement): void {
    this.camera.position.copy(target).add(away);
    this.target.copy(target);
    this.controls.update();
  }

  private aim(direction: THREE.Vector3, points: THREE.Vector3[]): void {
    this.wideness = this.pageAspect;
    this.fit(this.pageAspect);
    const back = direction.clone().normalize();
    const right = new THREE.Vector3(0, 0, 1).cross(back).normalize(), up = back.clone().cross(right);
    const axes = new THREE.Matrix4().makeBasis(right, up, back), toView = axes.clone().transpose();
    const seen = points.map((point) => point.clone().applyMatrix4(toView));
    const box = new THREE.Box3().setFromPoints(seen);
    const center = box.getCenter(new THREE.Vector3()), size = box.getSize(new THREE.Vector3());
    const half = this.halfHeight(), least = MARGIN * Math.max(size.length() / 2, SMALLEST);
    let distance = least;
    for (const { x, y, z } of seen)
      distance = Math.max(
        distance,
        z - center.z + MARGIN * Math.max(Math.abs(y - center.y) / half, Math.abs(x - center.x) / (half * this.pageAspect)),
      );
    if (this.height > 0) {
      this.orthographic.zoom = this.height / (MARGIN * Math.max(size.y, size.x / this.pageAspect, SMALLEST));
      this.orthographic.updateProjectionMatrix();
    }
    this.setRange(0, 0);
    this.camera.updateProjectionMatrix();
    center.applyMatrix4(axes);
    this.lookFrom(center.clone().addScaledVector(back, distance), center);
  }

  /** Rotates about the target, by angles to the right and upwards (rad), and approaches it by a factor. */
  turn(right: number, up: number, nearer: number): void {
    this.glideEnd = null;
    const { position } = this.camera;
    const away = position.clone().sub(this.target);
    const height = THREE.MathUtils.clamp(Math.asin(away.z / away.length()) + up, -1.55, 1.55);
    const around = Math.atan2(away.y, away.x) + right,
      distance = away.length() / (this.height > 0 ? 1 : nearer);
    position.set(Math.cos(around) * Math.cos(height), Math.sin(around) * Math.cos(height), Math.sin(height));
    position.multiplyScalar(distance).add(this.target);
    this.orthographic.zoom *= nearer;
    this.orthographic.updateProjectionMatrix();
    this.controls.update();
    this.moved();
  }

  /** Turns to a point, and makes it the center of rotation. */
  focus(point: THREE.Vector3): void {
    this.glideEnd = null;
    this.target.copy(point);
    this.controls.update();
    this.moved();
  }

  home(): void {
    if (this.first) this.set(this.first);
    this.moved();
  }

  /** Call when the page's aspect ratio (width over height) has changed. */
  fit(pageAspect: number): void {
    this.pageAspect = pageAspect;
    this.perspective.fov = THREE.MathUtils.radToDeg(2 * Math.atan(this.halfHeight()));
    this.perspective.aspect = pageAspect;
    const half = 0.5 * (this.height || 1) * this.spread();
    Object.assign(this.orthographic, { left: -half * pageAspect, right: half * pageAspect, top: half, bottom: -half });
    this.camera.updateProjectionMatrix();
  }

  /** Returns the pixels per meter at a place, for a page of `height` pixels. */
  pixelsPerMeter(at: THREE.Vector3, height: number): number {
    if (this.height > 0) return (height * this.orthographic.zoom) / (this.orthographic.top - this.orthographic.bottom);
    return height / (2 * this.halfHeight() * Math.max(this.camera.position.distanceTo(at), 1e-3));
  }

  /** Returns the camera's description for the program. */
  describe(): { pose: number[]; distance: number; focal: number; ortho: number } {
    const { x, y, z, w } = this.camera.quaternion.clone().multiply(FLIP);
    return {
      pose: [...this.camera.position.toArray(), w, x, y, z],
      distance: this.camera.position.distanceTo(this.target),
      focal: this.focal,
      ortho: this.height / this.orthographic.zoom,
    };
  }

  /** Half the visible height at a distance of one meter, m. */
  private halfHeight(): number {
    return (0.5 / this.focal) * this.spread();
  }

  /** Returns the factor by which the visible height grows until the picture's width fits. */
  private spread(): number {
    return Math.max(1, (this.aspect || this.wideness) / this.pageAspect);
  }

  private use(camera: Camera): void {
    if (this.camera === camera) return;
    this.controls.object = camera;
    for (const listener of this.listeners) listener(camera);
  }
}
