import { keyCode, modifiersOf } from "./keys";
import { cursorCommand, eventCommand } from "./messages";
import type { Stage } from "./stage";

const Kind = { keyDown: 1, keyUp: 2, clickDown: 3, clickUp: 4, scroll: 5, modifier: 6 } as const;
const MODIFIERS = ["Shift", "Control", "Alt"];

/** Sends mouse and key events to the program, if it requested them. */
export class InputEvents {
  private requested = 0; // 1: events; 2: and no other effect on the page
  private cursorRequested = false;
  private pointer: PointerEvent | null = null; // the last event that moved the pointer since the last picture

  constructor(
    private readonly stage: Stage,
    private readonly send: (command: Uint8Array<ArrayBuffer>) => void,
  ) {
    const { canvas } = stage;
    const button =
      (kind: number) =>
      (event: PointerEvent): void =>
        this.report(kind, event.button, 0);
    canvas.addEventListener("pointerdown", button(Kind.clickDown));
    canvas.addEventListener("pointerup", button(Kind.clickUp));
    canvas.addEventListener("wheel", (event) => this.report(Kind.scroll, event.deltaY < 0 ? 1 : -1, 0), {
      passive: true,
    });
    canvas.addEventListener("pointermove", (event) => (this.pointer = event));
    addEventListener("keydown", (event) => this.key(Kind.keyDown, event));
    addEventListener("keyup", (event) => this.key(Kind.keyUp, event));
    stage.onTick(() => this.follow());
  }

  /** True if mouse and keys are reserved for the program. */
  get blocks(): boolean {
    return this.requested === 2;
  }

  setRequested(events: number, cursor: boolean): void {
    this.requested = events;
    this.cursorRequested = cursor;
    this.stage.viewpoint.controls.enabled = !this.blocks;
  }

  private report(kind: number, code: number, modifiers: number): void {
    if (this.requested > 0) this.send(eventCommand(kind, code, modifiers));
  }

  private key(kind: number, event: KeyboardEvent): void {
    if (event.repeat) return;
    if (MODIFIERS.includes(event.key)) return this.report(Kind.modifier, 0, modifiersOf(event));
    const code = keyCode(event);
    if (code > 0) this.report(kind, code, modifiersOf(event));
  }

  private follow(): void {
    if (!this.cursorRequested || !this.pointer) return;
    const hit = this.stage.pick(this.pointer);
    this.pointer = null;
    if (hit) this.send(cursorCommand(hit.id, hit.point.toArray(), hit.normal.toArray()));
    else this.send(cursorCommand(-1, [], []));
  }
}
