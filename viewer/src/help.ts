import { OPTIONS, optionNames } from "./display";
import { find, make } from "./element";

const KEYS: [string, string][] = [
  ["drag", "rotate; with the right button or Shift: shift"],
  ["Ctrl drag, Ctrl wheel", "rotate freely; wider or narrower view"],
  ["wheel, pinch", "nearer, farther"],
  ["click", "select a frame"],
  ["double click, right click", "rotate about that point"],
  ["?", "this help"],
  ["Esc", "close help, card, panel, ruler; else to the program"],
  ["Home", "first view"],
  ["Alt 1 … Alt 4", "view from the front, the side, above, aslant"],
  ["Alt ← → ↑ ↓", "rotate"],
  ["Alt Page up, down", "nearer, farther"],
  ["Alt U, T, J, O", "program, frames, joints, view"],
  ["Alt P", "save a picture"],
  ["Alt R", "measure"],
  ["Alt F, Alt Q", "everything in the picture; orthographic"],
  ["Ctrl Z, Ctrl Y", "undo, redo edits of joints and frames"],
  ["Alt G, Alt B", "move, rotate the selected frame"],
  ["Alt E", "pull: drag any link, and the joints follow"],
  ["Space", "play or pause the motion, if there is one; else to the program"],
  ["Alt K", "play or pause the motion, or the simulation"],
  ["← →, Shift wheel", "slice by slice, in a motion"],
  ...optionNames.map((name): [string, string] => [`Alt ${OPTIONS[name].letter}`, `${OPTIONS[name].label}, on or off`]),
];

const FINGERS: [string, string][] = [
  ["one finger", "rotate"],
  ["two fingers", "shift; nearer and farther by spreading them"],
  ["tap", "select a frame"],
  ["two taps", "rotate about that point"],
  ["≡", "frames, joints, view options, measuring, pulling, saving"],
];

/** The list of mouse and key commands, or of gestures on machines without a mouse. */
export class Help {
  private readonly root = find("help");
  private readonly button = find("help-button");

  constructor() {
    const hasMouse = matchMedia("(any-pointer: fine)").matches;
    this.root.append(
      make(
        "dl",
        {},
        ...(hasMouse ? KEYS : FINGERS).flatMap(([key, description]) => [
          make("dt", {}, make("kbd", { textContent: key })),
          make("dd", { textContent: description }),
        ]),
      ),
      ...(hasMouse ? [make("p", { textContent: "All other keys go to the program." })] : []),
    );
    this.button.addEventListener("click", () => this.toggle());
  }

  get isOpen(): boolean {
    return !this.root.hidden;
  }

  toggle(): void {
    this.root.hidden = !this.root.hidden;
    this.button.ariaExpanded = String(this.isOpen);
  }
}
