import * as THREE from "three";
import { WideLines } from "./lines";
import type { MotionMessage } from "./messages";
import { readDifferences } from "./packed";
import { materialsOf } from "./shapes";
import type { Shown } from "./shown";

const GHOSTS = 24; // largest number of slices drawn at once
const GHOST_OPACITY = 0.28;
const EARLY = 0x1c7ed6,
  LATE = 0xf76707; // colors of the first and the last slice
const TINT = 0.6; // share of them

/** Returns a faint material, tinted by the time from 0 to 1. */
function ghostOf(material: THREE.Material, part: number): THREE.Material {
  const ghost = Object.assign(material.clone(), { transparent: true, opacity: GHOST_OPACITY * material.opacity, depthWrite: false });
  if (ghost instanceof THREE.MeshStandardMaterial) ghost.color.lerp(new THREE.Color(EARLY).lerp(new THREE.Color(LATE), part), TINT);
  return ghost;
}

/** Numbers of a motion, slice after slice. */
export interface Slices {
  slices: number;
  frames: number;
  dofs: number;
  poses: Float32Array; // per frame x y z, w x y z
  q: Float32Array;
}

/** Reads the slices of a message. */
export function readSlices(data: ArrayBuffer): Slices {
  const view = new DataView(data);
  const [slices, frames, dofs] = [4, 8, 12].map((at) => view.getUint32(at, true)) as [number, number, number];
  const poses = 7 * slices * frames;
  return {
    slices, frames, dofs,
    poses: readDifferences(data, 16, poses, 7 * frames),
    q: readDifferences(data, 16 + 4 * poses, slices * dofs, dofs),
  };
}

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
    { slices, frames, dofs, poses, q }: Slices,
  ) {
    [this.slices, this.frames, this.dofs, this.poses, this.q] = [slices, frames, dofs, poses, q];
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

  /** Returns copies of the moving shapes in slices spread over the motion, from blue to orange. They share the frames'
   * geometries. */
  ghosts(frames: ReadonlyMap<number, Shown>): THREE.Group {
    const group = new THREE.Group();
    const count = Math.min(this.slices, GHOSTS);
    for (const [id, { object }] of frames) {
      if (!(object instanceof THREE.Mesh) || object instanceof WideLines || !object.visible || !this.moves(id)) continue;
      for (let i = 0; i < count; ++i) {
        const part = count === 1 ? 0 : i / (count - 1);
        const faint = materialsOf(object).map((material) => ghostOf(material, part));
        const ghost = new THREE.Mesh(object.geometry, faint.length > 1 ? faint : faint[0]!);
        this.place(ghost, id, part * (this.slices - 1));
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
