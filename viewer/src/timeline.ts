import * as THREE from "three";
import { find, leaveRoomAbove, make } from "./element";
import type { JointPanel } from "./joints";
import { Lanes } from "./lanes";
import { Marks } from "./marks";
import type { LinesMessage } from "./messages";
import { Motion } from "./motion";
import { PairLines } from "./pairs";
import { colorOf, type Curve, drawCurves, drawViolations, isViolated } from "./plot";
import { scrub } from "./scrub";
import { materialsOf } from "./shapes";
import type { ShownScene } from "./shown";
import type { Stage } from "./stage";

type Plotted = "joints" | "errors" | "lanes" | null;
const PLOTTED = ["joints", "errors", "lanes"] as const;
const NOWHERE: LinesMessage = { points: [], distances: [], names: [] };
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 4];

/** Plays a motion: a bar with a time slider, speed, curves of the joints, and all slices at once. */
export class Timeline {
  private motion: Motion | null = null;
  private moment = 0; // slice, plus the fraction to the next
  private playing = false;
  private speed = 1;
  private loop = false;
  private ghosts: THREE.Group | null = null;
  private plotted: Plotted = null;
  private curvesShown: Curve[] = [];
  private readonly timeListeners: ((seconds: number) => void)[] = [];
  private readonly marked: Marks;
  private readonly touching: PairLines;
  private readonly root = find("motion");
  private readonly playButton = make("button", { className: "play", ariaLabel: "play", onclick: () => this.toggle() });
  private readonly slider = make("input", { type: "range", min: "0", step: "any", ariaLabel: "time" });
  private readonly clock = make("output");
  private readonly text = make("pre", { className: "slice-text" });
  private readonly marks = make("canvas", { className: "marks" });
  private readonly curves = make("canvas", { className: "curves" });
  private readonly plot = make("div", { className: "plot", hidden: true });
  private readonly legend = make("div", { className: "legend" });
  private readonly plotBoxes = {
    joints: make("input", {
      type: "checkbox",
      onchange: () => this.setPlotted(this.plotBoxes.joints.checked ? "joints" : null),
    }),
    errors: make("input", {
      type: "checkbox",
      onchange: () => this.setPlotted(this.plotBoxes.errors.checked ? "errors" : null),
    }),
    lanes: make("input", {
      type: "checkbox",
      onchange: () => this.setPlotted(this.plotBoxes.lanes.checked ? "lanes" : null),
    }),
  };
  private readonly errorsLabel = make("label", {}, this.plotBoxes.errors, "errors");
  private readonly lanesLabel = make("label", {}, this.plotBoxes.lanes, "objectives");
  private readonly readout = make("output", { className: "readout" });
  private readonly lanes = new Lanes((part) => this.seek(part), (text) => this.say(text));
  private readonly ghostBox = make("input", {
    type: "checkbox",
    onchange: () => this.showGhosts(this.ghostBox.checked),
  });

  constructor(
    private readonly stage: Stage,
    private readonly shown: ShownScene,
    private readonly joints: JointPanel,
    private readonly moved: () => void,
  ) {
    const speed = make(
      "select",
      { ariaLabel: "speed" },
      ...SPEEDS.map((x) => make("option", { value: String(x), textContent: `${x}×`, selected: x === 1 })),
    );
    speed.addEventListener("change", () => (this.speed = Number(speed.value)));
    const loopBox = make("input", { type: "checkbox", onchange: () => (this.loop = loopBox.checked) });
    this.marked = new Marks(stage, shown.frames);
    this.touching = new PairLines(stage, true);
    this.slider.addEventListener("input", () => this.goTo(this.slider.valueAsNumber));
    this.plot.append(this.lanes.root, this.curves, this.legend, this.readout);
    scrub(this.curves, (part) => this.seek(part), (part) => this.say(part === null ? "" : this.valuesAt(part)));
    this.root.append(
      this.text,
      this.plot,
      make(
        "div",
        { className: "transport" },
        this.playButton,
        make("div", { className: "track" }, this.marks, this.slider),
        this.clock,
        speed,
        make("label", {}, loopBox, "loop"),
        make("label", {}, this.ghostBox, "all slices"),
        make("label", {}, this.plotBoxes.joints, "curves"),
        this.errorsLabel,
        this.lanesLabel,
      ),
    );
    stage.onTick((seconds) => this.advance(seconds));
    stage.canvas.addEventListener(
      "wheel",
      (event) => {
        if (!event.shiftKey || !this.motion) return;
        event.preventDefault();
        event.stopImmediatePropagation();
        this.step(Math.sign(event.deltaY || event.deltaX));
      },
      { capture: true, passive: false },
    );
    addEventListener("resize", () => this.draw());
    leaveRoomAbove(this.root);
  }

