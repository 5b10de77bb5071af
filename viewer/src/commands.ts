type Field = ["int", number] | ["number", number] | ["number[]", number[]];

/** Encodes a command for the server: int32, float64, and arrays as length and float64s. */
export function writeCommand(...fields: Field[]): Uint8Array<ArrayBuffer> {
  const size = fields.reduce(
    (sum, [kind, value]) => sum + (kind === "int" ? 4 : kind === "number" ? 8 : 4 + 8 * value.length),
    0,
  );
  const view = new DataView(new ArrayBuffer(size));
  let at = 0;
  const int = (value: number): void => view.setInt32((at += 4) - 4, value, true);
  const double = (value: number): void => view.setFloat64((at += 8) - 8, value, true);
  for (const [kind, value] of fields) {
    if (kind === "int") int(value);
    else if (kind === "number") double(value);
    else {
      int(value.length);
      value.forEach(double);
    }
  }
  return new Uint8Array(view.buffer);
}
