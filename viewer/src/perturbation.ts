import * as THREE from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import { label } from "./labels";
import { perturbCommand } from "./messages";
import { PointDrag } from "./point_drag";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

const WIDTH = 4; // pixels

/** Perturbs bodies of a simulation by dragging: a spring moves the clicked point to the pointer, in the plane that
 * faces the camera. */
export class PerturbationTool {
  on = false;
  structure = 0; // number of the scene
  private readonly drag: PointDrag;
  private readonly line = new THREE.Mesh(
    new THREE.CylinderGeometry(0.5, 0.5, 1, 8).translate(0, 0.5, 0),
    new THREE.MeshBasicMaterial({ color: 0x1971c2, depthTest: false, transparent: true }),
  );
  private readonly force: CSS2DObject = label("", 2, "name force");

  constructor(
    stage: Stage,
    frames: ReadonlyMap<number, Shown>,
    send: (command: Uint8Array<ArrayBuffer>) => void,
  ) {
    this.line.frustumCulled = false;
    this.line.renderOrder = 2;
    this.line.visible = this.force.visible = false;
    stage.scene.add(this.line, this.force);
    stage.onDraw(() => {
      const { scale, position } = this.line;
      scale.x = scale.z = (WIDTH * stage.resolution) / stage.pixelsPerMeter(position);
    });
    this.drag = new PointDrag(stage, frames, {
      takes: (event) => this.on && !event.ctrlKey,
      moved: (id, point, target) => send(perturbCommand(this.structure, id, point.toArray(), target.toArray())),
      ended: () => send(perturbCommand(this.structure, -1, [], [])),
    });
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
    return this.drag.isHolding;
  }
}
