// The browser's gamepad: its left stick, polled while one is plugged in.

const PERIOD = 40;  // ms
const DEAD = 0.12;  // dead zone, as a part of the stick's range

export class Gamepad {
  #timer = null;
  #was_held = false;

  /// `moved(x, y, held)`: -1 to 1, y up. `named(id)`: the gamepad in use, or null.
  constructor(moved, named) {
    this.moved = moved;
    this.named = named;
    addEventListener("gamepadconnected", () => this.#begin());
    addEventListener("gamepaddisconnected", () => this.#look());
  }

  #begin() {
    if (this.#timer === null) this.#timer = setInterval(() => this.#look(), PERIOD);
    this.#look();
  }

  #look() {
    const pad = [...navigator.getGamepads()].find((each) => each?.connected);
    this.named(pad?.id ?? null);
    if (!pad) {
      clearInterval(this.#timer);
      this.#timer = null;
    }
    const [x, y] = pad && document.hasFocus() ? [pad.axes[0], -pad.axes[1]] : [0, 0];
    const is_held = Math.hypot(x, y) > DEAD;
    if (is_held || this.#was_held) this.moved(is_held ? x : 0, is_held ? y : 0, is_held);
    this.#was_held = is_held;
  }
}
