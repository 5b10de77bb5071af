import * as THREE from "three";
import { Outline } from "./outline";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

const COLOR = 0xe03131;

/** Outlines the frames of violated constraints red. */
export class Marks {
  private readonly outline: Outline;
  private marked: readonly number[] = [];

  constructor(stage: Stage, private readonly frames: ReadonlyMap<number, Shown>) {
    this.outline = new Outline(stage, frames, COLOR, 2);
  }

  get count(): number {
    return this.outline.count;
  }

  /** Marks exactly these frames. */
  show(ids: readonly number[]): void {
    if (ids.length === this.marked.length && ids.every((id, i) => id === this.marked[i])) return;
    this.marked = ids;
    this.outline.show(ids.map((id) => this.visible(id)));
  }

  /** Returns the nearest frame with a shape, from this one upwards. */
  private visible(id: number): number {
    for (let at: Shown | undefined = this.frames.get(id); at; at = this.frames.get(at.message.parent)) {
      if (at.object instanceof THREE.Mesh) return at.message.id;
    }
    return id;
  }
}
