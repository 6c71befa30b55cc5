// The messages between the page and the engine: text and binary frames, and answers to requests.
import { Emitter } from "./emitter.js";

const ANSWER_WITHIN = 5000;  // ms

/// Emits: open, lost (why, wait in ms), said (an object of the engine), frame (kind, bytes). The transport of the messages
/// is a `Socket`, or the worker with the engine.
export class Link extends Emitter {
  #transport;
  #next = 1;
  #asked = new Map();

  constructor(transport) {
    super();
    this.#transport = transport;
    transport.on("open", () => this.emit("open"));
    transport.on("message", (data) => this.#take(data));
    transport.on("closed", () => {
      for (const id of [...this.#asked.keys()]) this.#answer({ id, ok: false, text: "" });
    });
    transport.on("lost", (why, wait) => this.emit("lost", why, wait));
  }

  get is_open() {
    return this.#transport.is_open;
  }

  /// Whether the engine is a program that can serve further pages.
  get serves_pages() {
    return this.#transport.serves_pages;
  }

  connect() {
    this.#transport.connect();
  }

  /// Returns false if there is no connection.
  send(what) {
    if (!this.is_open) return false;
    this.#transport.send(JSON.stringify(what));
    return true;
  }

  /// Sends a request. Resolves to the answer { ok, text, ... }; without an answer within `within` ms, `ok` is false and
  /// `text` is "".
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

  #take(data) {
    if (typeof data === "string") {
      const said = JSON.parse(data);
      if (said.is === "answer") this.#answer(said);
      else this.emit("said", said);
    } else {
      const kind = new DataView(data).getUint32(0, true);
      this.emit("frame", kind, new Uint8Array(data, 4));
    }
  }
}