  get current(): Motion | null {
    return this.motion;
  }

  /** Numbers slices before the path negatively. */
  get slice(): number {
    return this.moment - (this.motion?.message.prefix ?? 0);
  }

  get markCount(): number {
    return this.marked.count;
  }

  /** Pairs of shapes that violate a constraint in this slice, and the number of them in contact. */
  get pairCount(): { all: number; touching: number } {
    return this.touching.count;
  }

  get isPlaying(): boolean {
    return this.playing;
  }

  start(motion: Motion): void {
    this.end();
    this.motion = motion;
    this.shown.held = true;
    this.root.hidden = false;
    document.body.classList.add("has-motion");
    this.slider.max = String(motion.slices - 1);
    this.errorsLabel.hidden = this.lanesLabel.hidden = motion.message.traces.length === 0;
    this.lanes.show(motion.message.traces);
    this.setPlotted(this.plotted !== "joints" && this.errorsLabel.hidden ? null : this.plotted);
    const { start, first } = motion.message;
    this.showGhosts(start === "all");
    this.setPlaying(start === "play");
    this.goTo(start === "all" ? motion.slices - 1 : first);
  }

  end(): void {
    if (!this.motion) return;
    this.showGhosts(false);
    this.setPlaying(false);
    this.marked.show([]);
    this.touching.clear();
    this.motion = null;
    this.shown.held = false;
    this.root.hidden = true;
    document.body.classList.remove("has-motion");
    this.shown.placeAll();
    this.joints.showState(this.joints.current.q);
    this.moved();
  }

  /** Handles Space, which plays and pauses, and the arrow keys, which step through slices; returns whether the key was
   * for the motion. */
  takeKey(key: string): boolean {
    if (!this.motion || ![" ", "ArrowLeft", "ArrowRight"].includes(key)) return false;
    if (key === " ") return this.toggle(), true;
    this.step(key === "ArrowLeft" ? -1 : 1);
    return true;
  }

  toggle(): void {
    if (!this.motion) return;
    if (!this.playing && this.moment >= this.motion.slices - 1) this.goTo(0);
    this.setPlaying(!this.playing);
  }

  pause(): void {
    this.setPlaying(false);
  }

  /** Time of the picture since the motion's start, s. */
  get time(): number {
    if (!this.motion) return 0;
    return (this.moment / Math.max(this.motion.slices - 1, 1)) * this.motion.message.seconds;
  }

  /** Seconds of the motion per second. */
  get pace(): number {
    return this.speed;
  }

  /** Duration at the chosen speed, s. */
  get seconds(): number {
    return this.motion ? this.motion.message.seconds / this.speed : 0;
  }

  /** Shows the motion at a time since its start, s at the chosen speed. */
  showAt(seconds: number): void {
    if (!this.motion) return;
    this.setPlaying(false);
    this.goTo((seconds / Math.max(this.seconds, 1e-3)) * (this.motion.slices - 1));
  }

  /** Registers a listener of times of the motion, s. It is called before frames move. */
  onTime(listener: (seconds: number) => void): void {
    this.timeListeners.push(listener);
  }

  goTo(moment: number): void {
    if (!this.motion) return;
    this.moment = Math.max(0, Math.min(moment, this.motion.slices - 1));
    for (const listener of this.timeListeners) listener(this.time);
    for (const [id, { anchor }] of this.shown.frames) this.motion.place(anchor, id, this.moment);
    if (this.motion.dofs > 0) this.joints.showState(this.motion.state(this.moment));
    this.draw();
    this.moved();
  }

