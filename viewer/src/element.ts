/** Creates an element with properties and children. */
export function make<Tag extends keyof HTMLElementTagNameMap>(
  tag: Tag,
  properties: Partial<HTMLElementTagNameMap[Tag]> = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[Tag] {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}

/** Returns the page's element with an id. */
export const find = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

const bars: HTMLElement[] = [];

/** Keeps the panels above this bar while it is shown, at any height: see style.css. */
export function leaveRoomAbove(bar: HTMLElement): void {
  bars.push(bar);
  new ResizeObserver(() => {
    const { style } = document.documentElement;
    const top = Math.min(...bars.filter((one) => !one.hidden).map((one) => one.getBoundingClientRect().top));
    if (Number.isFinite(top)) style.setProperty("--below", `${innerHeight - top + 10}px`);
    else style.removeProperty("--below");
  }).observe(bar);
}
