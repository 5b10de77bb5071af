import { Vector3 } from "three";
import { type Display, type Option, optionNames } from "./display";
import type { Stage } from "./stage";

interface Remembered {
  position: number[];
  target: number[];
  on: Option[];
}

const MAX_SCENES = 40; // scenes

/** Keeps camera and switches of each scene in the browser, for the next time that it is shown. */
export class Memory {
  private key = "";
  private cameraIsGiven = false;

  constructor(
    private readonly stage: Stage,
    private readonly display: Display,
  ) {
    stage.onMove(() => this.save());
  }

  /** The program has said where to look from, which counts more. */
  setCameraGiven(): void {
    this.cameraIsGiven = true;
  }

  /** Call when a scene is shown; `names` of its frames say which it is. True if something was remembered. */
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

  /** None in pages that may not have any, as in a notebook's frame. */
  private storage(): Storage | null {
    try {
      return localStorage;
    } catch {
      return null;
    }
  }
}
