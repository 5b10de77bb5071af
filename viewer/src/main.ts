import * as THREE from "three";
import { Controls } from "./controls";
import { Connection, type Listener, readRecording, recordedMessages } from "./connection";
import { Display, type Option } from "./display";
import { find, make } from "./element";
import { Drawings } from "./drawings";
import { Exports } from "./exports";
import { Gizmo } from "./gizmo";
import { Help } from "./help";
import { Hover } from "./hover";
import { type JointEdits, OwnEdits, SentEdits } from "./joint_edits";
import { JointPanel } from "./joints";
import { Link } from "./link";
import { keyCode, modifiersOf } from "./keys";
import { lengthText } from "./lengths";
import { Measure } from "./measure";
import { InputEvents } from "./input";
import { Memory } from "./memory";
import {
  BinaryKind,
  clickCommand,
  keyCommand,
  type AppearanceMessage,
  type MotionMessage,
  type ServerMessage,
  viewpointCommand,
} from "./messages";
import { LoggedImages } from "./logged";
import { Motion, readSlices } from "./motion";
import { NearLines } from "./near";
import { Notices } from "./notices";
import { Warnings } from "./warnings";
import { requireWebGL } from "./webgl";
import { Panel } from "./panel";
import { Companion } from "./companion";
import { Player } from "./player";
import { Plots } from "./plots";
import { Pull } from "./pull";
import { Quads } from "./quads";
import { Quality } from "./quality";
import { Run } from "./run";
import { Section } from "./section";
import { Selection } from "./selection";
import { ShownScene } from "./shown";
import { Stage } from "./stage";
import { Timeline } from "./timeline";
import { Toolbar } from "./toolbar";

const PRESETS: Record<string, [number, number, number]> = {
  front: [1, 0, 0.001],
  side: [0, 1, 0.001],
  above: [0, -0.001, 1],
  aslant: [1, 1, 0.8],
};

requireWebGL();
const recorded = recordedMessages();
let connection: Connection | null = null;
const send = (command: Uint8Array<ArrayBuffer>): void => connection?.send(command);

const stage = new Stage(find<HTMLCanvasElement>("canvas"));
const shown = new ShownScene(stage.frames, stage.scene, () => stage.redraw());
stage.shapes.push(shown.shared);
const display = new Display();
const joints = new JointPanel(() => edits);
const own = recorded
  ? new OwnEdits(shown.frames, () => joints.pictured, (q) => {
      timeline.pause();
      joints.setState(q);
      moved();
    })
  : null;
const edits: JointEdits = own ?? new SentEdits(shown.frames, () => joints.current, send);
const help = new Help();
const measure = new Measure(stage);
const memory = new Memory(stage, display);
const near = new NearLines(stage, send);
const quads = new Quads();
const input = new InputEvents(stage, send);
const warnings = new Warnings(stage, shown.frames, recorded ? null : send, () => {
  panel.showWarnings(warnings.all, warnings.ignored);
  selection.refresh();
});
const controls = new Controls(recorded ? null : send);
const plots = new Plots();
const images = new LoggedImages(showProgram);
const drawings = new Drawings(stage, shown.frames, images);
const notices = new Notices();
let hasPlots = false;
const panel = new Panel(display, shown.frames, switched, (id) => selection.select(id), () => plots.request());
stage.onDraw(() => shown.prepare((at) => stage.pixelsPerMeter(at), stage.hurries));
const selection = new Selection(stage, shown.frames, joints, edits, recorded ? null : send, (id) => panel.select(id), (id) => warnings.about(id));
new Gizmo(stage);
new Section(stage);
const toolbar = new Toolbar(stage);
new Hover(stage, (id) => shown.frames.get(id)?.message.name ?? "");
const timeline = new Timeline(stage, shown, joints, moved);
const pull = new Pull(stage, shown.frames, () => edits, () => !run.isShown && (recorded !== null || timeline.current === null));
const run = new Run(stage, shown.frames, recorded ? null : send);
const exports = new Exports(stage, timeline, shown.frames, recorded !== null);
const link = new Link(stage, timeline);
let unplaced = false; // the poses of new frames have not arrived yet
let digits = false; // digit keys toggle parts of the picture
let cameras = 0; // number of received messages with a camera
let poses = 0; // number of received messages with poses
let announced: MotionMessage | null = null; // its slices have not arrived yet
stage.onSquare((square) => (find("scale").textContent = `grid: ${lengthText(square)}, ${lengthText(square / 5)}`));
find("presets").append(
  ...Object.keys(PRESETS).map((name) => make("button", { textContent: name, onclick: () => lookFrom(name) })),
);

