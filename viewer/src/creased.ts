import * as THREE from "three";

const CREASE = Math.cos(0.7); // edges sharper than 0.7 rad stay sharp
const WELD = 1e-6; // relative to the size: closer points are merged

/** Numbers points such that equal points have equal numbers. */
function weld(points: ArrayLike<number>): Uint32Array {
  let largest = 0;
  for (let i = 0; i < points.length; ++i) largest = Math.max(largest, Math.abs(points[i]!));
  const cell = Math.max(largest * WELD, 1e-12);
  const numbers = new Uint32Array(points.length / 3);
  const seen = new Map<string, number>();
  for (let i = 0; i < numbers.length; ++i) {
    const key = `${Math.round(points[3 * i]! / cell)},${Math.round(points[3 * i + 1]! / cell)},${Math.round(points[3 * i + 2]! / cell)}`;
    const known = seen.get(key);
    if (known === undefined) seen.set(key, i);
    numbers[i] = known ?? i;
  }
  return numbers;
}

/** Normals of the triangles, with twice the area as length. */
function faceNormals(points: ArrayLike<number>, indices: ArrayLike<number>): Float32Array {
  const normals = new Float32Array(indices.length);
  const [a, b, c] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  for (let f = 0; f < indices.length; f += 3) {
    [a, b, c].forEach((corner, k) => corner.fromArray(points as number[], 3 * indices[f + k]!));
    b.sub(a).cross(c.sub(a)).toArray(normals, f);
  }
  return normals;
}

/** The faces at each point: one list, and the start of each point's part. */
function facesAt(corners: ArrayLike<number>, points: number): { starts: Uint32Array; faces: Uint32Array } {
  const starts = new Uint32Array(points + 1);
  for (let i = 0; i < corners.length; ++i) ++starts[corners[i]! + 1]!;
  for (let i = 0; i < points; ++i) starts[i + 1]! += starts[i]!;
  const next = starts.slice();
  const faces = new Uint32Array(corners.length);
  for (let i = 0; i < corners.length; ++i) faces[next[corners[i]!]!++] = Math.floor(i / 3);
  return { starts, faces };
}

/** Returns the surface with smooth normals except at sharp edges. Vertices are shared if possible. Triangles keep their
 * order. */
export function creased(geometry: THREE.BufferGeometry): THREE.BufferGeometry {
  const points = geometry.getAttribute("position").array;
  const colors = geometry.getAttribute("color")?.array;
  const places = geometry.getAttribute("uv")?.array;
  const indices = geometry.index?.array ?? Uint32Array.from({ length: points.length / 3 }, (_, i) => i);
  const welded = weld(points);
  const corners = Uint32Array.from(indices, (i) => welded[i]!);
  const normals = faceNormals(points, corners);
  const { starts, faces } = facesAt(corners, welded.length);
  const outPoints: number[] = [], outNormals: number[] = [], outColors: number[] = [], outPlaces: number[] = [], outIndices: number[] = [];
  const made: { normal: THREE.Vector3; attributes: string; vertex: number }[][] = Array.from({ length: welded.length }, () => []);
  const [own, other, sum] = [new THREE.Vector3(), new THREE.Vector3(), new THREE.Vector3()];
  for (let i = 0; i < corners.length; ++i) {
    const point = corners[i]!, face = i - (i % 3), source = indices[i]!;
    own.fromArray(normals, face).normalize();
    if (own.lengthSq() === 0) own.set(0, 0, 1);
    sum.set(0, 0, 0);
    for (let k = starts[point]!; k < starts[point + 1]!; ++k) {
      other.fromArray(normals, 3 * faces[k]!);
      if (other.dot(own) >= CREASE * other.length()) sum.add(other);
    }
    sum.lengthSq() > 0 ? sum.normalize() : sum.copy(own);
    const color = colors ? `${colors[3 * source]},${colors[3 * source + 1]},${colors[3 * source + 2]}` : "";
    const attributes = places ? `${color},${places[2 * source]},${places[2 * source + 1]}` : color;
    let entry = made[point]!.find((known) => known.attributes === attributes && known.normal.dot(sum) > 0.9999);
    if (!entry) {
      entry = { normal: sum.clone(), attributes, vertex: outPoints.length / 3 };
      made[point]!.push(entry);
      outPoints.push(points[3 * point]!, points[3 * point + 1]!, points[3 * point + 2]!);
      outNormals.push(sum.x, sum.y, sum.z);
      if (colors) outColors.push(colors[3 * source]!, colors[3 * source + 1]!, colors[3 * source + 2]!);
      if (places) outPlaces.push(places[2 * source]!, places[2 * source + 1]!);
    }
    outIndices.push(entry.vertex);
  }
  const out = new THREE.BufferGeometry().setIndex(outIndices);
  out.setAttribute("position", new THREE.Float32BufferAttribute(outPoints, 3));
  out.setAttribute("normal", new THREE.Float32BufferAttribute(outNormals, 3));
  if (colors) out.setAttribute("color", new THREE.Float32BufferAttribute(outColors, 3));
  if (places) out.setAttribute("uv", new THREE.Float32BufferAttribute(outPlaces, 2));
  return out;
}
