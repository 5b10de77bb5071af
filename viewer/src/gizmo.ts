import * as THREE from "three";
import { make } from "./element";
import { AXIS_COLORS } from "./shapes";
import type { Stage } from "./stage";

const SIZE = 84,
  REACH = 30; // pixels: of the picture, and of an axis
const AXES = ["x", "y", "z"] as const;

/** The world's axes as the camera sees them. A click on one looks along it. */
export class Gizmo {
  private readonly root = make("nav", { id: "gizmo", ariaLabel: "Directions" });
  private readonly canvas = make("canvas", { width: 2 * SIZE, height: 2 * SIZE });
  private readonly ends: { button: HTMLButtonElement; direction: THREE.Vector3 }[];

  constructor(private readonly stage: Stage) {
    this.ends = AXES.flatMap((name, axis) =>
      [1, -1].map((sign) => {
        const direction = new THREE.Vector3().setComponent(axis, sign);
        const title = `look from ${sign > 0 ? "+" : "−"}${name}`;
        const button = make("button", { textContent: sign > 0 ? name : "", title, ariaLabel: title, onclick: () => this.look(direction) });
        button.style.setProperty("--color", `#${AXIS_COLORS[axis]!.toString(16)}`);
        button.classList.toggle("back", sign < 0);
        return { button, direction };
      }),
    );
    this.root.append(this.canvas, ...this.ends.map(({ button }) => button));
    document.body.append(this.root);
    stage.onDraw(() => this.draw());
  }

  /** From above and below, x points to the right. */
  private look(direction: THREE.Vector3): void {
    const tilt = direction.z !== 0 ? new THREE.Vector3(0, -0.001, 0) : new THREE.Vector3(0, 0, 0.001);
    this.stage.lookAlong(direction.clone().add(tilt));
  }

  private draw(): void {
    const context = this.canvas.getContext("2d")!;
    context.setTransform(2, 0, 0, 2, SIZE, SIZE);
    context.clearRect(-SIZE, -SIZE, 2 * SIZE, 2 * SIZE);
    context.lineWidth = 2;
    const back = this.stage.camera.quaternion.clone().invert();
    this.ends.forEach(({ button, direction }, i) => {
      const at = direction.clone().applyQuaternion(back).multiplyScalar(REACH);
      button.style.left = `${SIZE / 2 + at.x}px`;
      button.style.top = `${SIZE / 2 - at.y}px`;
      button.style.zIndex = String(Math.round(REACH + at.z));
      if (i % 2 === 1) return;
      context.strokeStyle = `#${AXIS_COLORS[i / 2]!.toString(16)}`;
      context.beginPath();
      context.moveTo(0, 0);
      context.lineTo(at.x, -at.y);
      context.stroke();
    });
  }
}
