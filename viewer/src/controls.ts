import { find, make } from "./element";
import { type ControlMessage, controlCommand } from "./messages";

interface Row {
  message: ControlMessage;
  show(message: ControlMessage): void;
  element: HTMLElement;
}

/** A number with as many digits as a slider's step over this range needs. */
const rounded = (value: number, range: number): string => value.toFixed(Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(range)))));

/** The program's buttons, sliders, check boxes, choices and text fields, by folders. */
export class Controls {
  private rows = new Map<number, Row>();
  private readonly root = make("div", { className: "controls" });
  private readonly folders = new Map<string, HTMLElement>();
  private layout = ""; // ids and folders of the shown controls

  /** `send` is null on a saved page, which shows the last values. */
  constructor(private readonly send: ((command: Uint8Array<ArrayBuffer>) => void) | null) {
    find("tab-program").prepend(this.root);
  }

  get count(): number {
    return this.rows.size;
  }

  /** Returns whether there are controls, and whether some are new. */
  read(controls: ControlMessage[]): boolean {
    const layout = controls.map(({ id, folder }) => `${id} ${folder}`).join();
    if (layout === this.layout) {
      for (const control of controls) this.update(control);
      return false;
    }
    this.layout = layout;
    const known = this.rows;
    this.rows = new Map();
    this.folders.clear();
    this.root.replaceChildren();
    for (const control of controls) {
      const row = known.get(control.id) ?? this.make(control);
      this.rows.set(control.id, row);
      this.folder(control.folder).append(row.element);
      this.update(control);
    }
    return controls.length > 0;
  }

  /** Clicks the button of a key; returns whether there is one. */
  takeKey(key: string): boolean {
    for (const { message, element } of this.rows.values()) {
      if (message.type !== "button" || message.key !== key || !this.send) continue;
      element.querySelector("button")!.click();
      return true;
    }
    return false;
  }

  private update(message: ControlMessage): void {
    const row = this.rows.get(message.id)!;
    row.message = message;
    row.show(message);
  }

  private folder(path: string): HTMLElement {
    if (path === "") return this.root;
    const known = this.folders.get(path);
    if (known) return known;
    const cut = path.lastIndexOf("/");
    const folder = make("details", { open: true }, make("summary", { textContent: path.slice(cut + 1) }));
    this.folder(cut < 0 ? "" : path.slice(0, cut)).append(folder);
    this.folders.set(path, folder);
    return folder;
  }

  private make(message: ControlMessage): Row {
    const set = (number: number, text: string): void => this.send?.(controlCommand(message.id, number, text));
    const disabled = this.send === null;
    const { label } = message;
    if (message.type === "button") {
      const key = message.key ? [make("kbd", { textContent: message.key })] : [];
      const button = make("button", { disabled, onclick: () => set(0, "") }, label, ...key);
      return { message, element: make("div", { className: "control" }, button), show: () => {} };
    }
    if (message.type === "slider") return this.makeSlider(message, set);
    if (message.type === "check") {
      const box = make("input", { type: "checkbox", disabled, onchange: () => set(box.checked ? 1 : 0, "") });
      return { message, element: make("label", { className: "control check" }, box, label), show: ({ number }) => (box.checked = number !== 0) };
    }
    const field: HTMLInputElement | HTMLSelectElement =
      message.type === "choice"
        ? make("select", {}, ...message.options.map((option) => make("option", { textContent: option, value: option })))
        : make("input", { type: "text", maxLength: 900 });
    field.disabled = disabled;
    field.ariaLabel = label;
    field.addEventListener("change", () => set(0, field.value));
    const show = ({ text }: ControlMessage): void => {
      if (document.activeElement !== field || message.type === "choice") field.value = text;
    };
    return { message, element: make("div", { className: "control" }, make("span", { textContent: label }), field), show };
  }

  private makeSlider(message: ControlMessage, set: (number: number, text: string) => void): Row {
    const { label, lower, upper, unit } = message;
    let held = false;
    const slider = make("input", { type: "range", min: String(lower), max: String(upper), step: "any", ariaLabel: label, disabled: this.send === null });
    const value = make("output");
    const write = (number: number): void => {
      value.textContent = `${rounded(number, upper - lower)} ${unit}`.trim();
      slider.ariaValueText = value.textContent;
    };
    let waiting = false;
    slider.addEventListener("input", () => {
      write(slider.valueAsNumber);
      if (waiting) return; // at most one command per picture
      waiting = true;
      requestAnimationFrame(() => {
        waiting = false;
        set(slider.valueAsNumber, "");
      });
    });
    slider.addEventListener("pointerdown", () => (held = true));
    for (const end of ["pointerup", "pointercancel"]) slider.addEventListener(end, () => (held = false));
    const element = make("div", { className: "control" }, make("span", { textContent: label }), value, slider);
    const show = ({ number }: ControlMessage): void => {
      if (held || waiting) return;
      slider.valueAsNumber = number;
      write(number);
    };
    return { message, element, show };
  }
}
