import * as THREE from "three";
import { coarser } from "./coarser";

/** Cells of the grid per radius of a mesh; each serves up to so many pixels of radius on the screen. */
const LEVELS = [
  { cells: 2.5, pixels: 12 },
  { cells: 4, pixels: 28 },
  { cells: 5.5, pixels: 44 },
  { cells: 8, pixels: 80 },
  { cells: 16, pixels: 200 },
] as const;
const WORTH = 0.75; // of the triangles, at most, are left where a coarser mesh is worth it
const FEWEST = 200; // triangles of a mesh that may become coarser
const PATIENCE = 4; // ms that may go into coarser meshes for a picture

/** The triangles of a mesh, and coarser ones that are made when they are asked for. */
export class Levels {
  private readonly made = new Map<number, THREE.BufferGeometry>();
  readonly radius: number;

  constructor(readonly full: THREE.BufferGeometry) {
    full.computeBoundingSphere();
    this.radius = full.boundingSphere!.radius;
  }

  /** As fine as a radius of so many pixels needs it. `until`: when nothing new is to be made any more, by the page's clock. */
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

/** A mesh that can be drawn more coarsely. */
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

/** When coarser meshes for a picture that begins now have taken long enough. */
export const deadline = (): number => performance.now() + PATIENCE;
