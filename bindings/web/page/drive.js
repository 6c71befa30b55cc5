// Driving by hand: the pad, its values and scale, and the present driver. When the pad is released, or the focus or the
// connection is lost, zero is sent.
import { at_most_every, el } from "./dom.js";
import { Gamepad } from "./gamepad.js";
import { make_pad, RADIUS } from "./pad.js";
import { T } from "./texts.js";

const PERIOD = 50;  // ms between two commands; the engine releases the port after 500
const SPEED = 0.3;  // m/s at full deflection
const YAW_RATE = 3;  // rad/s
const SCALES = [0.25, 0.5, 0.75, 1, 1.5, 2];

/// The value for a port of this type at stick position (x, y) [px, y up].
export function value_of(type, x, y) {
  if (type === "TimedFloatSeq") return { TimedFloatSeq: [x, y] };
  return { TimedVelocity2D: { vx: (y / RADIUS) * SPEED, vy: 0, va: (-x / RADIUS) * YAW_RATE } };
}

/// Ports that can be driven: [[name, type], ...], robots first.
export function drivable(model) {
  const [robots, sticks] = [[], []];
  for (const { name, kind, type, ports } of model.system?.components ?? []) {
    for (const port of ports) {
      if (type === "Joystick" && port.way === "out" && port.name === "pos") sticks.push([`${name}.${port.name}`, port.type]);
      if (kind === "robot" && port.way === "in" && port.type === "TimedVelocity2D") robots.push([`${name}.${port.name}`, port.type]);
    }
  }
  return [...robots, ...sticks];
}

class Driver {
  port = null;
  type = null;
  scale = 1;
  #parts;
  #stick = [0, 0];
  #is_held = false;
  #takes = false;
  #timer = null;

