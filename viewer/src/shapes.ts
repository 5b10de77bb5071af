import * as THREE from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";
import { Cloud, linearColors, spread } from "./clouds";
import { creased } from "./creased";
import { WideLines } from "./lines";
import { LevelMesh, Levels } from "./meshes";
import type { ShapeMessage } from "./messages";
import type { Pictures, TexturedTriangles } from "./pictures";
import { PrimitiveMesh, type Primitives } from "./primitives";

/** A mesh from the server; without triangles it is a point cloud. */
export interface MeshData {
  geometry: THREE.BufferGeometry;
  levels: Levels | null; // of triangles without images
  isPoints: boolean;
  hasColors: boolean;
  textured: TexturedTriangles[];
}

/** Colors of x, y and z. */
export const AXIS_COLORS = [0xd64545, 0x3f9c4b, 0x3b6fd6] as const;

/** Reflection of surfaces. */
export const SURFACE = { roughness: 0.55, metalness: 0.05 } as const;

const LARGEST_CREASED = 60000; // triangles

export function makeMeshData(positions: Float32Array, indices: Uint32Array, places: Float32Array, textured: TexturedTriangles[], colors: Uint8Array): MeshData {
  let geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const vertices = positions.length / 3;
  const hasColors = vertices > 0 && colors.length === 4 * vertices;
  if (hasColors) {
    geometry.setAttribute("color", new THREE.BufferAttribute(linearColors(colors), 3));
  }
  if (textured.length > 0) geometry.setAttribute("uv", new THREE.BufferAttribute(places, 2));
  const isPoints = indices.length === 0;
  if (!isPoints) {
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    if (indices.length < 3 * LARGEST_CREASED) geometry = creased(geometry);
    else geometry.computeVertexNormals();
  }
  if (!coversAll(textured, indices.length / 3)) addGroups(geometry, textured, indices.length / 3);
  const levels = isPoints || textured.length > 0 ? null : new Levels(geometry);
  return { geometry, levels, isPoints, hasColors, textured };
}

const coversAll = (textured: TexturedTriangles[], triangles: number): boolean => textured.length === 1 && textured[0]![1] === triangles;

/** Material 0 shows colors, the others show images. */
function addGroups(geometry: THREE.BufferGeometry, textured: TexturedTriangles[], triangles: number): void {
  if (textured.length === 0) return;
  let at = 0;
  textured.forEach(([first, count], i) => {
    if (first > at) geometry.addGroup(3 * at, 3 * (first - at), 0);
    geometry.addGroup(3 * first, 3 * count, i + 1);
    at = first + count;
  });
  if (at < triangles) geometry.addGroup(3 * at, 3 * (triangles - at), 0);
}

/** Returns the materials of a mesh: one, or one per group. */
export function materialsOf({ material }: THREE.Mesh): THREE.Material[] {
  return Array.isArray(material) ? material : [material];
}

/** Arrows along x (red), y (green) and z (blue). */
export function marker(length: number): THREE.Object3D {
  const group = new THREE.Group();
  const shaft = new THREE.CylinderGeometry(0.02 * length, 0.02 * length, 0.8 * length, 12).translate(0, 0.4 * length, 0);
  const tip = new THREE.ConeGeometry(0.06 * length, 0.2 * length, 20).translate(0, 0.9 * length, 0);
  const turns: [number, number, number][] = [[0, 0, -Math.PI / 2], [0, 0, 0], [Math.PI / 2, 0, 0]];
  const parts = AXIS_COLORS.flatMap((color, axis) =>
    [shaft, tip].map((geometry) => {
      const part = geometry.clone().applyQuaternion(new THREE.Quaternion().setFromEuler(new THREE.Euler(...turns[axis]!)));
      const colors = new Float32Array(3 * part.getAttribute("position").count);
      for (let i = 0; i < colors.length; i += 3) new THREE.Color(color).toArray(colors, i);
      return part.setAttribute("color", new THREE.BufferAttribute(colors, 3));
    }),
  );
  return group.add(new THREE.Mesh(mergeGeometries(parts), new THREE.MeshBasicMaterial({ vertexColors: true })));
}

function makePrimitive({ type, size }: ShapeMessage, primitives: Primitives, material: THREE.Material): PrimitiveMesh | null {
  return primitives.get(type, size, 0) ? new PrimitiveMesh(primitives, type, size, material) : null;
}

/** Creates the shape of a frame, in the frame's coordinates; null if nothing is visible (yet). */
export function makeShape(shape: ShapeMessage, meshes: Map<number, MeshData>, pictures: Pictures, primitives: Primitives): THREE.Object3D | null {
  if (shape.type === "marker" || shape.type === "camera") return marker(shape.size[0] ?? 0.1);
  const [red = 0.8, green = 0.8, blue = 0.8, alpha = 1] = shape.color;
  const color = new THREE.Color().setRGB(red, green, blue, THREE.SRGBColorSpace);
  const data = shape.mesh >= 0 ? meshes.get(shape.mesh) : undefined;
  if (data?.isPoints) {
    if (shape.type === "lines") return new WideLines(data.geometry, color, alpha);
    return new Cloud(spread(data.geometry), new THREE.PointsMaterial({ size: 4, sizeAttenuation: false, color: data.hasColors ? 0xffffff : color, vertexColors: data.hasColors }));
  }
  const transparent = alpha < 1;
  const material = new THREE.MeshStandardMaterial({
    ...SURFACE, color: data?.hasColors ? 0xffffff : color, vertexColors: data?.hasColors ?? false,
    transparent, opacity: alpha, depthWrite: !transparent, side: data || shape.type === "quad" ? THREE.DoubleSide : THREE.FrontSide,
  });
  const pictured = (data?.textured ?? []).map(([, , picture]) => {
    const shown = material.clone();
    shown.color.setHex(0xffffff);
    return Object.assign(shown, { vertexColors: false, map: pictures.get(picture) });
  });
  let mesh: THREE.Mesh | null;
  if (data?.levels) mesh = new LevelMesh(data.levels, material);
  else if (data) mesh = new THREE.Mesh(data.geometry, data.geometry.groups.length > 0 ? [material, ...pictured] : pictured[0] ?? material);
  else mesh = makePrimitive(shape, primitives, material);
  if (!mesh) return null;
  mesh.castShadow = !transparent;
  mesh.receiveShadow = !transparent;
  return mesh;
}
