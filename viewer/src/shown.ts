import * as THREE from "three";
import { BinaryKind, type FrameMessage, type SceneMessage } from "./messages";
import { Cloud } from "./clouds";
import { Instances } from "./instances";
import { deadline, LevelMesh } from "./meshes";
import { readSurface } from "./packed";
import { Pictures, type TexturedTriangles } from "./pictures";
import { PrimitiveMesh, Primitives } from "./primitives";
import { makeMeshData, makeShape, materialsOf, type MeshData, SURFACE } from "./shapes";

/** A frame: `anchor` has its pose; `object` is its visible shape, if any. */
export interface Shown {
  message: FrameMessage;
  anchor: THREE.Group;
  object: THREE.Object3D | null;
}

/** Frees an object's resources of the graphics card; `kept` is a shared geometry. */
function release(object: THREE.Object3D, kept: THREE.BufferGeometry | undefined): void {
  object.traverse((part) => {
    if (part instanceof PrimitiveMesh) return part.material.dispose();
    if (!(part instanceof THREE.Mesh || part instanceof THREE.Points || part instanceof THREE.LineSegments)) return;
    if (part.geometry !== kept && !(part instanceof LevelMesh)) part.geometry.dispose();
    for (const material of part instanceof THREE.Mesh ? materialsOf(part) : [part.material]) material.dispose();
  });
}

/** The frames of the scene as three.js objects, updated by the server's messages. */
export class ShownScene {
  private readonly shown = new Map<number, Shown>();
  readonly frames: ReadonlyMap<number, Shown> = this.shown;
  private readonly meshes = new Map<number, MeshData>();
  private readonly primitives = new Primitives();
  private readonly poses = new Map<number, Float32Array>();

  /** While a motion is shown, arriving poses wait. */
  held = false;

  private readonly instances = new Instances(new THREE.MeshStandardMaterial(SURFACE));

  readonly pictures: Pictures;
  readonly shared: THREE.Object3D; // shapes of several frames that are drawn together

  /** Frames are added to `parent`, and objects shared by several frames to `scene`. `changed` is called when images
   * that arrive later change the picture. */
  constructor(private readonly parent: THREE.Group, scene: THREE.Scene, changed: () => void) {
    scene.add(this.instances.group);
    this.shared = this.instances.group;
    this.pictures = new Pictures(changed);
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
      const object = frame.shape ? makeShape(frame.shape, this.meshes, this.pictures, this.primitives) : null;
      if (object) anchor.add(object);
      this.shown.set(frame.id, { message: frame, anchor, object });
      this.place(frame.id);
    }
    this.dropUnusedMeshes();
  }

  /** Reads poses, meshes and images; returns false for other messages. */
  readBinary(data: ArrayBuffer): boolean {
    const view = new DataView(data);
    const kind = view.getUint32(0, true);
    if (kind === BinaryKind.poses) this.readPoses(view);
    else if (kind === BinaryKind.mesh) this.readMesh(data, view);
    else if (kind === BinaryKind.surface) this.readSurface(data);
    else if (kind === BinaryKind.image) this.pictures.read(data);
    else return false;
    return true;
  }

  /** Sets all frames to the poses of the last message. */
  placeAll(): void {
    for (const id of this.shown.keys()) this.place(id);
  }

  /** Call before a picture: chooses levels of detail by size on the screen; meshes are simplified only if `quickly`. */
  prepare(pixelsPerMeter: (at: THREE.Vector3) => number, quickly: boolean): void {
    const until = deadline();
    for (const { object } of this.shown.values()) {
      if (object instanceof PrimitiveMesh) object.refine(pixelsPerMeter);
      else if (object instanceof Cloud) object.thin(quickly);
      else if (object instanceof LevelMesh) object.refine(pixelsPerMeter, quickly, until);
    }
    this.instances.update(this.primitiveMeshes());
  }

  private readPoses(view: DataView): void {
    const count = view.getUint32(4, true);
    for (let i = 0; i < count; ++i) {
      const at = 8 + 32 * i;
      const id = view.getUint32(at, true);
      let pose = this.poses.get(id); // thousands arrive many times a second: objects are reused
      if (!pose) this.poses.set(id, (pose = new Float32Array(7)));
      for (let k = 0; k < 7; ++k) pose[k] = view.getFloat32(at + 4 + 4 * k, true);
      if (!this.held) this.place(id);
    }
  }

  private readMesh(data: ArrayBuffer, view: DataView): void {
    const [index, vertices, triangles, colors, places, textured] = [4, 8, 12, 16, 20, 24].map((at) => view.getUint32(at, true)) as [number, number, number, number, number, number];
    let at = 28;
    const floats = (count: number): Float32Array => {
      at += 4 * count;
      return new Float32Array(data, at - 4 * count, count);
    };
    const words = (count: number): Uint32Array => {
      at += 4 * count;
      return new Uint32Array(data, at - 4 * count, count);
    };
    const positions = floats(3 * vertices), indices = words(3 * triangles), uv = floats(2 * places), list = words(3 * textured);
    const shown = Array.from({ length: textured }, (_, i): TexturedTriangles => [list[3 * i]!, list[3 * i + 1]!, list[3 * i + 2]!]);
    this.meshes.set(index, makeMeshData(positions, indices, uv, shown, new Uint8Array(data, at, 4 * colors)));
  }

  private readSurface(data: ArrayBuffer): void {
    const { number, positions, indices, colors } = readSurface(data);
    this.meshes.set(number, makeMeshData(positions, indices, new Float32Array(), [], colors));
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

  /** Drops unused meshes; the server assumes that the page does. */
  private dropUnusedMeshes(): void {
    const used = new Set([...this.shown.values()].map((shown) => shown.message.shape?.mesh));
    for (const [number, mesh] of this.meshes) {
      if (used.has(number)) continue;
      if (mesh.levels) mesh.levels.dispose();
      else mesh.geometry.dispose();
      this.meshes.delete(number);
    }
    this.pictures.keep(new Set([...this.meshes.values()].flatMap(({ textured }) => textured.map(([, , picture]) => picture))));
    this.primitives.keep(this.primitiveMeshes());
  }
}
