import * as THREE from "three";
import { WideLines } from "./lines";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import { isSeen } from "./display";
import { label } from "./labels";
import { warningsCommand, type WarningMessage } from "./messages";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

const CALM = 1000; // ms without a change, after which the warnings are requested
const COLOR = 0xf08c00;
const MAX_MARKS = 30; // largest number of marked frames

interface Mark {
  id: number;
  outline: THREE.LineSegments;
  label: CSS2DObject;
}

/** Warnings about the scene, requested when nothing moves any more. Ignored obstacles are marked by dashed boxes. */
export class Warnings {
  private warnings: readonly WarningMessage[] = [];
  private structure = 0;
  private on = true;
  private timer = 0;
  private marks: Mark[] = [];
  private readonly group = new THREE.Group();

  /** `send` is null on a saved page, which contains the warnings. `changed` is called with new ones. */
  constructor(
    private readonly stage: Stage,
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly send: ((command: Uint8Array<ArrayBuffer>) => void) | null,
    private readonly changed: () => void,
  ) {
    stage.scene.add(this.group);
    stage.onDraw(() => this.follow());
  }

  get all(): readonly WarningMessage[] {
    return this.warnings;
  }

  get markCount(): number {
    return this.marks.filter(({ outline }) => outline.visible).length;
  }

  /** Frames of ignored obstacles. */
  get ignored(): ReadonlySet<number> {
    return new Set(this.warnings.flatMap((warning) => (warning.ignored !== 0 ? warning.frames : [])));
  }

  /** Returns the warning about an ignored frame, or "". */
  about(id: number): string {
    return this.warnings.find((warning) => warning.ignored !== 0 && warning.frames.includes(id))?.text ?? "";
  }

  setStructure(structure: number): void {
    this.structure = structure;
    this.stir();
  }

  /** Call after every change. */
  stir(): void {
    clearTimeout(this.timer);
    if (this.send) this.timer = setTimeout(() => this.send!(warningsCommand(this.structure)), CALM);
  }

  read(warnings: readonly WarningMessage[]): void {
    this.warnings = warnings;
    this.refresh();
    this.changed();
  }

  show(on: boolean): void {
    this.on = on;
    this.refresh();
  }

  /** Call when shapes have changed. */
  refresh(): void {
    for (const { outline } of this.marks) {
      outline.geometry.dispose();
      (outline.material as THREE.Material).dispose();
    }
    this.group.clear();
    this.marks = this.on ? [...this.ignored].slice(0, MAX_MARKS).flatMap((id) => this.mark(id)) : [];
    for (const mark of this.marks) this.group.add(mark.outline, mark.label);
    this.stage.redraw();
  }

  private mark(id: number): Mark[] {
    const object = this.frames.get(id)?.object;
    if (!(object instanceof THREE.Mesh) || object instanceof WideLines) return [];
    const geometry = object.geometry as THREE.BufferGeometry;
    if (!geometry.boundingBox) geometry.computeBoundingBox();
    const size = geometry.boundingBox!.getSize(new THREE.Vector3()), center = geometry.boundingBox!.getCenter(new THREE.Vector3());
    const box = new THREE.BoxGeometry(...size.clone().multiplyScalar(1.02).toArray()).translate(...center.toArray());
    const dash = Math.max(...size.toArray()) / 30;
    const outline = new THREE.LineSegments(
      new THREE.EdgesGeometry(box),
      new THREE.LineDashedMaterial({ color: COLOR, dashSize: dash, gapSize: 0.6 * dash, depthTest: false, transparent: true }),
    );
    box.dispose();
    outline.computeLineDistances();
    outline.renderOrder = 1;
    return [{ id, outline, label: label("not an obstacle", 0.5, "name ignored") }];
  }

  /** Moves the marks to their frames, and hides them with these. */

  private follow(): void {
    for (const { id, outline, label } of this.marks) {
      const shown = this.frames.get(id);
      outline.visible = label.visible = shown?.object != null && isSeen(shown.object);
      if (!shown) continue;
      outline.position.copy(shown.anchor.position);
      outline.quaternion.copy(shown.anchor.quaternion);
      outline.updateMatrixWorld();
      const box = new THREE.Box3().setFromBufferAttribute(outline.geometry.getAttribute("position") as THREE.BufferAttribute);
      box.applyMatrix4(outline.matrixWorld);
      label.position.set((box.min.x + box.max.x) / 2, (box.min.y + box.max.y) / 2, box.max.z);
    }
  }
}
