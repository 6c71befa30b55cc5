// Plots of numbers over time: any fields of any ports in one drawing; can be paused, zoomed and saved.
import { numbers_in } from "./cdr.js";
import { at_most_every, el, save_as } from "./dom.js";
import { to_csv, to_svg } from "./plot_files.js";
import { make_plot_tree } from "./plot_tree.js";
import { T } from "./texts.js";

const KEPT = 300;  // s of data that are kept
const WINDOW = 60;  // s shown
const MOST_ROWS = 12000;
const STEP = 0.04;  // s between two rows
const MOST_FIELDS = 12;
const PLACES = ["pose.position.x", "pose.position.y", "pose.heading"];  // the numbers of a robot's truth that the time line has

/// The data of a plot: rows [time, value of the first field, ...], null without a value.
class Recording {
  fields = [];  // { port, path }
  rows = [];
  has_all = false;  // the rows have everything since the start, and old ones are kept
  ghost = [];  // the rows from before time went back

  get names() {
    return this.fields.map(({ port, path }) => (path.startsWith("[") || !path ? port + path : `${port}.${path}`));
  }

  add(field) {
    this.fields.push(field);
    for (const row of [...this.rows, ...this.ghost]) row.push(null);
  }

  remove(index) {
    this.fields.splice(index, 1);
    for (const row of [...this.rows, ...this.ghost]) row.splice(index + 1, 1);
    if (this.fields.length === 0) this.clear();
  }

  /// Fills in the earlier numbers of a field, from before it was chosen: `samples` is [[time, number], ...], each valid
  /// until the next one.
  fill(index, samples) {
    let at = -1;
    for (const row of this.rows) {
      while (at + 1 < samples.length && samples[at + 1][0] <= row[0] + 1e-9) ++at;
      if (at >= 0) row[index + 1] ??= samples[at][1];
    }
    const first = this.rows[0]?.[0] ?? Infinity;
    const none = this.fields.map(() => null);
    this.rows.unshift(...samples.filter(([time]) => time < first - 1e-9).map(([time, number]) => [time, ...none.map((_, i) => (i === index ? number : null))]));
    this.#drop_old();
  }

  #drop_old() {
    const last = this.rows.at(-1)?.[0];
    const old = this.has_all ? 0 : this.rows.findIndex(([time]) => time >= last - KEPT);
    this.rows.splice(0, Math.max(old, this.rows.length - (this.has_all ? 2 : 1) * MOST_ROWS));
  }

  clear() {
    this.has_all = false;
    this.rows.length = this.ghost.length = 0;
  }

  /// The data to draw: the rows, and also, dashed, the rows from before time went back.
  drawn() {
    if (this.ghost.length === 0) return { names: this.names, rows: this.rows.slice(), dashed: [] };
    const none = this.fields.map(() => null);
    const rows = [...this.rows.map((row) => [...row, ...none]), ...this.ghost.map(([time, ...values]) => [time, ...none, ...values])];
    const dashed = this.names.map((name) => T.plots.before(name));
    return { names: [...this.names, ...dashed], rows: rows.sort((a, b) => a[0] - b[0]), dashed };
  }

  /// Records the present values of the ports.
  take(time, values) {
    const last = this.rows[this.rows.length - 1];
    if (last && time < last[0]) {
      this.ghost = this.rows;
      this.rows = this.rows.filter((row) => row[0] <= time).map((row) => [...row]);
    }
    const latest = this.rows[this.rows.length - 1];
    if (this.fields.length === 0 || (latest && time - latest[0] < STEP)) return false;
    const seen = new Map();
    this.rows.push([time, ...this.fields.map(({ port, path }) => {
      if (!seen.has(port)) seen.set(port, new Map(numbers_in(values.get(port)?.value)));
      return seen.get(port).get(path) ?? null;
    })]);
    this.#drop_old();
    return true;
  }
}

/// The data of a plot for a recorded run: the rows of the whole run.
class WholeRecording extends Recording {
  #run;

  constructor(run) {
    super();
    this.#run = run;
  }

  add(field) {
    this.fields.push(field);
    this.rows = this.#run.rows_of(this.fields);
  }

  remove(index) {
    this.fields.splice(index, 1);
    this.rows = this.#run.rows_of(this.fields);
  }

  clear() {
    this.fields.length = this.rows.length = 0;
  }

  fill() {}

  take() {
    return false;
  }
}

const line_colors = () => {
  const style = getComputedStyle(document.documentElement);
  return Array.from({ length: MOST_FIELDS }, (_, i) => style.getPropertyValue(`--line-${i % 6}`).trim());
};

// The page has its own legend; this one sets a style attribute, which the security policy forbids.
Dygraph.PLUGINS = Dygraph.PLUGINS.filter((each) => each !== Dygraph.Plugins.Legend);

