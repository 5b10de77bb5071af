import * as THREE from "three";
import { coarser } from "./coarser";

/** Grid cells per radius of a mesh, each for radii of up to so many pixels on the screen. */
const LEVELS = [
  { cells: 2.5, pixels: 12 },
  { cells: 4, pixels: 28 },
  { cells: 5.5, pixels: 44 },
  { cells: 8, pixels: 80 },
  { cells: 16, pixels: 200 },
] as const;
const WORTH = 0.75; // largest share of the triangles at which a coarser mesh pays off
const FEWEST = 200; // smallest number of triangles of a mesh that is simplified
const PATIENCE = 4; // ms per picture for making coarser meshes

/** A mesh and its coarser levels, which are made on demand. */
export class Levels {
  private readonly made = new Map<number, THREE.BufferGeometry>();
  readonly radius: number;

  constructor(readonly full: THREE.BufferGeometry) {
    full.computeBoundingSphere();
    this.radius = full.boundingSphere!.radius;
  }

  /** Returns the level for a radius in pixels. After `until`, by the page's clock, no new level is made. */
  at(pixels: number, until: number): THREE.BufferGeometry {
    const level = LEVELS.findIndex((known) => pixels <= known.pixels);
    if (level < 0 || this.full.index!.count < 3 * FEWEST) return this.full;
    const known = this.made.get(level);
    if (known) return known;
    if (performance.now() > until) return this.full;
    const made = coarser(this.full, this.radius / LEVELS[level]!.cells);
    const chosen = made.index!.count <= WORTH * this.full.index!.count ? made : this.full;
    this.made.set(level, chosen);
    return chosen;
  }

  dispose(): void {
    for (const geometry of [this.full, ...this.made.values()]) geometry.dispose();
  }
}

/** A mesh with levels of detail. */
export class LevelMesh extends THREE.Mesh<THREE.BufferGeometry, THREE.Material> {
  constructor(
    private readonly levels: Levels,
    material: THREE.Material,
  ) {
    super(levels.full, material);
  }

  /** `pixelsPerMeter`: at a place. */
  refine(pixelsPerMeter: (at: THREE.Vector3) => number, quickly: boolean, until: number): void {
    const { full, radius } = this.levels;
    this.geometry = quickly ? this.levels.at(radius * pixelsPerMeter(this.parent!.position), until) : full;
  }
}

/** Returns the time after which a picture that starts now makes no more coarser meshes. */
export const deadline = (): number => performance.now() + PATIENCE;
