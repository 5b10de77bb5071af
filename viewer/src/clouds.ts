import * as THREE from "three";

const FEW = 100000; // points that are always drawn
const STRIDES = [7919, 7907]; // primes: the points of a cloud in such steps look like a random choice

const LINEAR = Float32Array.from({ length: 256 }, (_, i) => new THREE.Color().setRGB(i / 255, 0, 0, THREE.SRGBColorSpace).r);

/** Returns colors of vertices for the renderer, from rgba bytes. */
export function linearColors(rgba: Uint8Array): Float32Array<ArrayBuffer> {
  const linear = new Float32Array((3 * rgba.length) / 4);
  for (let i = 0, k = 0; i < rgba.length; i += 4) {
    linear[k++] = LINEAR[rgba[i]!]!;
    linear[k++] = LINEAR[rgba[i + 1]!]!;
    linear[k++] = LINEAR[rgba[i + 2]!]!;
  }
  return linear;
}

/** Points; while the scene moves on a slow machine, a part of a large cloud is drawn. */
export class Cloud extends THREE.Points<THREE.BufferGeometry, THREE.PointsMaterial> {
  /** Call before a picture. */
  thin(quickly: boolean): void {
    const count = this.geometry.getAttribute("position").count;
    this.geometry.setDrawRange(0, quickly && count > FEW ? FEW : Infinity);
  }
}

/** Returns the points of a large cloud in another order, such that the first ones are spread over all of it. */
export function spread(points: THREE.BufferGeometry): THREE.BufferGeometry {
  const count = points.getAttribute("position").count;
  if (count <= FEW || points.userData.isSpread) return points;
  points.userData.isSpread = true;
  const stride = STRIDES.find((prime) => count % prime !== 0) ?? 1; // every point occurs once
  const order = new Uint32Array(count);
  for (let i = 0, at = 0; i < count; ++i, at = (at + stride) % count) order[i] = at;
  for (const [name, attribute] of Object.entries(points.attributes)) {
    const from = attribute.array as Float32Array, to = new Float32Array(from.length);
    for (let i = 0; i < count; ++i) for (let k = 0; k < 3; ++k) to[3 * i + k] = from[3 * order[i]! + k]!;
    points.setAttribute(name, new THREE.BufferAttribute(to, 3));
  }
  return points;
}
