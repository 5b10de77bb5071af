import type { Stage } from "./stage";
import { find } from "./element";

/** The tools above the picture that need no panel; measuring and pulling have buttons of their own. */
export class Toolbar {
  private readonly flat = find("flat-button");

  constructor(private readonly stage: Stage) {
    find("fit-button").addEventListener("click", () => this.fit());
    this.flat.addEventListener("click", () => stage.setOrthographic(!stage.isOrthographic));
    stage.onDraw(() => (this.flat.ariaPressed = String(stage.isOrthographic)));
  }

  /** Shows the whole scene from the present direction. */
  fit(): void {
    this.stage.lookAlong(this.stage.camera.position.clone().sub(this.stage.viewpoint.target));
  }
}
