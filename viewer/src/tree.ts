import { make } from "./element";
import type { Shown } from "./shown";

/** The frames as a tree. A checkbox per frame hides it with all below; a click on its name selects it. */
export class SceneTree {
  private readonly collapsed = new Set<string>();
  private frames: ReadonlyMap<number, Shown> = new Map();
  private selected: number | null = null;
  private ignored: ReadonlySet<number> = new Set();

  constructor(
    private readonly element: HTMLElement,
    private readonly search: HTMLInputElement,
    private readonly hidden: Set<string>,
    private readonly changed: () => void,
    private readonly onSelect: (id: number) => void,
  ) {
    search.addEventListener("input", () => this.fill());
  }

  show(frames: ReadonlyMap<number, Shown>): void {
    this.frames = frames;
    this.fill();
  }

  /** Sets the frames of ignored obstacles. */
  mark(ignored: ReadonlySet<number>): void {
    this.ignored = ignored;
    for (const button of this.element.querySelectorAll<HTMLElement>(".frame")) this.markIf(button);
  }

  private markIf(button: HTMLElement): void {
    const ignored = this.ignored.has(Number(button.dataset.id));
    button.classList.toggle("ignored", ignored);
    button.title = `select ${button.textContent}${ignored ? ", which is not an obstacle" : ""}`;
  }

  select(id: number | null): void {
    this.selected = id;
    for (const button of this.element.querySelectorAll<HTMLElement>(".frame")) {
      const selected = button.dataset.id === String(id);
      button.classList.toggle("selected", selected);
      if (selected) button.scrollIntoView({ block: "nearest" });
    }
  }

  private fill(): void {
    const children = new Map<number, number[]>();
    for (const [id, { message }] of this.frames) {
      const parent = this.frames.has(message.parent) ? message.parent : -1;
      children.set(parent, [...(children.get(parent) ?? []), id]);
    }
    const query = this.search.value.trim().toLowerCase();
    const found = query === "" ? null : this.matches(query);
    const branch = (parent: number): HTMLElement[] =>
      (children.get(parent) ?? [])
        .filter((id) => !found || found.has(id))
        .map((id) => this.item(id, branch(id), found !== null));
    this.element.replaceChildren(...branch(-1));
    if (this.element.childElementCount === 0) this.element.textContent = query ? "no such frame" : "no frames";
    this.disable();
    this.select(this.selected);
  }

  /** Grays and disables the boxes below hidden frames, which are hidden whatever their boxes say. */
  private disable(): void {
    for (const box of this.element.querySelectorAll<HTMLInputElement>("summary input"))
      box.closest("details")!.classList.toggle("off", !box.checked);
    for (const box of this.element.querySelectorAll<HTMLInputElement>("input"))
      box.disabled = box.closest(".leaf, details")!.parentElement!.closest("details.off") !== null;
  }

  /** Returns the frames whose names contain the text, and all above them. */
  private matches(text: string): Set<number> {
    const found = new Set<number>();
    for (const [id, { message }] of this.frames) {
      if (!message.name.toLowerCase().includes(text)) continue;
      for (let at = id; this.frames.has(at) && !found.has(at); at = this.frames.get(at)!.message.parent) found.add(at);
    }
    return found;
  }

  private item(id: number, below: HTMLElement[], searching: boolean): HTMLElement {
    const { name } = this.frames.get(id)!.message;
    const box = make("input", { type: "checkbox", checked: !this.hidden.has(name), ariaLabel: `show ${name}` });
    box.addEventListener("change", () => {
      if (box.checked) this.hidden.delete(name);
      else this.hidden.add(name);
      this.disable();
      this.changed();
    });
    const frame = make("button", { className: "frame", textContent: name });
    frame.dataset.id = String(id);
    this.markIf(frame);
    frame.addEventListener("click", (event) => {
      event.preventDefault(); // keeps the branch unfolded
      this.onSelect(id);
    });
    if (below.length === 0) return make("div", { className: "leaf" }, box, frame);
    const details = make("details", {}, make("summary", {}, box, frame), ...below);
    details.open = searching || !this.collapsed.has(name);
    details.addEventListener("toggle", () => {
      if (this.search.value.trim() !== "") return;
      if (details.open) this.collapsed.delete(name);
      else this.collapsed.add(name);
    });
    return details;
  }
}
