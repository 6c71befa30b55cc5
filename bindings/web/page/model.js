// The page's knowledge of the running system: its layout, poses, and the values of watched ports.
import { Cdr, to_message } from "./cdr.js";
import { at_most_every } from "./dom.js";
import { Emitter } from "./emitter.js";
import { with_hosts } from "./hosts.js";
import { split_port } from "./port_name.js";
import { with_rtcs } from "./rtcs.js";

const single_type = (type) => type.replace("array of ", "");

const KEPT_EMPTY = 2000;  // ms

/// Makes a value from its numbers and texts with their paths: ["pose.x", 1] or ["[2]", 1]. The present value `now`, if it
/// is known, tells which numbers are booleans.
function from_leaves(leaves, now) {
  let root;
  for (const [path, value] of leaves) {
    const keys = [...path.matchAll(/\[(\d+)\]|([^.[\]]+)/g)].map(([, index, name]) => (index ? Number(index) - 1 : name));
    const same = keys.reduce((each, key) => each?.[key], now);
    const own = typeof same === "boolean" ? Boolean(value) : value;
    if (keys.length === 0) return own;
    const empty = (key) => (typeof key === "number" ? [] : {});
    root ??= empty(keys[0]);
    let at = root;
    keys.forEach((key, i) => {
      at[key] = i + 1 === keys.length ? own : at[key] ?? empty(keys[i + 1]);
      at = at[key];
    });
  }
  return root;
}

/// Emits: hello, system, rtcs, frame, port (name), picture, floor, restarted, went_back, looked, chosen (a robot, in the
/// world), and other messages of the engine by their names.
export class Model extends Emitter {
  hello = null;
  system = null;
  boxes = [];   // the components of the system, of other hosts and other programs
  connections = [];  // of all components
  rtcs = null;  // the RTCs in the name services, if the system uses RTCs
  frame = { time: 0, tick: 0, running: false, speed: 1, late: 0 };
  robots = [];   // poses by index
  things = [];
  markers = [];
  rays = [];    // the rays of each robot, by index
  floor = null;  // the address of the floor's picture, after it was received
  coverage = new Map();  // of the latest run of scenarios: path of a file to Map of line to the number of its executions
  looked = null;  // { time } while the page shows robots, things and values of a past time
  values = new Map();  // of watched ports and members: { value, tm, at, count }
  #present = { robots: [], things: [] };  // the present poses, while past ones are shown
  #then = new Map();  // name: { value, tm }: the remembered values of the past time that is shown
  #link;
  #cdr = null;
  #watchers = new Map();  // who: { ports, pictures, truth, rays }
  #sent = "";
  #slots = [];  // of watched ports: { name, since }
  #will_send = false;
  #floor_asked = "";  // the system for which the picture was requested

