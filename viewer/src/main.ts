import * as THREE from "three";
import { Connection } from "./connection";
import { Display } from "./display";
import { keyCode } from "./keys";
import type { ServerMessage } from "./messages";
import { Panel } from "./panel";
import { ShownScene } from "./shown";
import { Stage } from "./stage";

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

const stage = new Stage(element<HTMLCanvasElement>("canvas"));
const shown = new ShownScene(stage.frames);
const help = element("help");
const display = new Display();
const panel = new Panel(element, display, shown.frames, redisplay, () => stage.savePicture(`${document.title}.png`));
element("scale").textContent = "grid: 1 m, 0.2 m";

function redisplay(): void {
  display.apply(shown.frames);
  stage.redraw();
}

function show(id: string, text: string): void {
  element(id).textContent = text;
  element(id).hidden = text === "";
}

function receive(message: ServerMessage): void {
  switch (message.kind) {
    case "scene":
      shown.readScene(message);
      redisplay();
      panel.refresh();
      break;
    case "text":
      document.title = message.title;
      show("message", message.message);
      show("error", message.error);
      break;
    case "camera":
      stage.lookFrom(new THREE.Vector3(...message.position), new THREE.Vector3(...message.target));
      break;
  }
  stage.redraw();
}

const connection = new Connection({
  opened() {
    shown.clear();
    element("ended").hidden = true;
  },
  message: receive,
  binary(data) {
    shown.readBinary(data);
    stage.redraw();
  },
  closed() {
    element("ended").hidden = false;
  },
});

const toggleHelp = (): void => {
  help.hidden = !help.hidden;
};
element("help-button").addEventListener("click", toggleHelp);

/** Keys that people type into the panel are not for the program. */
const isTyping = (target: EventTarget | null): boolean => target instanceof HTMLElement && target.closest("input, summary, button") !== null;
const leaveControls = (): void => (document.activeElement as HTMLElement | null)?.blur();

addEventListener("keydown", (event) => {
  if (event.altKey && panel.takeKey(event.code)) return event.preventDefault();
  if (event.key === "Tab" && panel.isOpen) return; // moves on in the panel
  if (isTyping(event.target)) {
    if (event.key === "Escape") {
      panel.close();
      leaveControls();
    }
    return;
  }
  if (event.key === "?") return toggleHelp();
  if (event.key === "Home") return stage.home();
  const code = keyCode(event);
  if (code === 0) return;
  connection.sendKey(code);
  if (["Tab", "Backspace", " ", "'", "/"].includes(event.key) || event.key.startsWith("Arrow")) event.preventDefault();
});
element("canvas").addEventListener("pointerdown", leaveControls);
for (const button of document.querySelectorAll("body > button")) button.addEventListener("click", () => (button as HTMLElement).blur());

/** For tests: what is on the page. */
Object.assign(window, {
  kinegraph: {
    frames: () => shown.frames.size,
    meshes: () => shown.meshCount,
    geometries: () => stage.renderer.info.memory.geometries,
    idle: () => stage.idle,
    position: (name: string) => stage.frames.getObjectByName(name)?.position.toArray() ?? null,
    message: () => element("message").textContent,
    error: () => element("error").textContent,
    ended: () => !element("ended").hidden,
  },
});