function lookFrom(preset: string): void {
  stage.lookAlong(new THREE.Vector3(...PRESETS[preset]!));
}

/** Call when a user toggled an option. */
function switched(): void {
  memory.save();
  redisplay();
}

function redisplay(): void {
  display.apply(shown.frames);
  near.show(display.on.has("near"));
  warnings.show(display.on.has("warnings"));
  stage.redraw();
}

/** Call when frames have moved. */
function moved(): void {
  selection.follow();
  stage.redraw();
}

function show(id: string, text: string): void {
  find(id).textContent = text;
  find(id).hidden = text === "";
}

function setAppearance(appearance: AppearanceMessage): void {
  display.visualsOnly = appearance.visualsOnly !== 0;
  document.body.classList.toggle("no-text", appearance.visualsOnly !== 0 || appearance.text === 0);
  stage.setAppearance(appearance);
  display.wireframe = appearance.wireframe !== 0;
  digits = appearance.digits !== 0;
  input.setRequested(appearance.events, appearance.cursor !== 0);
  redisplay();
}

function showProgram(isNew: boolean): void {
  panel.showProgram(controls.count > 0 || hasPlots || images.names.length > 0, isNew);
}

function receive(message: ServerMessage): void {
  switch (message.kind) {
    case "scene":
      shown.readScene(message);
      if (link.hasCamera) memory.setCameraGiven();
      if (memory.recall(Array.from(shown.frames.values(), (frame) => frame.message.name))) panel.refreshOptions();
      redisplay();
      unplaced = true;
      panel.refresh();
      selection.refresh();
      drawings.refresh();
      break;
    case "controls":
      showProgram(controls.read(message.controls));
      break;
    case "draw":
      drawings.announce(message);
      break;
    case "undraw":
      drawings.remove(message.name);
      break;
    case "plots":
      hasPlots = message.series.length > 0;
      showProgram(plots.setSeries(message.series));
      break;
    case "notify":
      notices.show(message);
      break;
    case "joints":
      joints.setJoints(message);
      near.setStructure(message.structure);
      run.perturbation.structure = message.structure;
      warnings.setStructure(message.structure);
      break;
    case "text":
      document.title = message.title;
      show("message", message.message);
      show("error", message.error);
      break;
    case "camera":
      memory.setCameraGiven();
      if (cameras++ > 0 || !link.hasCamera) stage.setCamera(message);
      break;
    case "near":
      near.read(message);
      break;
    case "warnings":
      warnings.read(message.warnings);
      break;
    case "appearance":
      setAppearance(message);
      break;
    case "motion":
      announced = message.slices > 0 ? message : null;
      timeline.end();
      near.apply(announced === null);
      run.setMotion(announced !== null);
      exports.refresh();
      break;
    case "run":
      run.read(message);
      break;
    case "select":
      selection.select(message.frame, "translate");
      break;
    default:
      message satisfies never; // all kinds of messages are handled
  }
  stage.redraw();
}

function receiveBinary(data: ArrayBuffer): void {
  const kind = new DataView(data).getUint32(0, true);
  if (kind === BinaryKind.joints) {
    const q = new Float64Array(data, 8);
    own?.setHome(q);
    joints.setState(q);
  } else if (kind === BinaryKind.quad) {
    quads.read(data);
  } else if (kind === BinaryKind.drawing) {
    drawings.readData(data);
  } else if (kind === BinaryKind.samples) {
    plots.readSamples(data);
  } else if (kind === BinaryKind.motion && announced) {
    timeline.start(new Motion(announced, readSlices(data)));
    link.seek();
    exports.refresh();
  } else if (shown.readBinary(data)) {
    if (kind === BinaryKind.poses) ++poses;
    warnings.stir();
    if (unplaced && kind === BinaryKind.poses) {
      unplaced = false;
      stage.fitScene();
    }
    moved();
  }
}

