import { make } from "./element";
import type { Stage } from "./stage";

const REST = 60; // ms: the pointer moves no more
const BESIDE = 14; // pixels

/** Names the frame under a mouse that rests, and shows that a click selects it. */
export class Hover {
  private readonly tip = make("div", { id: "hover", hidden: true });
  private timer = 0;
  private at = { x: NaN, y: NaN }; // last place of the pointer

  constructor(
    private readonly stage: Stage,
    private readonly nameOf: (id: number) => string,
  ) {
    this.tip.ariaHidden = "true";
    document.body.append(this.tip);
    stage.canvas.addEventListener("pointermove", (event) => {
      if (event.clientX === this.at.x && event.clientY === this.at.y) return; // the page changed, not the pointer
      this.at = { x: event.clientX, y: event.clientY };
      this.hide();
      if (event.pointerType === "mouse" && event.buttons === 0) this.timer = setTimeout(() => this.show(event), REST);
    });
    for (const end of ["pointerleave", "pointerdown", "wheel"]) stage.canvas.addEventListener(end, () => this.hide(), { passive: true });
  }

  private hide(): void {
    clearTimeout(this.timer);
    this.tip.hidden = true;
    this.stage.canvas.classList.remove("over");
  }

  private show(event: PointerEvent): void {
    const hit = this.stage.pick(event);
    if (!hit) return;
    this.tip.textContent = this.nameOf(hit.id);
    this.tip.hidden = this.tip.textContent === "";
    this.stage.canvas.classList.add("over");
    const left = Math.min(event.clientX + BESIDE, innerWidth - this.tip.offsetWidth - 4);
    Object.assign(this.tip.style, { left: `${left}px`, top: `${event.clientY + BESIDE}px` });
  }
}
