import type { ServerMessage } from "./messages";

export interface Listener {
  opened(): void;
  message(message: ServerMessage): void;
  binary(data: ArrayBuffer): void;
  closed(): void;
}

/** The websocket to the program; comes back by itself when the program does. */
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

type Recorded = { text: string } | { binary: string }; // bytes in base64

/** Messages that are part of the page itself: it then needs no program. */
export function recordedMessages(): Recorded[] | null {
  const text = document.getElementById("recording")?.textContent;
  return text ? (JSON.parse(text) as Recorded[]) : null;
}

export function replay(recorded: Recorded[], listener: Listener): void {
  listener.opened();
  for (const entry of recorded) {
    if ("text" in entry) listener.message(JSON.parse(entry.text) as ServerMessage);
    else listener.binary(Uint8Array.from(atob(entry.binary), (letter) => letter.charCodeAt(0)).buffer);
  }
}
