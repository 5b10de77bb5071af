// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.
// clang-format off

import { writeCommand } from "./commands";

/** First 4 bytes of a binary message from the server. */
export const BinaryKind = {
  poses: 1,
  mesh: 2,
  joints: 3,
  motion: 4,
  quad: 5,
  image: 6,
  drawing: 7,
  samples: 8,
  surface: 9,
} as const;

export interface ShapeMessage {
  type: string;
  size: number[];
  color: number[];
  mesh: number;
}

export interface FrameMessage {
  id: number;
  name: string;
  parent: number;
  collides: number;
  details: string;
  shape: ShapeMessage | null;
}

export interface JointMessage {
  name: string;
  frame: number;
  unit: string;
  lower: number;
  upper: number;
}

export interface MovingMessage {
  frame: number;
  dof: number;
  scale: number;
  steps: string[];
  axes: number[];
}

export interface LinesMessage {
  points: number[];
  distances: number[];
  names: string[];
}

export interface WarningMessage {
  text: string;
  frames: number[];
  ignored: number;
}

export interface ControlMessage {
  id: number;
  type: string;
  label: string;
  folder: string;
  unit: string;
  key: string;
  lower: number;
  upper: number;
  number: number;
  text: string;
  options: string[];
}

export interface SeriesMessage {
  id: number;
  name: string;
  unit: string;
  curves: number;
}

export interface TraceMessage {
  name: string;
  type: string;
  values: number[];
}

export interface SceneMessage {
  kind: "scene";
  count: number;
  frames: FrameMessage[];
}

export interface JointsMessage {
  kind: "joints";
  structure: number;
  joints: JointMessage[];
  moving: MovingMessage[];
}

export interface TextMessage {
  kind: "text";
  title: string;
  message: string;
  error: string;
}

export interface CameraMessage {
  kind: "camera";
  pose: number[];
  distance: number;
  focal: number;
  ortho: number;
  aspect: number;
  near: number;
  far: number;
}

export interface AppearanceMessage {
  kind: "appearance";
  visualsOnly: number;
  background: number[];
  floor: number[];
  shadows: number;
  text: number;
  lights: number[];
  flat: number;
  wireframe: number;
  digits: number;
  events: number;
  cursor: number;
}

export interface NearMessage {
  kind: "near";
  lines: LinesMessage;
}

export interface WarningsMessage {
  kind: "warnings";
  warnings: WarningMessage[];
}

export interface SelectMessage {
  kind: "select";
  frame: number;
}

export interface MotionMessage {
  kind: "motion";
  slices: number;
  seconds: number;
  start: string;
  first: number;
  prefix: number;
  texts: string[];
  violations: number[];
  marked: number[][];
  touching: LinesMessage[];
  traces: TraceMessage[];
}

export interface ControlsMessage {
  kind: "controls";
  controls: ControlMessage[];
}

export interface DrawMessage {
  kind: "draw";
  name: string;
  type: string;
  frame: string;
  text: string;
  width: number;
  size: number;
  pose: number[];
  focal: number;
  aspect: number;
}

export interface UndrawMessage {
  kind: "undraw";
  name: string;
}

export interface PlotsMessage {
  kind: "plots";
  series: SeriesMessage[];
}

export interface NotifyMessage {
  kind: "notify";
  text: string;
  level: string;
}

export interface RunMessage {
  kind: "run";
  shown: number;
  steered: number;
  time: number;
  factor: number;
  paused: number;
  contacts: number[];
  perturbation: number[];
}

export const keyCommand = (code: number, modifiers: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 1], ["int", code], ["int", modifiers]);

export const setJointCommand = (structure: number, joint: number, value: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 2], ["int", structure], ["int", joint], ["number", value]);

export const resetJointsCommand = (structure: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 3], ["int", structure]);

export const randomJointsCommand = (structure: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 4], ["int", structure]);

export const moveFrameCommand = (structure: number, frame: number, pose: number[]): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 5], ["int", structure], ["int", frame], ["number[]", pose]);

export const nearCommand = (structure: number, margin: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 6], ["int", structure], ["number", margin]);

export const eventCommand = (what: number, code: number, modifiers: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 7], ["int", what], ["int", code], ["int", modifiers]);

export const cursorCommand = (frame: number, point: number[], normal: number[]): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 8], ["int", frame], ["number[]", point], ["number[]", normal]);

export const viewpointCommand = (pose: number[], distance: number, focal: number, ortho: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 9], ["number[]", pose], ["number", distance], ["number", focal], ["number", ortho]);

export const runCommand = (what: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 10], ["int", what]);

export const perturbCommand = (structure: number, frame: number, point: number[], target: number[]): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 11], ["int", structure], ["int", frame], ["number[]", point], ["number[]", target]);

export const warningsCommand = (structure: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 12], ["int", structure]);

export const controlCommand = (id: number, number: number, text: string): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 13], ["int", id], ["number", number], ["string", text]);

export const clickCommand = (frame: number, point: number[], normal: number[]): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 14], ["int", frame], ["number[]", point], ["number[]", normal]);

export const undoCommand = (structure: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 15], ["int", structure]);

export const redoCommand = (structure: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 16], ["int", structure]);

export type ServerMessage = SceneMessage | JointsMessage | TextMessage | CameraMessage | AppearanceMessage | NearMessage | WarningsMessage | SelectMessage | MotionMessage | ControlsMessage | DrawMessage | UndrawMessage | PlotsMessage | NotifyMessage | RunMessage;
