// Shows values at the lines of the open file while a behaviour runs it, and marks each line that was seen to run.
import { el } from "./dom.js";
import { T } from "./texts.js";

const AGAIN = 500;  // ms between two requested executions
const LONGEST = 90;  // characters of the values at a line

const is_same = (shown, name) => shown === name || shown.endsWith(`/${name}`) || name.endsWith(`/${shown}`);

export function make_values(editor, { link, model }) {
  const { text } = editor;
  const which = el("select", { "aria-label": T.editor.values_of, hidden: true });
  const toggle = el("button", { class: "toggle", "aria-pressed": false, text: T.editor.values, title: T.editor.values_hint, disabled: true });
  let is_shown = false;
  let timer = null;
  let waits = false;
  let widgets = [];
  let ran = new Set();  // handles of the marked lines
  const is_on = () => toggle.getAttribute("aria-pressed") === "true";

  const clear_values = () => {
    for (const each of widgets) each.clear();
    widgets = [];
  };
  const forget_lines = () => {
    text.clearGutter("gutter-ran");
    ran = new Set();
  };
  const ask = async () => {
    clearTimeout(timer);
    if (!is_on() || !is_shown || waits || !which.value || !link.is_open) return;
    waits = true;
    const { ok, text: why } = await link.ask({ do: "explain", component: which.value });
    if (ok) return;
    waits = false;
    editor.say(why || T.link.no_answer, "bad");
    stop();
  };
  const stop = () => {
    toggle.setAttribute("aria-pressed", false);
    clearTimeout(timer);
    clear_values();
    forget_lines();
  };
  const show = (lines) => {
    const last = new Map();  // line: its values, the latest ones
    for (const { file, line, values } of lines) {
      if (!is_same(editor.shown_name, file)) continue;
      last.set(line, new Map([...last.get(line) ?? [], ...values]));
    }
    text.operation(() => {
      clear_values();
      for (const [line, values] of last) {
        if (line > text.lineCount()) continue;
        const handle = text.getLineHandle(line - 1);
        if (!ran.has(handle)) {
          ran.add(handle);
          text.setGutterMarker(line - 1, "gutter-ran", el("span", { class: "ran-sign", title: T.editor.ran, text: "▎" }));
        }
        if (values.size === 0) continue;
        const all = [...values].map(([name, value]) => `${name} = ${value}`).join("   ");
        const node = el("span", { class: "line-values", title: all, text: all.length > LONGEST ? `${all.slice(0, LONGEST)}…` : all });
        widgets.push(text.setBookmark({ line: line - 1, ch: text.getLine(line - 1).length }, { widget: node, insertLeft: true }));
      }
    });
  };
  model.on("explain", (seen) => {
    if (!is_on() || seen.component !== which.value || seen.waits) return;
    waits = false;
    if (seen.problem) {
      editor.say(seen.problem, "bad");
      return stop();
    }
    // Not after a change of the text: its lines are no longer those that ran.
    if (!editor.is_changed(editor.file)) show(seen.lines);
    timer = setTimeout(ask, AGAIN);
  });
  toggle.onclick = () => {
    if (is_on()) return stop();
    toggle.setAttribute("aria-pressed", true);
    waits = false;
    ask();
  };
  which.onchange = () => {
    waits = false;
    clear_values();
    ask();
  };
  const restart = () => {
    waits = false;
    if (is_on()) ask();
  };
  model.on("restarted", restart);
  link.on("lost", () => {
    waits = false;
  });
  link.on("open", restart);
  const fill = () => {
    const behaviors = (model.system?.components ?? []).filter(({ kind }) => kind === "behavior");
    const own = behaviors.filter(({ script }) => is_same(editor.shown_name, script ?? ""));
    const names = (own.length > 0 || editor.kind !== "modules" ? own : behaviors).map(({ name }) => name);
    toggle.disabled = names.length === 0;
    which.hidden = names.length < 2;
    if (which.dataset.names === names.join()) return;
    const before = which.value;
    which.dataset.names = names.join();
    which.replaceChildren(...names.map((name) => el("option", { value: name, text: name })));
    if (names.includes(before)) which.value = before;
    if (names.length === 0 && is_on()) stop();
  };
  model.on("system", fill);
  return {
    tools: [toggle, which],
    opened: () => {
      clear_values();
      forget_lines();
      fill();
      waits = false;
      ask();
    },
    changed: clear_values,
    shown: (shown) => {
      is_shown = shown;
      ask();
    },
  };
}
