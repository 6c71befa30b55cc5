// The view of the world: its picture, its tools, and labels over it.
import * as THREE from "./lib/three/three.module.js";
import { el } from "./dom.js";
import { ghost_of } from "./past_tracks.js";
import { T } from "./texts.js";
import { make_devices } from "./devices.js";
import { stranded_robots } from "./troubles.js";
import { number_text } from "./value_text.js";
import { Eye } from "./world_camera.js";
import { put_hands_on } from "./world_hand.js";
import { Scene } from "./world_scene.js";
import { make_tools } from "./world_tools.js";

const MOST_NAMES = 40;
const MOST_VALUES = 16;  // most values shown at the rays of one robot
const NUDGES_JOIN = 500;  // ms: key presses closer than this are one move

/// The theme's colours, from the style sheet.
function theme_colors() {
  const style = getComputedStyle(document.documentElement);
  const color = (name) => style.getPropertyValue(`--${name}`).trim();
  return {
    background: color("sky"), floor: color("floor"), painted: color("floor-painted"), grid: color("grid"), border: color("wall"), accent: color("accent"),
    error: color("state-error"), hull: color("hull"), arrow: color("hull-arrow"), wheel: "#23272e", sensor: "#c0392b",
    ray: color("ray"), ray_near: color("ray-near"),
    trails: [0, 1, 2, 3, 4, 5].map((i) => color(`line-${i}`)),
  };
}

function make_renderer(canvas) {
  try {
    const renderer = new THREE.WebGLRenderer({ canvas, antialias: true });
    renderer.setPixelRatio(Math.min(2, devicePixelRatio));
    return renderer;
  } catch {
    return null;
  }
}

/// Labels over the picture; elements are reused and moved.
class Labels {
  node = el("div", { class: "labels", "aria-hidden": "true" });
  #used = 0;
  #width = 0;
  #height = 0;

