import { find, make } from "./element";
import type { JointEdits, JointState } from "./joint_edits";
import type { JointMessage, JointsMessage, MovingMessage } from "./messages";

const HALF_TURN = Math.PI; // rad: range to each side of dofs without limits
const REACH = 1; // m, also for dofs without unit

interface Row {
  slider: HTMLInputElement;
  number: HTMLInputElement;
}

/** The dofs, each with a slider and a number. */
export class JointPanel {
  private structure = 0;
  private joints: JointMessage[] = [];
  private moving: MovingMessage[] = [];
  private q: ArrayLike<number> = [];
  private shown: ArrayLike<number> = []; // at the present time of a motion, or q
  private rows: Row[] = [];
  private readonly list = make("div", { id: "joint-rows" });
  private readonly waiting = new Map<number, number>(); // dof -> value, sent with the next picture

  constructor(private readonly edits: () => JointEdits) {
    const button = (text: string, title: string, act: (edits: JointEdits) => void): HTMLElement =>
      make("button", { textContent: text, title, onclick: () => act(edits()) });
    find("tab-joints").append(
      make(
        "div",
        { className: "buttons" },
        button("reset", "to where the joints are at home", (to) => to.reset()),
        button("random", "anywhere within the limits", (to) => to.random()),
        button("undo", "the last edit of joints or frames (Ctrl Z)", (to) => to.undo()),
        button("redo", "what was undone (Ctrl Y)", (to) => to.redo()),
      ),
      this.list,
    );
  }

  /** The joint values of the program. */
  get current(): JointState {
    return { structure: this.structure, joints: this.joints, moving: this.moving, q: this.q };
  }

  /** The joint values of the picture, which may show a time of a motion. */
  get pictured(): JointState {
    return { ...this.current, q: this.shown };
  }

  /** Undoes the last edit of joints or frames, or does it again. */
  undo(again: boolean): void {
    if (again) this.edits().redo();
    else this.edits().undo();
  }

  setJoints({ structure, joints, moving }: JointsMessage): void {
    this.structure = structure;
    this.joints = joints;
    this.moving = moving;
    this.waiting.clear();
    this.rows = joints.map((joint, i) => this.makeRow(joint, i));
    if (joints.length === 0) this.list.replaceChildren("no joints");
    this.showState(this.q);
  }

  /** Shows joint values of the program, or of one time of a motion. */
  showState(q: ArrayLike<number>): void {
    this.shown = q;
    this.rows.forEach(({ slider, number }, i) => {
      const value = q[i] ?? 0;
      if (document.activeElement !== slider || !this.waiting.has(i)) slider.value = String(value);
      slider.ariaValueText = `${value.toFixed(3)} ${this.joints[i]!.unit}`;
      if (document.activeElement !== number) number.value = value.toFixed(3);
    });
  }

  setState(q: ArrayLike<number>): void {
    this.q = q;
    this.showState(q);
  }

  private makeRow(joint: JointMessage, index: number): Row {
    const limited = joint.lower <= joint.upper;
    const reach = joint.unit === "rad" ? HALF_TURN : REACH;
    const middle = this.q[index] ?? 0;
    const [min, max] = limited
      ? [joint.lower, joint.upper]
      : [Math.min(-reach, middle - reach), Math.max(reach, middle + reach)];
    const slider = make("input", {
      type: "range",
      min: String(min),
      max: String(max),
      step: "any",
      ariaLabel: joint.name,
    });
    slider.addEventListener("input", () => this.request(index, slider.valueAsNumber));
    const number = make("input", {
      type: "number",
      min: String(min),
      max: String(max),
      step: "0.01",
      ariaLabel: `${joint.name}, value`,
    });
    const warning = make("span", { className: "warning", hidden: true });
    warning.setAttribute("role", "alert");
    number.addEventListener("change", () => {
      const requested = number.valueAsNumber;
      if (!Number.isFinite(requested)) return;
      const taken = limited ? Math.max(joint.lower, Math.min(requested, joint.upper)) : requested;
      warning.hidden = taken === requested;
      warning.textContent = `${requested} is beyond the limit ${taken} ${joint.unit}, which is taken`;
      number.value = taken.toFixed(3);
      this.request(index, taken);
    });
    slider.addEventListener("input", () => (warning.hidden = true));
    const limits = limited ? `${joint.lower} to ${joint.upper} ${joint.unit}` : "without limits";
    if (index === 0) this.list.replaceChildren();
    this.list.append(
      make(
        "div",
        { className: "joint", title: `${joint.name}: ${limits}` },
        make("span", { className: "joint-name", textContent: joint.name }),
        number,
        make("span", { className: "unit", textContent: joint.unit }),
        slider,
        warning,
      ),
    );
    return { slider, number };
  }

  /** Makes at most one edit per picture. */
  private request(index: number, value: number): void {
    if (this.waiting.size === 0) requestAnimationFrame(() => this.flush());
    this.waiting.set(index, value);
  }

  private flush(): void {
    this.edits().set(new Map(this.waiting));
    this.waiting.clear();
  }
}
