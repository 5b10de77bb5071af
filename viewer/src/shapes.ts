import * as THREE from "three";
import { RoundedBoxGeometry } from "three/addons/geometries/RoundedBoxGeometry.js";
import { toCreasedNormals } from "three/addons/utils/BufferGeometryUtils.js";
import type { ShapeMessage } from "./messages";

/** A mesh as the server sent it: without triangles it is a point cloud. */
export interface MeshData {
  geometry: THREE.BufferGeometry;
  isPoints: boolean;
  hasColors: boolean;
}

/** Of x, y and z. */
export const AXIS_COLORS = [0xd64545, 0x3f9c4b, 0x3b6fd6] as const;

const CREASE = 0.7; // rad: edges sharper than this stay sharp
const LARGEST_CREASED = 60000; // triangles

export function makeMeshData(positions: Float32Array, indices: Uint32Array, colors: Uint8Array): MeshData {
  let geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(positions, 3));
  const vertices = positions.length / 3;
  const hasColors = vertices > 0 && colors.length === 4 * vertices;
  if (hasColors) {
    const linear = new Float32Array(3 * vertices);
    const color = new THREE.Color();
    for (let i = 0; i < vertices; ++i) {
      color.setRGB(colors[4 * i]! / 255, colors[4 * i + 1]! / 255, colors[4 * i + 2]! / 255, THREE.SRGBColorSpace);
      color.toArray(linear, 3 * i);
    }
    geometry.setAttribute("color", new THREE.BufferAttribute(linear, 3));
  }
  const isPoints = indices.length === 0;
  if (!isPoints) {
    geometry.setIndex(new THREE.BufferAttribute(indices, 1));
    if (indices.length < 3 * LARGEST_CREASED) geometry = toCreasedNormals(geometry, CREASE);
    else geometry.computeVertexNormals();
  }
  return { geometry, isPoints, hasColors };
}

/** A profile of (radius, z) points turned about z; edges between flat parts stay sharp. */
function turned(profile: [number, number][]): THREE.BufferGeometry {
  const lathe = new THREE.LatheGeometry(profile.map(([r, z]) => new THREE.Vector2(r, z)), 48);
  return toCreasedNormals(lathe.rotateX(Math.PI / 2), CREASE);
}

function roundedCylinder(length: number, radius: number, rounding: number): THREE.BufferGeometry {
  const profile: [number, number][] = [[0, -length / 2]];
  for (const half of [-1, 1]) {
    for (let i = 0; i <= 8; ++i) {
      const angle = (Math.PI / 2) * ((half < 0 ? i : 8 - i) / 8);
      profile.push([radius - rounding * (1 - Math.sin(angle)), half * (length / 2 - rounding * (1 - Math.cos(angle)))]);
    }
  }
  profile.push([0, length / 2]);
  return turned(profile);
}

function primitive(type: string, size: number[]): THREE.BufferGeometry | null {
  const [a = 0, b = 0, c = 0, r = 0] = size;
  switch (type) {
    case "box": case "sdf": case "tensor": return new THREE.BoxGeometry(a, b, c);
    case "ssBox": return r > 1e-6 ? new RoundedBoxGeometry(a, b, c, 5, r) : new THREE.BoxGeometry(a, b, c);
    case "sphere": return new THREE.SphereGeometry(a, 48, 32);
    case "capsule": return new THREE.CapsuleGeometry(b, a, 16, 48).rotateX(Math.PI / 2);
    case "cylinder": return turned([[0, -a / 2], [b, -a / 2], [b, a / 2], [0, a / 2]]);
    case "ssCylinder": return roundedCylinder(a, b, c);
    case "quad": return new THREE.PlaneGeometry(a, b);
    default: return null;
  }
}

/** Arrows along x (red), y (green) and z (blue). */
function marker(length: number): THREE.Object3D {
  const group = new THREE.Group();
  const shaft = new THREE.CylinderGeometry(0.02 * length, 0.02 * length, 0.8 * length, 12).translate(0, 0.4 * length, 0);
  const tip = new THREE.ConeGeometry(0.06 * length, 0.2 * length, 20).translate(0, 0.9 * length, 0);
  const turns: [number, number, number][] = [[0, 0, -Math.PI / 2], [0, 0, 0], [Math.PI / 2, 0, 0]];
  AXIS_COLORS.forEach((color, axis) => {
    const material = new THREE.MeshBasicMaterial({ color });
    for (const geometry of [shaft, tip]) {
      const part = new THREE.Mesh(geometry, material);
      part.rotation.set(...turns[axis]!);
      group.add(part);
    }
  });
  return group;
}

/** What a frame shows, in the frame's own coordinates; null if there is nothing to see (yet). */
export function makeShape(shape: ShapeMessage, meshes: Map<number, MeshData>): THREE.Object3D | null {
  if (shape.type === "marker" || shape.type === "camera") return marker(shape.size[0] ?? 0.1);
  const [red = 0.8, green = 0.8, blue = 0.8, alpha = 1] = shape.color;
  const color = new THREE.Color().setRGB(red, green, blue, THREE.SRGBColorSpace);
  const data = shape.mesh >= 0 ? meshes.get(shape.mesh) : undefined;
  if (data?.isPoints) {
    if (shape.type === "lines") return new THREE.LineSegments(data.geometry, new THREE.LineBasicMaterial({ color }));
    return new THREE.Points(data.geometry, new THREE.PointsMaterial({ size: 4, sizeAttenuation: false, color: data.hasColors ? 0xffffff : color, vertexColors: data.hasColors }));
  }
  const geometry = data?.geometry ?? primitive(shape.type, shape.size);
  if (!geometry) return null;
  const transparent = alpha < 1;
  const material = new THREE.MeshStandardMaterial({
    color: data?.hasColors ? 0xffffff : color, vertexColors: data?.hasColors ?? false, roughness: 0.55, metalness: 0.05,
    transparent, opacity: alpha, depthWrite: !transparent, side: data || shape.type === "quad" ? THREE.DoubleSide : THREE.FrontSide,
  });
  const mesh = new THREE.Mesh(geometry, material);
  mesh.castShadow = !transparent;
  mesh.receiveShadow = !transparent;
  return mesh;
}
