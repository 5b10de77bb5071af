import { Quaternion, Vector3 } from "three";
import type { JointMessage, MovingMessage } from "./messages";
import type { Shown } from "./shown";
import { solve } from "./linear";

/** A pose relative to the parent. */
interface Place {
  position: Vector3;
  rotation: Quaternion;
}

const AGREES = { position: 1e-4, rotation: 1e-3 }; // m, rad: rounding of poses and joint values
const ITERATIONS = 30;
const DIFFERENCE = 1e-6; // of joint values, for derivatives
const FAR = 0.2; // m: largest step to a target
const ROTATION_WEIGHT = 0.3; // m per rad
const WORSE = 0.002; // m: farther from the target than this, the rotation is given up

/** Returns the pose that the dofs of a joint produce. */
function motionOf({ dof, scale, steps, axes }: MovingMessage, q: ArrayLike<number>): Place {
  const position = new Vector3(), rotation = new Quaternion();
  let at = dof;
  steps.forEach((step, i) => {
    const axis = new Vector3().fromArray(axes, 3 * i);
    if (step === "shift") {
      position.add(axis.multiplyScalar(scale * q[at++]!).applyQuaternion(rotation));
    } else if (step === "turn") {
      rotation.multiply(new Quaternion().setFromAxisAngle(axis, scale * q[at++]!));
    } else if (step === "quaternion") {
      rotation.multiply(new Quaternion(q[at + 1]!, q[at + 2]!, q[at + 3]!, q[at]!).normalize());
      at += 4;
    } else if (step === "circle") {
      rotation.multiply(new Quaternion(0, 0, q[at + 1]!, q[at]!).normalize());
      at += 2;
    } else {
      ++at;
    }
  });
  return { position, rotation };
}

/** Returns the rotation from `a` to `b` as a vector, rad. */
function rotationBetween(a: Quaternion, b: Quaternion): Vector3 {
  const turn = b.clone().multiply(a.clone().invert());
  if (turn.w < 0) turn.set(-turn.x, -turn.y, -turn.z, -turn.w);
  const sine = Math.hypot(turn.x, turn.y, turn.z);
  const factor = sine < 1e-9 ? 2 : (2 * Math.atan2(sine, turn.w)) / sine;
  return new Vector3(turn.x, turn.y, turn.z).multiplyScalar(factor);
}

/** A point of a frame and where it shall be, if possible with a rotation of the frame. */
export interface Goal {
  frame: number;
  point: Vector3; // in the frame
  target: Vector3;
  rotation: Quaternion | null;
}

/** Forward and inverse kinematics of the shown frames. */
export class Kinematics {
  private moving = new Map<number, MovingMessage>(); // by frame; those that agree with the shown poses
  private readonly fixed = new Map<number, Place>(); // other frames, relative to their parents
  private q: number[];

  /** Frames have their shown poses at joint values `q`. A frame whose pose does not follow from `q`, as one that a
   * motion has moved to another parent, is fixed to its parent. */
  constructor(
    private readonly frames: ReadonlyMap<number, Shown>,
    private readonly joints: readonly JointMessage[],
    moving: readonly MovingMessage[],
    q: ArrayLike<number>,
  ) {
    this.q = Array.from(q);
    // Errors of rounding would grow with each edit.
    for (const { anchor } of frames.values()) anchor.quaternion.normalize();
    const known = new Map(moving.map((entry) => [entry.frame, entry]));
    for (const [id, { message, anchor }] of frames) {
      const above = frames.get(message.parent)?.anchor;
      const back = above?.quaternion.clone().invert() ?? new Quaternion();
      const place = {
        position: anchor.position.clone().sub(above?.position ?? new Vector3()).applyQuaternion(back),
        rotation: back.clone().multiply(anchor.quaternion).normalize(),
      };
      const entry = known.get(id);
      const expected = entry && motionOf(entry, this.q);
      const agrees = expected && expected.position.distanceTo(place.position) < AGREES.position && rotationBetween(expected.rotation, place.rotation).length() < AGREES.rotation;
      if (agrees) this.moving.set(id, entry);
      else this.fixed.set(id, place);
    }
  }

  /** Returns whether dofs move a frame. */
  movesFrame(id: number): boolean {
    return this.above(id).some((frame) => this.moving.has(frame));
  }

  /** Returns the world pose of a frame. */
  pose(id: number, q: ArrayLike<number>): Place {
    const place: Place = { position: new Vector3(), rotation: new Quaternion() };
    for (const frame of this.above(id)) {
      const entry = this.moving.get(frame);
      const { position, rotation } = entry ? motionOf(entry, q) : this.fixed.get(frame)!;
      place.position.applyQuaternion(rotation).add(position);
      place.rotation.premultiply(rotation);
    }
    return place;
  }

