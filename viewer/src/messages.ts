// Made by tools/generate_messages.py from viewer/messages.json; change that file instead.

/** First 4 bytes of a binary message. */
export const BinaryKind = {
  poses: 1,
  mesh: 2,
  key: 3,
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
  shape: ShapeMessage | null;
}

export interface SceneMessage {
  kind: "scene";
  count: number;
  frames: FrameMessage[];
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

export type ServerMessage = SceneMessage | TextMessage | CameraMessage;
