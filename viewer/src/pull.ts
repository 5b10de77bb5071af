import { Vector3 } from "three";
import { find } from "./element";
import type { JointEdits } from "./joint_edits";
import { PointDrag } from "./point_drag";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

/** Lets the pointer drag links: inverse kinematics moves the joints such that the taken point follows. */
export class Pull {
  on = false;
  private readonly button = find("pull-button");
  private readonly drag: PointDrag;
  private waiting: (() => void) | null = null; // the latest goal, for the next picture

  /** `isPossible`: whether the page shows a scene whose joints users may move. */
  constructor(
    stage: Stage,
    frames: ReadonlyMap<number, Shown>,
    edits: () => JointEdits,
    isPossible: () => boolean,
  ) {
    this.button.addEventListener("click", () => this.toggle());
    this.drag = new PointDrag(stage, frames, {
      takes: (event, id) => this.on && !event.ctrlKey && isPossible() && edits().movesFrame(id),
      moved: (frame, point, target) => {
        const goal = { frame, point: new Vector3().copy(point), target: new Vector3().copy(target), rotation: null };
        this.waiting = () => edits().reach(goal);
      },
      ended: () => this.work(),
    });
    stage.onTick(() => this.work());
  }

  get isHolding(): boolean {
    return this.drag.isHolding;
  }

  toggle(): void {
    this.on = !this.on;
    this.button.ariaPressed = String(this.on);
  }

  private work(): void {
    this.waiting?.();
    this.waiting = null;
  }
}
