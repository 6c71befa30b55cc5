// Plots of numbers over time: any fields of any ports in one drawing; can be paused, zoomed and saved.
import { numbers_in } from "./cdr.js";
import { at_most_every, el, save_as } from "./dom.js";
import { to_csv, to_svg } from "./plot_files.js";
import { T } from "./texts.js";

const KEPT = 300;  // s
const WINDOW = 60;  // s shown
const MOST_ROWS = 12000;
const STEP = 0.04;  // s between two rows
const MOST_FIELDS = 12;
const SURVEY = 700;  // ms
const MOST_SURVEYED = 200;

/// The data of a plot: rows [time, value of the first field, ...], null without a value.
class Recording {
  fields = [];  // { port, path }
  rows = [];
  ghost = [];  // rows of before time went back

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
  }

  clear() {
    this.rows.length = this.ghost.length = 0;
  }

  /// What is drawn: the rows, and beside them those of before time went back.
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
    while (this.rows.length > MOST_ROWS || this.rows[0][0] < time - KEPT) this.rows.shift();
    return true;
  }
}

/// Of a run that is over: the rows of the whole run.
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
    addEventListener("theme", () => this.#anew());
    new ResizeObserver(() => this.#graph?.resize()).observe(this.box);
  }

  shown(is_shown) {
    this.#is_shown = is_shown;
    if (is_shown) this.draw();
  }

  add(port, path) {
    const is_there = this.recording.fields.some((each) => each.port === port && each.path === path);
    if (is_there || this.recording.fields.length >= MOST_FIELDS) return;
    this.recording.add({ port, path });
    this.#changed();
  }

  remove(index) {
    this.recording.remove(index);
    this.#changed();
  }

  clear() {
    this.recording.clear();
    this.#changed();
  }

  /// Shows the values at a time of the past; none without.
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

  pause(is_paused) {
    this.#is_paused = is_paused;
    this.draw();
  }

  follow() {
    this.#range = null;
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
    const dateWindow = this.#range ?? [this.#parts.run ? rows[0][0] : Math.max(rows[0][0], end - WINDOW), Math.max(end, rows[0][0] + 1)];
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

function make_chooser(plots, { model }) {
  const search = el("input", { type: "search", placeholder: T.plots.search, "aria-label": T.plots.search });
  const port = el("select", { "aria-label": T.plots.port });
  const field = el("select", { "aria-label": T.plots.field });
  const add = el("button", { text: T.plots.plot, onclick: () => field.value !== "-" && plots.add(port.value, field.value) });
  let fields = "";
  const look = () => {
    model.watch("plot chooser", port.value && model.wanted([port.value]));
    fields = "";
    fill_fields();
  };
  const fill_fields = at_most_every(200, () => {
    const paths = numbers_in(model.values.get(port.value)?.value).map(([path]) => path);
    if (paths.join() === fields && field.children.length > 0) return;
    fields = paths.join();
    field.replaceChildren(...(paths.length > 0 ? paths.map((path) => el("option", { value: path, text: path || port.value.split(".")[1] }))
      : [el("option", { value: "-", text: T.plots.no_fields })]));
    add.disabled = paths.length === 0;
  });
  let all = [];
  let with_data = new Set();
  /// Looks once at everything, to show first what has data.
  const survey = () => {
    model.watch("plot survey", model.wanted(all.slice(0, MOST_SURVEYED)));
    setTimeout(() => {
      with_data = new Set(all.filter((name) => model.values.get(name)?.count > 0 && numbers_in(model.values.get(name).value).length > 0));
      model.watch("plot survey", null);
      fill();
    }, SURVEY);
  };
  /// The ports whose names have all words that are searched, grouped by component; those with data come first.
  const fill = () => {
    const words = search.value.toLowerCase().split(/[\s.]+/).filter(Boolean);
    const names = all.filter((name) => words.every((word) => name.toLowerCase().includes(word)));
    const before = port.value;
    const groups = new Map();  // label: names
    const add_to = (label, name) => groups.set(label, [...groups.get(label) ?? [], name]);
    for (const name of names.filter((each) => with_data.has(each))) add_to(name.split(".")[0], name);
    for (const name of names.filter((each) => !with_data.has(each))) add_to(with_data.size > 0 ? T.plots.without_data : name.split(".")[0], name);
    port.replaceChildren(...[...groups].map(([label, those]) => el("optgroup", { label }, ...those.map((name) => el("option", { value: name, text: name })))));
    if (names.includes(before)) port.value = before;
    if (port.value !== before || field.children.length === 0) look();
  };
  port.onchange = look;
  model.on("port", (name) => name === port.value && fill_fields());
  model.on("system", () => {
    const names = model.all_ports().filter(([, { type }]) => !/String|CameraImage/.test(type)).map(([name]) => name)
      .concat(model.all_members());
    if (port.dataset.names === names.join()) return;
    port.dataset.names = names.join();
    all = names;
    fill();
  });
  search.oninput = () => fill();
  return { nodes: [search, port, field, add], look: () => {
    look();
    survey();
  }, stop: () => model.watch("plot chooser", null) };
}

export function make_plots(parts) {
  const plots = new Plots(parts);
  const chooser = make_chooser(plots, parts);
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
  plots.on_changed = () => show_legend();
  plots.on_values = show_legend;
  addEventListener("theme", () => show_legend());
  const tools = el("div", { class: "tools", role: "toolbar", "aria-label": T.views.plots }, ...chooser.nodes, el("span", { class: "gap" }), pause,
    el("button", { text: T.plots.zoom_out, onclick: () => plots.follow() }),
    el("button", { text: T.plots.csv, onclick: () => save_as(`${name()}.csv`, "text/csv", to_csv(recording.names, recording.rows)) }),
    el("button", { text: T.plots.svg, onclick: () => save_as(`${name()}.svg`, "image/svg+xml", to_svg(recording.names, recording.rows, line_colors())) }),
    el("button", { class: "quiet", text: T.plots.clear, onclick: () => plots.clear() }));
  return { node: el("div", { class: "plots" }, tools, plots.legend, plots.box, el("p", { class: "hint", text: T.plots.zoom })),
    shown: (is_shown) => {
      if (is_shown) chooser.look();
      else chooser.stop();
      plots.shown(is_shown);
    } };
}
