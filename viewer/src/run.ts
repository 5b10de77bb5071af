import { ForceArrows } from "./arrows";
import { find, leaveRoomAbove, make } from "./element";
import { lengthText } from "./lengths";
import { runCommand, type RunMessage } from "./messages";
import { PerturbationTool } from "./perturbation";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

const Action = { pause: 1, goOn: 2, step: 3, reset: 4 } as const;

/** A simulation in the program: its time, contacts and forces, and buttons to control it. */
export class Run {
  readonly arrows: ForceArrows;
  readonly perturbation: PerturbationTool;
  private message: RunMessage | null = null;
  private motionIsShown = false;
  isPlayback = false; // of a recording, which has a time slider of its own
  private readonly root = find("run");
  private readonly playButton = make("button", { className: "play", onclick: () => this.toggle() });
  private readonly perturbButton = make("button", {
    textContent: "perturb",
    title: "drag a body: a spring moves it to the pointer",
    ariaPressed: "false",
    onclick: () => this.setPerturbing(!this.perturbation.on),
  });
  private readonly contactsBox = make("input", { type: "checkbox", checked: true, onchange: () => this.draw() });
  private readonly time = make("output", { className: "run-time" });
  private readonly factor = make("output", { className: "run-factor", title: "simulated seconds per second" });
  private readonly scale = make("output", { className: "run-scale" });
  private readonly steering: HTMLElement[]; // shown only for simulations that users can control

  /** `send` is null on a saved page, which has no controls. */
  constructor(
    private readonly stage: Stage,
    frames: ReadonlyMap<number, Shown>,
    private readonly send: ((command: Uint8Array<ArrayBuffer>) => void) | null,
  ) {
    this.perturbation = new PerturbationTool(stage, frames, (command) => send?.(command));
    this.arrows = new ForceArrows(stage, () => this.showScale());
    stage.scene.add(this.arrows.group);
    leaveRoomAbove(this.root);
    const request = (action: number) => (): void => send?.(runCommand(action));
    const buttons = [
      this.playButton,
      make("button", { textContent: "step", title: "one step of the simulation", onclick: request(Action.step) }),
      make("button", { textContent: "reset", title: "to the state in which it was first shown", onclick: request(Action.reset) }),
      this.perturbButton,
    ];
    this.steering = [...(send ? buttons : []), this.time, this.factor];
    this.root.append(
      make(
        "div",
        { className: "transport" },
        ...this.steering,
        make("label", {}, this.contactsBox, "contacts"),
        this.scale,
      ),
    );
  }

  get isShown(): boolean {
    return this.message !== null && !this.motionIsShown;
  }

  get isPaused(): boolean {
    return this.message !== null && this.message.paused !== 0;
  }

  read(message: RunMessage): void {
    this.message = message.shown !== 0 ? message : null;
    this.draw();
  }

  /** Hides the simulation while a motion is shown. */
  setMotion(shown: boolean): void {
    this.motionIsShown = shown;
    this.draw();
  }

  end(): void {
    this.message = null;
    this.draw();
  }

  toggle(): void {
    if (this.isShown && this.message?.steered) this.send?.(runCommand(this.isPaused ? Action.goOn : Action.pause));
  }

  private setPerturbing(on: boolean): void {
    this.perturbation.on = on;
    this.perturbButton.ariaPressed = String(on);
  }

  private draw(): void {
    const { message } = this;
    this.root.hidden = !this.isShown || this.isPlayback;
    document.body.classList.toggle("has-run", !this.root.hidden);
    if (!message || this.motionIsShown) {
      this.arrows.group.visible = false;
      this.perturbation.show([]);
      if (!message) this.setPerturbing(false);
      return this.stage.redraw();
    }
    for (const element of this.steering) element.hidden = message.steered === 0;
    this.playButton.textContent = this.isPaused ? "▶" : "❚❚";
    this.playButton.ariaLabel = this.isPaused ? "go on" : "pause";
    this.time.textContent = `${message.time.toFixed(2)} s`;
    const factor = message.factor < 10 ? message.factor.toFixed(2) : message.factor.toPrecision(2);
    this.factor.textContent = this.isPaused ? "paused" : message.factor > 0 ? `${Number(factor)}×` : "";
    this.arrows.group.visible = this.contactsBox.checked;
    this.arrows.show(message.contacts);
    this.showScale();
    this.perturbation.show(message.perturbation);
    this.stage.redraw();
  }

  private showScale(): void {
    const { scale, measure, count } = this.arrows;
    this.scale.textContent = count > 0 ? `${lengthText(measure)} of arrow: ${Number((measure / scale).toPrecision(2))} N` : "";
  }
}
