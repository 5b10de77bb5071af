import * as THREE from "three";

const COLOR = 0xd6336c;
const SHAFT = 0.006,
  HEAD = 0.016,
  HEAD_LENGTH = 0.035; // m, on the page
const LONGEST = 0.35; // m, that an arrow shall have
const SCALES = [0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 5e-4, 2e-4, 1e-4, 1e-5, 1e-6]; // m per N

const material = (): THREE.MeshBasicMaterial => new THREE.MeshBasicMaterial({ color: COLOR, depthTest: false, transparent: true });

/** Forces as arrows that begin where they act, and dots there. All have one scale, which follows the largest force. */
export class ForceArrows {
  readonly group = new THREE.Group();
  private shafts = this.instances(new THREE.CylinderGeometry(SHAFT, SHAFT, 1, 8).translate(0, 0.5, 0), 64);
  private heads = this.instances(new THREE.ConeGeometry(HEAD, 1, 12).translate(0, 0.5, 0), 64);
  private dots = this.instances(new THREE.SphereGeometry(0.008, 10, 8), 64);
  private metersPerNewton = SCALES[0]!;

  constructor() {
    this.group.renderOrder = 2;
  }

  get count(): number {
    return this.group.visible ? this.dots.count : 0;
  }

  /** m on the page per N. */
  get scale(): number {
    return this.metersPerNewton;
  }

  /** `contacts`: x y z (m) and fx fy fz (N) of each. */
  show(contacts: readonly number[]): void {
    const count = contacts.length / 6;
    const forces = Array.from({ length: count }, (_, i) => new THREE.Vector3().fromArray(contacts, 6 * i + 3));
    this.rescale(Math.max(0, ...forces.map((force) => force.length())));
    this.reserve(count);
    const up = new THREE.Vector3(0, 1, 0),
      turn = new THREE.Quaternion(),
      matrix = new THREE.Matrix4();
    forces.forEach((force, i) => {
      const at = new THREE.Vector3().fromArray(contacts, 6 * i);
      const length = this.metersPerNewton * force.length(),
        head = Math.min(HEAD_LENGTH, 0.5 * length);
      turn.setFromUnitVectors(up, force.clone().normalize());
      const thickness = head / HEAD_LENGTH;
      this.shafts.setMatrixAt(i, matrix.compose(at, turn, new THREE.Vector3(thickness, Math.max(length - head, 1e-9), thickness)));
      const tip = at.clone().addScaledVector(force, length > 0 ? (length - head) / force.length() : 0);
      this.heads.setMatrixAt(i, matrix.compose(tip, turn, new THREE.Vector3(thickness, Math.max(head, 1e-9), thickness)));
      this.dots.setMatrixAt(i, matrix.makeTranslation(at));
    });
    for (const mesh of [this.shafts, this.heads, this.dots]) {
      mesh.count = count;
      mesh.instanceMatrix.needsUpdate = true;
    }
  }

  /** Another scale where the longest arrow would be too long, or all would be tiny; else it stays. */
  private rescale(largest: number): void {
    const length = largest * this.metersPerNewton;
    if (largest === 0 || (length <= LONGEST && length >= 0.1 * LONGEST)) return;
    this.metersPerNewton = SCALES.find((scale) => largest * scale <= LONGEST) ?? SCALES.at(-1)!;
  }

  private instances(geometry: THREE.BufferGeometry, most: number): THREE.InstancedMesh {
    const mesh = new THREE.InstancedMesh(geometry, material(), most);
    mesh.frustumCulled = false;
    mesh.count = 0;
    mesh.renderOrder = 2;
    this.group.add(mesh);
    return mesh;
  }

  /** Room for so many. */
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
