import * as THREE from "three";
import { TransformControls } from "three/addons/controls/TransformControls.js";
import { find, make } from "./element";
import type { JointEdits } from "./joint_edits";
import type { JointPanel } from "./joints";
import { moveFrameCommand } from "./messages";
import { Outline } from "./outline";
import type { Shown } from "./shown";
import type { Stage } from "./stage";

const HIGHLIGHT = 0x2f6fde;
type Handles = "translate" | "rotate" | "pull" | null;

const numbers = (values: number[], digits: number): string =>
  values.map((x) => (Math.abs(x) < 0.5 * 10 ** -digits ? 0 : x).toFixed(digits)).join(" ");
const KEYWORDS = new Set(["Include", "Prefix", "Edit", "Delete", "DeleteBranch", "ChDir", "Quit", "shape", "joint"]);
const isPlain = (name: string): boolean => /^[A-Za-z_][\w./-]*$/.test(name);
const quoted = (name: string): string => (isPlain(name) ? name : `"${name}"`);
/** Returns the name, or the closest one that a .g text can contain, as the program writes it. */
const expressible = (name: string): string => {
  const possible = name.replace(/[\s(),"']/g, "_");
  return KEYWORDS.has(possible) ? `${possible}_` : possible || "frame";
};
/** Returns the name of a frame's entry. With a parent behind it, a quoted name may have brackets. */
const entryName = (name: string, hasParent: boolean): string =>
  quoted(hasParent && !/[\s"]/.test(name) ? name : expressible(name));

interface Placement {
  position: THREE.Vector3;
  rotation: THREE.Quaternion;
}

const wxyz = (q: THREE.Quaternion): number[] => (q.w < 0 ? [-q.w, -q.x, -q.y, -q.z] : [q.w, q.x, q.y, q.z]);

/** The selected frame: its card, an outline, and handles to move it. */
export class Selection {
  private id: number | null = null;
  private handles: Handles = null;
  private readonly card = find("card");
  private readonly axes = new THREE.AxesHelper(0.15);
  private readonly outline: Outline;
  private readonly grip = new THREE.Object3D();
  private readonly controls: TransformControls;
  private moved = false;

  constructor(
    private readonly stage: Stage,
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly joints: JointPanel,
    private readonly edits: JointEdits,
    private readonly send: ((command: Uint8Array<ArrayBuffer>) => void) | null,
    private readonly onSelect: (id: number | null) => void,
    private readonly warningOf: (id: number) => string,
  ) {
    this.outline = new Outline(stage, frames, HIGHLIGHT, 1);
    this.controls = new TransformControls(stage.camera, stage.canvas);
    this.controls.size = 0.8;
    this.controls.addEventListener("change", () => stage.redraw());
    this.controls.addEventListener("objectChange", () => (this.moved = true));
    this.controls.addEventListener("dragging-changed", ({ value }) => (stage.viewpoint.controls.enabled = !value));
    stage.viewpoint.onCamera((camera) => (this.controls.camera = camera));
    stage.scene.add(this.grip, this.controls.getHelper(), this.axes);
    Object.assign(this.axes, { renderOrder: 1, visible: false });
    Object.assign(this.axes.material, { depthTest: false, transparent: true });
    stage.onTick(() => this.sendMove());
  }

  get selected(): number | null {
    return this.id;
  }

  /** True while the pointer is on a handle. */
  get isHeld(): boolean {
    return this.handles !== null && (this.controls.dragging || this.controls.axis !== null);
  }

  select(id: number | null, handles: Handles = null): void {
    if (this.id === id && handles === null) return;
    this.id = id;
    this.handles = handles;
    this.refresh();
    this.onSelect(id);
  }

  close(): void {
    this.select(null);
  }

  /** Call when frames have changed; after mere motion, `follow` is enough. */
  refresh(): void {
    if (this.id !== null && !this.frames.has(this.id)) this.id = null;
    if (this.id === null) this.handles = null;
    this.highlight();
    if (this.handles) {
      this.controls.attach(this.grip);
      this.controls.setMode(this.handles === "pull" ? "translate" : this.handles);
    } else {
      this.controls.detach();
    }
    this.showCard();
    this.follow();
    this.stage.redraw();
  }

  /** Call when frames have moved. */
  follow(): void {
    const shown = this.shown();
    if (!shown) return;
    this.axes.position.copy(shown.anchor.position);
    this.axes.quaternion.copy(shown.anchor.quaternion);
    if (!this.controls.dragging) {
      this.grip.position.copy(shown.anchor.position);
      this.grip.quaternion.copy(shown.anchor.quaternion);
    }
    this.showPoses();
  }

  /** Returns the frame as an entry of a `.g` file, with its present pose. */
  asText(): string {
    const shown = this.shown();
    if (!shown) return "";
    const { name, parent, details } = shown.message;
    const above = this.frames.get(parent);
    const { joints, q } = this.joints.current;
    const values = joints.flatMap((joint, i) => (joint.frame === this.id ? [Number((q[i] ?? 0).toFixed(6))] : []));
    const { position, rotation } = this.relative(shown);
    const pose = [...position.toArray(), ...wxyz(rotation)].map((x) => Number(x.toFixed(6)));
    const place = values.length > 0 ? `q: [${values.join(", ")}]` : `pose: [${pose.join(", ")}]`;
    const inside = above ? ` (${entryName(above.message.name, above.message.parent >= 0)})` : "";
    return `${entryName(name, above !== undefined)}${inside}: { ${[place, details].filter((x) => x !== "").join(", ")} }`;
  }

  private shown(): Shown | undefined {
    return this.id === null ? undefined : this.frames.get(this.id);
  }

  private relative(shown: Shown): Placement {
    const above = this.frames.get(shown.message.parent)?.anchor;
    const { position, quaternion } = shown.anchor;
    if (!above) return { position: position.clone(), rotation: quaternion.clone() };
    const back = above.quaternion.clone().invert();
    return {
      position: position.clone().sub(above.position).applyQuaternion(back),
      rotation: back.multiply(quaternion),
    };
  }

  /** Outlines the shape, and draws the frame's axes over everything. */
  private highlight(): void {
    this.axes.visible = this.id !== null;
    this.outline.show(this.id === null ? [] : [this.id]);
  }

  /** The card is where the frame is not: on the other side, or at the other end of narrow pages. */
  private avoid(shown: Shown): void {
    const { x, y } = shown.anchor.position.clone().project(this.stage.camera);
    const isNarrow = matchMedia("(max-width: 560px)").matches;
    this.card.classList.toggle("aside", isNarrow ? y < 0 : x < 0);
  }

  private showCard(): void {
    const shown = this.shown();
    this.card.hidden = !shown;
    if (!shown) return;
    this.avoid(shown);
    const { name, parent, details } = shown.message;
    const above = this.frames.get(parent)?.message.name;
    const row = (label: string, ...value: (Node | string)[]): Node[] => [
      make("dt", { textContent: label }),
      make("dd", {}, ...value),
    ];
    const handle = (mode: Handles & string, text: string): HTMLElement => {
      const button = make("button", { textContent: text, onclick: () => this.toggleHandles(mode) });
      button.ariaPressed = String(this.handles === mode);
      return button;
    };
    const warning = this.warningOf(shown.message.id);
    const copy = make("button", { textContent: "copy as .g", onclick: () => this.copy(copy) });
    this.card.replaceChildren(
      make(
        "header",
        {},
        make("b", { textContent: name }),
        make("button", { className: "close", textContent: "×", ariaLabel: "close", onclick: () => this.close() }),
      ),
      make(
        "dl",
        {},
        ...(above === undefined
          ? []
          : row("in", make("button", { className: "link", textContent: above, onclick: () => this.select(parent) }))),
        ...row("world", make("code", { id: "pose-world" })),
        ...(above === undefined ? [] : row("in parent", make("code", { id: "pose-parent" }))),
        ...(warning === "" ? [] : row("warning", make("span", { className: "warning", textContent: warning }))),
        ...(details === ""
          ? []
          : row(
              "is",
              make("code", {
                textContent: details
                  .replaceAll(", ", ",\n")
                  .replace(/\[[^\]]*\]/g, (list) => list.replaceAll(",\n", " ")),
              }),
            )),
      ),
      make(
        "div",
        { className: "buttons" },
        ...(this.send ? [handle("translate", "move"), handle("rotate", "turn")] : []),
        ...(this.edits.movesFrame(shown.message.id) ? [handle("pull", "pull")] : []),
        copy,
      ),
    );
  }

  private showPoses(): void {
    const shown = this.shown();
    if (!shown || this.card.hidden) return;
    const text = (p: THREE.Vector3, q: THREE.Quaternion): string =>
      `${numbers(p.toArray(), 4)}\n${numbers(wxyz(q), 4)}`;
    find("pose-world").textContent = text(shown.anchor.position, shown.anchor.quaternion);
    const { position, rotation } = this.relative(shown);
    const inParent = document.getElementById("pose-parent");
    if (inParent) inParent.textContent = text(position, rotation);
  }

  toggleHandles(handles: Handles): void {
    if (handles === "pull" ? this.id !== null && this.edits.movesFrame(this.id) : this.send)
      this.setHandles(this.handles === handles ? null : handles);
  }

  private setHandles(handles: Handles): void {
    this.handles = handles;
    this.refresh();
  }

  private copy(button: HTMLElement): void {
    const text = this.asText(), name = this.shown()?.message.name ?? "", written = entryName(name, this.shown()?.message.parent !== -1);
    const copied = navigator.clipboard?.writeText(text) ?? Promise.reject(new Error("no clipboard"));
    copied.then(
      () => (button.textContent = written === quoted(name) ? "copied" : `copied as ${written}`),
      () => prompt("copy this text", text),
    );
    setTimeout(() => (button.textContent = "copy as .g"), 1500);
  }

  /** Makes at most one edit per picture. With the handles to pull, the frame keeps its rotation if it can. */
  private sendMove(): void {
    if (!this.moved || this.id === null) return;
    this.moved = false;
    if (this.handles === "pull") {
      const { position, quaternion } = this.grip;
      return this.edits.reach({ frame: this.id, point: new THREE.Vector3(), target: position.clone(), rotation: quaternion.clone() });
    }
    if (!this.send) return;
    this.send(
      moveFrameCommand(this.joints.current.structure, this.id, [
        ...this.grip.position.toArray(),
        ...wxyz(this.grip.quaternion),
      ]),
    );
  }
}
