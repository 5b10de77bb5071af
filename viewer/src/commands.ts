type Field = ["int", number] | ["number", number] | ["number[]", number[]] | ["string", string];

const utf8 = new TextEncoder();

function sizeOf([kind, value]: Field): number {
  if (kind === "int") return 4;
  if (kind === "number") return 8;
  return 4 + (kind === "string" ? utf8.encode(value).length : 8 * value.length);
}

/** Encodes a command for the server: int32, float64, arrays as length and float64s, texts as length and UTF-8. */
export function writeCommand(...fields: Field[]): Uint8Array<ArrayBuffer> {
  const size = fields.reduce((sum, field) => sum + sizeOf(field), 0);
  const view = new DataView(new ArrayBuffer(size));
  let at = 0;
  const int = (value: number): void => view.setInt32((at += 4) - 4, value, true);
  const double = (value: number): void => view.setFloat64((at += 8) - 8, value, true);
  for (const [kind, value] of fields) {
    if (kind === "int") int(value);
    else if (kind === "number") double(value);
    else if (kind === "string") {
      const bytes = utf8.encode(value);
      int(bytes.length);
      new Uint8Array(view.buffer).set(bytes, at);
      at += bytes.length;
    } else {
      int(value.length);
      value.forEach(double);
    }
  }
  return new Uint8Array(view.buffer);
}
