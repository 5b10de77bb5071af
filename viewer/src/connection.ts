import { BinaryKind, type ServerMessage } from "./messages";

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

  sendKey(code: number): void {
    if (this.socket?.readyState === WebSocket.OPEN) this.socket.send(new Uint32Array([BinaryKind.key, code]));
  }

  private connect(): void {
    const socket = new WebSocket(`ws://${location.host}/`);
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
