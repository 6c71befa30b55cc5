// The diagram of the system: components, ports and connections, and actions on them.
import { lua_text, make_add_form } from "./add_form.js";
import { ask } from "./ask.js";
import { at_most_every, el, svg } from "./dom.js";
import { connect_ports, disconnect_ports, make_chosen } from "./diagram_chosen.js";
import { curve, place, port_at, route } from "./diagram_layout.js";
import { Sheet } from "./diagram_view.js";
import { owner_of } from "./port_name.js";
import { carries_same } from "./rtcs.js";
import { T } from "./texts.js";
import { value_text } from "./value_text.js";

const SIGNS = { ACTIVE: "▶", INACTIVE: "❚❚", ERROR: "!", CREATED: "○", REMOTE: "⇄", GONE: "✕", SILENT: "…" };

/// The colour of a type of port, the same everywhere.
export function type_color(type) {
  let sum = 7;
  for (const letter of type.replace("Timed", "")) sum = (sum * 31 + letter.charCodeAt(0)) % 3600;
  return `hsl(${(sum * 137.5) % 360} 62% var(--port-light))`;
}

/// Returns { from, to } if these two ports can be connected, or null.
export function fits(model, one, other) {
  const [a, b] = [model.port(one), model.port(other)];
  if (!a || !b || one === other || (a.way === b.way) !== (a.way === "service") || (a.component.host && b.component.host)) return null;
  const is_of_rtc = a.component.kind === "rtc" || b.component.kind === "rtc";
  if (is_of_rtc ? !carries_same(model.rtcs, [one, a], [other, b]) : a.type !== b.type) return null;
  const is_first = a.way === "service" ? one < other : a.way === "out";
  const pair = is_first ? { from: one, to: other } : { from: other, to: one };
  const is_there = model.connections.some(({ from, to }) => from === pair.from && to === pair.to);
  return is_there ? null : pair;
}

class Diagram {
  #parts;
  #boxes = new Map();
  #shape = "";
  #chosen = null;  // { component } or { from, to }
  #begun = null;  // the port at which a connection was started
  #looked_at = null;
  #centre = "";  // the component that is shown with its neighbours, if not all components are shown
  #is_part = false;

