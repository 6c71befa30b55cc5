// The arena edited by hand: each change is written into the system file, and the system starts again with it.
import { added, call_of, calls_in, moved, removed } from "./arena_text.js";
import { el } from "./dom.js";
import { Files } from "./editor_files.js";
import { outline_of, standing } from "./arena_places.js";
import { T } from "./texts.js";

const WORDS = ["box", "wall", "cylinder", "marker", "robot"];
const TRIES = 24;  // free places that are tried for a new thing
const PLACES = 400;  // places that are examined to find free ones
const GAP = 0.02;  // m between a new thing and others
const ANSWER_WITHIN = 2000;  // ms

export class ArenaEdit {
  is_on = false;
  #parts;
  #world;
  #files;
  #text = "";
  #mark = "";
  #file = "";
  #before = [];  // texts, for undo
  #work = Promise.resolve();

  constructor(parts, world) {
    this.#parts = parts;
    this.#world = world;
    this.#files = new Files(parts.link);
    this.told = el("span", { class: "hint", role: "status" });
    this.undo_button = el("button", { text: T.arena.undo, disabled: true, onclick: () => this.undo() });
    this.node = el("div", { class: "tools arena-tools", role: "toolbar", "aria-label": T.arena.edit, hidden: true }, el("span", { class: "label", text: T.arena.add }),
      ...WORDS.map((word) => el("button", { text: T.arena.words[word], onclick: () => this.add(word) })),
      el("button", { text: T.arena.remove, onclick: () => this.remove() }), this.undo_button, this.told);
  }

  say(text, is_bad = false) {
    this.told.textContent = text;
    this.told.classList.toggle("error", is_bad);
  }

  async set(is_on) {
    this.is_on = is_on;
    this.node.hidden = !is_on;
    if (!is_on) return;
    this.#parts.acts.time("pause");
    await this.#read();
  }

  async #read() {
    this.say("");
    await this.#files.list();
    const found = this.#files.named(this.#parts.model.system.file);
    if (!found) return this.say(T.arena.no_file, true);
    this.#file = found.file;
    const { ok, text, content, mark } = await this.#files.ask("read", { file: this.#file });
    if (!ok) return this.say(text || T.link.no_answer, true);
    [this.#text, this.#mark] = [content, mark];
    this.say(T.arena.hint(this.#file));
  }

  /// Makes changes one after the other. `change` makes one change; the message of its error is shown.
  #next(change) {
    this.#work = this.#work.then(async () => {
      if (!this.#file) return;
      try {
        await change();
      } catch (wrong) {
        this.say(wrong.message, true);
      }
    });
    return this.#work;
  }

