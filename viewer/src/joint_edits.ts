import type { JointMessage, MovingMessage } from "./messages";
import { randomJointsCommand, redoCommand, resetJointsCommand, setJointCommand, undoCommand } from "./messages";
import { type Goal, Kinematics } from "./kinematics";
import type { Shown } from "./shown";

/** What the page knows of the dofs. */
export interface JointState {
  structure: number; // number of the scene
  joints: JointMessage[];
  moving: MovingMessage[];
  q: ArrayLike<number>; // as shown, which may be a time of a motion
}

/** Edits of joint values: by the program, or on a saved page by the page itself. */
export interface JointEdits {
  set(changes: ReadonlyMap<number, number>): void;
  reset(): void;
  random(): void;
  undo(): void;
  redo(): void;
  /** Brings a point of a frame to a target, by inverse kinematics. */
  reach(goal: Goal): void;
  /** Returns whether dofs move a frame. */
  movesFrame(id: number): boolean;
}

type Frames = ReadonlyMap<number, Shown>;

const kinematicsOf = (frames: Frames, { joints, moving, q }: JointState): Kinematics => new Kinematics(frames, joints, moving, q);

/** The differences between joint values. */
function changesOf(from: ArrayLike<number>, to: readonly number[]): Map<number, number> {
  const changes = new Map<number, number>();
  to.forEach((value, i) => value !== from[i] && changes.set(i, value));
  return changes;
}

/** Sends edits to the program, which updates all browsers. */
export class SentEdits implements JointEdits {
  constructor(
    private readonly frames: Frames,
    private readonly state: () => JointState,
    private readonly send: (command: Uint8Array<ArrayBuffer>) => void,
  ) {}

  set(changes: ReadonlyMap<number, number>): void {
    for (const [index, value] of changes) this.send(setJointCommand(this.state().structure, index, value));
  }

  reset(): void {
    this.send(resetJointsCommand(this.state().structure));
  }

  random(): void {
    this.send(randomJointsCommand(this.state().structure));
  }

  undo(): void {
    this.send(undoCommand(this.state().structure));
  }

  redo(): void {
    this.send(redoCommand(this.state().structure));
  }

  reach(goal: Goal): void {
    const state = this.state();
    this.set(changesOf(state.q, kinematicsOf(this.frames, state).reach(goal)));
  }

  movesFrame(id: number): boolean {
    return kinematicsOf(this.frames, this.state()).movesFrame(id);
  }
}

const MOST = 100; // steps that can be undone
const PAUSE = 1000; // ms: a longer one separates edits
const REACH = 0.5; // range to each side of random values without limits

/** Edits the joint values of a saved page, and moves its frames. */
export class OwnEdits implements JointEdits {
  private home: number[] = [];
  private past: number[][] = [];
  private future: number[][] = [];
  private lastEdit = -Infinity; // ms

  /** `show` is called with the new joint values, after the frames have been moved. */
  constructor(
    private readonly frames: Frames,
    private readonly state: () => JointState,
    private readonly show: (q: number[]) => void,
  ) {}

  /** Call with the joint values of the file. */
  setHome(q: ArrayLike<number>): void {
    this.home = Array.from(q);
    this.past = [];
    this.future = [];
  }

  set(changes: ReadonlyMap<number, number>): void {
    this.edit(Array.from(this.state().q, (value, i) => changes.get(i) ?? value));
  }

  reset(): void {
    this.lastEdit = -Infinity;
    this.edit(this.home);
  }

  random(): void {
    const { joints, q } = this.state();
    this.lastEdit = -Infinity;
    this.edit(
      Array.from(q, (value, i) => {
        const { lower, upper } = joints[i]!;
        const [from, to] = lower <= upper ? [lower, upper] : [value - REACH, value + REACH];
        return from + Math.random() * (to - from);
      }),
    );
  }

  undo(): void {
    this.restore(this.past, this.future);
  }

  redo(): void {
    this.restore(this.future, this.past);
  }

  reach(goal: Goal): void {
    this.edit(kinematicsOf(this.frames, this.state()).reach(goal));
  }

  movesFrame(id: number): boolean {
    return kinematicsOf(this.frames, this.state()).movesFrame(id);
  }

  private edit(q: readonly number[]): void {
    const now = performance.now();
    if (now - this.lastEdit > PAUSE) this.past = [...this.past.slice(1 - MOST), Array.from(this.state().q)];
    this.lastEdit = now;
    this.future = [];
    this.move(q);
  }

  private restore(from: number[][], to: number[][]): void {
    const q = from.pop();
    if (!q) return;
    to.push(Array.from(this.state().q));
    this.lastEdit = -Infinity;
    this.move(q);
  }

  private move(q: readonly number[]): void {
    kinematicsOf(this.frames, this.state()).place(q);
    this.show(q.slice());
  }
}
