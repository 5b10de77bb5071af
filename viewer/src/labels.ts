import * as THREE from "three";
import { CSS2DObject, CSS2DRenderer } from "three/addons/renderers/CSS2DRenderer.js";
import { make } from "./element";

const LETTER = 6.4,
  AROUND = 8,
  HEIGHT = 17; // pixels: approximate height of a label

/** Creates a label at a place of the scene. If labels overlap, only the one with the highest rank is shown, or else
 * the nearest. */
export function label(text: string, rank: number, className = "name"): CSS2DObject {
  const object = new CSS2DObject(make("span", { className, textContent: text }));
  object.userData.rank = rank;
  return object;
}

interface Placed {
  object: CSS2DObject;
  at: THREE.Vector3; // x and y in pixels; z increases with the distance
  width: number;
}

/** Draws labels over the scene. */
export class Labels {
  private readonly renderer = new CSS2DRenderer();
  private size = new THREE.Vector2();

  constructor(canvas: HTMLCanvasElement) {
    this.renderer.domElement.className = "labels";
    canvas.after(this.renderer.domElement);
  }

  setSize(width: number, height: number): void {
    this.size.set(width, height);
    this.renderer.setSize(width, height);
  }

  render(scene: THREE.Scene, camera: THREE.Camera): void {
    this.renderer.render(scene, camera);
    const labels: Placed[] = [];
    scene.traverseVisible((object) => {
      if (!(object instanceof CSS2DObject)) return;
      const at = object.getWorldPosition(new THREE.Vector3()).project(camera);
      if (Math.abs(at.z) > 1) return;
      at.x *= this.size.x / 2;
      at.y *= this.size.y / 2;
      labels.push({ object, at, width: LETTER * object.element.textContent!.length + AROUND });
    });
    labels.sort((a, b) => b.object.userData.rank - a.object.userData.rank || a.at.z - b.at.z);
    const seen: Placed[] = [];
    for (const one of labels) {
      const isFree = seen.every(
        ({ at, width }) => Math.abs(at.x - one.at.x) > (width + one.width) / 2 || Math.abs(at.y - one.at.y) > HEIGHT,
      );
      one.object.element.style.visibility = isFree ? "" : "hidden";
      if (isFree) seen.push(one);
    }
  }
}