const listener: Listener = {
  opened() {
    timeline.end();
    run.end();
    shown.clear();
    quads.clear();
    drawings.clear();
    plots.clear();
    controls.read([]);
    find("ended").hidden = true;
  },
  message: receive,
  binary: receiveBinary,
  closed() {
    find("ended").hidden = false;
  },
};
async function replay(recording: string): Promise<void> {
  const messages = await readRecording(recording);
  listener.opened();
  const seconds = messages.at(-1)?.time ?? 0;
  if (seconds > 0) {
    run.isPlayback = true;
    const player = new Player(messages, {
      deliver: (content) => (content instanceof ArrayBuffer ? receiveBinary(content) : receive(content)),
      clearDrawings: () => drawings.clear(),
    });
    timeline.onTime((time) => player.apply(time));
    plots.onSeek = (time) => timeline.showAt(player.timeOfSample(time) / timeline.pace);
    timeline.start(player.motion);
    link.seek();
    exports.refresh();
    new Companion(stage, timeline);
  } else {
    for (const { content } of messages) content instanceof ArrayBuffer ? receiveBinary(content) : receive(content);
  }
}
if (recorded) void replay(recorded);
else connection = new Connection(listener);

stage.onMove(() => {
  const { pose, distance, focal, ortho } = stage.viewpoint.describe();
  send(viewpointCommand(pose, distance, focal, ortho));
});

stage.onClick((event) => {
  if (selection.isHeld || input.blocks || pull.isHolding) return;
  const hit = stage.pick(event);
  if (hit) send(clickCommand(hit.id, hit.point.toArray(), hit.normal.toArray()));
  if (measure.on) measure.click(hit);
  else if (hit) selection.select(hit.id);
  else selection.close();
});

const ROTATIONS: Record<string, [number, number, number]> = {
  ArrowLeft: [-0.1, 0, 1],
  ArrowRight: [0.1, 0, 1],
  ArrowUp: [0, 0.1, 1],
  ArrowDown: [0, -0.1, 1],
  PageUp: [0, 0, 1.15],
  PageDown: [0, 0, 1 / 1.15],
};

/** Handles Alt and a key. */
function takeAlt(code: string): boolean {
  const digit = /^Digit([1-4])$/.exec(code);
  if (digit) lookFrom(Object.keys(PRESETS)[Number(digit[1]) - 1]!);
  else if (ROTATIONS[code]) stage.viewpoint.turn(...ROTATIONS[code]);
  else if (code === "KeyP") exports.savePicture();
  else if (code === "KeyR") measure.toggle();
  else if (code === "KeyK") timeline.current ? timeline.toggle() : run.toggle();
  else if (code === "KeyF") toolbar.fit();
  else if (code === "KeyE") pull.toggle();
  else if (code === "KeyQ") stage.setOrthographic(!stage.isOrthographic);
  else if (code === "KeyG") selection.toggleHandles("translate");
  else if (code === "KeyB") selection.toggleHandles("rotate");
  else return panel.takeKey(code);
  return true;
}

const DIGITS: Record<string, Option> = { 1: "solid", 2: "markers", 3: "axes", 4: "near", 7: "names" };

/** Closes the topmost open part. */
function closeTopmost(): boolean {
  if (help.isOpen) help.toggle();
  else if (measure.on) measure.toggle();
  else if (selection.selected !== null) selection.close();
  else if (panel.isOpen) panel.close();
  else return false;
  leaveControls();
  return true;
}

const TEXT = /^(text|search|number)$/;
const OWN_KEYS: Record<string, RegExp> = {
  range: /^(Arrow|Page|Home|End)/,
  checkbox: /^ $/,
};

/** Returns whether a control handles the key itself: all keys in a text field, some in other controls. */
function isTyping({ target, key }: KeyboardEvent): boolean {
  const control = target instanceof HTMLElement ? target.closest("input, select, summary, button") : null;
  if (control instanceof HTMLInputElement) return TEXT.test(control.type) || (OWN_KEYS[control.type]?.test(key) ?? true);
  if (control instanceof HTMLSelectElement) return true;
  return control !== null && (key === "Enter" || key === " ");
}
const leaveControls = (): void => (document.activeElement as HTMLElement | null)?.blur();

