import * as THREE from "three";
import { WideLines } from "./lines";
import type { MotionMessage } from "./messages";
import { materialsOf } from "./shapes";
import type { Shown } from "./shown";

const GHOSTS = 24; // largest number of slices drawn at once
const GHOST_OPACITY = 0.28;

/** The slices of a motion: poses of all frames and joint values. */
export class Motion {
  readonly slices: number;
  readonly dofs: number;
  private readonly frames: number;
  private readonly poses: Float32Array;
  readonly q: Float32Array;
  private readonly from = new THREE.Quaternion();
  private readonly to = new THREE.Quaternion();

  constructor(
    readonly message: MotionMessage,
    data: ArrayBuffer,
  ) {
    const view = new DataView(data);
    [this.slices, this.frames, this.dofs] = [4, 8, 12].map((at) => view.getUint32(at, true)) as [
      number,
      number,
      number,
    ];
    this.poses = new Float32Array(data, 16, 7 * this.slices * this.frames);
    this.q = new Float32Array(data, 16 + this.poses.byteLength, this.slices * this.dofs);
  }

  /** Sets an object to a frame's pose at a time, which may lie between two slices. */
  place(object: THREE.Object3D, frame: number, moment: number): void {
    if (frame >= this.frames) return;
    const slice = Math.min(Math.floor(moment), this.slices - 1);
    const part = moment - slice;
    const a = this.pose(slice, frame);
    const b = this.pose(Math.min(slice + 1, this.slices - 1), frame);
    object.position.set(a[0]! + part * (b[0]! - a[0]!), a[1]! + part * (b[1]! - a[1]!), a[2]! + part * (b[2]! - a[2]!));
    this.from.set(a[4]!, a[5]!, a[6]!, a[3]!);
    this.to.set(b[4]!, b[5]!, b[6]!, b[3]!);
    object.quaternion.slerpQuaternions(this.from, this.to, part);
  }

  /** Returns the joint values at a time. */
  state(moment: number): Float32Array {
    const slice = Math.min(Math.floor(moment), this.slices - 1);
    const next = Math.min(slice + 1, this.slices - 1);
    return Float32Array.from({ length: this.dofs }, (_, i) => {
      const a = this.q[slice * this.dofs + i]!;
      return a + (moment - slice) * (this.q[next * this.dofs + i]! - a);
    });
  }

  /** Returns the values of a dof per slice. */
  curveOf(dof: number): Float32Array {
    return Float32Array.from({ length: this.slices }, (_, t) => this.q[t * this.dofs + dof]!);
  }

  /** Returns copies of the moving shapes in slices spread over the motion. They share the frames' geometries. */
  ghosts(frames: ReadonlyMap<number, Shown>): THREE.Group {
    const group = new THREE.Group();
    const count = Math.min(this.slices, GHOSTS);
    for (const [id, { object }] of frames) {
      if (!(object instanceof THREE.Mesh) || object instanceof WideLines || !object.visible || !this.moves(id)) continue;
      const faint = materialsOf(object).map((material) =>
        Object.assign(material.clone(), { transparent: true, opacity: GHOST_OPACITY * material.opacity, depthWrite: false }));
      const material = faint.length > 1 ? faint : faint[0]!;
      for (let i = 0; i < count; ++i) {
        const ghost = new THREE.Mesh(object.geometry, material);
        this.place(ghost, id, count === 1 ? 0 : (i * (this.slices - 1)) / (count - 1));
        group.add(ghost);
      }
    }
    return group;
  }

  private moves(frame: number): boolean {
    if (frame >= this.frames) return false;
    const first = this.pose(0, frame);
    for (let t = 1; t < this.slices; ++t) {
      if (this.pose(t, frame).some((x, i) => Math.abs(x - first[i]!) > 1e-5)) return true;
    }
    return false;
  }

  private pose(slice: number, frame: number): Float32Array {
    const at = 7 * (slice * this.frames + frame);
    return this.poses.subarray(at, at + 7);
  }
}
