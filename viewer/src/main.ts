import * as THREE from "three";
import { Connection } from "./connection";
import { keyCode } from "./keys";
import type { ServerMessage } from "./messages";
import { ShownScene } from "./shown";
import { Stage } from "./stage";

const element = <T extends HTMLElement>(id: string): T => document.getElementById(id) as T;

const stage = new Stage(element<HTMLCanvasElement>("canvas"));
const shown = new ShownScene(stage.frames);
const help = element("help");
element("scale").textContent = "grid: 1 m, 0.2 m";

function show(id: string, text: string): void {
  element(id).textContent = text;
  element(id).hidden = text === "";
}

function receive(message: ServerMessage): void {
  switch (message.kind) {
    case "scene":
      shown.readScene(message);
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

addEventListener("keydown", (event) => {
  if (event.key === "?") return toggleHelp();
  if (event.key === "Home") return stage.home();
  const code = keyCode(event);
  if (code === 0) return;
  connection.sendKey(code);
  if (["Tab", "Backspace", " ", "'", "/"].includes(event.key) || event.key.startsWith("Arrow")) event.preventDefault();
});

/** For tests: what is on the page. */
Object.assign(window, {
  kinegraph: {
    frames: () => shown.frameCount,
    objects: () => shown.objectCount,
    meshes: () => shown.meshCount,
    geometries: () => stage.renderer.info.memory.geometries,
    idle: () => stage.idle,
    position: (name: string) => stage.frames.getObjectByName(name)?.position.toArray() ?? null,
    message: () => element("message").textContent,
    error: () => element("error").textContent,
    ended: () => !element("ended").hidden,
  },
});
