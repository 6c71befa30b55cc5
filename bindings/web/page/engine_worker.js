// The engine in a worker, as a transport of `Link`. The worker is ended when it does not answer; then a new one can begin.
import { Emitter } from "./emitter.js";

const LONGEST_SILENCE = 8000;  // ms; the engine sends at least once a second

/// Emits: open, message (text or ArrayBuffer), closed, lost ("ended"), saved (files by name), refused (why), module (the
/// program, for others).
export class EngineWorker extends Emitter {
  #make;
  #start;
  #worker = null;
  #ready;  // the first worker, which compiles the program before `connect`
  #heard = 0;
  #is_open = false;
  serves_pages = false;
  helpers = null;  // `Helpers` that take some of the messages

  /// `make` returns a new Worker; `start` is the first message to worker.js.
  constructor(make, start) {
    super();
    this.#make = make;
    this.#start = start;
    this.#ready = make();
    this.#ready.onerror = () => (this.#ready = null);  // connect makes another worker, and reports its error
    setInterval(() => this.#is_open && !document.hidden && performance.now() - this.#heard > LONGEST_SILENCE && this.emit("silent"), 1000);
  }

  get is_open() {
    return this.#is_open;
  }

  /// Starts the engine. Called again, starts it anew, with other files.
  connect(start = this.#start) {
    this.end();
    this.#start = start;
    this.#worker = this.#ready ?? this.#make();
    this.#ready = null;
    this.#worker.onmessage = ({ data }) => this.#take(data);
    this.#worker.onerror = ({ message }) => this.emit("refused", message);
    this.#worker.postMessage({ start });
  }

  send(text) {
    if (!this.helpers?.takes(text)) this.#worker.postMessage(text);
  }

  end() {
    this.#worker?.terminate();
    this.#worker = null;
    this.#is_open = false;
    this.emit("closed");
  }

  #take({ message, saved, refused, opened, ended, module }) {
    this.#heard = performance.now();
    if (message !== undefined) this.emit("message", message);
    else if (module) this.emit("module", module);
    else if (saved) this.emit("saved", saved);
    else if (refused) this.emit("refused", refused);
    else if (opened) {
      this.#is_open = true;
      this.emit("open");
    } else if (ended) {
      this.emit("ended");
    }
  }
}
