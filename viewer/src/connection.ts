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

/** Returns the messages embedded in a saved page, which needs no program: compressed, in base64. */
export function recordedMessages(): string | null {
  return document.getElementById("recording")?.textContent ?? null;
}

/** A message and when it was sent, in s since the start of the recording; a saved scene has only the time 0. */
export interface Timed {
  time: number;
  content: ServerMessage | ArrayBuffer;
}

export async function readRecording(recording: string): Promise<Timed[]> {
  const packed = Uint8Array.from(atob(recording), (letter) => letter.charCodeAt(0));
  const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
  const data = await new Response(stream).arrayBuffer(), view = new DataView(data);
  const messages: Timed[] = [];
  let end = 0;
  for (let at = 0; at < data.byteLength; at = Math.ceil(end / 4) * 4) {
    end = at + 16 + view.getUint32(at + 12, true);
    const bytes = data.slice(at + 16, end), isText = view.getUint32(at + 8, true) === 0;
    messages.push({
      time: view.getFloat64(at, true),
      content: isText ? (JSON.parse(new TextDecoder().decode(bytes)) as ServerMessage) : bytes,
    });
  }
  return messages;
}
