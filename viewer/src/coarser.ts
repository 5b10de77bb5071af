import * as THREE from "three";

const DIRECTIONS = 6; // main directions of normals: +x -x +y -y +z -z

/** Returns the nearest of the six directions of a normal. */
function directionOf(normals: ArrayLike<number>, vertex: number): number {
  let best = 0;
  for (let k = 1; k < 3; ++k)
    if (Math.abs(normals[3 * vertex + k]!) > Math.abs(normals[3 * vertex + best]!)) best = k;
  return 2 * best + (normals[3 * vertex + best]! < 0 ? 1 : 0);
}

/** Averages values over the vertices with the same number. */
function means(values: ArrayLike<number>, numbers: Uint32Array, count: number): Float32Array {
  const sums = new Float32Array(3 * count),
    counts = new Uint32Array(count);
  numbers.forEach((number, vertex) => {
    ++counts[number]!;
    for (let k = 0; k < 3; ++k) sums[3 * number + k]! += values[3 * vertex + k]!;
  });
  for (let i = 0; i < sums.length; ++i) sums[i]! /= counts[Math.floor(i / 3)]!;
  return sums;
}

/** Numbers equal keys equally, from 0 on; `count` is the number of different keys. */
function numbered(keys: Float64Array): { numbers: Uint32Array; count: number } {
  const known = new Map<number, number>();
  const numbers = Uint32Array.from(keys, (key) => {
    const number = known.get(key) ?? known.size;
    known.set(key, number);
    return number;
  });
  return { numbers, count: known.size };
}

/** Simplifies a surface: all points in a cell of a grid are replaced by their mean. Edges between faces with different
 * directions stay sharp. The geometry has an index, normals and optionally colors. */
export function coarser(geometry: THREE.BufferGeometry, cell: number): THREE.BufferGeometry {
  const { position, normal, color } = geometry.attributes as Record<string, THREE.BufferAttribute | undefined>;
  const points = position!.array,
    normals = normal!.array;
  if (!geometry.boundingBox) geometry.computeBoundingBox();
  const { min, max } = geometry.boundingBox!;
  const [columns, rows] = [Math.floor((max.x - min.x) / cell) + 1, Math.floor((max.y - min.y) / cell) + 1];
  const cells = numbered(
    Float64Array.from({ length: position!.count }, (_, i) => {
      const [x, y, z] = min.toArray().map((least, k) => Math.floor((points[3 * i + k]! - least) / cell));
      return x! + columns * (y! + rows * z!);
    }),
  );
  const corners = numbered(
    Float64Array.from(cells.numbers, (number, i) => DIRECTIONS * number + directionOf(normals, i)),
  );
  const outIndices: number[] = [];
  const index = geometry.index!.array;
  for (let i = 0; i < index.length; i += 3) {
    const [a, b, c] = [cells.numbers[index[i]!], cells.numbers[index[i + 1]!], cells.numbers[index[i + 2]!]];
    if (a === b || b === c || c === a) continue;
    for (let k = 0; k < 3; ++k) outIndices.push(corners.numbers[index[i + k]!]!);
  }
  const centers = means(points, cells.numbers, cells.count);
  const outPoints = new Float32Array(3 * corners.count);
  corners.numbers.forEach((corner, i) => {
    for (let k = 0; k < 3; ++k) outPoints[3 * corner + k] = centers[3 * cells.numbers[i]! + k]!;
  });
  const out = new THREE.BufferGeometry().setIndex(outIndices);
  out.setAttribute("position", new THREE.BufferAttribute(outPoints, 3));
  out.setAttribute("normal", new THREE.BufferAttribute(means(normals, corners.numbers, corners.count), 3));
  if (color) out.setAttribute("color", new THREE.BufferAttribute(means(color.array, corners.numbers, corners.count), 3));
  out.normalizeNormals();
  return out;
}
