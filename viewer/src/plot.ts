import type { Motion } from "./motion";

const PALETTE = ["#2f6fde", "#d9480f", "#2b8a3e", "#9c36b5", "#e8a200", "#0b7285", "#c2255c", "#5f3dc4", "#74b816", "#868e96"];

/** The color of a dof's curve. */
export const colorOf = (dof: number): string => PALETTE[dof % PALETTE.length]!;

function prepare(canvas: HTMLCanvasElement): CanvasRenderingContext2D | null {
  const scale = Math.min(devicePixelRatio, 2);
  canvas.width = canvas.clientWidth * scale;
  canvas.height = canvas.clientHeight * scale;
  const context = canvas.getContext("2d");
  context?.scale(scale, scale);
  return context;
}

/** The joint values over time, each from its lowest to its highest value, and where the motion is. */
export function drawCurves(canvas: HTMLCanvasElement, motion: Motion, moment: number): void {
  const context = prepare(canvas);
  if (!context) return;
  const { clientWidth: width, clientHeight: height } = canvas;
  const { slices, dofs, q } = motion;
  const low = q.reduce((a, b) => Math.min(a, b), Infinity);
  const high = q.reduce((a, b) => Math.max(a, b), -Infinity);
  const x = (slice: number): number => (slices < 2 ? width / 2 : (slice / (slices - 1)) * width);
  const y = (value: number): number => height - 4 - ((value - low) / Math.max(high - low, 1e-9)) * (height - 8);
  const ink = getComputedStyle(canvas).color;
  context.font = "10px ui-monospace, monospace";
  for (let i = 0; i < dofs; ++i) {
    context.strokeStyle = colorOf(i);
    context.lineWidth = 1.6;
    context.beginPath();
    for (let t = 0; t < slices; ++t) context.lineTo(x(t), y(q[t * dofs + i]!));
    context.stroke();
  }
  context.fillStyle = context.strokeStyle = ink;
  context.globalAlpha = 0.6;
  context.fillText(high.toFixed(2), 2, 10);
  context.fillText(low.toFixed(2), 2, height - 3);
  context.lineWidth = 1;
  context.beginPath();
  context.moveTo(x(moment), 0);
  context.lineTo(x(moment), height);
  context.stroke();
}

const TOLERANCE = 1e-3; // of constraints: what is above counts as violated

export const isViolated = (violation: number | undefined): boolean => (violation ?? 0) > TOLERANCE;

/** Red where constraints are violated, the stronger the more. */
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