  async #problem_of(text) {
    const { ok, text: why, findings } = await this.#files.ask("check", { file: this.#file, text });
    return ok ? findings[0]?.message ?? "" : why || T.link.no_answer;
  }

  /// Writes a text that has been checked, and starts the system with it.
  async #take(text, keeps = true) {
    const answer = await this.#files.ask("save", { file: this.#file, text, mark: this.#mark });
    if (answer.changed) {
      await this.#read();
      throw new Error(T.arena.changed);
    }
    if (!answer.ok) throw new Error(answer.text || T.link.no_answer);
    if (keeps) this.#before.push(this.#text);
    this.undo_button.disabled = this.#before.length === 0;
    [this.#text, this.#mark] = [text, answer.mark];
    const shown = this.#shown_anew();
    const started = await this.#parts.link.ask({ do: "time", what: "restart" }, 20000);
    if (!started.ok) throw new Error(started.text || T.link.no_answer);
    await shown;
    this.say(answer.text || T.arena.written(this.#file));
  }

  /// Resolves when the page has the poses of things after the next start.
  #shown_anew() {
    const { model } = this.#parts;
    const { start } = model.system;
    return new Promise((resolve) => {
      const stop = model.on("frame", () => model.system.start !== start && done());
      const late = setTimeout(() => done(), ANSWER_WITHIN);
      const done = () => {
        clearTimeout(late);
        stop();
        resolve();
      };
    });
  }

  async #change(text) {
    const problem = await this.#problem_of(text);
    if (problem) throw new Error(problem);
    await this.#take(text);
  }

  /// The call in the file that makes the chosen object.
  #call({ kind, index }) {
    const { system } = this.#parts.model;
    if (kind === "robot") {
      const { name } = system.robots[index];
      const calls = calls_in(this.#text).filter((each) => each.word === "robot" && each.name === name);
      if (calls.length !== 1) throw new Error(T.arena.no_robot(name));
      return calls[0];
    }
    const all = kind === "marker" ? system.markers : system.arena.things;
    const { name, place } = all[index];
    if (!place) throw new Error(T.arena.no_place(name));
    const words = kind === "marker" ? ["marker"] : name.startsWith("cylinder") ? ["cylinder"] : ["box", "wall"];
    const number = (each) => Number(each.name.split(" ").at(-1));
    const same = all.filter((each) => each.place?.line === place.line && each.place.file === place.file && (kind === "marker" || each.name.split(" ")[0] === name.split(" ")[0]));
    if (kind !== "marker") same.sort((a, b) => number(a) - number(b));
    return call_of(this.#text, words, place.line, same.indexOf(all[index]), same.length);
  }

  move(what, pose) {
    const from = this.#world.pose_of(what);
    if (!from) return;
    const step = { dx: pose.x - from.x, dy: pose.y - from.y, turn: (pose.yaw ?? 0) - (from.yaw ?? 0), to: pose };
    return this.#next(() => this.#change(moved(this.#text, this.#call(what), step)));
  }

  remove() {
    const what = this.#world.chosen;
    if (!what) return this.say(T.arena.choose, true);
    return this.#next(async () => {
      await this.#change(removed(this.#text, this.#call(what)));
      this.#world.choose(null);
    });
  }

  undo() {
    return this.#next(async () => {
      const text = this.#before.pop();
      this.undo_button.disabled = this.#before.length === 0;
      if (text !== undefined) await this.#take(text, false);
    });
  }

  /// Adds a thing near the middle of the view, at the first free place.
  add(word) {
    return this.#next(async () => {
      const { system } = this.#parts.model;
      let problem = T.arena.full;
      for (const [x, y] of this.#free_places(word)) {
        const text = added(this.#text, word, this.#written(word, system, x, y));
        problem = await this.#problem_of(text);
        if (!problem) return this.#take(text);
      }
      throw new Error(problem);
    });
  }

  #free_places(word) {
    const { model } = this.#parts;
    const { scene, eye } = this.#world;
    const others = standing(model, scene);
    const outline = outline_of(word, Math.max(0.1, ...scene.sizes) / 2);
    const size = model.system.arena.size ?? [Infinity, Infinity];
    const fits = ([x, y]) => outline.every(([dx, dy, radius]) => Math.abs(x + dx) + radius < size[0] / 2 && Math.abs(y + dy) + radius < size[1] / 2
      && others.every((distance) => distance(x + dx, y + dy) > radius + GAP));
    const places = Array.from({ length: PLACES }, (_, i) => {
      const [angle, far] = [i * 2.4, 0.06 * Math.sqrt(i)];
      return [eye.target.x + far * Math.cos(angle), eye.target.y + far * Math.sin(angle)];
    });
    return places.filter(fits).slice(0, TRIES);
  }

  #written(word, system, x, y) {
    const at = (dx = 0, dy = 0) => `{ ${[x + dx, y + dy].map((each) => Number(each.toFixed(2))).join(", ")} }`;
    const free = (is_used) => {
      let number = 1;
      while (is_used(number)) number += 1;
      return number;
    };
    if (word === "box") return `box { at = ${at()}, size = { 0.1, 0.1, 0.1 } }`;
    if (word === "wall") return `wall { from = ${at(0, -0.2)}, to = ${at(0, 0.2)} }`;
    if (word === "cylinder") return `cylinder { at = ${at()}, radius = 0.05, height = 0.1 }`;
    if (word === "marker") return `marker { id = ${free((number) => system.markers.some(({ id }) => id === number))}, at = { ${[x, y].map((each) => Number(each.toFixed(2))).join(", ")}, 0.1 }, size = 0.08 }`;
    const model = system.robots[0]?.model ?? "raspimouse";
    const name = `robot${free((number) => system.components.some((each) => each.name === `robot${number}`))}`;
    return `robot "${name}" { model = "${model}", pose = { x = ${Number(x.toFixed(2))}, y = ${Number(y.toFixed(2))}, heading = 0 } }`;
  }
}
