// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.

import { writeCommand } from "./commands";

/** First 4 bytes of a binary message from the server. */
export const BinaryKind = {
  poses: 1,
  mesh: 2,
  joints: 3,
  motion: 4,
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

export interface SceneMessage {
  kind: "scene";
  count: number;
  frames: FrameMessage[];
}

export interface JointsMessage {
  kind: "joints";
  structure: number;
  joints: JointMessage[];
}

export interface TextMessage {
  kind: "text";
  title: string;
  message: string;
  error: string;
}

export interface CameraMessage {
  kind: "camera";
  position: number[];
  target: number[];
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
  texts: string[];
  violations: number[];
}

export const keyCommand = (code: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 1], ["int", code]);

export const setJointCommand = (structure: number, joint: number, value: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 2], ["int", structure], ["int", joint], ["number", value]);

export const resetJointsCommand = (structure: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 3], ["int", structure]);

export const randomJointsCommand = (structure: number): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 4], ["int", structure]);

export const moveFrameCommand = (structure: number, frame: number, pose: number[]): Uint8Array<ArrayBuffer> =>
  writeCommand(["int", 5], ["int", structure], ["int", frame], ["number[]", pose]);

export type ServerMessage = SceneMessage | JointsMessage | TextMessage | CameraMessage | SelectMessage | MotionMessage;
