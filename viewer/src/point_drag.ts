import * as THREE from "three";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

interface Grip {
  id: number;
  point: THREE.Vector3; // in the frame
  plane: THREE.Plane;
}

/** Who is told of a dragged point of a frame. */
export interface DragListener {
  /** Returns whether the pointer takes the frame. */
  takes(event: PointerEvent, id: number): boolean;
  moved(id: number, point: THREE.Vector3, target: THREE.Vector3): void;
  ended(): void;
}

/** Lets the pointer take a point of a shape, and move it in the plane that faces the camera. */
export class PointDrag {
  private grip: Grip | null = null;

  constructor(
    private readonly stage: Stage,
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly listener: DragListener,
  ) {
    const { canvas } = stage;
    canvas.addEventListener("pointerdown", (event) => this.take(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.drag(event), { capture: true });
    for (const kind of ["pointerup", "pointercancel"] as const)
      canvas.addEventListener(kind, (event) => this.letGo(event), { capture: true });
  }

  get isHolding(): boolean {
    return this.grip !== null;
  }

  private take(event: PointerEvent): void {
    if (this.grip || event.button !== 0 || !event.isPrimary || event.shiftKey) return;
    const hit = this.stage.pick(event);
    const anchor = hit && this.frames.get(hit.id)?.anchor;
    if (!hit || !anchor || !this.listener.takes(event, hit.id)) return;
    event.stopImmediatePropagation();
    this.stage.canvas.setPointerCapture(event.pointerId);
    const normal = this.stage.camera.getWorldDirection(new THREE.Vector3());
    this.grip = {
      id: hit.id,
      point: anchor.worldToLocal(hit.point.clone()),
      plane: new THREE.Plane().setFromNormalAndCoplanarPoint(normal, hit.point),
    };
    this.listener.moved(this.grip.id, this.grip.point, hit.point);
  }

  private drag(event: PointerEvent): void {
    if (!this.grip) return;
    event.stopImmediatePropagation();
    const { clientWidth: width, clientHeight: height } = this.stage.canvas;
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * event.offsetX) / width - 1, 1 - (2 * event.offsetY) / height), this.stage.camera);
    const target = ray.ray.intersectPlane(this.grip.plane, new THREE.Vector3());
    if (target) this.listener.moved(this.grip.id, this.grip.point, target);
  }

  private letGo(event: PointerEvent): void {
    if (!this.grip) return;
    event.stopImmediatePropagation();
    this.grip = null;
    this.listener.ended();
  }
}
