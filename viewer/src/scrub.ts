/** Lets the pointer choose a time on a picture of a motion: a press or a drag goes there; without a button it reads
 * values. */
export function scrub(
  element: HTMLElement,
  seek: (part: number) => void,
  read: (part: number | null, event: PointerEvent) => void,
): void {
  const partOf = (event: PointerEvent): number => {
    const { left, width } = element.getBoundingClientRect();
    return Math.max(0, Math.min(1, (event.clientX - left) / Math.max(width, 1)));
  };
  element.classList.add("scrubbed");
  element.addEventListener("pointerdown", (event) => {
    if (event.button !== 0) return;
    element.setPointerCapture(event.pointerId);
    seek(partOf(event));
  });
  element.addEventListener("pointermove", (event) => {
    if (element.hasPointerCapture(event.pointerId)) seek(partOf(event));
    read(partOf(event), event);
  });
  element.addEventListener("pointerleave", (event) => read(null, event));
}
