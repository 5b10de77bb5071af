import * as THREE from "three";
import { label } from "./labels";
import type { LinesMessage } from "./messages";
import type { Stage } from "./stage";

const APART = new THREE.Color(0xe8a200),
  TOUCHING = new THREE.Color(0xe03131);
const LABELS = 12; // largest number shown
const DOT = 7,
  RING = 26,
  WIDTH = 3.5; // pixels
const OVER = { depthTest: false, transparent: true } as const; // drawn over everything else

/** A red ring with a white rim. */
function ringPicture(): THREE.Texture {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 64;
  const context = canvas.getContext("2d")!;
  for (const [color, width] of [["white", 13], [`#${TOUCHING.getHexString()}`, 7]] as const) {
    Object.assign(context, { strokeStyle: color, lineWidth: width });
    context.beginPath();
    context.arc(32, 32, 24, 0, 2 * Math.PI);
    context.stroke();
  }
  return Object.assign(new THREE.CanvasTexture(canvas), { colorSpace: THREE.SRGBColorSpace });
}

/**
 * Pairs of shapes, each as a line between their surfaces with the distance. Lines are yellow if the shapes are apart.
 * They are red if the shapes overlap, from the deepest point of one to the surface of the other, with a ring that marks
 * even short lines.
 */
export class PairLines {
  readonly group = new THREE.Group();
  private readonly lines = new THREE.Group(); // one rod per line
  private readonly rod = new THREE.CylinderGeometry(0.5, 0.5, 1, 6).translate(0, 0.5, 0);
  private readonly materials = new Map([APART, TOUCHING].map((color) => [color, new THREE.MeshBasicMaterial({ ...OVER, color })]));
  private readonly ends = new THREE.Points(
    new THREE.BufferGeometry(),
    new THREE.PointsMaterial({ ...OVER, vertexColors: true, size: DOT, sizeAttenuation: false }),
  );
  private readonly rings = new THREE.Points(
    new THREE.BufferGeometry(),
    new THREE.PointsMaterial({ ...OVER, map: ringPicture(), size: RING, sizeAttenuation: false }),
  );
  private readonly labels = new THREE.Group();
  private shown: LinesMessage = { points: [], distances: [], names: [] };

  /** `named`: labels contain the names of the shapes. */
  constructor(
    private readonly stage: Stage,
    private readonly named: boolean,
  ) {
    for (const object of [this.ends, this.rings]) Object.assign(object, { frustumCulled: false, renderOrder: 1 });
    this.group.add(this.lines, this.ends, this.rings, this.labels);
    stage.scene.add(this.group);
    stage.onDraw(() => this.thin());
    this.clear();
  }

  /** The number of pairs, and the number of pairs in contact. */
  get count(): { all: number; touching: number } {
    const { distances } = this.shown;
    return this.group.visible
      ? { all: distances.length, touching: distances.filter((distance) => distance <= 0).length }
      : { all: 0, touching: 0 };
  }

  set visible(on: boolean) {
    this.group.visible = on;
    for (const label of this.labels.children) label.visible = on; // labels are separate HTML elements
  }

  clear(): void {
    this.show({ points: [], distances: [], names: [] });
  }

  show(lines: LinesMessage): void {
    if (lines === this.shown) return;
    this.shown = lines;
    const { points, distances, names } = lines;
    const colors = distances.flatMap((distance) => {
      const color = (distance > 0 ? APART : TOUCHING).toArray();
      return [...color, ...color];
    });
    this.lines.clear();
    this.lines.add(...distances.map((distance, i) => this.line(i, distance > 0 ? APART : TOUCHING)));
    this.ends.geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.ends.geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
    const touching = distances.flatMap((distance, i) => (distance <= 0 ? this.middle(i).toArray() : []));
    this.rings.geometry.setAttribute("position", new THREE.Float32BufferAttribute(touching, 3));
    this.labels.clear();
    const nearest = names.map((_, i) => i).sort((i, j) => distances[i]! - distances[j]!);
    for (const i of nearest.slice(0, LABELS)) this.addLabel(i);
  }

  private line(i: number, color: THREE.Color): THREE.Mesh {
    const line = new THREE.Mesh(this.rod, this.materials.get(color));
    const direction = new THREE.Vector3().fromArray(this.shown.points, 6 * i + 3).sub(line.position.fromArray(this.shown.points, 6 * i));
    line.scale.y = Math.max(direction.length(), 1e-9);
    line.quaternion.setFromUnitVectors(new THREE.Vector3(0, 1, 0), direction.normalize());
    line.renderOrder = 1;
    return line;
  }

  /** Keeps the width of lines on the page constant. */
  private thin(): void {
    for (const { scale, position } of this.lines.children) scale.x = scale.z = (WIDTH * this.stage.resolution) / this.stage.pixelsPerMeter(position);
  }

  private middle(i: number): THREE.Vector3 {
    const { points } = this.shown;
    return new THREE.Vector3().fromArray(points, 6 * i).lerp(new THREE.Vector3().fromArray(points, 6 * i + 3), 0.5);
  }

  private addLabel(i: number): void {
    const distance = this.shown.distances[i]!;
    const text = `${(1000 * distance).toFixed(1)} mm`;
    const object = label(
      this.named ? `${this.shown.names[i]}: ${text}` : text,
      1 - distance,
      distance <= 0 ? "name distance touching" : "name distance",
    );
    object.center.set(0.5, distance <= 0 ? -0.9 : 0.5); // below the ring
    object.position.copy(this.middle(i));
    object.visible = this.group.visible;
    this.labels.add(object);
  }
}
