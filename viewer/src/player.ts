import * as THREE from "three";
import type { Timed } from "./connection";
import { BinaryKind, type MotionMessage, type ServerMessage } from "./messages";
import { Motion, readSlices } from "./motion";

const RATE = 60; // slices per second
const LARGEST = 5e7; // numbers in all slices

type Content = ServerMessage | ArrayBuffer;

const kindOf = (content: Content): number => (content instanceof ArrayBuffer ? (content.byteLength < 4 ? 0 : new DataView(content).getUint32(0, true)) : 0);
const isText = (content: Content): content is ServerMessage => !(content instanceof ArrayBuffer);

/** Kinds of binary messages with shapes. */
const SHAPES: readonly number[] = [BinaryKind.mesh, BinaryKind.surface, BinaryKind.image];

const isStructure = (content: Content): boolean =>
  isText(content) ? content.kind === "scene" || content.kind === "joints" : SHAPES.includes(kindOf(content));
const isMotion = (content: Content): boolean => (isText(content) ? content.kind === "motion" : [BinaryKind.poses, BinaryKind.joints, BinaryKind.motion].includes(kindOf(content) as never));
const isLog = (content: Content): boolean => (isText(content) ? content.kind === "plots" : kindOf(content) === BinaryKind.samples);

/** What a player acts on. */
export interface Playground {
  deliver(content: Content): void;
  clearDrawings(): void;
}

/** Plays a recorded run: frames and joints as a motion, and everything else at its time. Plots show the whole run. */
export class Player {
  readonly motion: Motion;
  private readonly events: Timed[] = []; // after the start
  private readonly initial: Content[] = [];
  private readonly samples: { logged: number; time: number }[] = []; // times of the last samples of messages
  private at = 0; // number of events that have been delivered
  private time = 0;

  constructor(
    messages: readonly Timed[],
    private readonly ground: Playground,
  ) {
    for (const { time, content } of messages) {
      if (!isText(content) && content.byteLength === 0) continue; // the end
      if (isLog(content)) this.addSamples(time, content);
      else if (isMotion(content)) continue;
      else if (time > 0) this.events.push({ time, content });
      else this.initial.push(content);
    }
    this.deliverAll(messages.filter(({ time, content }) => time === 0 && !isLog(content) && (!isMotion(content) || SLOTS.includes(kindOf(content)))));
    for (const { content } of messages) if (isLog(content)) ground.deliver(content);
    this.motion = motionOf(messages);
  }

  /** Shows everything but frames and joints as it was at a time. */
  apply(time: number): void {
    if (time < this.time) this.rewind();
    const isStep = time - this.time < 1;
    for (; this.at < this.events.length && this.events[this.at]!.time <= time; ++this.at) {
      const { content } = this.events[this.at]!;
      if (isStep || !isText(content) || content.kind !== "notify") this.ground.deliver(content);
    }
    this.time = time;
  }

  /** Returns the time of the recording when a value was logged at a time of the program. */
  timeOfSample(logged: number): number {
    return (this.samples.find((sample) => sample.logged >= logged) ?? this.samples.at(-1))?.time ?? 0;
  }

  private rewind(): void {
    const changes = this.events.slice(0, this.at).some(({ content }) => isStructure(content));
    this.ground.clearDrawings();
    for (const content of this.initial) if (changes || !isStructure(content)) this.ground.deliver(content);
    this.at = 0;
    this.time = 0;
  }

  private deliverAll(messages: readonly Timed[]): void {
    for (const { content } of messages) this.ground.deliver(content);
  }

  private addSamples(time: number, content: Content): void {
    if (isText(content)) return;
    const view = new DataView(content);
    let at = 8, last = -Infinity;
    for (let left = view.getUint32(4, true); left > 0; --left) {
      last = Math.max(last, view.getFloat64(at + 8, true));
      at += 16 + 8 * view.getUint32(at + 4, true);
    }
    this.samples.push({ logged: last, time });
  }
}

/** Kinds that the scene needs at the start. */
const SLOTS: readonly number[] = [BinaryKind.poses, BinaryKind.joints];

/** Samples poses and joint values evenly. A motion within the run plays from when it was shown. */
function motionOf(messages: readonly Timed[]): Motion {
  const seconds = messages.at(-1)!.time;
  let frames = 0, dofs = 0;
  for (const { content } of messages) {
    if (isText(content) && content.kind === "scene") frames = Math.max(frames, content.count);
    else if (!isText(content) && kindOf(content) === BinaryKind.joints) dofs = Math.max(dofs, (content.byteLength - 8) / 8);
  }
  const size = 7 * frames + dofs;
  const slices = Math.max(2, Math.min(Math.ceil(seconds * RATE) + 1, Math.floor(LARGEST / Math.max(size, 1))));
  const poses = new Float32Array(7 * frames * slices), q = new Float32Array(dofs * slices);
  const now = { poses: new Float32Array(7 * frames), q: new Float32Array(dofs) };
  for (let i = 0; i < frames; ++i) now.poses[7 * i + 3] = 1;
  let announced: MotionMessage | null = null, inner: { motion: Motion; start: number } | null = null;

  const read = ({ time, content }: Timed): void => {
    if (isText(content)) {
      if (content.kind === "motion") [announced, inner] = [content.slices > 0 ? content : null, null];
      return;
    }
    const view = new DataView(content), kind = kindOf(content);
    if (kind === BinaryKind.motion && announced) inner = { motion: new Motion(announced, readSlices(content)), start: time };
    else if (kind === BinaryKind.joints) now.q.set(new Float64Array(content, 8));
    else if (kind === BinaryKind.poses) {
      for (let i = 0; i < view.getUint32(4, true); ++i) {
        const at = 8 + 32 * i, id = view.getUint32(at, true);
        for (let k = 0; k < 7; ++k) now.poses[7 * id + k] = view.getFloat32(at + 4 + 4 * k, true);
      }
    }
  };
  const object = new THREE.Object3D();
  const place = (time: number, to: Float32Array): void => {
    if (!inner) return;
    const { motion, start } = inner;
    const moment = Math.min((time - start) / Math.max(motion.message.seconds, 1e-3), 1) * (motion.slices - 1);
    for (let i = 0; i < frames; ++i) {
      object.position.fromArray(now.poses, 7 * i);
      object.quaternion.set(now.poses[7 * i + 4]!, now.poses[7 * i + 5]!, now.poses[7 * i + 6]!, now.poses[7 * i + 3]!);
      motion.place(object, i, moment);
      to.set([...object.position.toArray(), object.quaternion.w, object.quaternion.x, object.quaternion.y, object.quaternion.z], 7 * i);
    }
    if (motion.dofs === dofs) now.q.set(motion.state(moment));
  };
  let next = 0;
  for (let slice = 0; slice < slices; ++slice) {
    const time = (slice / (slices - 1)) * seconds;
    while (next < messages.length && messages[next]!.time <= time + 1e-9) read(messages[next++]!);
    poses.set(now.poses, 7 * frames * slice);
    place(time, poses.subarray(7 * frames * slice));
    q.set(now.q, dofs * slice);
  }
  const message: MotionMessage = { kind: "motion", slices, seconds, start: "pause", first: 0, prefix: 0, texts: [], violations: [], marked: [], touching: [], traces: [] };
  return new Motion(message, { slices, frames, dofs, poses, q });
}
