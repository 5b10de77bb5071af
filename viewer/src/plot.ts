const PALETTE = [
  "#2f6fde",
  "#d9480f",
  "#2b8a3e",
  "#9c36b5",
  "#e8a200",
  "#0b7285",
  "#c2255c",
  "#5f3dc4",
  "#74b816",
  "#868e96",
];

/** Returns the color of a curve. */
export const colorOf = (curve: number): string => PALETTE[curve % PALETTE.length]!;

function prepare(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const scale = Math.min(devicePixelRatio, 2);
  canvas.width = canvas.clientWidth * scale;
  canvas.height = canvas.clientHeight * scale;
  const context = canvas.getContext("2d");
  context?.scale(scale, scale);
  return context;
}

/** Values over the slices of a motion. */
export interface Curve {
  name: string;
  values: ArrayLike<number>; // per slice
}

const SMALLEST = 1e-6; // smallest error on the logarithmic scale; smaller ones count as zero

/**
 * Curves between the lowest and the highest of all values, with the present time of the motion. `logarithmic` spaces
 * powers of ten evenly.
 */
export function drawCurves(
  canvas: HTMLCanvasElement,
  curves: readonly Curve[],
  moment: number,
  logarithmic: boolean,
): void {
  const context = prepare(canvas);
  if (!context) return;
  const { clientWidth: width, clientHeight: height } = canvas;
  const scaled = (value: number): number => (logarithmic ? Math.log10(Math.max(value, SMALLEST)) : value);
  let low = Infinity,
    high = -Infinity;
  for (const { values } of curves) {
    for (let t = 0; t < values.length; ++t) {
      low = Math.min(low, scaled(values[t]!));
      high = Math.max(high, scaled(values[t]!));
    }
  }
  const slices = curves[0]?.values.length ?? 0;
  const x = (slice: number): number => (slices < 2 ? width / 2 : (slice / (slices - 1)) * width);
  const y = (value: number): number => height - 4 - ((scaled(value) - low) / Math.max(high - low, 1e-9)) * (height - 8);
  const ink = getComputedStyle(canvas).color;
  context.font = "10px ui-monospace, monospace";
  curves.forEach(({ values }, i) => {
    context.strokeStyle = colorOf(i);
    context.lineWidth = 1.6;
    context.beginPath();
    for (let t = 0; t < slices; ++t) context.lineTo(x(t), y(values[t]!));
    if (slices === 1) context.lineTo(x(0) + 8, y(values[0]!));
    context.stroke();
  });
  if (curves.length === 0) return;
  const text = (value: number): string => (logarithmic ? (10 ** value).toExponential(0) : value.toFixed(2));
  context.fillStyle = context.strokeStyle = ink;
  context.globalAlpha = 0.6;
  context.fillText(text(high), 2, 10);
  context.fillText(text(low), 2, height - 3);
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(x(moment), 0);
  context.lineTo(x(moment), height);
  context.stroke();
}

const TOLERANCE = 1e-3; // of constraints: larger violations count

export const isViolated = (violation: number | undefined): boolean => (violation ?? 0) > TOLERANCE;

/** Shows the values of an objective per slice: darker where they are larger, on a logarithmic scale. Violated
 * constraints are red. */
export function drawLane(canvas: HTMLCanvasElement, values: readonly number[], isConstraint: boolean, part: number): void {
  const context = prepare(canvas);
  if (!context) return;
  const { clientWidth: width, clientHeight: height } = canvas;
  const step = width / Math.max(values.length, 1);
  values.forEach((value, t) => {
    if (!(value > SMALLEST)) return;
    context.fillStyle = isConstraint && isViolated(value) ? "#e03131" : "#2f6fde";
    context.globalAlpha = Math.max(0.08, Math.min(1, 1 + Math.log10(value) / 6));
    context.fillRect(t * step, 0, Math.max(step, 1), height);
  });
  context.globalAlpha = 0.7;
  context.fillStyle = getComputedStyle(canvas).color;
  context.fillRect(part * (width - 1), 0, 1, height);
}

/** Shows constraint violations in red, with a strength that increases with the violation. */
export function drawViolations(canvas: HTMLCanvasElement, violations: number[], slices: number): void {
  const context = prepare(canvas);
  if (!context) return;
  const width = canvas.clientWidth / Math.max(slices, 1);
  violations.forEach((violation, t) => {
    if (!isViolated(violation)) return;
    context.fillStyle = "#e03131";
    context.globalAlpha = Math.min(1, 0.45 + violation);
    context.fillRect(t * width, 0, Math.max(width, 2), canvas.clientHeight);
  });
}
