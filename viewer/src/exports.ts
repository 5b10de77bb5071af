import { GLTFExporter } from "three/addons/exporters/GLTFExporter.js";
import { find, make } from "./element";
import type { Stage } from "./stage";
import type { Timeline } from "./timeline";

const FRAMES_PER_SECOND = 30;

function save(url: string, file: string): void {
  make("a", { href: url, download: file }).click();
}

function saveBlob(blob: Blob, file: string): void {
  const url = URL.createObjectURL(blob);
  save(url, file);
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

/** Saves what is seen: a picture, the shapes, a video of the motion, the page itself. */
export class Exports {
  private readonly video = make("button", {
    textContent: "video",
    title: "WebM of the motion, as it plays",
    onclick: () => void this.saveVideo(),
  });

  constructor(
    private readonly stage: Stage,
    private readonly timeline: Timeline,
    isRecording: boolean,
  ) {
    find("exports").append(
      make("button", {
        id: "picture",
        textContent: "picture",
        title: "PNG of what is seen (Alt P)",
        onclick: () => this.savePicture(),
      }),
      make("button", {
        id: "model",
        textContent: "model",
        title: "glTF of the shapes, where they are now",
        onclick: () => void this.saveModel(),
      }),
      this.video,
      ...(isRecording
        ? []
        : [
            make("button", {
              id: "page",
              textContent: "page",
              title: "HTML file that shows this without the program",
              onclick: () => this.savePage(),
            }),
          ]),
    );
    this.video.id = "video";
    this.refresh();
  }

  /** Call when a motion has come or gone. */
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
    const binary = await new GLTFExporter().parseAsync(this.stage.frames, { binary: true, onlyVisible: true });
    saveBlob(new Blob([binary as ArrayBuffer], { type: "model/gltf-binary" }), `${document.title}.glb`);
  }

  private async saveVideo(): Promise<void> {
    const recorder = new MediaRecorder(this.stage.canvas.captureStream(FRAMES_PER_SECOND), {
      mimeType: "video/webm",
      videoBitsPerSecond: 8e6,
    });
    const parts: Blob[] = [];
    recorder.ondataavailable = ({ data }) => parts.push(data);
    const stopped = new Promise((resolve) => (recorder.onstop = resolve));
    this.video.disabled = true;
    recorder.start();
    this.timeline.playFromStart();
    for (let rest = FRAMES_PER_SECOND / 2; rest > 0; rest -= this.timeline.isPlaying ? 0 : 1) {
      // the end stays for a moment
      this.stage.redraw();
      await new Promise(requestAnimationFrame);
    }
    recorder.stop();
    await stopped;
    this.refresh();
    saveBlob(new Blob(parts, { type: "video/webm" }), `${document.title}.webm`);
  }
}