  constructor(link) {
    super();
    this.#link = link;
    link.on("said", (said) => this.#take(said));
    link.on("frame", (kind, bytes) => [null, this.#take_frame, this.#take_picture, this.#take_floor][kind]?.call(this, bytes));
    link.on("state", (state) => this.#take_state(state));
    link.on("open", () => this.#watch_again());
  }

  get may_act() {
    return this.hello !== null && !this.hello.view_only && this.#link.is_open;
  }

  get you() {
    return this.hello?.you ?? "";
  }

  /// Sets the values that `who` wants to see from now on. Without `wanted`, none.
  watch(who, wanted) {
    if (wanted) this.#watchers.set(who, wanted);
    else this.#watchers.delete(who);
    if (this.#will_send) return;
    this.#will_send = true;
    queueMicrotask(() => {
      this.#will_send = false;
      this.#send_watch();
    });
  }

  component(name) {
    return this.boxes.find((each) => each.name === name);
  }

  /// "name.port" to the port's description, with its component.
  port(full) {
    const [owner, name] = split_port(full);
    const component = this.component(owner);
    const port = component?.ports.find((each) => each.name === name);
    return port && { ...port, component };
  }

  /// Every port: [["mouse.ir_sensor_out", port], ...].
  all_ports() {
    return (this.system?.components ?? []).flatMap((component) =>
      component.ports.map((port) => [`${component.name}.${port.name}`, port]));
  }

  /// Other objects with numbers: ["mouse.truth", "controller.probes", ...].
  all_members() {
    return (this.system?.components ?? []).flatMap(({ name, members }) => members.map((member) => `${name}.${member}`));
  }

  /// The value of a watched port or member at the time that is shown; undefined if there was none, or if it is not known.
  value_of(name) {
    return (this.looked ? this.#then : this.values).get(name);
  }

  /// Requests the watched values of the past time that is shown.
  #ask_then = at_most_every(50, () => {
    const names = [...this.#watchers.values()].flatMap(({ ports = [], members = [] }) => [...ports, ...members]);
    if (this.looked && names.length > 0) this.#link.send({ do: "then", at: this.looked.time, names: [...new Set(names)] });
  });

  #take_then({ at, values }) {
    if (this.looked?.time !== at) return;
    this.#then = new Map(Object.entries(values).map(([name, { tm, leaves }]) =>
      [name, { tm, value: from_leaves(leaves, this.values.get(name)?.value) }]));
    this.#tell_values();
  }

  #tell_values() {
    for (const name of this.values.keys()) this.emit("port", name);
  }

  /// The argument of `watch` for the values of these ports and members.
  wanted(names) {
    const members = new Set(this.all_members());
    return { ports: names.filter((name) => !members.has(name)), members: names.filter((name) => members.has(name)) };
  }

  #watch_again() {
    this.#slots = [];
    this.#sent = "";
    this.values.clear();
    if (!this.floor) this.#floor_asked = "";
    this.#send_watch();
  }

  /// Requests the picture of the floor, once per start. It comes over the connection, which needs a token, unlike files.
  #ask_floor({ start, file, arena }) {
    const which = arena.floor ? JSON.stringify([file, start, arena.floor]) : "";
    if (which === this.#floor_asked) return;
    this.#floor_asked = which;
    this.#set_floor(null);
    if (which) this.#link.send({ do: "floor" });
  }

  #set_floor(url) {
    if (this.floor) URL.revokeObjectURL(this.floor);
    this.floor = url;
    this.emit("floor");
  }