  constructor(parts) {
    this.#parts = parts;
    addEventListener("blur", () => this.let_go());
    document.addEventListener("visibilitychange", () => document.hidden && this.let_go());
    addEventListener("pagehide", () => this.let_go());
    parts.link.on("lost", () => this.let_go());
    parts.model.on("drive", ({ port, ok, text }) => {
      if (port !== this.port || ok) return;
      this.#is_held = false;
      clearInterval(this.#timer);
      this.on_let_go?.();
      parts.notices.say(text, "warn");
    });
  }

  get who() {
    const { link, model } = this.#parts;
    return (link.is_open && model.system?.drivers?.[this.port]) || null;
  }

  get is_mine() {
    return this.#is_held || this.who === this.#parts.model.you;
  }

  choose(port, type) {
    if (port === this.port) return;
    this.let_go();
    [this.port, this.type] = [port, type];
  }

  /// Handles a new position (x, y) of the stick [px]; `held` is false after the release.
  move(x, y, held) {
    this.#stick = [x * this.scale, y * this.scale];
    if (!held) return this.let_go();
    if (!this.port || !this.#parts.model.may_act) return;
    if (this.who && !this.is_mine && !this.#takes) return;
    if (!this.#is_held) {
      this.#is_held = true;
      clearInterval(this.#timer);
      this.#timer = setInterval(() => this.#send(), PERIOD);
    }
    this.#send();
  }

  /// Takes over from the present driver.
  take() {
    this.#takes = true;
    this.move(0, 0, true);
    this.let_go();
  }

  let_go() {
    this.on_let_go?.();
    if (!this.#is_held) return;
    this.#is_held = false;
    clearInterval(this.#timer);
    this.#parts.link.send({ do: "drive", port: this.port, value: null });  // the engine holds zero before it releases the port
  }

  #send() {
    const message = { do: "drive", port: this.port, value: value_of(this.type, ...this.#stick) };
    if (this.#takes) message.take = true;
    this.#takes = false;
    this.#parts.link.send(message);
  }
}

export function make_drive(parts) {
  const { model } = parts;
  const driver = new Driver(parts);
  const port = el("select", { "aria-label": T.drive.port });
  const scale = el("select", { "aria-label": T.drive.scale }, ...SCALES.map((each) =>
    el("option", { value: String(each), text: `${(SPEED * each).toFixed(2)} m/s · ${(YAW_RATE * each).toFixed(2)} rad/s` })));
  scale.value = localStorage.getItem("nezumi.scale") ?? "1";
  const who = el("p", { class: "who", role: "status" });
  const take = el("button", { class: "acts", text: T.drive.take, onclick: () => driver.take() });
  const source = el("p", { class: "hint" });
  const cells = Object.fromEntries(["x", "y", "r", "theta", "v", "w"].map((each) => [each, el("output", { text: "0" })]));
  const pad = make_pad((x, y, held) => {
    driver.move(x, y, held);
    read_out(x, y);
  });
  driver.on_let_go = () => {
    pad.let_go();
    read_out(0, 0);
  };

  const read_out = (x, y) => {
    const r = Math.hypot(x, y);
    const { v, w } = cells;
    cells.x.textContent = x.toFixed(0);
    cells.y.textContent = y.toFixed(0);
    cells.r.textContent = r.toFixed(0);
    cells.theta.textContent = r > 0 ? ((Math.atan2(y, x) * 180) / Math.PI).toFixed(0) : "0";
    v.textContent = ((y / RADIUS) * SPEED * driver.scale).toFixed(2);
    w.textContent = ((-x / RADIUS) * YAW_RATE * driver.scale).toFixed(2);
  };
  const use_scale = () => {
    driver.scale = Number(scale.value);
    localStorage.setItem("nezumi.scale", scale.value);
  };
  scale.onchange = use_scale;
  use_scale();

  const show_who = () => {
    const driving = driver.who;
    const is_other = driving !== null && driving !== model.you;
    who.textContent = driving === null ? T.drive.nobody : is_other ? T.drive.other(driving) : T.drive.you;
    who.className = `who ${driving === null ? "" : is_other ? "other" : "you"}`;
    take.hidden = !is_other;
    pad.node.classList.toggle("locked", is_other);
    const from = (model.system?.connections ?? []).filter(({ to }) => to === driver.port).map((each) => each.from);
    source.textContent = from.length > 0 ? T.drive.connected(from.join(", ")) : "";
  };
  const fill = () => {
    const ports = drivable(model);
    const names = ports.map(([name]) => name).join();
    if (port.dataset.names !== names) {
      port.dataset.names = names;
      port.replaceChildren(...ports.map(([name]) => el("option", { value: name, text: name })));
      if (ports.some(([name]) => name === driver.port)) port.value = driver.port;
      body.classList.toggle("nothing", ports.length === 0);
      choose();
    }
    show_who();
  };
  const choose = () => {
    const found = drivable(model).find(([name]) => name === port.value);
    driver.choose(...(found ?? [null, null]));
    show_who();
  };
  port.onchange = choose;

  const gamepad = el("p", { class: "hint", text: T.drive.no_gamepad });
  new Gamepad((x, y, held) => pad.move_to(x * RADIUS, y * RADIUS, held), (id) => {
    gamepad.textContent = id ? T.drive.gamepad_in_use(id) : T.drive.no_gamepad;
  });

  const cell = (name, label, unit) => el("div", {}, el("span", { text: label }), cells[name], el("small", { text: unit }));
  const body = el("div", { class: "driving" },
    el("p", { class: "empty", text: T.drive.nothing }),
    el("div", { class: "row" }, el("label", {}, el("span", { text: T.drive.port }), port),
      el("label", {}, el("span", { text: T.drive.scale }), scale)),
    el("div", { class: "row who-row" }, who, take),
    el("div", { class: "pad-row" }, pad.node,
      el("div", { class: "cells" }, cell("x", T.drive.x, T.drive.px), cell("y", T.drive.y, T.drive.px), cell("r", T.drive.r, T.drive.px),
        cell("theta", T.drive.theta, T.drive.deg), cell("v", T.drive.v, "m/s"), cell("w", T.drive.w, "rad/s"))),
    source, el("p", { class: "hint", text: T.drive.keys }), gamepad);
  model.on("system", at_most_every(50, fill));
  parts.link.on("lost", show_who);
  model.on("chosen", (robot) => {  // a robot was chosen in the view of the world
    const own = drivable(model).find(([name]) => name.startsWith(`${robot}.`));
    if (!own || driver.is_mine) return;
    port.value = own[0];
    choose();
  });
  return { node: el("div", { class: "drive" }, body), shown: (is_shown) => is_shown || driver.let_go() };
}
