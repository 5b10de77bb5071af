import { Vector3 } from "three";
import { type Display, type Option, optionNames } from "./display";
import type { Stage } from "./stage";

interface Remembered {
  position: number[];
  target: number[];
  on: Option[];
}

const MAX_SCENES = 40;

/** Stores the camera and options of each scene in the browser for its next use. */
export class Memory {
  private key = "";
  private cameraIsGiven = false;

  constructor(
    private readonly stage: Stage,
    private readonly display: Display,
  ) {
    stage.onMove(() => this.save());
  }

  /** Call when the program has set the camera, which takes precedence. */
  setCameraGiven(): void {
    this.cameraIsGiven = true;
  }

  /** Call when a scene is shown; the `names` of its frames identify it. Returns whether stored values were found. */
  recall(names: Iterable<string>): boolean {
    const key = `kinegraph ${document.title} ${[...names].slice(0, 30).join(" ")}`;
    if (key === this.key) return false;
    this.key = key;
    const text = this.storage()?.getItem(key);
    if (!text) return false;
    const { position, target, on } = JSON.parse(text) as Remembered;
    this.display.on.clear();
    for (const name of optionNames) if (on.includes(name)) this.display.on.add(name);
    if (!this.cameraIsGiven) {
      this.stage.viewpoint.lookFrom(new Vector3(...position), new Vector3(...target));
      this.stage.keepCamera();
    }
    return true;
  }

  save(): void {
    const storage = this.storage();
    if (!storage || this.key === "") return;
    const numbers = (v: Vector3): number[] => v.toArray();
    const now: Remembered = {
      position: numbers(this.stage.camera.position),
      target: numbers(this.stage.viewpoint.target),
      on: [...this.display.on],
    };
    const keys = Object.keys(storage).filter((key) => key.startsWith("kinegraph "));
    if (keys.length >= MAX_SCENES && !keys.includes(this.key)) storage.removeItem(keys[0]!);
    storage.setItem(this.key, JSON.stringify(now));
  }

  /** Returns the browser's storage; null in pages without access to it, as in a notebook's frame. */
  private storage(): Storage | null {
    try {
      return localStorage;
    } catch {
      return null;
    }
  }
}
