import * as THREE from "three";
import type { CSS2DObject } from "three/addons/renderers/CSS2DRenderer.js";
import { label } from "./labels";
import { nearCommand, type NearMessage } from "./messages";
import type { Stage } from "./stage";

export const MARGIN = 0.05; // m
const APART = new THREE.Color(0xe8a200),
  TOUCHING = new THREE.Color(0xe03131);
const LABELS = 12; // most that are shown

/** Lines between shapes that are near each other, yellow, or red where they touch, with the distance. */
export class NearLines {
  private on = false;
  private structure = 0;
  private readonly lines = new THREE.LineSegments(
    new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ vertexColors: true, depthTest: false, transparent: true }),
  );
  private readonly ends = new THREE.Points(
    this.lines.geometry,
    new THREE.PointsMaterial({
      vertexColors: true,
      size: 5,
      sizeAttenuation: false,
      depthTest: false,
      transparent: true,
    }),
  );
  private readonly group = new THREE.Group();
  private readonly labels = new THREE.Group();

  constructor(
    private readonly stage: Stage,
    private readonly send: (command: Uint8Array<ArrayBuffer>) => void,
  ) {
    this.lines.frustumCulled = this.ends.frustumCulled = false;
    this.group.add(this.lines, this.ends, this.labels);
    this.group.visible = false;
    this.group.renderOrder = 1;
    stage.scene.add(this.group);
  }

  get count(): number {
    return this.group.visible ? this.lines.geometry.drawRange.count / 2 : 0;
  }

  /** Call with every structure of the scene: it is asked for anew. */
  setStructure(structure: number): void {
    this.structure = structure;
    this.ask();
  }

  show(on: boolean): void {
    if (this.on === on) return;
    this.on = on;
    this.ask();
    this.apply(true);
  }

  /** `live`: false while a motion is shown, which the lines say nothing of. */
  apply(live: boolean): void {
    this.group.visible = this.on && live;
    for (const label of this.labels.children) label.visible = this.group.visible;
    this.stage.redraw();
  }

  read({ points, distances, names }: NearMessage): void {
    const { geometry } = this.lines;
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    geometry.setAttribute(
      "color",
      new THREE.Float32BufferAttribute(
        distances.flatMap((d) => {
          const color = (d > 0 ? APART : TOUCHING).toArray();
          return [...color, ...color];
        }),
        3,
      ),
    );
    geometry.setDrawRange(0, 2 * distances.length);
    this.labels.clear();
    const nearest = distances
      .map((_, i) => i)
      .sort((i, j) => distances[i]! - distances[j]!)
      .slice(0, LABELS);
    for (const i of nearest) this.labels.add(this.label(names[i]!, distances[i]!, points.slice(6 * i, 6 * i + 6)));
    this.stage.redraw();
  }

  private ask(): void {
    if (this.on) this.send(nearCommand(this.structure, MARGIN));
  }

  private label(name: string, distance: number, ends: number[]): CSS2DObject {
    const object = label(`${(1000 * distance).toFixed(1)} mm`, 1 - distance, distance <= 0 ? "name distance touching" : "name distance");
    object.element.title = name;
    object.position.set((ends[0]! + ends[3]!) / 2, (ends[1]! + ends[4]!) / 2, (ends[2]! + ends[5]!) / 2);
    object.visible = this.group.visible;
    return object;
  }
}
