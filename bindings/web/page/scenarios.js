// The scenarios of the project: lists them, runs them beside the system, shows results with margins, and opens failed runs.
import { el } from "./dom.js";
import { make_judge } from "./judge.js";
import { read_coverage, read_report } from "./tap.js";
import { T } from "./texts.js";

const SIGNS = { passed: "✔", failed: "✖", runs: "…", skipped: "–", "": "·" };
const PATIENCE = 30000;  // ms to wait for the list, and for the page of a failed run

export function make_scenarios(parts) {
  const { link, model, notices } = parts;
  let listed = [];       // { name, file, line }
  let results = new Map();  // "file: name" to { state, message, lines, folder }
  let report = "";
  let is_running = false;
  let is_known = false;

  const told = el("span", { class: "hint", role: "status" });
  const rows = el("div", { class: "rows", role: "list" });
  const plots = el("details", { class: "measures", hidden: true, open: true });
  const all = el("button", { class: "primary acts", text: T.scenarios.run_all, onclick: () => run({}) });
  const stop = el("button", { class: "acts", text: T.scenarios.stop, disabled: true, onclick: () => link.ask({ do: "test", what: "stop" }) });
  const look = el("button", { class: "acts", text: T.scenarios.look, onclick: () => list() });

  const key = ({ file, name }) => `${file}: ${name}`;
  /// Shows a run in a page of its own.
  const open_page = async (wanted, button) => {
    const tab = window.open("about:blank", "_blank");  // must be opened during the click: later the browser refuses it
    button.disabled = true;
    const { ok, text, content } = await link.ask({ do: "test", ...wanted }, PATIENCE);
    button.disabled = false;
    if (ok && tab) tab.location.replace(new URL(content, location.href).href);
    else if (ok) notices.say(content);
    else {
      tab?.close();
      notices.say(text || T.link.no_answer, "error");
    }
  };
  const made = new Map();  // the shown rows, which are used again, so that a row does not change under the pointer
  const row_of = (each) => {
    const now = JSON.stringify([each, results.get(key(each))]);
    if (made.get(key(each))?.now !== now) made.set(key(each), { now, node: make_row(each) });
    const { node } = made.get(key(each));
    node.querySelector(".run-one").disabled = is_running;
    return node;
  };
  const make_row = (each) => {
    const { state = "", message = "", lines = [], folder = "" } = results.get(key(each)) ?? {};
    const open = el("button", { text: T.scenarios.open, title: T.scenarios.open_hint });
    open.onclick = () => open_page({ what: "open", file: folder }, open);
    const watch = el("button", { class: "acts watch-one", text: T.scenarios.watch, "aria-label": T.scenarios.watch_one(each.name) });
    watch.onclick = () => open_page({ what: "watch", file: each.file, name: each.name }, watch);
    const details = lines.length > 0 ? el("details", { open: state === "failed" }, el("summary", { text: message || T.scenarios.margins(lines.length) }), el("pre", { text: lines.join("\n") })) : null;
    return el("div", { class: `scenario ${state}`, role: "listitem", data: { name: each.name } },
      el("span", { class: "sign", role: "img", "aria-label": T.scenarios.states[state], title: T.scenarios.states[state], text: SIGNS[state] }),
      el("b", { text: each.name }),
      el("button", { class: "quiet place", text: `${each.file}:${each.line}`, onclick: () => parts.open_file({ shown: each.file, line: each.line }) }),
      el("button", { class: "acts run-one", text: T.scenarios.run, "aria-label": T.scenarios.run_one(each.name), onclick: () => run(each) }),
      link.serves_pages && watch, folder && open, details);
  };
  const show = () => {
    all.disabled = is_running || listed.length === 0;
    look.disabled = is_running;
    stop.disabled = !is_running;
    const counts = ["passed", "failed"].map((state) => [...results.values()].filter((each) => each.state === state).length);
    told.textContent = is_running ? T.scenarios.running(counts[0] + counts[1]) : results.size > 0 ? T.scenarios.ended(...counts) : T.scenarios.count(listed.length);
    parts.layout?.badge("scenarios", counts[1]);
    const nodes = listed.length > 0 ? listed.map(row_of) : [el("p", { class: "empty", text: is_known ? T.scenarios.none : "" })];
    if (nodes.length !== rows.children.length || nodes.some((node, i) => node !== rows.children[i])) rows.replaceChildren(...nodes);
  };
  const list = async () => {
    if (!model.may_act) return;
    const { ok, text, content } = await link.ask({ do: "test", what: "list" }, PATIENCE);
    is_known = true;
    listed = [...(content ?? "").matchAll(/^(.*?) {2,}(\S+):(\d+)$/gm)].map(([, name, file, line]) => ({ name, file, line: Number(line) }));
    show();
    if (!ok) rows.prepend(el("p", { class: "error", text: text || T.link.no_answer }));
  };
  /// Drawings of the measures, by their names, as `nezumi test --plots` makes them.
  const show_plots = (drawn) => {
    const names = Object.keys(drawn);
    plots.hidden = names.length === 0;
    plots.replaceChildren(el("summary", { text: T.scenarios.measures(names.length) }),
      ...names.map((name) => el("img", { alt: name, title: name, src: `data:image/svg+xml,${encodeURIComponent(drawn[name])}` })));
  };
  const run = async ({ name, file }) => {
    const { ok, text } = await link.ask({ do: "test", what: "run", ...(name ? { name, file } : {}) });
    if (!ok) return notices.say(text || T.link.no_answer, "error");
    report = "";
    is_running = true;
    const those = listed.filter((each) => !name || (each.name === name && each.file === file));
    if (!name) results = new Map();
    for (const each of those) results.set(key(each), { state: "runs" });
    show();
  };
  model.on("tests", ({ text = "", done = false, problem = "", plots: drawn = {}, coverage = "" }) => {
    report += text;
    for (const each of read_report(report)) results.set(key(each), each);
    if (done) {
      is_running = false;
      show_plots(drawn);
      model.coverage = read_coverage(coverage);
      model.emit("covered");
      for (const [name, { state }] of results) if (state === "runs") results.delete(name);
      if (problem && problem !== "stopped") notices.say(problem.split("\n")[0], "error");
    }
    show();
  });
  link.on("lost", () => {
    is_running = false;
    show();
  });
  let is_seen = false;
  const look_first = () => is_seen && !is_known && list();
  model.on("hello", look_first);
  return { node: el("div", { class: "scenarios" }, el("div", { class: "tools", role: "toolbar", "aria-label": T.views.scenarios }, all, stop, look, told), plots, rows, make_judge(parts)),
    shown: (is_shown) => {
      is_seen = is_shown;
      look_first();
    } };
}
