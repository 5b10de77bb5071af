import * as THREE from "three";
import { find, make } from "./element";
import { materialsOf } from "./shapes";
import type { Stage } from "./stage";

type Axis = "x" | "y" | "z";
const AXES: readonly Axis[] = ["x", "y", "z"];

/** Cuts the scene open: shapes are drawn on one side of a plane only. */
export class Section {
  private axis: Axis | null = null;
  private readonly plane = new THREE.Plane();
  private readonly cut: THREE.Plane[] = []; // shared by the materials
  private readonly buttons = AXES.map((axis) => make("button", { textContent: axis, title: `cut across ${axis}`, ariaPressed: "false", onclick: () => this.choose(axis) }));
  private readonly flip = make("input", { type: "checkbox", onchange: () => this.place() });
  private readonly slider = make("input", { type: "range", min: "0", max: "1", step: "any", value: "0.5", ariaLabel: "place of the cut" });
  private readonly output = make("output");
  private readonly details = make("div", { hidden: true, className: "section" }, this.slider, this.output, make("label", {}, this.flip, "other side"));

  constructor(private readonly stage: Stage) {
    find("section").append(make("div", { className: "buttons" }, ...this.buttons), this.details);
    this.slider.addEventListener("input", () => this.place());
    stage.onDraw(() => this.apply());
  }

  private choose(axis: Axis): void {
    this.axis = this.axis === axis ? null : axis;
    this.buttons.forEach((button, i) => (button.ariaPressed = String(AXES[i] === this.axis)));
    this.details.hidden = this.axis === null;
    this.place();
  }

  private place(): void {
    const { axis } = this;
    this.cut.length = 0;
    if (axis) {
      const { min, max } = this.stage.bounds();
      const at = min[axis] + this.slider.valueAsNumber * (max[axis] - min[axis]), sign = this.flip.checked ? 1 : -1;
      this.plane.set(new THREE.Vector3().setComponent(AXES.indexOf(axis), sign), -sign * at);
      this.output.textContent = `${axis} = ${at.toFixed(3)} m`;
      this.cut.push(this.plane);
    }
    this.stage.cut = axis ? this.plane : null;
    this.stage.redraw();
  }

  /** Inside a cut shape, its back faces are seen. */
  private apply(): void {
    const planes = this.axis ? this.cut : null;
    for (const root of this.stage.shapes) {
      root.traverse((object) => {
        if (!(object instanceof THREE.Mesh)) return;
        for (const material of materialsOf(object)) {
          if (material.clippingPlanes === planes) continue;
          const before = material.userData.side as THREE.Side | undefined;
          material.userData.side = before ?? material.side;
          Object.assign(material, { clippingPlanes: planes, side: planes ? THREE.DoubleSide : (before ?? material.side), needsUpdate: true });
        }
      });
    }
  }
}
