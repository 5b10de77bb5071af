import { type Display, OPTIONS, type Option, optionNames } from "./display";
import type { Shown } from "./shown";
import { SceneTree } from "./tree";

/** The panel at the side: switches, the tree of frames, and saving a picture. */
export class Panel {
  private readonly root: HTMLElement;
  private readonly search: HTMLInputElement;
  private readonly tree: SceneTree;
  private readonly boxes = new Map<Option, HTMLInputElement>();

  constructor(
    find: <T extends HTMLElement>(id: string) => T,
    private readonly display: Display,
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly changed: () => void,
    private readonly savePicture: () => void,
  ) {
    this.root = find("panel");
    this.search = find<HTMLInputElement>("search");
    this.tree = new SceneTree(find("tree"), this.search, display.hidden, changed);
    for (const option of optionNames) find("options").append(this.makeBox(option));
    find("picture").addEventListener("click", savePicture);
    find("panel-button").addEventListener("click", () => this.toggle());
  }

  get isOpen(): boolean {
    return !this.root.hidden;
  }

  /** Call when frames have come, gone or changed. */
  refresh(): void {
    if (this.isOpen) this.tree.show(this.frames);
  }

  /** True if the key, pressed with Alt, was for the panel. */
  takeKey(code: string): boolean {
    const letter = code.replace("Key", "");
    const option = optionNames.find((name) => OPTIONS[name].letter === letter);
    if (option) this.set(option, !this.display.on.has(option));
    else if (letter === "T") this.toggle();
    else if (letter === "P") this.savePicture();
    else return false;
    return true;
  }

  close(): void {
    this.root.hidden = true;
  }

  private toggle(): void {
    this.root.hidden = !this.root.hidden;
    this.refresh();
    if (this.isOpen) this.search.focus();
  }

  private set(option: Option, on: boolean): void {
    if (on) this.display.on.add(option);
    else this.display.on.delete(option);
    this.boxes.get(option)!.checked = on;
    this.changed();
  }

  private makeBox(option: Option): HTMLElement {
    const box = document.createElement("input");
    box.type = "checkbox";
    box.checked = this.display.on.has(option);
    box.addEventListener("change", () => this.set(option, box.checked));
    this.boxes.set(option, box);
    const label = document.createElement("label");
    const key = document.createElement("kbd");
    key.textContent = `Alt ${OPTIONS[option].letter}`;
    label.append(box, OPTIONS[option].label, key);
    return label;
  }
}