addEventListener("keydown", (event) => {
  if (input.blocks) return;
  if (event.altKey && takeAlt(event.code)) return event.preventDefault();
  if (event.key === "Escape" && closeTopmost()) return;
  if (event.key === "Tab") return; // moves between the controls
  if (isTyping(event)) return;
  if (event.ctrlKey || event.metaKey) {
    const letter = event.key.toLowerCase();
    if (letter === "z" || letter === "y") {
      joints.undo(letter === "y" || event.shiftKey);
      return event.preventDefault();
    }
  }
  if (event.key === "?") return help.toggle();
  if (event.key === "Home") return stage.home();
  if (timeline.takeKey(event.key)) return event.preventDefault();
  if (!event.ctrlKey && !event.metaKey && controls.takeKey(event.key)) return;
  const code = keyCode(event);
  if (code === 0) return;
  const option = digits ? DIGITS[event.key] : undefined;
  if (option) panel.toggle(option);
  send(keyCommand(code, modifiersOf(event)));
  if (["Backspace", " ", "'", "/"].includes(event.key) || event.key.startsWith("Arrow")) event.preventDefault();
});
stage.canvas.addEventListener("pointerdown", leaveControls);
for (const button of document.querySelectorAll("body > button"))
  button.addEventListener("click", () => (button as HTMLElement).blur());

/** The page's content, for tests. */
Object.assign(window, {
  kinegraph: {
    frames: () => shown.frames.size,
    blocked: () => input.blocks,
    camera: () => stage.camera.position.toArray(),
    viewpoint: () => stage.viewpoint.describe(),
    nearLines: () => near.count,
    violatedPairs: () => timeline.pairCount,
    warnings: () => ({ marks: warnings.markCount, texts: warnings.all.map(({ text }) => text) }),
    quads: () => quads.count,
    drawings: () => drawings.names,
    plots: () => plots.sizes,
    meshes: () => shown.meshCount,
    geometries: () => stage.renderer.info.memory.geometries,
    idle: () => stage.idle && !shown.pictures.busy,
    pictures: () => stage.renderer.info.render.frame,
    poses: () => poses,
    resolution: () => stage.resolution,
    quality: () => new Quality(true),
    hurry: () => stage.drawHurriedly(),
    triangles: () => stage.renderer.info.render.triangles,
    position: (name: string) => stage.frames.getObjectByName(name)?.position.toArray() ?? null,
    pose: (name: string) => {
      const anchor = stage.frames.getObjectByName(name);
      return anchor ? [...anchor.position.toArray(), anchor.quaternion.w, ...anchor.quaternion.toArray().slice(0, 3)] : null;
    },
    reach: (name: string, pose: number[]) => {
      const [x, y, z, qw, qx, qy, qz] = pose as [number, number, number, number, number, number, number];
      edits.reach({
        frame: stage.frames.getObjectByName(name)!.userData.id as number,
        point: new THREE.Vector3(),
        target: new THREE.Vector3(x, y, z),
        rotation: new THREE.Quaternion(qx, qy, qz, qw),
      });
      return Array.from(joints.pictured.q);
    },
    message: () => find("message").textContent,
    error: () => find("error").textContent,
    ended: () => !find("ended").hidden,
    selected: () => (selection.selected === null ? null : shown.frames.get(selection.selected)!.message.name),
    asText: () => selection.asText(),
    joints: () => Array.from(joints.current.q),
    link: () => link.text,
    seconds: () => timeline.current?.message.seconds ?? null,
    target: () => stage.viewpoint.target.toArray(),
    slice: () => (timeline.current ? timeline.slice : null),
    marks: () => timeline.markCount,
    playing: () => timeline.isPlaying,
    run: () => (run.isShown ? { paused: run.isPaused, arrows: run.arrows.count } : null),
    pixel: (x: number, y: number, z: number) => {
      const p = new THREE.Vector3(x, y, z).project(stage.camera);
      return [((p.x + 1) / 2) * stage.canvas.clientWidth, ((1 - p.y) / 2) * stage.canvas.clientHeight];
    },
  },
});
