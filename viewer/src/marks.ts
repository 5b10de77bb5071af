import * as THREE from "three";
import type { Shown } from "./shown";

const COLOR = 0xe03131;

/** Tints the frames of violated constraints red. */
export class Marks {
  private tinted: THREE.MeshStandardMaterial[] = [];
  private marked: readonly number[] = [];

  constructor(private readonly frames: ReadonlyMap<number, Shown>) {}

  get count(): number {
    return this.tinted.length;
  }

  /** Marks exactly these frames. */
  show(ids: readonly number[]): void {
    if (ids.length === this.marked.length && ids.every((id, i) => id === this.marked[i])) return;
    this.marked = ids;
    for (const material of this.tinted) material.emissive.setHex(0);
    this.tinted = [];
    for (const id of new Set(ids.map((id) => this.visible(id)))) {
      const object = this.frames.get(id)?.object;
      if (!(object instanceof THREE.Mesh) || !(object.material instanceof THREE.MeshStandardMaterial)) continue;
      object.material.emissive.setHex(COLOR);
      object.material.emissiveIntensity = 0.55;
      this.tinted.push(object.material);
    }
  }

  /** Returns the nearest frame with a shape, from this one upwards. */
  private visible(id: number): number {
    for (let at: Shown | undefined = this.frames.get(id); at; at = this.frames.get(at.message.parent)) {
      if (at.object instanceof THREE.Mesh) return at.message.id;
    }
    return id;
  }
}
