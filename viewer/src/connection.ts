import type { ServerMessage } from "./messages";

export interface Listener {
  opened(): void;
  message(message: ServerMessage): void;
  binary(data: ArrayBuffer): void;
  closed(): void;
}

/** The websocket to the program; it reconnects when the program returns. */
export class Connection {
  private socket: WebSocket | null = null;

  constructor(private readonly listener: Listener) {
    this.connect();
  }

  send(command: Uint8Array<ArrayBuffer>): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(command);
  }

  private connect(): void {
    const socket = new WebSocket(
      `${location.protocol === "https:" ? "wss" : "ws"}://${location.host}/${location.search}`,
    );
    this.socket = socket;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => this.listener.opened();
    socket.onmessage = ({ data }) => {
      if (typeof data === "string") this.listener.message(JSON.parse(data) as ServerMessage);
      else this.listener.binary(data as ArrayBuffer);
    };
    socket.onclose = () => {
      this.listener.closed();
      setTimeout(() => this.connect(), 500);
    };
  }
}

/** Decodes base64 bytes; packed ones are deflated differences of 32-bit words at a distance of `stride`. */
type Recorded = { text: string } | { binary: string } | { packed: string; bytes: number; stride: number };

const bytesOf = (base64: string): Uint8Array<ArrayBuffer> => Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));

async function unpack(base64: string, bytes: number, stride: number): Promise<ArrayBuffer> {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
  const planes = new Uint8Array(await new Response(stream).arrayBuffer()); // all lowest bytes, then all second ones,
                                                                           // ...
  const count = planes.length / 4;
  const values = new Int32Array(count);
  for (let i = 0; i < count; ++i) {
    const code = planes[i]! | (planes[count + i]! << 8) | (planes[2 * count + i]! << 16) | (planes[3 * count + i]! << 24);
    values[i] = ((code >>> 1) ^ -(code & 1)) + (i < stride ? 0 : values[i - stride]!);
  }
  return values.buffer.slice(0, bytes);
}

/** Returns the messages embedded in a saved page, which needs no program. */
export function recordedMessages(): Recorded[] | null {
  const text = document.getElementById("recording")?.textContent;
  return text ? (JSON.parse(text) as Recorded[]) : null;
}

export async function replay(recorded: Recorded[], listener: Listener): Promise<void> {
  listener.opened();
  for (const entry of recorded) {
    if ("text" in entry) listener.message(JSON.parse(entry.text) as ServerMessage);
    else if ("binary" in entry) listener.binary(bytesOf(entry.binary).buffer);
    else listener.binary(await unpack(entry.packed, entry.bytes, entry.stride));
  }
}
