import * as THREE from "three";
import { label } from "./labels";
import { WideLines } from "./lines";
import type { FrameMessage, ShapeMessage } from "./messages";
import { AXIS_COLORS, materialsOf } from "./shapes";
import type { Shown } from "./shown";

/** Options that users toggle, by a switch or by Alt and a letter. */
export const OPTIONS = {
  solid: { label: "shapes", letter: "V", initially: true },
  collision: { label: "collision shapes", letter: "L", initially: false },
  transparent: { label: "transparent shapes", letter: "C", initially: true },
  markers: { label: "markers", letter: "M", initially: true },
  axes: { label: "axes of all frames", letter: "A", initially: false },
  names: { label: "names of frames", letter: "N", initially: false },
  wireframe: { label: "triangles only", letter: "W", initially: false },
  xray: { label: "see through everything", letter: "X", initially: false },
  near: { label: "distances below 5 cm, contacts", letter: "D", initially: false },
  warnings: { label: "obstacles that are ignored", letter: "I", initially: true },
} as const;

export type Option = keyof typeof OPTIONS;
export const optionNames = Object.keys(OPTIONS) as Option[];

const AXES_LENGTH = 0.1; // m
const XRAY_OPACITY = 0.4;
const FAINT = 0.25; // alpha

export function isSeen(object: THREE.Object3D): boolean {
  return object.visible && (object.parent === null || isSeen(object.parent));
}

/** Returns whether a shape serves collisions only: it collides and is nearly transparent. */
function kindOf({ collides }: FrameMessage, shape: ShapeMessage): Option {
  if (shape.type === "marker" || shape.type === "camera") return "markers";
  const alpha = shape.color[3] ?? 1;
  if (collides !== 0 && alpha <= FAINT) return "collision";
  return alpha < 1 ? "transparent" : "solid";
}

/** Determines the visible parts of the scene: kinds of shapes, axes, names, and frames that are hidden with all below
 * them. */
export class Display {
  readonly on = new Set<Option>(optionNames.filter((name) => OPTIONS[name].initially));
  wireframe = false; // overrides the switches
  visualsOnly = false; // no markers and transparent shapes, overrides the switches
  readonly hidden = new Set<string>(); // names of hidden frames

  apply(frames: ReadonlyMap<number, Shown>): void {
    for (const shown of frames.values()) {
      const { shape, name } = shown.message;
      shown.anchor.visible = !this.isHidden(shown, frames);
      if (shown.object && shape) {
        shown.object.visible = this.isOn(kindOf(shown.message, shape));
        this.paint(shown.object, shape);
      }
      this.attach(shown.anchor, "axes", () => new THREE.AxesHelper(AXES_LENGTH).setColors(...AXIS_COLORS));
      this.attach(shown.anchor, "names", () => label(name, 0));
    }
  }

  private isOn(kind: Option): boolean {
    return this.on.has(kind) && (kind === "solid" || !this.visualsOnly);
  }

  private paint(object: THREE.Object3D, shape: ShapeMessage): void {
    if (!(object instanceof THREE.Mesh) || object instanceof WideLines) return;
    const alpha = shape.color[3] ?? 1;
    const opacity = this.on.has("xray") ? Math.min(alpha, XRAY_OPACITY) : alpha;
    for (const material of materialsOf(object)) {
      material.needsUpdate = material.transparent !== opacity < 1;
      Object.assign(material, {
        wireframe: this.wireframe || this.on.has("wireframe"),
        transparent: opacity < 1,
        opacity,
        depthWrite: opacity === 1,
      });
    }
    object.castShadow = object.receiveShadow = opacity === 1;
  }

  private isHidden(shown: Shown, frames: ReadonlyMap<number, Shown>): boolean {
    for (let at: Shown | undefined = shown; at; at = frames.get(at.message.parent)) {
      if (this.hidden.has(at.message.name)) return true;
    }
    return false;
  }

  private attach(anchor: THREE.Object3D, option: Option, make: () => THREE.Object3D): void {
    const present = anchor.children.find((child) => child.userData.option === option);
    if (present) {
      present.visible = this.on.has(option);
    } else if (this.on.has(option)) {
      const object = make();
      object.userData.option = option;
      anchor.add(object);
    }
  }
}
