import { Group, LineSegments, Mesh, type Object3D, Points, Quaternion, Vector3 } from "three";
import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { find, make } from "./element";
import { filmOf } from "./film";
import { WideLines } from "./lines";
import type { Shown } from "./shown";
import { isSeen } from "./display";
import type { Stage } from "./stage";
import type { Timeline } from "./timeline";

const FRAMES_PER_SECOND = 30;
const STILL = FRAMES_PER_SECOND / 2; // pictures of the end

function save(url: string, file: string): void {
  make("a", { href: url, download: file }).click();
}

function saveBlob(blob: Blob, file: string): void {
  const url = URL.createObjectURL(blob);
  save(url, file);
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** Copies a shape to an independent object; geometries and materials are shared. */
function copyOf(object: Object3D): Object3D {
  const plain =
    object instanceof WideLines
      ? object.plain()
      : object instanceof Mesh
        ? new Mesh(object.geometry, object.material)
        : object instanceof Points
          ? new Points(object.geometry, object.material)
          : object instanceof LineSegments
            ? new LineSegments(object.geometry, object.material)
            : new Group();
  plain.position.copy(object.position);
  plain.quaternion.copy(object.quaternion);
  plain.scale.copy(object.scale);
  for (const child of object.children) if (isSeen(child)) plain.add(copyOf(child));
  return plain;
}

/** Builds the tree of frames for glTF, whose y axis points up. Hidden shapes are omitted. */
function hierarchyOf(frames: ReadonlyMap<number, Shown>): Group {
  const root = new Group();
  root.name = "scene";
  root.quaternion.setFromAxisAngle(new Vector3(1, 0, 0), -Math.PI / 2);
  const nodes = new Map(Array.from(frames.keys(), (id) => [id, new Group()]));
  for (const [id, { message, anchor, object }] of frames) {
    const node = nodes.get(id)!;
    const above = frames.get(message.parent)?.anchor;
    const back = above?.quaternion.clone().invert() ?? new Quaternion();
    node.name = message.name;
    node.position.copy(anchor.position).sub(above?.position ?? new Vector3()).applyQuaternion(back);
    node.quaternion.copy(back).multiply(anchor.quaternion);
    if (object && isSeen(object)) node.add(copyOf(object));
    (nodes.get(message.parent) ?? root).add(node);
  }
  return root;
}

/** Saves the visible scene: a picture, the shapes, a video of the motion, or the page itself. */
export class Exports {
  private readonly video = make("button", {
    textContent: "video",
    title: "WebM video of the motion",
    onclick: () => void this.saveVideo(),
  });

  constructor(
    private readonly stage: Stage,
    private readonly timeline: Timeline,
    private readonly frames: ReadonlyMap<number, Shown>,
    isRecording: boolean,
  ) {
    find("exports").append(
      make("button", {
        id: "picture",
        textContent: "picture",
        title: "PNG picture of the page (Alt P)",
        onclick: () => this.savePicture(),
      }),
      make("button", {
        id: "model",
        textContent: "model",
        title: "glTF model of the shapes at their present poses",
        onclick: () => void this.saveModel(),
      }),
      this.video,
      ...(isRecording
        ? []
        : [
            make("button", {
              id: "page",
              textContent: "page",
              title: "HTML file that shows the scene without the program",
              onclick: () => this.savePage(),
            }),
          ]),
    );
    this.video.id = "video";
    this.refresh();
  }

  /** Call when a motion appears or ends. */
  refresh(): void {
    this.video.disabled = this.timeline.current === null;
  }

  savePicture(): void {
    this.stage.drawFully();
    save(this.stage.canvas.toDataURL("image/png"), `${document.title}.png`);
  }

  private savePage(): void {
    save(`scene.html${location.search}`, `${document.title}.html`);
  }

  private async saveModel(): Promise<void> {
    this.stage.drawFully();
    const binary = await new GLTFExporter().parseAsync(hierarchyOf(this.frames), { binary: true, onlyVisible: true, trs: true });
    saveBlob(new Blob([binary as ArrayBuffer], { type: "model/gltf-binary" }), `${document.title}.glb`);
  }

  /** Saves the motion from its start, at the speed of the timeline and in the size of the picture on the page. */
  private async saveVideo(): Promise<void> {
    this.video.disabled = true;
    this.stage.holdResolution(true);
    const film = await filmOf(this.stage.canvas, FRAMES_PER_SECOND);
    const pictures = Math.ceil(this.timeline.seconds * FRAMES_PER_SECOND) + 1;
    for (let i = 0; i < pictures + STILL; ++i) {
      if (i < pictures) this.timeline.showAt(i / FRAMES_PER_SECOND);
      this.stage.drawFully();
      await film.add(i);
      this.video.textContent = `${Math.round((100 * i) / (pictures + STILL))} %`;
    }
    this.stage.holdResolution(false);
    this.video.textContent = "video";
    this.refresh();
    saveBlob(await film.finish(), `${document.title}.webm`);
  }
}
