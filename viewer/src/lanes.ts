import { make } from "./element";
import type { TraceMessage } from "./messages";
import { drawLane, isViolated } from "./plot";
import { scrub } from "./scrub";

/** One lane per objective of a motion: where it has errors, and how large they are. */
export class Lanes {
  readonly root = make("div", { className: "lanes", hidden: true });
  private traces: TraceMessage[] = [];
  private canvases: HTMLCanvasElement[] = [];

  constructor(
    private readonly seek: (part: number) => void,
    private readonly say: (text: string) => void,
  ) {}

  show(traces: readonly TraceMessage[]): void {
    this.traces = traces.slice();
    this.canvases = traces.map((trace) => {
      const canvas = make("canvas", { className: "lane" });
      scrub(canvas, this.seek, (part) => this.say(part === null ? "" : this.textAt(trace, part)));
      return canvas;
    });
    this.root.replaceChildren(
      ...traces.flatMap(({ name, type, values }, i) => {
        const title = make("span", { textContent: name, title: `${name} (${type})` });
        title.classList.toggle("violated", type !== "sos" && values.some((value) => isViolated(value)));
        return [title, this.canvases[i]!];
      }),
    );
  }

  /** `part`: of the motion that has passed. */
  draw(part: number): void {
    if (this.root.hidden) return;
    this.canvases.forEach((canvas, i) => drawLane(canvas, this.traces[i]!.values, this.traces[i]!.type !== "sos", part));
  }

  private textAt({ name, type, values }: TraceMessage, part: number): string {
    const slice = Math.round(part * Math.max(values.length - 1, 0));
    return `${name} (${type}): ${(values[slice] ?? 0).toPrecision(3)} in slice ${slice}`;
  }
}
