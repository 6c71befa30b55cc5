// A simple event emitter: `on` registers a listener, `emit` calls the listeners.

export class Emitter {
  #heard = new Map();

  on(event, work) {
    if (!this.#heard.has(event)) this.#heard.set(event, new Set());
    this.#heard.get(event).add(work);
    return () => this.#heard.get(event).delete(work);
  }

  emit(event, ...details) {
    for (const work of this.#heard.get(event) ?? []) work(...details);
  }
}
