import { keyCode, modifiersOf } from "./keys";
import { cursorCommand, eventCommand } from "./messages";
import type { Stage } from "./stage";

const What = { keyDown: 1, keyUp: 2, clickDown: 3, clickUp: 4, scroll: 5, modifier: 6 } as const;
const MODIFIERS = ["Shift", "Control", "Alt"];

/** Tells the program what people do with mouse and keys, if it wants to know. */
export class InputEvents {
  private wanted = 0; // 1: events; 2: and nothing else happens
  private cursorWanted = false;
  private pointer: PointerEvent | null = null; // has moved since the last picture

  constructor(
    private readonly stage: Stage,
    private readonly send: (command: Uint8Array<ArrayBuffer>) => void,
  ) {
    const { canvas } = stage;
    const button =
      (what: number) =>
      (event: PointerEvent): void =>
        this.tell(what, event.button, 0);
    canvas.addEventListener("pointerdown", button(What.clickDown));
    canvas.addEventListener("pointerup", button(What.clickUp));
    canvas.addEventListener("wheel", (event) => this.tell(What.scroll, event.deltaY < 0 ? 1 : -1, 0), {
      passive: true,
    });
    canvas.addEventListener("pointermove", (event) => (this.pointer = event));
    addEventListener("keydown", (event) => this.key(What.keyDown, event));
    addEventListener("keyup", (event) => this.key(What.keyUp, event));
    stage.onTick(() => this.follow());
  }

  /** True if mouse and keys are for the program alone. */
  get blocks(): boolean {
    return this.wanted === 2;
  }

  setWanted(events: number, cursor: boolean): void {
    this.wanted = events;
    this.cursorWanted = cursor;
    this.stage.viewpoint.controls.enabled = !this.blocks;
  }

  private tell(what: number, code: number, modifiers: number): void {
    if (this.wanted > 0) this.send(eventCommand(what, code, modifiers));
  }

  private key(what: number, event: KeyboardEvent): void {
    if (event.repeat) return;
    if (MODIFIERS.includes(event.key)) return this.tell(What.modifier, 0, modifiersOf(event));
    const code = keyCode(event);
    if (code > 0) this.tell(what, code, modifiersOf(event));
  }

  private follow(): void {
    if (!this.cursorWanted || !this.pointer) return;
    const hit = this.stage.pick(this.pointer);
    this.pointer = null;
    if (hit) this.send(cursorCommand(hit.id, hit.point.toArray(), hit.normal.toArray()));
    else this.send(cursorCommand(-1, [], []));
  }
}
