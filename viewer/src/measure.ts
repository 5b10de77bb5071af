import * as THREE from "three";
import { find } from "./element";
import type { Hit, Stage } from "./stage";

const COLOR = 0xd9480f;

/** Measures the distance of two clicked points. */
export class Measure {
  on = false;
  private readonly button = find("measure-button");
  private readonly points: THREE.Vector3[] = [];
  private readonly drawn = new THREE.Group();

  constructor(private readonly stage: Stage) {
    stage.scene.add(this.drawn);
    this.button.addEventListener("click", () => this.toggle());
  }

  toggle(): void {
    this.on = !this.on;
    this.button.ariaPressed = String(this.on);
    this.points.length = 0;
    this.show();
  }

  click(hit: Hit | null): void {
    if (!hit) return;
    if (this.points.length === 2) this.points.length = 0;
    this.points.push(hit.point.clone());
    this.show();
  }

  private show(): void {
    const [a, b] = this.points;
    this.drawn.clear();
    for (const point of this.points) {
      const ball = new THREE.Mesh(
        new THREE.SphereGeometry(0.008, 16, 12),
        new THREE.MeshBasicMaterial({ color: COLOR, depthTest: false }),
      );
      ball.position.copy(point);
      this.drawn.add(ball);
    }
    const text = find("measure");
    text.hidden = !this.on;
    text.textContent = "click two points to measure between them (Esc ends)";
    if (a && b) {
      this.drawn.add(
        new THREE.Line(
          new THREE.BufferGeometry().setFromPoints([a, b]),
          new THREE.LineBasicMaterial({ color: COLOR, depthTest: false }),
        ),
      );
      const d = b.clone().sub(a);
      text.textContent = `${d.length().toFixed(4)} m   (x ${d.x.toFixed(4)}, y ${d.y.toFixed(4)}, z ${d.z.toFixed(4)})`;
    }
    this.stage.redraw();
  }
}