class Plots {
  recording;
  #parts;
  #graph = null;
  #is_shown = false;
  #is_paused = false;
  #range = null;  // chosen by a person
  box = el("div", { class: "graph" });
  legend = el("div", { class: "legend" });

  constructor(parts) {
    this.#parts = parts;
    this.recording = parts.run ? new WholeRecording(parts.run) : new Recording();
    const { model } = parts;
    const draw = at_most_every(100, () => this.draw());
    model.on("frame", () => this.recording.take(model.frame.time, model.values) && draw());
    model.on("restarted", () => this.recording.clear());
    if (parts.run) model.on("frame", () => this.#look(model.frame.time));
    model.on("looked", () => this.#look(model.looked?.time));
    model.on("remembered", (said) => this.#take_history(said));
    model.on("earlier", (said) => {
      this.recording.has_all = true;
      this.#take_history(said);
    });
    addEventListener("theme", () => this.#anew());
    new ResizeObserver(() => this.#graph?.resize()).observe(this.box);
  }

  shown(is_shown) {
    this.#is_shown = is_shown;
    if (is_shown) this.draw();
  }

  add(port, path) {
    if (this.has(port, path) || this.recording.fields.length >= MOST_FIELDS) return;
    this.recording.add({ port, path });
    const { link, model, run } = this.#parts;
    const branch = model.system?.past?.branches[model.system.past.branch].name;
    if (!run && branch) link.send({ do: "remembered", branch, rows: port.endsWith(".truth"), port });
    this.#changed();
  }

  has(port, path) {
    return this.recording.fields.some((each) => each.port === port && each.path === path);
  }

  toggle(port, path) {
    if (this.has(port, path)) this.remove(this.recording.fields.findIndex((each) => each.port === port && each.path === path));
    else this.add(port, path);
  }

  /// Takes the earlier values of a port, from before it was chosen.
  #take_history({ port, labels, values, rows }) {
    if (!port) return;
    const { system, frame } = this.#parts.model;
    const robot = system.robots.findIndex(({ name }) => `${name}.truth` === port);
    this.recording.fields.forEach((field, index) => {
      if (field.port !== port) return;
      const column = labels.indexOf(field.path);
      const place = PLACES.indexOf(field.path);
      let samples = [];
      if (column >= 0) samples = values.map((row) => [row[0], row[column + 1]]);
      else if (robot >= 0 && place >= 0) samples = (rows ?? []).map((row) => [row[0], row[1 + 3 * robot + place] ?? null]);
      this.recording.fill(index, samples.filter(([time, number]) => number !== null && time <= frame.time + 1e-9));
    });
    this.draw();
  }

  remove(index) {
    this.recording.remove(index);
    this.#changed();
  }

  clear() {
    this.recording.clear();
    this.#changed();
  }

  /// Shows the values at a past time; without a time, shows none.
  #look(time) {
    if (time === undefined) {
      this.#graph?.clearSelection();
      return this.on_values?.(null);
    }
    const { names, rows } = this.recording.drawn();
    const index = rows.findIndex((row) => row[0] >= time - 1e-9);
    if (index < 0 || rows.length < 2) return;
    if (this.#is_shown) this.#graph?.setSelection(index);
    this.on_values?.(time, new Map(names.map((name, i) => [name, rows[index][i + 1]])));
  }

  /// Asks the engine to compute the values before the first row.
  ask_earlier() {
    this.#range = null;
    for (const port of new Set(this.recording.fields.map((each) => each.port))) this.#parts.acts.earlier(port);
  }

  pause(is_paused) {
    this.#is_paused = is_paused;
    this.draw();
  }

  follow() {
    this.#range = null;
    this.recording.has_all = false;
    this.draw();
  }

  #changed() {
    const { model } = this.#parts;
    model.watch("plots", model.wanted([...new Set(this.recording.fields.map(({ port }) => port))]));
    this.#anew();
    this.on_changed?.();
    if (this.#parts.run) this.#look(model.frame.time);
  }

  #anew() {
    this.#graph?.destroy();
    this.#graph = null;
    this.draw();
  }

  /// Draws the last minute, the zoomed range, or the data at the time of the pause.
  draw() {
    const { rows, names } = this.recording;
    if (!this.#is_shown || names.length === 0 || rows.length < 2) {
      if (rows.length < 2 || names.length === 0) {
        this.#graph?.destroy();
        this.#graph = null;
        this.box.replaceChildren(names.length === 0 ? el("p", { class: "empty", text: T.plots.empty }) : "");
      }
      return;
    }
    const end = Math.max(rows[rows.length - 1][0], this.recording.ghost[this.recording.ghost.length - 1]?.[0] ?? 0);
    const dateWindow = this.#range ?? [this.#parts.run ? rows[0][0] : Math.max(rows[0][0], end - (this.recording.has_all ? Infinity : WINDOW)), Math.max(end, rows[0][0] + 1)];
    const drawn = this.recording.drawn();
    if (this.#graph && this.#graph.numColumns() !== drawn.names.length + 1) {
      this.#graph.destroy();
      this.#graph = null;
    }
    if (!this.#graph) this.#make(drawn, dateWindow);
    else if (!this.#is_paused) this.#graph.updateOptions({ file: drawn.rows, dateWindow });
    else this.#graph.updateOptions({ dateWindow: this.#range ?? this.#graph.xAxisRange() });
  }

  #make({ rows, names, dashed }, dateWindow) {
    this.box.replaceChildren();
    const colors = line_colors().slice(0, names.length - dashed.length);
    const style = getComputedStyle(document.documentElement);
    const color = (name) => style.getPropertyValue(`--${name}`).trim();
    this.#graph = new Dygraph(this.box, rows, {
      labels: ["t", ...names], colors: [...colors, ...colors], dateWindow,
      series: Object.fromEntries(dashed.map((name) => [name, { strokePattern: [5, 4], strokeWidth: 1.2 }])), xlabel: T.plots.time, strokeWidth: 1.8, legend: "never",
      gridLineColor: color("line"), axisLineColor: color("line"), axisLabelFontSize: 12, connectSeparatedPoints: true,
      xRangePad: 4, yRangePad: 10, animatedZooms: false, rightGap: 12,
      highlightCallback: (_, x, points) => this.on_values?.(x, new Map(points.map(({ name, yval }) => [name, yval]))),
      unhighlightCallback: () => this.on_values?.(null),
      zoomCallback: (from, to) => {
        const all = rows[0][0] >= from && to >= this.recording.rows[this.recording.rows.length - 1][0];
        this.#range = all ? null : [from, to];
      },
    });
  }
}

export function make_plots(parts) {
  const plots = new Plots(parts);
  const tree = make_plot_tree(plots, parts);
  const choose = el("button", { class: "toggle", "aria-expanded": true, text: T.plots.choose });
  const show_tree = (is_open) => {
    choose.setAttribute("aria-expanded", is_open);
    tree.node.hidden = !is_open;
    tree.shown(is_open && is_shown);
  };
  choose.onclick = () => show_tree(tree.node.hidden);
  let is_shown = false;
  const { recording } = plots;
  const name = () => `${parts.model.system?.name ?? "nezumi"}_plot`;
  const pause = el("button", { class: "toggle", "aria-pressed": false, text: T.plots.pause, onclick: () => {
    const is_paused = pause.getAttribute("aria-pressed") !== "true";
    pause.setAttribute("aria-pressed", is_paused);
    pause.textContent = is_paused ? T.plots.resume : T.plots.pause;
    plots.pause(is_paused);
  } });
  const show_legend = (_, values) => {
    const colors = line_colors();
    plots.legend.replaceChildren(...recording.names.map((each, i) => {
      const value = values?.get(each);
      const chip = el("span", { class: "chip" }, el("i", { style: { background: colors[i] } }), el("span", { text: each }),
        el("b", { text: value === undefined || value === null ? "" : String(Number(value.toPrecision(5))) }),
        el("button", { class: "quiet", text: "×", title: T.plots.remove(each), "aria-label": T.plots.remove(each), onclick: () => plots.remove(i) }));
      return chip;
    }));
  };
  plots.on_changed = () => {
    show_legend();
    tree.fill();
  };
  plots.on_values = show_legend;
  addEventListener("theme", () => show_legend());
  const tools = el("div", { class: "tools", role: "toolbar", "aria-label": T.views.plots }, choose, el("span", { class: "gap" }), pause,
    el("button", { text: T.plots.zoom_out, onclick: () => plots.follow() }),
    el("button", { text: T.plots.earlier, title: T.plots.earlier_hint, hidden: Boolean(parts.run), onclick: () => plots.ask_earlier() }),
    el("button", { text: T.plots.csv, onclick: () => save_as(`${name()}.csv`, "text/csv", to_csv(recording.names, recording.rows)) }),
    el("button", { text: T.plots.svg, onclick: () => save_as(`${name()}.svg`, "image/svg+xml", to_svg(recording.names, recording.rows, line_colors())) }),
    el("button", { class: "quiet", text: T.plots.clear, onclick: () => plots.clear() }));
  const drawing = el("div", { class: "drawing" }, plots.legend, plots.box, el("p", { class: "hint", text: T.plots.zoom }));
  return { node: el("div", { class: "plots" }, tools, el("div", { class: "both" }, tree.node, drawing)),
    shown: (whether) => {
      is_shown = whether;
      tree.shown(is_shown && !tree.node.hidden);
      plots.shown(is_shown);
    } };
}