  begin(width, height) {
    [this.#width, this.#height] = [width, height];
    this.#used = 0;
  }

  /// The name of a robot with the colour of its trail; at the edge, with an arrow, if the robot is out of sight.
  put_name(kind, text, pixel, color) {
    if (!pixel) return;
    const [x, y] = pixel;
    const arrow = x < 0 ? "←" : x > this.#width ? "→" : y < 0 ? "↑" : y > this.#height ? "↓" : "";
    const clamped = (value, most) => Math.max(0, Math.min(most, value));
    if (arrow) this.put(`${kind} far`, `${arrow} ${text}`, [clamped(x, this.#width - 20) + 16, clamped(y, this.#height - 34) + 28], color);
    else this.put(kind, text, pixel, color);
  }

  put(kind, text, pixel, color = "") {
    if (!pixel) return;
    const node = this.node.children[this.#used++] ?? this.node.appendChild(el("span"));
    if (node.textContent !== text) node.textContent = text;
    if (node.className !== kind) node.className = kind;
    if (node.hidden) node.hidden = false;
    if (node.dataset.color !== color) {
      node.dataset.color = color;
      node.style.setProperty("--own", color);
    }
    const back = pixel[0] > 0.8 * this.#width ? " translateX(-100%)" : "";  // not beyond the edge
    node.style.transform = `translate(${pixel[0].toFixed(1)}px, ${pixel[1].toFixed(1)}px)${back}`;
  }

  end() {
    for (let i = this.#used; i < this.node.children.length; ++i) this.node.children[i].hidden = true;
  }
}

class World {
  canvas = el("canvas", { tabindex: 0, role: "application", "aria-label": T.world.label });
  labels = new Labels();
  eye = new Eye();
  scene = new Scene();
  shows = { rays: true, trails: true, names: true, ...JSON.parse(localStorage.getItem("nezumi.world") ?? "{}") };
  chosen = null;  // { kind, index }
  carried = null;  // { kind, index, pose }
  follows = false;
  arena = null;  // edits the system file; null until the tools are opened
  #parts;
  #renderer = make_renderer(this.canvas);
  #is_asked = false;
  #is_shown = false;
  #nudged = {};  // the last move by keys: { what, when, pose }
  #ghost = null;  // the other branch that is drawn
  #layout = "";
  #is_old = false;  // the picture must be rebuilt for a new description of the system

  constructor(parts) {
    this.#parts = parts;
    const { model, tracks } = parts;
    this.stage = el("div", { class: "stage-box" }, this.canvas, this.labels.node);
    if (!this.#renderer) this.stage.append(el("p", { class: "empty", text: T.world.no_gl }));
    model.on("system", () => {
      this.#is_old = true;
      this.#look_for_ghosts();
    });
    tracks.on("track", (branch) => branch === this.#ghost?.branch && this.#draw_ghosts());
    model.on("looked", () => this.draw());
    model.on("frame", () => {
      if (this.#is_old) this.#rebuild();
      if (!model.looked) this.scene.trails.follow(model.robots, model.frame.time);
      this.draw();
    });
    for (const what of ["restarted", "went_back"]) model.on(what, () => this.scene.trails.forget());
    model.on("floor", () => this.#rebuild(true));
    addEventListener("theme", () => this.#rebuild(true));
    this.scene.on_loaded = () => {
      this.canvas.dataset.floor = "shown";
      this.draw();
    };
    new ResizeObserver(() => {
      this.#resize();
      this.draw();
    }).observe(this.stage);
    put_hands_on(this.canvas, {
      eye: this.eye, scene: this.scene, model,
      may_move: () => model.may_act && !model.hello.real,
      chosen: () => this.chosen,
      choose: (kind, index) => this.choose(kind, index),
      carry: (kind, index, pose) => {
        this.carried = kind && { kind, index, pose };
        this.draw();
      },
      drop: () => this.#drop(),
      nudge: (step, turn) => this.#nudge(step, turn),
      changed: () => this.draw(),
    });
  }

  shown(is_shown) {
    this.#is_shown = is_shown;
    this.watch();
    if (is_shown) this.draw();
  }

  watch() {
    const ports = this.shows.rays ? this.#valued().flatMap(({ name, distances }) =>
      distances.length > MOST_VALUES ? [] : distances.filter(Boolean).map(({ port }) => `${name}.${port}`)) : [];
    this.#parts.model.watch("world", this.#is_shown && { truth: true, rays: this.shows.rays, ports: [...new Set(ports)] });
  }

  set(what, value) {
    this.shows[what] = value;
    localStorage.setItem("nezumi.world", JSON.stringify(this.shows));
    this.watch();
    this.draw();
  }

  choose(kind, index) {
    this.chosen = kind ? { kind, index } : null;
    if (!kind) this.follows = false;
    if (kind === "robot") this.#parts.model.emit("chosen", this.#parts.model.system.robots[index].name);
    this.watch();
    this.on_chosen?.();
    this.devices?.update();
    this.draw();
  }

  whole() {
    this.follows = false;
    this.eye.show(this.scene.bounds);
    this.on_chosen?.();
    this.draw();
  }

  pose_of({ kind, index }) {
    const { model } = this.#parts;
    if (kind === "thing") return this.scene.thing_pose(model.things, index);
    return kind === "robot" ? model.robots[index] : this.scene.marker_pose(model.markers, index);
  }

  async #put(what, pose) {
    const { acts, model } = this.#parts;
    if (this.arena?.is_on) return this.arena.move(what, pose);
    if (what.kind === "robot") return acts.teleport(model.system.robots[what.index].name, pose);
    if (what.kind === "thing") return acts.move_thing(model.system.arena.things[what.index].name, pose);
    return acts.move_marker(model.system.markers[what.index].name, pose);
  }

  /// Drops the carried object. It stays where it was dropped until the engine has answered.
  async #drop() {
    const { carried } = this;
    if (!carried?.pose) return;
    await this.#put(carried, { ...this.pose_of(carried), ...carried.pose });
    if (this.carried === carried) setTimeout(() => {
      if (this.carried === carried) this.carried = null;
      this.draw();
    }, 60);
  }

  /// Moves the chosen object by keys: from the last position set by keys, even if the engine has not confirmed it.
  #nudge([dx, dy], turn) {
    const { what, when, pose: wished } = this.#nudged;
    const pose = what === this.chosen && performance.now() - when < NUDGES_JOIN ? wished : this.pose_of(this.chosen);
    if (!pose) return;
    this.#nudged = { what: this.chosen, when: performance.now(), pose: { ...pose, x: pose.x + dx, y: pose.y + dy, yaw: pose.yaw + turn } };
    this.#put(this.chosen, this.#nudged.pose);
  }

  #rebuild(anyway = false) {
    const { system } = this.#parts.model;
    this.#is_old = false;
    if (!system || (anyway && this.#layout === "")) return;
    const { arena, robots, markers } = system;
    const layout = JSON.stringify({ arena, robots, markers });
    if (layout === this.#layout && !anyway) return;
    const is_first = this.#layout === "";
    this.#layout = layout;
    this.scene.paint(theme_colors());
    this.scene.build(system, this.#parts.model);
    if (this.#ghost) this.#draw_ghosts();
    if (is_first) {
      this.#resize();
      this.whole();
    }
    this.watch();
    this.on_layout?.();
    this.draw();
  }

  /// Updates which other branch is drawn pale: requests its data, or removes the drawing if there is none.
  #look_for_ghosts() {
    const ghost = ghost_of(this.#parts.model.system?.past);
    if (JSON.stringify(ghost) === JSON.stringify(this.#ghost)) return;
    this.#ghost = ghost;
    if (ghost) this.#parts.tracks.ask(ghost.branch, true);
    else this.scene.ghosts.draw_ways([], 0);
  }

  #draw_ghosts() {
    this.scene.ghosts.draw_ways(this.#parts.tracks.rows(this.#ghost.branch), this.#ghost.from);
    this.draw();
  }

  #resize() {
    const { clientWidth: width, clientHeight: height } = this.stage;
    if (!width || !height || (this.width === width && this.height === height)) return;
    [this.width, this.height] = [width, height];
    this.#renderer?.setSize(width, height, false);
    this.eye.resize(width, height);
    if (this.eye.shows_all) this.eye.show(this.scene.bounds);
  }

  draw() {
    if (this.#is_asked || !this.#is_shown) return;
    this.#is_asked = true;
    requestAnimationFrame(() => {
      this.#is_asked = false;
      this.#draw();
    });
  }

  #draw() {
    const { model } = this.#parts;
    if (this.#layout === "" || !this.#is_shown) return;
    const followed = this.follows && this.chosen && this.pose_of(this.chosen);
    if (followed) this.eye.target.set(followed.x, followed.y, 0);
    this.eye.update();
    const chosen = this.chosen?.kind === "robot" ? this.chosen.index : null;
    this.scene.update(model, { chosen, shows_rays: this.shows.rays && !model.looked, carried: this.carried });
    const time = model.looked?.time ?? model.frame.time;
    this.scene.ghosts.place(this.#ghost?.moves ? this.#parts.tracks.at(this.#ghost.branch, time) : []);
    this.scene.ghosts.lines.visible &&= this.#ghost !== null;
    this.canvas.dataset.ghosts = this.scene.ghosts.count;
    this.canvas.dataset.ways = this.scene.ghosts.lines.visible;
    this.scene.trails.lines.visible = this.shows.trails;
    if (this.shows.trails) this.scene.trails.draw();
    this.#renderer?.render(this.scene.three, this.eye.camera);
    const pose = this.chosen && this.pose_of(this.chosen);
    this.canvas.dataset.chosen = (pose && this.eye.pixel(pose.x, pose.y, pose.z ?? 0)) || "";
    this.canvas.dataset.contacts = this.scene.contact_count;
    this.canvas.dataset.calls = this.#renderer?.info.render.calls ?? 0;
    this.#label(model);
  }

  /// The robots whose sensor values are shown.
  #valued() {
    const { system } = this.#parts.model;
    if (!system) return [];
    return system.robots.filter((_, i) => system.robots.length === 1 || (this.chosen?.kind === "robot" && this.chosen.index === i));
  }

  /// The value of the sensor that a ray belongs to.
  #sensor_value({ name, distances }, index) {
    const carrier = distances[index];
    const value = carrier && this.#parts.model.value_of(`${name}.${carrier.port}`)?.value;
    const number = Array.isArray(value) ? value[carrier.index] : value?.ranges?.[carrier.index] ?? value;
    return typeof number === "number" ? number_text(number) : undefined;
  }

  #label(model) {
    const { labels, eye, chosen } = this;
    const robots = model.system.robots;
    const stranded = stranded_robots(model);
    labels.begin(this.width, this.height);
    robots.forEach(({ name }, i) => {
      const pose = model.robots[i];
      const is_chosen = chosen?.kind === "robot" && chosen.index === i;
      const is_stranded = stranded.has(name);
      if (!pose || !(is_chosen || is_stranded || (this.shows.names && robots.length <= MOST_NAMES))) return;
      const signs = (is_stranded ? " !" : "") + (pose.collided ? " ⚠" : "");
      labels.put_name(`name${is_chosen ? " chosen" : ""}${signs ? " bad" : ""}`, name + signs, eye.pixel(pose.x, pose.y, 0.12),
        `var(--line-${i % 6})`);
      if (!this.shows.rays || model.looked || !(is_chosen || robots.length === 1)) return;
      if ((model.rays[i]?.length ?? 0) > MOST_VALUES) return;
      for (const { from, to, hit, distance } of model.rays[i] ?? []) {
        if (!hit) continue;
        const cm = (Math.hypot(to.x - from.x, to.y - from.y, to.z - from.z) * 100).toFixed(1);
        labels.put("ray", T.world.value(cm, this.#sensor_value(robots[i], distance)), eye.pixel(...beyond(from, to)));
      }
    });
    labels.end();
  }
}

/// A point slightly beyond the end of a ray, so that neighbouring labels do not overlap.
function beyond(from, to) {
  const length = Math.hypot(to.x - from.x, to.y - from.y) || 1;
  const more = 0.02 + 0.25 * length;
  return [to.x + ((to.x - from.x) / length) * more, to.y + ((to.y - from.y) / length) * more, to.z];
}

export function make_world(parts) {
  const world = new World(parts);
  const about = el("p", { class: "hint", text: T.world.about });
  parts.model.on("hello", () => {
    about.textContent = parts.model.hello.real ? T.world.no_truth : T.world.about;
  });
  const [tools, edit_tools, readout] = make_tools(world, parts);
  const devices = make_devices(parts, () => (world.chosen?.kind === "robot" ? world.chosen.index : null));
  world.devices = devices;
  world.stage.append(readout, devices.node);
  return { node: el("div", { class: "world" }, tools, edit_tools, world.stage, about), shown: (is_shown) => world.shown(is_shown) };
}
