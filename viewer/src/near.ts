import { nearCommand, type NearMessage } from "./messages";
import { PairLines } from "./pairs";
import type { Stage } from "./stage";

export const MARGIN = 0.05; // m

/** Lines between near shapes, with the distance, on request of users. */
export class NearLines {
  private on = false;
  private structure = 0;
  private readonly pairs: PairLines;

  constructor(
    private readonly stage: Stage,
    private readonly send: (command: Uint8Array<ArrayBuffer>) => void,
  ) {
    this.pairs = new PairLines(stage, false);
    this.pairs.visible = false;
  }

  get count(): number {
    return this.pairs.count.all;
  }

  /** Call with every structure of the scene; the lines are requested again. */
  setStructure(structure: number): void {
    this.structure = structure;
    this.request();
  }

  show(on: boolean): void {
    if (this.on === on) return;
    this.on = on;
    this.request();
    this.apply(true);
  }

  /** `live`: false while a motion is shown, because the lines do not apply to it. */
  apply(live: boolean): void {
    this.pairs.visible = this.on && live;
    this.stage.redraw();
  }

  read({ lines }: NearMessage): void {
    this.pairs.show(lines);
    this.stage.redraw();
  }

  private request(): void {
    if (this.on) this.send(nearCommand(this.structure, MARGIN));
  }
}
