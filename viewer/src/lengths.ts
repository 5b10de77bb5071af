/** Formats a length in m with three digits in a suitable unit. */
export function lengthText(m: number): string {
  const [size, unit] = m >= 1000 ? [m / 1000, "km"] : m >= 0.1 ? [m, "m"] : m >= 0.01 ? [100 * m, "cm"] : [1000 * m, "mm"];
  return `${Number(size.toPrecision(3))} ${unit}`;
}
