import { make } from "./element";

/** Images on top of the scene; one with a zoom covers everything else. */
export class Quads {
  private readonly shown = new Map<number, HTMLCanvasElement>();

  get count(): number {
    return this.shown.size;
  }

  clear(): void {
    for (const canvas of this.shown.values()) canvas.remove();
    this.shown.clear();
    document.body.classList.remove("picture");
  }

  read(data: ArrayBuffer): void {
    const view = new DataView(data);
    const [id, columns, rows] = [4, 8, 12].map((at) => view.getInt32(at, true)) as [number, number, number];
    const [x, y, height, zoom] = [16, 20, 24, 28].map((at) => view.getFloat32(at, true)) as [
      number,
      number,
      number,
      number,
    ];
    const canvas = this.shown.get(id) ?? make("canvas", { className: "quad" });
    canvas.width = columns;
    canvas.height = rows;
    const image = new ImageData(columns, rows);
    const rgb = new Uint8Array(data, 32);
    for (let i = 0; i < columns * rows; ++i)
      image.data.set([rgb[3 * i]!, rgb[3 * i + 1]!, rgb[3 * i + 2]!, 255], 4 * i);
    canvas.getContext("2d")!.putImageData(image, 0, 0);
    Object.assign(
      canvas.style,
      zoom > 0
        ? { left: "0", top: "0", width: `${zoom * columns}px`, height: `${zoom * rows}px` }
        : {
            left: `${100 * x}vh`,
            top: `${100 * y}vh`,
            width: `${(100 * height * columns) / rows}vh`,
            height: `${100 * height}vh`,
          },
    );
    canvas.setAttribute("role", "img");
    canvas.ariaLabel = "picture";
    if (zoom > 0) document.body.classList.add("picture");
    this.shown.set(id, canvas);
    document.getElementById("canvas")!.after(canvas);
  }
}
