// The WebSocket to the engine, opened again after a loss.
import { Emitter } from "./emitter.js";

const FIRST_WAIT = 500;  // ms
const LONGEST_WAIT = 8000;
const LONGEST_SILENCE = 6000;  // ms; the engine sends at least once a second, also while it is paused

/// A transport of `Link`. Emits: open, message (text or ArrayBuffer), closed (before the reason is known), lost (why,
/// wait in ms).
export class Socket extends Emitter {
  #token;
  #socket = null;
  #wait = FIRST_WAIT;
  #heard = 0;
  serves_pages = true;

  constructor(token) {
    super();
    this.#token = token;
    addEventListener("online", () => this.#socket || this.connect());
    setInterval(() => this.#give_up_on_silence(), 1000);
  }

  get is_open() {
    return this.#socket?.readyState === WebSocket.OPEN;
  }

  connect() {
    clearTimeout(this.again);
    if (this.#socket) return;
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/ws`, ["nezumi", `token.${this.#token}`]);
    socket.binaryType = "arraybuffer";
    this.#socket = socket;
    let was_open = false;
    socket.onopen = () => {
      was_open = true;
      this.#heard = performance.now();
      this.#wait = FIRST_WAIT;
      this.emit("open");
    };
    socket.onmessage = ({ data }) => {
      this.#heard = performance.now();
      this.emit("message", data);
    };
    socket.onclose = () => socket === this.#socket && this.#closed(was_open);
  }

  send(text) {
    this.#socket.send(text);
  }

  /// Closes the connection if nothing came for a while: after sleep or a network failure, the browser does not close it.
  #give_up_on_silence() {
    if (!this.is_open || performance.now() - this.#heard < LONGEST_SILENCE) return;
    const silent = this.#socket;
    this.#closed(true);
    silent.onmessage = null;
    silent.close();
  }

  async #closed(was_open) {
    this.#socket = null;
    this.emit("closed");
    const wait = this.#wait;
    this.#wait = Math.min(LONGEST_WAIT, wait * 2);
    this.again = setTimeout(() => this.connect(), wait);
    this.emit("lost", was_open ? "closed" : await this.#why_refused(), wait);
  }

  /// The reason of a refusal: if the server serves the page's files but refuses the connection, the token is wrong.
  async #why_refused() {
    try {
      return (await fetch("/index.html", { method: "GET", cache: "no-store" })).ok ? "refused" : "away";
    } catch {
      return "away";
    }
  }
}
