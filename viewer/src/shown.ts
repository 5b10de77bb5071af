import * as THREE from "three";
import { BinaryKind, type FrameMessage, type SceneMessage } from "./messages";
import { Instances } from "./instances";
import { PrimitiveMesh, Primitives } from "./primitives";
import { makeMeshData, makeShape, type MeshData, SURFACE } from "./shapes";

/** A frame: `anchor` has its pose; `object` is the shape on it, if there is something to see. */
export interface Shown {
  message: FrameMessage;
  anchor: THREE.Group;
  object: THREE.Object3D | null;
}

/** Frees what the graphics card holds of an object; `kept` is a geometry that others use too. */
function release(object: THREE.Object3D, kept: THREE.BufferGeometry | undefined): void {
  object.traverse((part) => {
    if (part instanceof PrimitiveMesh) return part.material.dispose();
    if (!(part instanceof THREE.Mesh || part instanceof THREE.Points || part instanceof THREE.LineSegments)) return;
    if (part.geometry !== kept) part.geometry.dispose();
    part.material.dispose();
  });
}

/** The frames of the scene as three.js objects, kept as the server's messages say. */
export class ShownScene {
  private readonly shown = new Map<number, Shown>();
  readonly frames: ReadonlyMap<number, Shown> = this.shown;
  private readonly meshes = new Map<number, MeshData>();
  private readonly primitives = new Primitives();
  private readonly poses = new Map<number, Float32Array>();

  /** While a motion is shown, poses that arrive wait. */
  held = false;

  private readonly instances = new Instances(new THREE.MeshStandardMaterial(SURFACE));

  /** Frames are added to `parent`, and what is drawn for several of them at once to `scene`. */
  constructor(private readonly parent: THREE.Group, scene: THREE.Scene) {
    scene.add(this.instances.group);
  }

  get meshCount(): number {
    return this.meshes.size;
  }

  clear(): void {
    for (const id of [...this.shown.keys()]) this.remove(id);
    this.dropUnusedMeshes();
    this.poses.clear();
  }

  readScene(message: SceneMessage): void {
    for (const id of [...this.shown.keys()]) if (id >= message.count) this.remove(id);
    for (const frame of message.frames) {
      this.remove(frame.id);
      const anchor = new THREE.Group();
      anchor.name = frame.name;
      anchor.userData.id = frame.id;
      this.parent.add(anchor);
      const object = frame.shape ? makeShape(frame.shape, this.meshes, this.primitives) : null;
      if (object) anchor.add(object);
      this.shown.set(frame.id, { message: frame, anchor, object });
      this.place(frame.id);
    }
    this.dropUnusedMeshes();
  }

  /** Reads poses and meshes; false for other messages. */
  readBinary(data: ArrayBuffer): boolean {
    const view = new DataView(data);
    const kind = view.getUint32(0, true);
    if (kind === BinaryKind.poses) this.readPoses(view);
    else if (kind === BinaryKind.mesh) this.readMesh(data, view);
    else return false;
    return true;
  }

  /** Puts all frames where the last message said. */
  placeAll(): void {
    for (const id of this.shown.keys()) this.place(id);
  }

  /** Call before a picture: shapes are drawn as finely as they are large on it. */
  prepare(pixelsPerMetre: (at: THREE.Vector3) => number): void {
    for (const mesh of this.primitiveMeshes()) mesh.refine(pixelsPerMetre);
    this.instances.update(this.primitiveMeshes());
  }

  private readPoses(view: DataView): void {
    const count = view.getUint32(4, true);
    for (let i = 0; i < count; ++i) {
      const at = 8 + 32 * i;
      const pose = new Float32Array(7);
      for (let k = 0; k < 7; ++k) pose[k] = view.getFloat32(at + 4 + 4 * k, true);
      const id = view.getUint32(at, true);
      this.poses.set(id, pose);
      if (!this.held) this.place(id);
    }
  }

  private readMesh(data: ArrayBuffer, view: DataView): void {
    const [index, vertices, triangles, colors] = [4, 8, 12, 16].map((at) => view.getUint32(at, true)) as [number, number, number, number];
    let at = 20;
    const positions = new Float32Array(data, at, 3 * vertices);
    at += positions.byteLength;
    const indices = new Uint32Array(data, at, 3 * triangles);
    at += indices.byteLength;
    this.meshes.set(index, makeMeshData(positions, indices, new Uint8Array(data, at, 4 * colors)));
  }

  private place(id: number): void {
    const anchor = this.shown.get(id)?.anchor;
    const pose = this.poses.get(id);
    if (!anchor || !pose) return;
    anchor.position.set(pose[0]!, pose[1]!, pose[2]!);
    anchor.quaternion.set(pose[4]!, pose[5]!, pose[6]!, pose[3]!);
  }

  private remove(id: number): void {
    const shown = this.shown.get(id);
    if (!shown) return;
    this.parent.remove(shown.anchor);
    release(shown.anchor, this.meshes.get(shown.message.shape?.mesh ?? -1)?.geometry);
    shown.anchor.clear();
    this.shown.delete(id);
  }

  private *primitiveMeshes(): Generator<PrimitiveMesh> {
    for (const { object } of this.shown.values()) if (object instanceof PrimitiveMesh) yield object;
  }

  /** The server keeps no other meshes than those in use, and counts on the same here. */
  private dropUnusedMeshes(): void {
    const used = new Set([...this.shown.values()].map((shown) => shown.message.shape?.mesh));
    for (const [number, mesh] of this.meshes) {
      if (used.has(number)) continue;
      mesh.geometry.dispose();
      this.meshes.delete(number);
    }
    this.primitives.keep(this.primitiveMeshes());
  }
}