  /** Goes to a part of the motion, 0 to 1. */
  private seek(part: number): void {
    if (!this.motion) return;
    this.setPlaying(false);
    this.goTo(part * (this.motion.slices - 1));
  }

  private say(text: string): void {
    this.readout.textContent = text || "\u00a0";
  }

  private valuesAt(part: number): string {
    if (!this.motion) return "";
    const slice = Math.round(part * (this.motion.slices - 1)), { joints } = this.joints.current;
    const unit = (i: number): string => (this.plotted === "joints" ? ` ${joints[i]?.unit ?? ""}` : "");
    const values = this.curvesShown.map(({ name, values: all }, i) => `${name} ${Number((all[slice] ?? 0).toPrecision(3))}${unit(i)}`);
    return `slice ${slice - this.motion.message.prefix}: ${values.join(", ")}`;
  }

  private step(by: number): void {
    this.setPlaying(false);
    this.goTo(by > 0 ? Math.floor(this.moment) + 1 : Math.ceil(this.moment) - 1);
  }

  private advance(seconds: number): void {
    if (!this.motion || !this.playing) return;
    const last = this.motion.slices - 1;
    const rate = last / Math.max(this.motion.message.seconds, 1e-3);
    const next = this.moment + seconds * rate * this.speed;
    if (next < last) return this.goTo(next);
    this.goTo(this.loop ? 0 : last);
    if (!this.loop) this.setPlaying(false);
  }

  private setPlaying(playing: boolean): void {
    this.playing = playing;
    this.playButton.textContent = playing ? "❚❚" : "▶";
    this.playButton.ariaLabel = playing ? "pause" : "play";
  }

  private showGhosts(on: boolean): void {
    this.ghostBox.checked = on;
    if (this.ghosts) {
      this.stage.scene.remove(this.ghosts);
      for (const ghost of this.ghosts.children) if (ghost instanceof THREE.Mesh) materialsOf(ghost).forEach((material) => material.dispose());
      this.ghosts = null;
    }
    if (on && this.motion) {
      this.ghosts = this.motion.ghosts(this.shown.frames);
      this.stage.scene.add(this.ghosts);
    }
    this.stage.redraw();
  }

  private setPlotted(plotted: Plotted): void {
    this.plotted = plotted;
    for (const kind of PLOTTED) this.plotBoxes[kind].checked = kind === plotted;
    this.lanes.root.hidden = plotted !== "lanes";
    this.curves.hidden = this.legend.hidden = plotted === "lanes";
    this.say("");
    this.plot.hidden = plotted === null;
    this.curvesShown = this.motion ? this.curvesOf(this.motion) : [];
    this.legend.replaceChildren(
      ...this.curvesShown.map(({ name }, i) => {
        const item = make("span", { textContent: name });
        item.style.setProperty("--color", colorOf(i));
        return item;
      }),
    );
    this.draw();
  }

  private curvesOf(motion: Motion): Curve[] {
    if (this.plotted === "errors")
      return motion.message.traces.map(({ name, type, values }) => ({ name: `${name} (${type})`, values }));
    return this.joints.current.joints.slice(0, motion.dofs).map(({ name }, i) => ({ name, values: motion.curveOf(i) }));
  }

  private draw(): void {
    if (!this.motion) return;
    const { slices, message } = this.motion;
    const slice = Math.round(this.moment);
    const last = Math.max(slices - 1, 1);
    this.slider.value = String(this.moment);
    const number = slice - message.prefix,
      highest = slices - 1 - message.prefix;
    this.slider.ariaValueText = `slice ${number} of ${highest}`;
    this.clock.textContent = `${number}/${highest}   ${((this.moment / last) * message.seconds).toFixed(2)} s`;
    const text = message.texts[slice] ?? "";
    this.text.textContent = text;
    this.text.hidden = text === "";
    this.text.classList.toggle("violated", isViolated(message.violations[slice]));
    drawViolations(this.marks, message.violations, slices);
    this.lanes.draw(this.moment / last);
    if (!this.curves.hidden && !this.plot.hidden) drawCurves(this.curves, this.curvesShown, this.moment, this.plotted === "errors");
    this.marked.show(message.marked[slice] ?? []);
    this.touching.show(message.touching[slice] ?? NOWHERE);
  }
}
