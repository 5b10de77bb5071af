import * as THREE from "three";
import type { Stage } from "./stage";

const COLOR = 0xd6336c;
const SHAFT = 4,
  HEAD = 12,
  HEAD_LENGTH = 15,
  DOT = 7,
  RIM = 1.5; // pixels: widths, head lengths, and the white rim
const LONGEST = 0.11; // length of the longest arrow, as a share of the camera's distance
const SHORTEST = 0.1; // lower bound of the longest arrow's length, as a share of the upper one
const UP = new THREE.Vector3(0, 1, 0);

/** An arrow: start, direction, length, length of the head, and thickness relative to the usual one. */
interface Arrow {
  from: THREE.Vector3;
  direction: THREE.Vector3; // unit
  length: number; // m
  head: number; // m
  part: number;
  pixel: number; // size of a pixel there, m
}

/** Shafts, heads and dots of one color, for arrows with a rim of that width. */
class Arrows {
  readonly group = new THREE.Group();
  private readonly material: THREE.MeshBasicMaterial;
  private shafts = this.instances(new THREE.CylinderGeometry(0.5, 0.5, 1, 8).translate(0, 0.5, 0), 64);
  private heads = this.instances(new THREE.ConeGeometry(0.5, 1, 12).translate(0, 0.5, 0), 64);
  private dots = this.instances(new THREE.SphereGeometry(0.5, 10, 8), 64);

  constructor(
    color: number,
    private readonly rim: number,
    private readonly order: number,
  ) {
    this.material = new THREE.MeshBasicMaterial({ color, depthTest: false, transparent: true });
    for (const mesh of this.all) Object.assign(mesh, { material: this.material, renderOrder: order });
  }

  show(arrows: readonly Arrow[]): void {
    this.reserve(arrows.length);
    const rotation = new THREE.Quaternion(),
      matrix = new THREE.Matrix4(),
      size = new THREE.Vector3();
    const { rim } = this;
    arrows.forEach(({ from, direction, length, head, part, pixel }, i) => {
      rotation.setFromUnitVectors(UP, direction);
      const width = (SHAFT * part + 2 * rim) * pixel;
      this.shafts.setMatrixAt(i, matrix.compose(from, rotation, size.set(width, length - head, width)));
      const base = from.clone().addScaledVector(direction, length - head - rim * pixel);
      const across = (HEAD * part + 3.5 * rim) * pixel;
      this.heads.setMatrixAt(i, matrix.compose(base, rotation, size.set(across, head + 4 * rim * pixel, across)));
      const dot = (DOT + 2 * rim) * pixel;
      this.dots.setMatrixAt(i, matrix.compose(from, rotation, size.set(dot, dot, dot)));
    });
    for (const mesh of this.all) {
      mesh.count = arrows.length;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  private get all(): THREE.InstancedMesh[] {
    return [this.shafts, this.heads, this.dots];
  }

  private instances(geometry: THREE.BufferGeometry, most: number): THREE.InstancedMesh {
    const mesh = new THREE.InstancedMesh(geometry, this.material, most);
    Object.assign(mesh, { frustumCulled: false, count: 0, renderOrder: this.order });
    this.group.add(mesh);
    return mesh;
  }

  /** Reserves space for this many arrows. */
  private reserve(count: number): void {
    if (count <= this.dots.instanceMatrix.count) return;
    const renew = (old: THREE.InstancedMesh): THREE.InstancedMesh => {
      this.group.remove(old);
      old.dispose();
      return this.instances(old.geometry, 2 * count);
    };
    this.shafts = renew(this.shafts);
    this.heads = renew(this.heads);
    this.dots = renew(this.dots);
  }
}

/**
 * Forces as arrows that start at their points of action, marked by dots. All arrows share one scale, which follows the
 * largest force and the camera's distance. Their thickness on the page is constant, and they have a white rim.
 */
export class ForceArrows {
  readonly group = new THREE.Group();
  private readonly layers = [new Arrows(0xffffff, RIM, 2), new Arrows(COLOR, 0, 3)];
  private contacts: readonly number[] = [];
  private metersPerNewton = 0.1;

  /** `rescaled` is called before a picture with a new scale. */
  constructor(
    private readonly stage: Stage,
    private readonly rescaled: () => void,
  ) {
    this.group.add(...this.layers.map(({ group }) => group));
    stage.onDraw(() => this.place());
  }

  get count(): number {
    return this.group.visible ? this.contacts.length / 6 : 0;
  }

  /** m on the page per N. */
  get scale(): number {
    return this.metersPerNewton;
  }

  /** Length of the scale's label: a power of ten in m, at most the longest arrow. */
  get measure(): number {
    return 10 ** Math.floor(Math.log10(this.longest));
  }

  /** `contacts`: x y z (m) and fx fy fz (N) of each. */
  show(contacts: readonly number[]): void {
    this.contacts = contacts;
    this.place();
  }

  private get longest(): number {
    return LONGEST * Math.max(this.stage.viewpoint.distance, 1e-6);
  }

  private place(): void {
    const forces = Array.from({ length: this.contacts.length / 6 }, (_, i) => new THREE.Vector3().fromArray(this.contacts, 6 * i + 3));
    this.rescale(Math.max(0, ...forces.map((force) => force.length())));
    const arrows = forces.map((force, i): Arrow => {
      const from = new THREE.Vector3().fromArray(this.contacts, 6 * i);
      const pixel = this.stage.resolution / this.stage.pixelsPerMeter(from);
      const length = Math.max(this.metersPerNewton * force.length(), 1e-9),
        head = Math.min(HEAD_LENGTH * pixel, 0.6 * length);
      return { from, direction: force.normalize(), length, head, part: head / (HEAD_LENGTH * pixel), pixel };
    });
    for (const layer of this.layers) layer.show(arrows);
  }

  /** Sets a new scale, 1, 2 or 5 times a power of ten, if the longest arrow is too long or all arrows are tiny. */
  private rescale(largest: number): void {
    const length = largest * this.metersPerNewton;
    if (largest === 0 || (length <= this.longest && length >= SHORTEST * this.longest)) return;
    const most = this.longest / largest,
      ten = 10 ** Math.floor(Math.log10(most));
    this.metersPerNewton = [5, 2, 1].map((times) => times * ten).find((scale) => scale <= most) ?? ten;
    this.rescaled();
  }
}
