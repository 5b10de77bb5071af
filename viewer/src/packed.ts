/** Undoes the coding of signed numbers: 2x or -2x - 1. */
const signed = (code: number): number => (code >>> 1) ^ -(code & 1);

/** Reads words whose differences from those `stride` before are in 4 planes of bytes. Returns the bits of float32
 * numbers as such. */
export function readDifferences(data: ArrayBuffer, at: number, count: number, stride: number): Float32Array {
  const planes = new Uint8Array(data, at, 4 * count);
  const words = new Int32Array(count);
  for (let i = 0; i < count; ++i) {
    const code = planes[i]! | (planes[count + i]! << 8) | (planes[2 * count + i]! << 16) | (planes[3 * count + i]! << 24);
    words[i] = signed(code) + (i < stride ? 0 : words[i - stride]!);
  }
  return new Float32Array(words.buffer);
}

export interface Surface {
  number: number;
  positions: Float32Array;
  indices: Uint32Array;
  colors: Uint8Array; // rgba, per vertex; or none
}

const HEAD = 44; // bytes
const NEW = 1,
  KNOWN = 2; // symbols

/** Reads a surface; the program's `packMesh` describes its bytes. */
export function readSurface(data: ArrayBuffer): Surface {
  const view = new DataView(data), bytes = new Uint8Array(data);
  const [number, vertices, triangles, colored, symbolCount, referenceCount] = [4, 8, 12, 16, 20, 24].map((at) => view.getUint32(at, true)) as [number, number, number, number, number, number];
  const origin = [28, 32, 36].map((at) => view.getFloat32(at, true)), step = view.getFloat32(40, true);
  const references = HEAD + symbolCount, differences = references + 3 * referenceCount, colors = differences + 9 * vertices;
  const places = new Int32Array(3 * vertices), indices = new Uint32Array(3 * triangles);
  let symbol = HEAD, reference = 0, written = 0, last = -1, index = 0;

  const code = (start: number, count: number, i: number): number =>
    bytes[start + i]! | (bytes[start + count + i]! << 8) | (bytes[start + 2 * count + i]! << 16);
  /** Reads a vertex; its place is expected at a + b - c. */
  const vertex = (kind: number, a: number, b: number, c: number): number => {
    if (kind === KNOWN) return (last = written - 1 - code(references, referenceCount, reference++));
    for (let k = 0; k < 3; ++k) {
      const expected = a < 0 ? 0 : places[3 * a + k]! + places[3 * b + k]! - places[3 * c + k]!;
      places[3 * written + k] = expected + signed(code(differences, 3 * vertices, k * vertices + written));
    }
    return (last = written++);
  };
  const gates: number[] = []; // edge from a to b of the next triangle, and the vertex opposite to it on the other side
  const add = (a: number, b: number, c: number): void => {
    indices.set([a, b, c], index);
    index += 3;
  };
  while (index < indices.length) {
    const [a, b, c] = [0, 1, 2].map(() => vertex(bytes[symbol++]!, last, last, last)) as [number, number, number];
    add(a, b, c);
    gates.push(b, a, c, c, b, a, a, c, b);
    while (gates.length > 0) {
      const opposite = gates.pop()!, to = gates.pop()!, from = gates.pop()!;
      const kind = bytes[symbol++]!;
      if (kind !== NEW && kind !== KNOWN) continue;
      const third = vertex(kind, from, to, opposite);
      add(from, to, third);
      gates.push(third, to, from, from, third, to);
    }
  }
  const positions = Float32Array.from(places, (place, i) => origin[i % 3]! + step * place);
  const rgba = new Uint8Array(4 * colored);
  for (let k = 0; k < 4; ++k) for (let i = 0; i < colored; ++i) rgba[4 * i + k] = bytes[colors + k * colored + i]!;
  return { number, positions, indices, colors: rgba };
}
