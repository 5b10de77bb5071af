import * as THREE from "three";
import type { Viewpoint } from "./viewpoint";

const SPEED = 3; // rad per half of the canvas's shorter side
const DOLLY = 1.1; // focal length and distance, per notch of the wheel

/** With Ctrl, dragging rotates the scene freely, also upside down; outside the largest circle on the canvas it rotates
 * about the line of sight. The wheel changes the angle of view while objects at the target keep their size. */
export class FreeRotation {
  private last: THREE.Vector2 | null = null; // of the pointer from the center, in halves of the shorter side
  private rolls = false;
  private holdsControl = false; // distinguishes Ctrl from pinching, which sends the same wheel events

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly viewpoint: Viewpoint,
  ) {
    const { controls } = viewpoint;
    for (const kind of ["keydown", "keyup"] as const)
      addEventListener(kind, ({ key }) => {
        if (key === "Control") this.holdsControl = kind === "keydown";
      });
    canvas.addEventListener("pointerdown", (event) => this.begin(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => {
      if (this.last && controls.enabled) this.drag(event);
    });
    for (const kind of ["pointerup", "pointercancel"] as const)
      canvas.addEventListener(kind, () => {
        if (this.last && controls.enabled) viewpoint.notify();
        this.last = null;
      });
    canvas.addEventListener("wheel", (event) => this.dolly(event), { capture: true, passive: false });
  }

  private place(event: PointerEvent): THREE.Vector2 {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    return new THREE.Vector2(event.offsetX - width / 2, event.offsetY - height / 2).divideScalar(
      Math.min(width, height) / 2,
    );
  }

  private begin(event: PointerEvent): void {
    const isFree = event.ctrlKey && event.button === 0 && event.pointerType === "mouse";
    this.viewpoint.controls.mouseButtons.LEFT = isFree ? null : THREE.MOUSE.ROTATE;
    if (!isFree) return;
    this.last = this.place(event);
    this.rolls = this.last.length() > 1;
    this.canvas.setPointerCapture(event.pointerId);
  }

  private drag(event: PointerEvent): void {
    const now = this.place(event),
      moved = now.clone().sub(this.last!);
    const rotation = new THREE.Quaternion();
    if (this.rolls) rotation.setFromAxisAngle(new THREE.Vector3(0, 0, 1), this.last!.angleTo(now) * Math.sign(this.last!.cross(now)));
    else if (moved.length() > 0)
      rotation.setFromAxisAngle(new THREE.Vector3(-moved.y, -moved.x, 0).normalize(), SPEED * moved.length());
    this.last = now;
    this.viewpoint.rotateFreely(rotation);
  }

  private dolly(event: WheelEvent): void {
    const { controls } = this.viewpoint;
    if (!this.holdsControl || !event.ctrlKey || event.deltaY === 0 || !controls.enabled) return;
    event.preventDefault();
    event.stopImmediatePropagation();
    this.viewpoint.widen(event.deltaY < 0 ? DOLLY : 1 / DOLLY);
  }
}
