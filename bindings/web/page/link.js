// The connection to the engine: text and binary frames, answers to requests, and reconnection after a loss.
import { Emitter } from "./emitter.js";

const FIRST_WAIT = 500;  // ms
const LONGEST_WAIT = 8000;
const ANSWER_WITHIN = 5000;
const LONGEST_SILENCE = 6000;  // ms; the engine sends at least once a second, also while it is paused

/// Emits: open, lost (why, wait in ms), said (an object of the engine), frame (kind, bytes).
export class Link extends Emitter {
  #token;
  #socket = null;
  #wait = FIRST_WAIT;
  #next = 1;
  #asked = new Map();
  #heard = 0;

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
    socket.onmessage = ({ data }) => this.#take(data);
    socket.onclose = () => socket === this.#socket && this.#closed(was_open);
  }

  /// Returns false if there is no connection.
  send(what) {
    if (!this.is_open) return false;
    this.#socket.send(JSON.stringify(what));
    return true;
  }

  /// Resolves to { ok, text } and what else the answer has; without an answer in time [ms], `ok` is false and `text` "".
  ask(what, within = ANSWER_WITHIN) {
    const id = this.#next++;
    return new Promise((resolve) => {
      if (!this.send({ ...what, id })) return resolve({ ok: false, text: "" });
      const late = setTimeout(() => this.#answer({ id, ok: false, text: "" }), within);
      this.#asked.set(id, { resolve, late });
    });
  }

  #answer(answer) {
    const asked = this.#asked.get(answer.id);
    if (!asked) return;
    clearTimeout(asked.late);
    this.#asked.delete(answer.id);
    asked.resolve(answer);
  }

  /// After sleep or a network failure the connection is not closed by itself.
  #give_up_on_silence() {
    if (!this.is_open || performance.now() - this.#heard < LONGEST_SILENCE) return;
    const silent = this.#socket;
    this.#closed(true);
    silent.onmessage = null;
    silent.close();
  }

  #take(data) {
    this.#heard = performance.now();
    if (typeof data === "string") {
      const said = JSON.parse(data);
      if (said.is === "answer") this.#answer(said);
      else this.emit("said", said);
    } else {
      const kind = new DataView(data).getUint32(0, true);
      this.emit("frame", kind, new Uint8Array(data, 4));
    }
  }

  async #closed(was_open) {
    this.#socket = null;
    for (const id of [...this.#asked.keys()]) this.#answer({ id, ok: false, text: "" });
    const wait = this.#wait;
    this.#wait = Math.min(LONGEST_WAIT, wait * 2);
    this.again = setTimeout(() => this.connect(), wait);
    this.emit("lost", was_open ? "closed" : await this.#why_refused(), wait);
  }

  /// If the server gives the page's files but refuses the connection, the token is wrong.
  async #why_refused() {
    try {
      return (await fetch("/index.html", { method: "GET", cache: "no-store" })).ok ? "refused" : "away";
    } catch {
      return "away";
    }
  }
}