  #take_floor(bytes) {
    this.#set_floor(URL.createObjectURL(new Blob([bytes])));
  }

  #send_watch() {
    const wanted = [...this.#watchers.values()];
    const all = (key) => [...new Set(wanted.flatMap((each) => each[key] ?? []))];
    const ports = all("ports");
    this.#fill_slots(ports);
    const next = {
      do: "watch",
      ports: this.#slots.map(({ name }) => name),
      pictures: all("pictures").sort(),
      members: all("members").sort(),
      truth: wanted.some((each) => each.truth),
      rays: wanted.some((each) => each.rays),
      peers: wanted.some((each) => each.peers),
    };
    const text = JSON.stringify(next);
    if (this.looked) this.#ask_then();
    if (text === this.#sent || !this.#link.send(next)) return;
    this.#sent = text;
    if (!next.rays) this.rays = [];
    for (const port of this.values.keys()) if (!ports.includes(port) && !next.members.includes(port)) this.values.delete(port);
  }

  /// A port keeps its index while it is watched. A freed index is not used for a while, because frames on their way may
  /// still contain it.
  #fill_slots(ports) {
    const now = performance.now();
    for (const slot of this.#slots) {
      if (slot.name && !ports.includes(slot.name)) Object.assign(slot, { name: "", since: now });
    }
    const has = new Set(this.#slots.map(({ name }) => name));
    for (const name of ports.filter((each) => !has.has(each))) {
      const free = this.#slots.find((slot) => !slot.name && now - slot.since > KEPT_EMPTY);
      if (free) free.name = name;
      else this.#slots.push({ name, since: now });
    }
  }

  #take(said) {
    if (said.is === "hello") {
      this.hello = said;
      this.#cdr = new Cdr(this.types);
      this.emit("hello");
    } else if (said.is === "system") {
      const before = this.system;
      this.system = said;
      this.#take_boxes();
      this.#cdr = new Cdr(this.types);
      for (const { parameters } of said.components) for (const each of parameters) each.type = single_type(each.type);
      if (before && (before.start !== said.start || before.file !== said.file)) this.#forget(before.starts === said.starts && before.file === said.file);
      this.#ask_floor(said);
      this.emit("system", before);
    } else if (said.is === "then") {
      this.#take_then(said);
    } else if (said.is === "rtcs") {
      this.rtcs = said;
      for (const { parameters } of said.rtcs) for (const each of parameters) each.type = single_type(each.type);
      if (this.system) this.#take_boxes();
      this.emit("rtcs");
    } else {
      this.emit(said.is, said);
    }
  }

  #take_boxes() {
    Object.assign(this, with_rtcs(with_hosts(this.system), this.system, this.rtcs));
  }

  /// The types of messages and frames: those of the program, and those that files of the system define.
  get types() {
    return { ...this.hello?.types, ...this.system?.types };
  }

  /// Shows a past time: `then` is { time, robots, things: Map of poses by index }; `robots` may be undefined. Values of
  /// that time are requested. Null: shows the present.
  look_at(then) {
    if (!then && !this.looked) return;
    if (!this.looked) this.#present = { robots: this.robots, things: this.things };
    const { robots, things } = this.#present;
    this.robots = then?.robots ? then.robots.map((pose, i) => ({ ...robots[i], ...pose, collided: false, touches: "", contacts: [] })) : robots;
    this.things = then ? things.map((each, index) => (then.things.has(index) ? { index, pose: then.things.get(index) } : each)) : things;
    this.looked = then && { time: then.time };
    if (then) {
      this.#ask_then();
    } else {
      this.#then = new Map();
      this.#tell_values();
    }
    this.emit("looked");
  }

  #forget(goes_back) {
    this.looked = null;
    this.#then = new Map();
    this.robots = [];
    this.things = [];
    this.markers = [];
    this.rays = [];
    this.values.clear();
    this.emit(goes_back ? "went_back" : "restarted");
  }

  #take_frame(bytes) {
    const { ports, members, ...state } = this.#cdr.read(this.hello.frame, bytes);
    this.#take_poses(state);
    for (const each of ports) this.#take_port(each);
    for (const each of members) this.#take_member(each, state.time);
    this.emit("frame");
  }

  /// Takes the state of a recorded run, in which ports and members have their values directly.
  #take_state({ values, ...state }) {
    this.#take_poses(state);
    for (const [name, value] of values) this.#take_value(name, { value, tm: state.time }, 1);
    this.emit("frame");
  }

  #take_poses({ robots, things, markers, rays, ...frame }) {
    this.frame = frame;
    const present = this.looked ? this.#present : this;
    for (const each of robots) present.robots[each.index] = each;
    for (const each of things) present.things[each.index] = each;
    for (const each of markers) this.markers[each.index] = each;
    this.#take_rays(rays);
  }

  /// The rays of a robot arrive together and replace the old ones.
  #take_rays(rays) {
    const begun = new Set();
    for (const ray of rays) {
      if (!begun.has(ray.robot)) this.rays[ray.robot] = [];
      begun.add(ray.robot);
      this.rays[ray.robot].push(ray);
    }
  }

  #take_port({ index, count, payload }) {
    const name = this.#slots[index]?.name;
    const port = name && this.port(name);
    if (!port) return;
    try {
      this.#take_value(name, to_message(this.#cdr.read(port.type, payload)), count);
    } catch (wrong) {
      console.warn(name, wrong.message);  // the message may belong to an earlier list of watched ports
    }
  }

  #take_member({ name, leaves }, tm) {
    this.#take_value(name, { value: Object.fromEntries(leaves.map((each) => [each.name, each.value])), tm }, 1);
  }

  #take_value(name, message, count) {
    this.values.set(name, { ...message, at: performance.now(), count: (this.values.get(name)?.count ?? 0) + count });
    this.emit("port", name);
  }

  #take_picture(bytes) {
    const types = { ...this.hello.types, Picture: PICTURE };
    this.emit("picture", new Cdr(types).read("Picture", bytes));
  }
}

const PICTURE = [
  { name: "port", type: "string" }, { name: "tm", type: "double" }, { name: "width", type: "uint32" },
  { name: "height", type: "uint32" }, { name: "jpeg", type: "sequence<octet>" },
];
