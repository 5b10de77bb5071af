import * as THREE from "three";
import { RoundedBoxGeometry } from "three/addons/geometries/RoundedBoxGeometry.js";
import { mergeVertices } from "three/addons/utils/BufferGeometryUtils.js";
import { creased } from "./creased";

/** Segments of a full circle per level of detail, each for radii of up to so many pixels on the screen. */
const LEVELS = [
  { parts: 8, pixels: 6 },
  { parts: 12, pixels: 16 },
  { parts: 20, pixels: 60 },
  { parts: 32, pixels: 150 },
  { parts: 56, pixels: Infinity },
] as const;

/** Rotates a profile of (radius, z) points about z; edges between flat parts stay sharp. */
function turned(profile: [number, number][], parts: number): THREE.BufferGeometry {
  return creased(
    new THREE.LatheGeometry(
      profile.map(([r, z]) => new THREE.Vector2(r, z)),
      parts,
    ).rotateX(Math.PI / 2),
  );
}

function roundedCylinder(length: number, radius: number, rounding: number, parts: number): THREE.BufferGeometry {
  const profile: [number, number][] = [[0, -length / 2]];
  const steps = Math.ceil(parts / 6);
  for (const half of [-1, 1]) {
    for (let i = 0; i <= steps; ++i) {
      const angle = (Math.PI / 2) * ((half < 0 ? i : steps - i) / steps);
      profile.push([radius - rounding * (1 - Math.sin(angle)), half * (length / 2 - rounding * (1 - Math.cos(angle)))]);
    }
  }
  profile.push([0, length / 2]);
  return turned(profile, parts);
}

function build(type: string, size: readonly number[], parts: number): THREE.BufferGeometry | null {
  const [a = 0, b = 0, c = 0, r = 0] = size;
  switch (type) {
    case "box":
    case "sdf":
    case "tensor":
      return new THREE.BoxGeometry(a, b, c);
    case "ssBox":
      return r > 1e-6 && parts > 8
        ? mergeVertices(new RoundedBoxGeometry(a, b, c, Math.ceil(parts / 16), r))
        : new THREE.BoxGeometry(a, b, c);
    case "sphere":
      return new THREE.SphereGeometry(a, parts, parts >> 1);
    case "capsule":
      return new THREE.CapsuleGeometry(b, a, parts >> 2, parts).rotateX(Math.PI / 2);
    case "cylinder":
      return turned(
        [
          [0, -a / 2],
          [b, -a / 2],
          [b, a / 2],
          [0, a / 2],
        ],
        parts,
      );
    case "ssCylinder":
      return roundedCylinder(a, b, c, parts);
    case "quad":
      return new THREE.PlaneGeometry(a, b);
    default:
      return null;
  }
}

const isRound = (type: string): boolean => !["box", "sdf", "tensor", "quad"].includes(type);

/** Geometries of primitive shapes. Equal shapes share them. */
export class Primitives {
  private readonly made = new Map<string, Map<number, THREE.BufferGeometry>>(); // by shape and level

  /** Returns null for other kinds of shapes. */
  get(type: string, size: readonly number[], level: number): THREE.BufferGeometry | null {
    const key = `${type} ${size.join(" ")}`;
    const levels = this.made.get(key) ?? new Map<number, THREE.BufferGeometry>();
    const geometry = levels.get(level) ?? build(type, size, LEVELS[level]!.parts);
    if (!geometry) return null;
    this.made.set(key, levels.set(level, geometry));
    return geometry;
  }

  /** Frees the geometries of shapes that are not in `used`. */
  keep(used: Iterable<PrimitiveMesh>): void {
    const keys = new Set(Array.from(used, ({ type, size }) => `${type} ${size.join(" ")}`));
    for (const [key, levels] of this.made) {
      if (keys.has(key)) continue;
      for (const geometry of levels.values()) geometry.dispose();
      this.made.delete(key);
    }
  }
}

/** A primitive with a level of detail that follows its size on the screen. */
export class PrimitiveMesh extends THREE.Mesh<THREE.BufferGeometry, THREE.Material> {
  private level: number;
  private readonly radius: number;

  constructor(
    private readonly primitives: Primitives,
    readonly type: string,
    readonly size: readonly number[],
    material: THREE.Material,
  ) {
    const level = isRound(type) ? 1 : 0;
    super(primitives.get(type, size, level) ?? undefined, material);
    this.level = level;
    this.geometry.computeBoundingSphere();
    this.radius = this.geometry.boundingSphere!.radius;
  }

  /** `pixelsPerMeter`: at a place. */
  refine(pixelsPerMeter: (at: THREE.Vector3) => number): void {
    if (!isRound(this.type)) return;
    const pixels = this.radius * pixelsPerMeter(this.parent!.position);
    const level = LEVELS.findIndex((known) => pixels <= known.pixels);
    if (level === this.level) return;
    this.level = level;
    this.geometry = this.primitives.get(this.type, this.size, level)!;
  }
}
