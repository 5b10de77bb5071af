import { Vector3 } from "three";
import { find, make } from "./element";
import type { Stage } from "./stage";
import type { Timeline } from "./timeline";

const DIGITS = 4;

/** Addresses of a view and a moment: #camera=x,y,z,x,y,z (camera and its target, m) and #time=s. */
export class Link {
  private time: number | null = null; // s; of a motion that has not arrived yet

  constructor(
    private readonly stage: Stage,
    private readonly timeline: Timeline,
  ) {
    const button = make("button", { textContent: "link", title: "copies the address of this view and moment", onclick: () => void this.copy(button) });
    find("exports").append(button);
    addEventListener("hashchange", () => this.follow());
    this.follow();
  }

  /** Call when a motion has started. */
  seek(): void {
    if (this.time === null || !this.timeline.current) return;
    this.timeline.showAt(this.time / this.timeline.pace);
    this.time = null;
  }

  /** Whether the address has a camera, which takes precedence. */
  get hasCamera(): boolean {
    return location.hash.includes("camera=");
  }

  get text(): string {
    const { camera, viewpoint } = this.stage;
    const numbers = [...camera.position.toArray(), ...viewpoint.target.toArray()].map((x) => Number(x.toFixed(DIGITS)));
    const time = this.timeline.current ? `&time=${Number(this.timeline.time.toFixed(DIGITS))}` : "";
    return `${location.href.split("#")[0]}#camera=${numbers.join(",")}${this.stage.isOrthographic ? "&flat" : ""}${time}`;
  }

  private follow(): void {
    const wanted = new URLSearchParams(location.hash.slice(1));
    const camera = (wanted.get("camera") ?? "").split(",").map(Number);
    if (camera.length === 6 && camera.every(Number.isFinite)) {
      this.stage.keepCamera();
      this.stage.viewpoint.lookFrom(new Vector3().fromArray(camera), new Vector3().fromArray(camera, 3));
      this.stage.setOrthographic(wanted.has("flat"));
      this.stage.redraw();
    }
    const time = wanted.has("time") ? Number(wanted.get("time")) : NaN;
    this.time = Number.isFinite(time) ? time : null;
    this.seek();
  }

  private async copy(button: HTMLButtonElement): Promise<void> {
    try {
      await navigator.clipboard.writeText(this.text);
      button.textContent = "copied";
      setTimeout(() => (button.textContent = "link"), 1500);
    } catch {
      prompt("copy this address", this.text);
    }
  }
}