  constructor(parts) {
    this.#parts = parts;
    const narrow = matchMedia("(max-width: 599px)");
    this.#is_part = narrow.matches;
    narrow.addEventListener("change", () => this.show_part(narrow.matches));
    this.centres = el("select", { class: "part", "aria-label": T.diagram.centre, onchange: () => this.#centre_on(this.centres.value) });
    this.part_button = el("button", { class: "part", onclick: () => this.show_part(!this.#is_part) });
    this.wires = svg("g");
    this.nodes = svg("g");
    this.loose = svg("path", { class: "wire loose" });
    this.svg = svg("svg", { class: "sheet", role: "group", "aria-label": T.diagram.label }, this.wires, this.nodes, this.loose);
    this.sheet = new Sheet(this.svg);
    this.sheet.on_size = () => this.fit();
    this.tip = el("div", { class: "tip", role: "tooltip", hidden: true });
    this.bar = make_chosen(parts);
    const { model, acts } = parts;
    model.on("system", () => this.#update());
    model.on("chosen", (robot) => this.#centre_on(robot));
    model.on("rtcs", () => {
      this.#update();
      this.#show_chosen();
    });
    model.on("port", at_most_every(60, () => this.#show_value()));
    this.svg.addEventListener("click", (event) => event.target === this.svg && this.#choose(null));
    this.svg.addEventListener("keydown", (event) => {
      if (event.key === "Escape") this.#begin(null);
      const { from, to } = this.#chosen ?? {};
      const connection = from && model.connections.find((each) => each.from === from && each.to === to);
      if (event.key === "Delete" && connection && model.may_act) disconnect_ports(acts, connection);
    });
  }

  get #places() {
    return JSON.parse(localStorage.getItem(`nezumi.places ${this.#parts.model.system.file}`) ?? "{}");
  }

  #keep_places(places) {
    localStorage.setItem(`nezumi.places ${this.#parts.model.system.file}`, JSON.stringify(places));
  }

  arrange() {
    this.#keep_places({});
    this.#update(true);
    this.fit();
  }

  fit() {
    this.sheet.fit(this.#boxes, this.#is_part ? this.#boxes.get(this.#centre) : null);
  }

  /// Shows one component with its neighbours, or all components.
  show_part(is_part) {
    this.#is_part = is_part;
    if (this.#chosen?.component) this.#centre = this.#chosen.component;
    this.#update(true);
    this.fit();
  }

  #centre_on(name) {
    const is_new = this.#centre !== name;
    this.#centre = name;
    if (!this.#is_part || !is_new) return;
    this.#update(true);
    this.fit();
    this.#choose({ component: name });
  }

  /// The components that are shown.
  #shown_of(components, connections) {
    const names = components.map(({ name }) => name);
    if (!names.includes(this.#centre)) this.#centre = names[0] ?? "";
    this.part_button.textContent = this.#is_part ? T.diagram.all_parts : T.diagram.part;
    this.centres.hidden = !this.#is_part;
    this.part_button.hidden = !this.#is_part && names.length < 3;  // with two components, both are shown anyway
    if (this.centres.dataset.names !== names.join()) this.centres.replaceChildren(...names.map((name) => el("option", { value: name, text: name })));
    this.centres.dataset.names = names.join();
    this.centres.value = this.#centre;
    if (!this.#is_part) return components;
    const near = new Set([this.#centre]);
    for (const ends of connections.map(({ from, to }) => [owner_of(from), owner_of(to)])) if (ends.includes(this.#centre)) ends.forEach((end) => near.add(end));
    return components.filter(({ name }) => near.has(name));
  }

  shown(is_shown) {
    if (!is_shown) this.#look(null);
    this.#parts.model.watch("diagram's RTCs", is_shown && { peers: true });
  }

  #update(anyway = false) {
    const { boxes: all, connections, system } = this.#parts.model;
    if (!system) return;
    const components = this.#shown_of(all, connections);
    const shape = JSON.stringify([components.map(({ parameters, ...rest }) => rest), connections]);
    if (shape === this.#shape && !anyway) return;
    const is_first = this.#boxes.size === 0;
    const count = this.#boxes.size;
    this.#shape = shape;
    const focus = document.activeElement?.dataset?.key;
    this.#boxes = place(components, connections, this.#is_part ? {} : this.#places);
    this.nodes.replaceChildren(...components.map((each) => this.#make_node(each)));
    this.#draw_wires();
    if (focus) this.svg.querySelector(`[data-key="${CSS.escape(focus)}"]`)?.focus();
    if (is_first || count !== this.#boxes.size) this.fit();
    this.#light();
    this.#show_chosen();
  }

  #draw_wires() {
    const { model } = this.#parts;
    this.wires.replaceChildren(...route(this.#boxes, model.connections).map(({ from, to, path }) => {
      const choose = () => this.#choose({ from, to });
      const waits = model.port(from)?.waits || model.port(to)?.waits ? " waits" : "";
      const wire = svg("g", { class: `wire-group wire${waits}`, tabindex: 0, role: "button", "aria-label": T.diagram.connection(from, to, waits !== ""),
        data: { key: `${from} ${to}`, from, to }, onclick: choose, onfocus: choose },
      svg("path", { class: "grip", d: path }), svg("path", { class: "line", d: path }));
      wire.style.setProperty("--type", type_color(model.port(from)?.type ?? ""));
      return wire;
    }));
  }

  #make_node(component) {
    const { name, kind, state, error, ports } = component;
    const type = kind === "remote" ? T.diagram.remote(component) : component.type;
    const box = this.#boxes.get(name);
    const title = svg("g", { class: "title", tabindex: 0, role: "button", data: { key: name },
      "aria-label": `${name}, ${type}, ${T.states[state] ?? state}`, onfocus: () => this.#choose({ component: name }) },
    svg("path", { class: "head", d: `M0 8q0-8 8-8h${box.w - 16}q8 0 8 8v22h${-box.w}z` }),
    svg("text", { class: "sign", x: 12, y: 20, text: SIGNS[state] ?? "?" }),
    svg("text", { class: "name", x: 34, y: 20, text: name }),
    svg("text", { class: "type", x: box.w - 10, y: 20, "text-anchor": "end", text: type }));
    const node = svg("g", { class: `node ${kind} ${state.toLowerCase()}${component.host && !component.host.here ? " waits" : ""}`, transform: `translate(${box.x} ${box.y})`, data: { component: name } },
      svg("rect", { class: "body", width: box.w, height: box.h, rx: 8 }), title,
      ...ports.map((port) => this.#make_port(name, port, box.ports.get(port.name))));
    if (error) {
      const most = Math.floor((box.w - 20) / 6.8);
      const brief = error.replace(/^\S*\//, "");  // without the folders before the file
      node.append(svg("text", { class: "error", x: 10, y: box.h - 11, text: brief.length > most ? `${brief.slice(0, most - 1)}…` : brief },
        svg("title", { text: error })));
    }
    this.#make_movable(title, node, name);
    return node;
  }

  #make_movable(title, node, name) {
    let grip = null;
    title.addEventListener("pointerdown", (event) => {
      grip = { x: event.clientX, y: event.clientY, moved: false };
      title.setPointerCapture(event.pointerId);
    });
    title.addEventListener("pointermove", (event) => {
      if (!grip) return;
      const [x, y] = this.sheet.point(event);
      const box = this.#boxes.get(name);
      if (!grip.moved) {
        if (Math.hypot(event.clientX - grip.x, event.clientY - grip.y) <= 4) return;
        Object.assign(grip, { moved: true, dx: box.x - x, dy: box.y - y });  // the sheet may have changed its size since the press
      }
      Object.assign(box, { x: Math.round(x + grip.dx), y: Math.round(y + grip.dy) });
      node.setAttribute("transform", `translate(${box.x} ${box.y})`);
      this.#draw_wires();
    });
    title.addEventListener("pointerup", () => {
      if (grip?.moved && !this.#is_part) {
        const box = this.#boxes.get(name);
        this.#keep_places({ ...this.#places, [name]: [box.x, box.y] });
      }
      if (grip && !grip.moved) this.#centre_on(name);
      grip = null;
    });
    title.addEventListener("pointercancel", () => {
      grip = null;
    });
    title.addEventListener("keydown", ({ key }) => key === "Enter" && this.#centre_on(name));
  }

  #make_port(owner, { name, way, type, waits }, [x, y]) {
    const full = `${owner}.${name}`;
    const inward = way === "in" ? 1 : -1;
    const node = svg("g", { class: `port ${way}${waits ? " waits" : ""}`, tabindex: 0, role: "button", "aria-label": T.diagram.port(full, way, type),
      data: { port: full, key: full }, transform: `translate(${x} ${y})`,
      onpointerenter: () => this.#look(full), onpointerleave: () => this.#look(null),
      onfocus: () => this.#look(full), onblur: () => this.#look(null) },
    svg("circle", { class: "reach", r: 12 }), svg("path", { class: "dot", d: "M-6-6H1L7 0 1 6H-6z" }),
    svg("text", { x: 12 * inward, y: 4, "text-anchor": way === "in" ? "start" : "end", text: name }));
    node.style.setProperty("--type", type_color(type));
    node.addEventListener("keydown", (event) => {
      if (event.key !== "Enter") return;
      event.preventDefault();
      this.#end_at(full);
    });
    node.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      event.preventDefault();
      node.releasePointerCapture?.(event.pointerId);
      if (this.#begun && this.#begun !== full) return this.#end_at(full);
      this.#drag_from(full, event);
    });
    return node;
  }

  /// Starts a connection at a port, by dragging to another one. After a click without movement, the next clicked port ends
  /// the connection.
  #drag_from(port, down) {
    if (!this.#begin(port)) return;
    const start = [down.clientX, down.clientY];
    let moved = false;
    const move = (event) => {
      moved ||= Math.hypot(event.clientX - start[0], event.clientY - start[1]) > 5;
      const at = port_at(this.#boxes, port);
      const here = this.sheet.point(event);
      this.loose.setAttribute("d", this.#parts.model.port(port)?.way !== "in" ? curve(at, here) : curve(here, at));
    };
    const up = (event) => {
      for (const [name, work] of [["pointermove", move], ["pointerup", up], ["pointercancel", up]]) removeEventListener(name, work);
      this.loose.removeAttribute("d");
      if (!moved) return;
      const over = event.type === "pointerup" && document.elementFromPoint(event.clientX, event.clientY)?.closest(".port")?.dataset.port;
      if (over && over !== port) this.#end_at(over);
      else this.#begin(null);
    };
    for (const [name, work] of [["pointermove", move], ["pointerup", up], ["pointercancel", up]]) addEventListener(name, work);
  }

  #begin(port) {
    if (port && !this.#parts.model.may_act) return false;
    this.#begun = port;
    this.#light();
    this.#show_chosen();
    return true;
  }

  #end_at(port) {
    if (!this.#begun) return this.#begin(port);
    const pair = fits(this.#parts.model, this.#begun, port);
    this.#begin(null);
    if (pair) connect_ports(this.#parts.acts, pair);
  }

  /// While a connection is made, makes all ports pale that do not fit.
  #light() {
    this.svg.classList.toggle("connecting", this.#begun !== null);
    for (const node of this.nodes.querySelectorAll(".port")) {
      const { port } = node.dataset;
      node.classList.toggle("begun", port === this.#begun);
      node.classList.toggle("fits", this.#begun !== null && fits(this.#parts.model, this.#begun, port) !== null);
    }
  }

  #choose(chosen) {
    this.#chosen = chosen;
    this.#show_chosen();
  }

  #look(port) {
    this.#looked_at = port;
    this.#parts.model.watch("diagram", port && { ports: [port] });
    this.tip.hidden = port === null;
    if (port) this.#show_value();
  }

  #show_value() {
    const { model } = this.#parts;
    const port = this.#looked_at && model.port(this.#looked_at);
    if (!port) return;
    const node = this.nodes.querySelector(`[data-port="${CSS.escape(this.#looked_at)}"]`);
    const now = model.value_of(this.#looked_at);
    const none = model.looked ? T.past.not_remembered : T.diagram.nothing_yet;
    const time = model.looked?.time ?? model.frame.time;
    this.tip.replaceChildren(el("b", { text: this.#looked_at }), el("small", { text: `${T.diagram[port.way]} ${port.type}` }),
      port.waits && port.component.host ? el("p", { text: T.diagram.waits(port.component.host) }) : "",
      port.doc ? el("p", { text: port.doc }) : "",
      port.component.kind === "rtc" ? "" : el("code", { text: now ? value_text(now.value) : none }),
      now && now.tm > 0 ? el("small", { text: T.diagram.age(Math.max(0, time - now.tm).toFixed(2)) }) : "");
    const [box, frame] = [node.getBoundingClientRect(), this.svg.getBoundingClientRect()];
    const room = frame.width - this.tip.offsetWidth - 8;
    this.tip.style.left = `${Math.max(8, Math.min(room, box.left - frame.left))}px`;
    const below = box.bottom - frame.top + 8;
    const is_low = below + this.tip.offsetHeight > frame.height;
    this.tip.style.top = `${is_low ? Math.max(4, box.top - frame.top - this.tip.offsetHeight - 8) : below}px`;
  }

  #show_chosen() {
    const chosen = this.#chosen;
    for (const node of this.nodes.children) node.classList.toggle("chosen", chosen?.component === node.dataset.component);
    for (const wire of this.wires.children) wire.classList.toggle("chosen", chosen?.from === wire.dataset.from && chosen?.to === wire.dataset.to);
    this.bar.show(chosen, this.#begun);
  }
}

export function make_diagram(parts) {
  const diagram = new Diagram(parts);
  const { model, acts } = parts;
  const all = (state, work) => () => {
    for (const { name, state: now } of model.system?.components ?? []) if (now === state) work(name);
  };
  const button = (text, onclick, kind = "") => el("button", { class: kind, text, onclick });
  let form = null;  // made when the engine has sent the list of behaviours
  const save = async () => {
    const name = await ask(T.diagram.save_as, T.diagram.save_now, model.system.file.replace(/(\.lua)?$/, "_changed.lua"));
    if (!name) return;
    const { ok, text } = await parts.run_line(`save ${lua_text(name)}`);
    parts.notices.say(ok ? T.diagram.saved(name) : text, ok ? "info" : "error");
  };
  const tools = el("div", { class: "tools", role: "toolbar", "aria-label": T.views.diagram },
    button(T.diagram.add, () => (form ??= make_add_form(parts)).open(), "acts"), button(T.diagram.save, save, "acts"),
    el("span", { class: "acts label", text: T.diagram.all }),
    button(T.diagram.activate, all("INACTIVE", acts.activate), "acts"), button(T.diagram.deactivate, all("ACTIVE", acts.deactivate), "acts"),
    button(T.diagram.reset, all("ERROR", acts.reset), "acts"), el("span", { class: "gap" }),
    diagram.centres, diagram.part_button, button(T.diagram.fit, () => diagram.fit()), button(T.diagram.arrange, () => diagram.arrange()),
    el("button", { text: "+", "aria-label": T.diagram.zoom_in, onclick: () => diagram.sheet.zoom(1.25) }),
    el("button", { text: "−", "aria-label": T.diagram.zoom_out, onclick: () => diagram.sheet.zoom(0.8) }));
  return { node: el("div", { class: "diagram" }, tools, el("div", { class: "stage-box" }, diagram.svg, diagram.tip, diagram.bar.card), diagram.bar.node),
    shown: (is_shown) => diagram.shown(is_shown) };
}
