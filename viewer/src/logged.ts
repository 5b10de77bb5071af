import { find, make } from "./element";

/** The last image of each name that the program logs, below the plots. */
export class LoggedImages {
  private readonly shown = new Map<string, HTMLElement>();
  private readonly root = make("div", { className: "logged images" });

  /** `changed` is called when images come or go. */
  constructor(private readonly changed: (isNew: boolean) => void) {
    find("tab-program").append(this.root);
  }

  get names(): string[] {
    return [...this.shown.keys()];
  }

  /** Shows rgb bytes, rows from top to bottom. */
  show(name: string, columns: number, rows: number, rgb: Uint8Array): void {
    const known = this.shown.get(name);
    const canvas = known?.querySelector("canvas") ?? make("canvas", { ariaLabel: `image ${name}`, role: "img" });
    Object.assign(canvas, { width: columns, height: rows });
    const image = new ImageData(columns, rows);
    image.data.fill(255);
    for (let i = 0; i < columns * rows; ++i) image.data.set(rgb.subarray(3 * i, 3 * i + 3), 4 * i);
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    if (known) return;
    const figure = make("figure", {}, make("figcaption", { textContent: name }), canvas);
    this.shown.set(name, figure);
    this.root.append(figure);
    this.changed(true);
  }

  remove(name: string): void {
    this.shown.get(name)?.remove();
    if (this.shown.delete(name)) this.changed(false);
  }
}
