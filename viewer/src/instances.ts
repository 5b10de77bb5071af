import * as THREE from "three";
import type { PrimitiveMesh } from "./primitives";

const FEWEST = 4; // fewest shapes of one geometry for which it pays off
const HIDDEN = 1; // a layer that rays see, but no camera

const isPlain = ({ material, parent, visible }: PrimitiveMesh): boolean =>
  visible &&
  parent!.visible &&
  material instanceof THREE.MeshStandardMaterial &&
  !material.transparent &&
  !material.wireframe &&
  material.emissive.getHex() === 0;

/** Draws shapes with the same geometry by one call; everything else still sees separate objects. */
export class Instances {
  readonly group = new THREE.Group();
  private readonly sets = new Map<THREE.BufferGeometry, THREE.InstancedMesh>();
  private readonly material: THREE.MeshStandardMaterial;

  constructor(material: THREE.MeshStandardMaterial) {
    this.material = material;
  }

  /** Call before a picture. */
  update(meshes: Iterable<PrimitiveMesh>): void {
    const shared = new Map<THREE.BufferGeometry, PrimitiveMesh[]>();
    for (const mesh of meshes) {
      mesh.layers.set(0);
      if (!isPlain(mesh)) continue;
      const same = shared.get(mesh.geometry);
      if (same) same.push(mesh);
      else shared.set(mesh.geometry, [mesh]);
    }
    for (const [geometry, same] of shared) if (same.length < FEWEST) shared.delete(geometry);
    for (const [geometry, set] of this.sets) if (!shared.has(geometry)) this.drop(geometry, set);
    for (const [geometry, same] of shared) this.place(this.setFor(geometry, same.length), same);
  }

  private setFor(geometry: THREE.BufferGeometry, count: number): THREE.InstancedMesh {
    const known = this.sets.get(geometry);
    if (known && known.instanceMatrix.count >= count) return known;
    if (known) this.drop(geometry, known);
    const set = new THREE.InstancedMesh(geometry, this.material, Math.ceil(1.5 * count));
    Object.assign(set, { frustumCulled: false, castShadow: true, receiveShadow: true });
    this.sets.set(geometry, set);
    this.group.add(set);
    return set;
  }

  private place(set: THREE.InstancedMesh, meshes: PrimitiveMesh[]): void {
    set.count = meshes.length;
    meshes.forEach((mesh, i) => {
      mesh.layers.set(HIDDEN);
      mesh.parent!.updateMatrix();
      set.setMatrixAt(i, mesh.parent!.matrix);
      set.setColorAt(i, (mesh.material as THREE.MeshStandardMaterial).color);
    });
    set.instanceMatrix.needsUpdate = true;
    set.instanceColor!.needsUpdate = true;
  }

  private drop(geometry: THREE.BufferGeometry, set: THREE.InstancedMesh): void {
    this.group.remove(set);
    set.dispose();
    this.sets.delete(geometry);
  }
}