  /** Moves all frames to where joint values lead them. */
  place(q: ArrayLike<number>): void {
    const done = new Set<number>();
    const placeOne = (id: number): void => {
      const shown = this.frames.get(id);
      if (!shown || done.has(id)) return;
      done.add(id);
      placeOne(shown.message.parent);
      const above = this.frames.get(shown.message.parent)?.anchor;
      const entry = this.moving.get(id);
      const { position, rotation } = entry ? motionOf(entry, q) : this.fixed.get(id)!;
      shown.anchor.position.copy(position);
      shown.anchor.quaternion.copy(rotation);
      if (!above) return;
      shown.anchor.position.applyQuaternion(above.quaternion).add(above.position);
      shown.anchor.quaternion.premultiply(above.quaternion).normalize();
    };
    for (const id of this.frames.keys()) placeOne(id);
  }

  /** Returns joint values, within their limits, that bring a goal as near as possible; the rotation only where the
   * target can be reached with it. */
  reach(goal: Goal): number[] {
    const without = this.approach({ ...goal, rotation: null });
    if (!goal.rotation) return without;
    const whole = this.approach(goal);
    return this.distance(goal, whole) < this.distance(goal, without) + WORSE ? whole : without;
  }

  /** The frame and those above it, from itself to the root. */
  private above(id: number): number[] {
    const chain: number[] = [];
    for (let at = id; this.frames.has(at) && chain.length <= this.frames.size; at = this.frames.get(at)!.message.parent) chain.push(at);
    return chain;
  }

  private distance(goal: Goal, q: number[]): number {
    const { position, rotation } = this.pose(goal.frame, q);
    return goal.point.clone().applyQuaternion(rotation).add(position).distanceTo(goal.target);
  }

  private residual(goal: Goal, q: number[]): number[] {
    const { position, rotation } = this.pose(goal.frame, q);
    const away = goal.target.clone().sub(goal.point.clone().applyQuaternion(rotation).add(position));
    if (!goal.rotation) return away.toArray();
    return [...away.toArray(), ...rotationBetween(rotation, goal.rotation).multiplyScalar(ROTATION_WEIGHT).toArray()];
  }

  private clamp(dof: number, value: number): number {
    const joint = this.joints[dof];
    return joint && joint.lower <= joint.upper ? Math.max(joint.lower, Math.min(value, joint.upper)) : value;
  }

  /** Quaternions and circles have norm 1. */
  private normalize(q: number[]): void {
    for (const { dof, steps } of this.moving.values()) {
      let at = dof;
      for (const step of steps) {
        const count = step === "quaternion" ? 4 : step === "circle" ? 2 : 1;
        const norm = Math.hypot(...q.slice(at, at + count));
        if (count > 1 && norm > 0) for (let i = 0; i < count; ++i) q[at + i]! /= norm;
        at += count;
      }
    }
  }

  /** Damped least squares (Levenberg-Marquardt), within the limits. */
  private approach(goal: Goal): number[] {
    const dofs = new Set<number>();
    for (const frame of this.above(goal.frame)) {
      const entry = this.moving.get(frame);
      const count = entry?.steps.reduce((sum, step) => sum + (step === "quaternion" ? 4 : step === "circle" ? 2 : 1), 0) ?? 0;
      for (let i = 0; i < count; ++i) dofs.add(entry!.dof + i);
    }
    let q = this.q.slice(), rest = this.residual(goal, q), error = Math.hypot(...rest), damping = 1e-3;
    for (let i = 0; i < ITERATIONS && error > 1e-6; ++i) {
      const part = Math.min(1, FAR / error), wanted = rest.map((x) => part * x);
      const columns = [...dofs].map((dof) => {
        const moved = q.slice();
        moved[dof]! += DIFFERENCE;
        return { dof, column: this.residual(goal, moved).map((x, k) => (rest[k]! - x) / DIFFERENCE) };
      });
      const free = columns.filter(({ dof, column }) => {
        const push = column.reduce((sum, x, k) => sum + x * rest[k]!, 0);
        return this.clamp(dof, q[dof]! + Math.sign(push) * DIFFERENCE) !== q[dof]!;
      });
      const normal = wanted.map((_, r) => wanted.map((_, c) => free.reduce((sum, { column }) => sum + column[r]! * column[c]!, r === c ? damping : 0)));
      const y = solve(normal, wanted);
      const next = q.slice();
      for (const { dof, column } of free) next[dof] = this.clamp(dof, q[dof]! + column.reduce((sum, x, k) => sum + x * y[k]!, 0));
      this.normalize(next);
      const left = this.residual(goal, next), size = Math.hypot(...left);
      if (size < error) {
        const gain = error - size;
        [q, rest, error, damping] = [next, left, size, Math.max(damping / 4, 1e-6)];
        if (gain < 1e-7) break;
      } else if ((damping *= 8) > 1e3) break;
    }
    return q;
  }
}
