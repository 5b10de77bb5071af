import uPlot from "uplot";
import { find, make } from "./element";
import type { SeriesMessage } from "./messages";
import { colorOf } from "./plot";

const MOST = 100000; // samples of a plot
const HEIGHT = 130; // pixels

interface Plot {
  message: SeriesMessage;
  times: number[];
  values: number[][]; // per curve
  element: HTMLElement;
  chart: uPlot | null; // made when it is first seen
  stale: boolean;
}

/** Names of the curves of a plot. */
const namesOf = ({ name, curves }: SeriesMessage): string[] =>
  curves === 1 ? [name] : Array.from({ length: curves }, (_, i) => `[${i}]`);

/** Plots of what the program logs. They grow; dragging zooms in, a double click shows everything. */
export class Plots {
  private readonly plots = new Map<number, Plot>();
  private readonly root = make("div", { className: "logged" });
  private waiting = false;
  /** Called with the time at which a user clicks, s. */
  onSeek: (time: number) => void = () => {};

  constructor() {
    find("tab-program").append(this.root);
    new ResizeObserver(() => this.draw()).observe(this.root);
  }

  get sizes(): Record<string, number> {
    return Object.fromEntries([...this.plots.values()].map(({ message, times }) => [message.name, times.length]));
  }

  clear(): void {
    this.setSeries([]);
  }

  /** Returns whether some plots are new. */
  setSeries(series: SeriesMessage[]): boolean {
    const ids = new Set(series.map(({ id }) => id));
    for (const [id, { element, chart }] of this.plots) {
      if (ids.has(id)) continue;
      chart?.destroy();
      element.remove();
      this.plots.delete(id);
    }
    let isNew = false;
    for (const message of series) {
      if (this.plots.has(message.id)) continue;
      isNew = true;
      const title = message.unit ? `${message.name} (${message.unit})` : message.name;
      const element = make("figure", {}, make("figcaption", { textContent: title }));
      element.ariaLabel = `plot of ${title}`;
      this.root.append(element);
      this.plots.set(message.id, { message, times: [], values: namesOf(message).map(() => []), element, chart: null, stale: true });
    }
    return isNew;
  }

  /** Reads samples: int32 series, uint32 numbers, float64 time, float64 numbers. */
  readSamples(data: ArrayBuffer): void {
    const view = new DataView(data);
    let at = 8;
    for (let left = view.getUint32(4, true); left > 0; --left) {
      const plot = this.plots.get(view.getInt32(at, true));
      const count = view.getUint32(at + 4, true);
      plot?.times.push(view.getFloat64(at + 8, true));
      for (let i = 0; i < count; ++i) plot?.values[i]?.push(view.getFloat64(at + 16 + 8 * i, true));
      at += 16 + 8 * count;
      if (plot) plot.stale = true;
    }
    for (const { times, values } of this.plots.values()) {
      if (times.length < 1.2 * MOST) continue;
      for (const list of [times, ...values]) list.splice(0, list.length - MOST);
    }
    this.request();
  }

  /** Call when plots may have come in sight. */
  request(): void {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  private draw(): void {
    const width = this.root.clientWidth;
    if (width === 0) return; // not in sight
    for (const plot of this.plots.values()) {
      plot.chart ??= this.make(plot, width);
      if (plot.chart.width !== width) plot.chart.setSize({ width, height: HEIGHT });
      if (!plot.stale) continue;
      plot.stale = false;
      const { times, values } = plot;
      const sorted = times.every((time, i) => i === 0 || time >= times[i - 1]!);
      const order = sorted ? null : times.map((_, i) => i).sort((a, b) => times[a]! - times[b]!);
      const arranged = (list: number[]): (number | null)[] =>
        (order ? order.map((i) => list[i]!) : list).map((value) => (Number.isFinite(value) ? value : null));
      plot.chart.setData([order ? order.map((i) => times[i]!) : times, ...values.map(arranged)]);
    }
  }

  private make({ message, element }: Plot, width: number): uPlot {
    const ink = getComputedStyle(document.body).color;
    const values = (_: uPlot, ticks: number[]): string[] => ticks.map((x) => String(Number(x.toPrecision(6))));
    const axis = { stroke: ink, font: "10px system-ui", grid: { stroke: "rgba(128,128,128,.2)", width: 1 }, ticks: { show: false }, values };
    const chart = new uPlot(
      {
        width,
        height: HEIGHT,
        scales: { x: { time: false } },
        cursor: { y: false },
        legend: { live: true },
        axes: [{ ...axis, size: 22 }, { ...axis, size: 44 }],
        series: [
          { label: "t", value: (_, t) => (t === null ? "" : `${t.toFixed(2)} s`) },
          ...namesOf(message).map((label, i) => ({
            label,
            stroke: colorOf(i),
            width: 1.5,
            points: { show: false },
            value: (_: uPlot, y: number | null) => (y === null ? "" : String(Number(y.toPrecision(4)))),
          })),
        ],
      },
      [[]] as unknown as uPlot.AlignedData,
      element,
    );
    chart.over.addEventListener("click", () => {
      if (chart.cursor.left !== undefined && chart.cursor.left >= 0) this.onSeek(chart.posToVal(chart.cursor.left, "x"));
    });
    return chart;
  }
}
