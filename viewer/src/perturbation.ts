import * as THREE from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import { label } from "./labels";
import { perturbCommand } from "./messages";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

const WIDTH = 4; // pixels

/** Perturbs bodies of a simulation by dragging: a spring moves the clicked point to the pointer, in the plane that
 * faces the camera. */
export class PerturbationTool {
  on = false;
  structure = 0; // number of the scene
  private grip: { id: number; point: THREE.Vector3; plane: THREE.Plane } | null = null;
  private readonly line = new THREE.Mesh(
    new THREE.CylinderGeometry(0.5, 0.5, 1, 8).translate(0, 0.5, 0),
    new THREE.MeshBasicMaterial({ color: 0x1971c2, depthTest: false, transparent: true }),
  );
  private readonly force: CSS2DObject = label("", 2, "name force");

  constructor(
    private readonly stage: Stage,
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly send: (command: Uint8Array<ArrayBuffer>) => void,
  ) {
    this.line.frustumCulled = false;
    this.line.renderOrder = 2;
    this.line.visible = this.force.visible = false;
    stage.scene.add(this.line, this.force);
    stage.onDraw(() => {
      const { scale, position } = this.line;
      scale.x = scale.z = (WIDTH * stage.resolution) / stage.pixelsPerMeter(position);
    });
    const { canvas } = stage;
    canvas.addEventListener("pointerdown", (event) => this.take(event), { capture: true });
    canvas.addEventListener("pointermove", (event) => this.drag(event), { capture: true });
    for (const kind of ["pointerup", "pointercancel"] as const)
      canvas.addEventListener(kind, (event) => this.letGo(event), { capture: true });
  }

  /** Shows the program's spring: from, to, and its force (N); or nothing. */
  show(spring: readonly number[]): void {
    const shown = spring.length === 7;
    this.line.visible = this.force.visible = shown;
    if (!shown) return;
    const direction = new THREE.Vector3().fromArray(spring, 3).sub(this.line.position.fromArray(spring));
    this.line.scale.y = Math.max(direction.length(), 1e-6);
    this.line.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction.normalize());
    this.force.position.fromArray(spring, 3);
    const newton = spring[6]!;
    this.force.element.textContent = `${newton.toPrecision(newton < 100 ? 2 : 3)} N`;
  }

  get isHolding(): boolean {
    return this.grip !== null;
  }

  private take(event: PointerEvent): void {
    if (!this.on || this.grip || event.button !== 0 || !event.isPrimary || event.ctrlKey || event.shiftKey) return;
    const hit = this.stage.pick(event);
    const anchor = hit && this.frames.get(hit.id)?.anchor;
    if (!hit || !anchor) return;
    event.stopImmediatePropagation();
    this.stage.canvas.setPointerCapture(event.pointerId);
    const normal = this.stage.camera.getWorldDirection(new THREE.Vector3());
    this.grip = {
      id: hit.id,
      point: anchor.worldToLocal(hit.point.clone()),
      plane: new THREE.Plane().setFromNormalAndCoplanarPoint(normal, hit.point),
    };
    this.report(hit.point);
  }

  private drag(event: PointerEvent): void {
    if (!this.grip) return;
    event.stopImmediatePropagation();
    const { clientWidth: width, clientHeight: height } = this.stage.canvas;
    const ray = new THREE.Raycaster();
    ray.setFromCamera(new THREE.Vector2((2 * event.offsetX) / width - 1, 1 - (2 * event.offsetY) / height), this.stage.camera);
    const target = ray.ray.intersectPlane(this.grip.plane, new THREE.Vector3());
    if (target) this.report(target);
  }

  private letGo(event: PointerEvent): void {
    if (!this.grip) return;
    event.stopImmediatePropagation();
    this.grip = null;
    this.send(perturbCommand(this.structure, -1, [], []));
  }

  private report(target: THREE.Vector3): void {
    const { id, point } = this.grip!;
    this.send(perturbCommand(this.structure, id, point.toArray(), target.toArray()));
  }
}
