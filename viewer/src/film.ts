import { BufferTarget, CanvasSource, getFirstEncodableVideoCodec, Output, WebMOutputFormat } from "mediabunny";

const BITRATE = 8e6;

/** A WebM film that grows picture by picture. */
export interface Film {
  /** Adds the canvas as picture `i`. */
  add(i: number): Promise<void>;
  finish(): Promise<Blob>;
}

const blobOf = (parts: BlobPart[]): Blob => new Blob(parts, { type: "video/webm" });

/** Creates a film of a canvas, in the canvas's size on the page. Each picture has its time in the film, however long it
 * takes to draw. Without encoder (pages by http from another machine), the browser records in real time. */
export async function filmOf(canvas: HTMLCanvasElement, rate: number): Promise<Film> {
  const width = 2 * Math.floor(canvas.clientWidth / 2), height = 2 * Math.floor(canvas.clientHeight / 2);
  const codec = await getFirstEncodableVideoCodec(["vp9", "vp8"], { width, height, bitrate: BITRATE });
  if (!codec) return recorded(canvas, rate);
  const copy = new OffscreenCanvas(width, height), context = copy.getContext("2d", { alpha: false })!;
  const target = new BufferTarget(), output = new Output({ format: new WebMOutputFormat(), target });
  const source = new CanvasSource(copy, { codec, bitrate: BITRATE });
  output.addVideoTrack(source, { frameRate: rate });
  await output.start();
  return {
    async add(i) {
      context.drawImage(canvas, 0, 0, width, height);
      await source.add(i / rate, 1 / rate);
    },
    async finish() {
      await output.finalize();
      return blobOf([target.buffer!]);
    },
  };
}

function recorded(canvas: HTMLCanvasElement, rate: number): Film {
  const recorder = new MediaRecorder(canvas.captureStream(rate), { mimeType: "video/webm", videoBitsPerSecond: BITRATE });
  const parts: Blob[] = [];
  recorder.ondataavailable = ({ data }) => parts.push(data);
  const stopped = new Promise((resolve) => (recorder.onstop = resolve));
  recorder.start();
  const begin = performance.now();
  return {
    async add(i) {
      do await new Promise(requestAnimationFrame);
      while (performance.now() - begin < (1000 * i) / rate);
    },
    async finish() {
      recorder.stop();
      await stopped;
      return blobOf(parts);
    },
  };
}
