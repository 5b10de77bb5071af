import { Vector3 } from "three";
import type { Stage } from "./stage";
import type { Timeline } from "./timeline";

interface Word {
  kinegraph: { time?: number; camera?: number[] };
}

/** Keeps this page in step with another run, in a page around both: it passes on the time and the camera. */
export class Companion {
  private listens = false; // follows the other run, and does not answer

  constructor(
    private readonly stage: Stage,
    private readonly timeline: Timeline,
  ) {
    if (window.parent === window) return;
    timeline.onTime((time) => this.say({ time }));
    stage.onMove(() => this.say({ camera: [...stage.camera.position.toArray(), ...stage.viewpoint.target.toArray()] }));
    addEventListener("message", ({ source, data }) => {
      if (source === window.parent && typeof (data as Word | null)?.kinegraph === "object") this.follow((data as Word).kinegraph);
    });
  }

  private say(kinegraph: Word["kinegraph"]): void {
    if (!this.listens) window.parent.postMessage({ kinegraph }, "*");
  }

  private follow({ time, camera }: Word["kinegraph"]): void {
    this.listens = true;
    if (typeof time === "number" && Number.isFinite(time)) this.timeline.showAt(time / this.timeline.pace);
    if (Array.isArray(camera) && camera.length === 6 && camera.every(Number.isFinite)) {
      this.stage.keepCamera();
      this.stage.viewpoint.lookFrom(new Vector3().fromArray(camera), new Vector3().fromArray(camera, 3));
      this.stage.redraw();
    }
    this.listens = false;
  }
}
