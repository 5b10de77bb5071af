/** GLFW codes of keys without a printable character. */
const NAMED: Record<string, number> = {
  Enter: 13,
  Escape: 27,
  Tab: 9,
  Backspace: 259,
  Insert: 260,
  Delete: 261,
  ArrowRight: 262,
  ArrowLeft: 263,
  ArrowDown: 264,
  ArrowUp: 265,
  PageUp: 266,
  PageDown: 267,
  Home: 268,
  End: 269,
};

/** Returns the program's code of a key, or 0 for keys reserved for the page. Letters are lower case. */
export function keyCode(event: KeyboardEvent): number {
  if (event.ctrlKey || event.altKey || event.metaKey) return 0;
  if (event.key.length === 1) {
    const code = event.key.toLowerCase().charCodeAt(0);
    return code < 128 ? code : 0;
  }
  const functionKey = /^F(\d+)$/.exec(event.key);
  if (functionKey) return 289 + Number(functionKey[1]);
  return NAMED[event.key] ?? 0;
}

/** Returns the sum of Shift 1, Ctrl 2, Alt 4. */
export const modifiersOf = (event: KeyboardEvent): number =>
  (event.shiftKey ? 1 : 0) + (event.ctrlKey ? 2 : 0) + (event.altKey ? 4 : 0);
