import { type Display, OPTIONS, type Option, optionNames } from "./display";
import { find, make } from "./element";
import type { WarningMessage } from "./messages";
import type { Shown } from "./shown";
import { SceneTree } from "./tree";

const TABS = { program: "U", frames: "T", joints: "J", view: "O" } as const;
const NAMED = 12; // largest number of buttons for the frames of a warning
type Tab = keyof typeof TABS;
const tabNames = Object.keys(TABS) as Tab[];

/** The side panel: frames, joints, and view options. */
export class Panel {
  private readonly root = find("panel");
  private readonly button = find("panel-button");
  private readonly tree: SceneTree;
  private readonly boxes = new Map<Option, HTMLInputElement>();
  private readonly tabs = new Map<Tab, HTMLButtonElement>();
  private tab: Tab = "frames";
  private wasClosed = false; // by a user

  constructor(
    private readonly display: Display,
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly changed: () => void,
    private readonly selectFrame: (id: number) => void,
    private readonly opened: () => void,
  ) {
    this.tree = new SceneTree(find("tree"), find<HTMLInputElement>("search"), display.hidden, changed, selectFrame);
    for (const option of optionNames) find("options").append(this.makeBox(option));
    for (const name of tabNames) find("tabs").append(this.makeTab(name));
    this.button.addEventListener("click", () => (this.isOpen ? this.close() : this.open(this.tab)));
    this.mark();
  }

  get isOpen(): boolean {
    return !this.root.hidden;
  }

  /** Call when frames have been added, removed or changed. */
  refresh(): void {
    if (this.isOpen && this.tab === "frames") this.tree.show(this.frames);
  }

  /** Shows the program's tab if it has content; opens it if it has just got some, unless a user closed the panel. */
  showProgram(hasContent: boolean, isNew: boolean): void {
    this.tabs.get("program")!.hidden = !hasContent;
    if (!hasContent && this.tab === "program") this.tab = "frames";
    if (hasContent && isNew && !this.wasClosed && matchMedia("(min-width: 561px)").matches) this.open("program", false);
    else this.mark();
  }

  /** Call when options have been changed elsewhere. */
  refreshOptions(): void {
    for (const [option, box] of this.boxes) box.checked = this.display.on.has(option);
  }

  /** Shows the warnings about the scene; `ignored` are the marked frames. */
  showWarnings(warnings: readonly WarningMessage[], ignored: ReadonlySet<number>): void {
    this.tree.mark(ignored);
    document.body.classList.toggle("has-warnings", ignored.size > 0);
    const root = find("warnings");
    root.hidden = warnings.length === 0;
    root.replaceChildren(...warnings.map((warning) => this.makeWarning(warning)));
  }

  private makeWarning({ text, frames }: WarningMessage): HTMLElement {
    const names = [...new Set(frames)].slice(0, NAMED).flatMap((id) => {
      const name = this.frames.get(id)?.message.name;
      return name === undefined ? [] : [make("button", { textContent: name, onclick: () => this.selectFrame(id) })];
    });
    return make("div", {}, make("p", { className: "warning", textContent: text }), make("div", { className: "buttons" }, ...names));
  }

  select(id: number | null): void {
    this.tree.select(id);
  }

  /** Handles a key pressed with Alt; returns whether it was for the panel. */
  takeKey(code: string): boolean {
    const letter = code.replace("Key", "");
    const option = optionNames.find((name) => OPTIONS[name].letter === letter);
    const tab = tabNames.find((name) => TABS[name] === letter && !this.tabs.get(name)!.hidden);
    if (option) this.toggle(option);
    else if (tab) this.isOpen && this.tab === tab ? this.close() : this.open(tab);
    else return false;
    return true;
  }

  toggle(option: Option): void {
    this.set(option, !this.display.on.has(option));
  }

  close(): void {
    this.wasClosed = true;
    this.root.hidden = true;
    this.mark();
  }

  private open(tab: Tab, focuses = true): void {
    this.tab = tab;
    this.root.hidden = false;
    this.mark();
    this.refresh();
    this.opened();
    if (focuses) find(`tab-${tab}`).querySelector<HTMLElement>("input, button")?.focus();
  }

  private mark(): void {
    this.button.ariaExpanded = String(this.isOpen);
    this.root.classList.toggle("wide", this.tab === "program");
    for (const [name, button] of this.tabs) {
      button.ariaSelected = String(name === this.tab);
      find(`tab-${name}`).hidden = name !== this.tab;
    }
  }

  private makeTab(name: Tab): HTMLElement {
    const button = make("button", { textContent: name, title: `Alt ${TABS[name]}`, onclick: () => this.open(name) });
    button.setAttribute("role", "tab");
    button.setAttribute("aria-controls", `tab-${name}`);
    button.hidden = name === "program";
    this.tabs.set(name, button);
    return button;
  }

  private set(option: Option, on: boolean): void {
    if (on) this.display.on.add(option);
    else this.display.on.delete(option);
    this.boxes.get(option)!.checked = on;
    this.changed();
  }

  private makeBox(option: Option): HTMLElement {
    const box = make("input", { type: "checkbox", checked: this.display.on.has(option) });
    box.addEventListener("change", () => this.set(option, box.checked));
    this.boxes.set(option, box);
    return make("label", {}, box, OPTIONS[option].label, make("kbd", { textContent: `Alt ${OPTIONS[option].letter}` }));
  }
}
