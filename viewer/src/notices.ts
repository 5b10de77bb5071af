import { make } from "./element";
import type { NotifyMessage } from "./messages";

const SECONDS: Record<string, number> = { info: 5, warning: 8, error: 15 };

/** Texts of the program that pass; a click removes one. */
export class Notices {
  private readonly root = make("div", { id: "notices" });

  constructor() {
    this.root.setAttribute("role", "status");
    document.body.append(this.root);
  }

  show({ text, level }: NotifyMessage): void {
    const notice = make("button", { className: `notice ${level}`, textContent: text, title: "click to remove", onclick: () => notice.remove() });
    this.root.append(notice);
    setTimeout(() => notice.remove(), 1000 * (SECONDS[level] ?? 5));
  }
}
