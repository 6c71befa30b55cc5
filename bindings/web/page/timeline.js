// The time line of a run: a slider over the past time, with marks, and the branches.
import { at_most_every, el } from "./dom.js";
import { T } from "./texts.js";

const NEWS = 2000;  // ms between two requests for marks

/// Makes the small signs over the slider, one for each mark { at, kind, text }.
function make_marks(go) {
  const node = el("div", { class: "marks" });
  let shown = "";
  const show = (marks, end) => {
    const now = JSON.stringify([marks, end > 0 ? Math.round(end * 10) : 0]);
    if (now === shown) return;
    shown = now;
    node.replaceChildren(...marks.filter(({ at }) => at <= end + 1e-9).map(({ at, kind, text }) => {
      const told = T.past.mark(T.time.seconds(at.toFixed(2)), text);
      return el("button", { class: `mark ${kind}`, tabindex: -1, title: told, "aria-label": told, onclick: () => go(at),
        style: { left: `${(100 * at) / (end || 1)}%` } });
    }));
  };
  return { node, show };
}

/// The conditions of a failed scenario as rows. A click on a row that names a time goes to this time.
function make_conditions(model, go) {
  const node = el("ul", { class: "conditions", hidden: true, "aria-label": T.past.conditions });
  model.on("hello", () => {
    const lines = model.hello.conditions ?? [];
    node.hidden = lines.length === 0;
    node.replaceChildren(...lines.map((text) => {
      const at = / at ([0-9.]+) s/.exec(text)?.[1];
      const failed = / beyond the limit by /.test(text);
      const row = at === undefined ? el("span", { text }) : el("button", { class: "quiet", text, title: T.past.mark(T.time.seconds(at), text), onclick: () => go(Number(at)) });
      return el("li", { class: failed ? "failed" : "" }, row);
    }));
  });
  return node;
}

export function make_timeline({ model, acts, tracks }) {
  const slider = el("input", { type: "range", min: 0, max: 0, step: 0.01, value: 0, "aria-label": T.past.time, title: T.past.keys });
  const told = el("output", { class: "told" });
  const branch = el("select", { class: "acts", "aria-label": T.past.branch, title: T.past.branch, hidden: true });
  const sign = el("span", { class: "is-past", text: T.past.is_past, title: T.past.hint, hidden: true });
  const now = el("button", { class: "acts quiet", text: T.past.now, title: T.past.now_hint, hidden: true });
  let held = false;  // a person moves the slider

  const past = () => model.system?.past;
  const name = () => past()?.branches[past().branch].name ?? "";
  const is_real = () => Boolean(model.hello?.real);
  const end = () => (past()?.is_past ? past().branches[past().branch].ends : model.frame.time);
  const seconds = (time) => T.time.seconds(time.toFixed(2));

  const go = async (time) => {
    await acts.seek(name(), Math.round(time * model.system.rate));
    held = false;
    model.look_at(null);
    show();
  };
  const marks = make_marks((time) => (is_real() ? look(time) : go(time)));
  const node = el("div", { class: "timeline", role: "group", "aria-label": T.past.label },
    el("div", { class: "slide acts" }, slider, marks.node), told, sign, now, branch, make_conditions(model, go));

  const show = at_most_every(100, () => {
    const at = held ? Number(slider.value) : model.frame.time;
    slider.max = Math.max(end(), at);
    slider.step = 1 / (model.system?.rate ?? 100);
    if (!held) slider.value = at;
    told.textContent = T.past.of(seconds(at), seconds(end()));
    slider.setAttribute("aria-valuetext", told.textContent);
    marks.show(tracks.marks(name()), Number(slider.max));
    const is_past = Boolean(past()?.is_past || past()?.away);
    sign.hidden = now.hidden = !is_past && !(is_real() && held);
    sign.textContent = past()?.away ? T.past.is_away : T.past.is_past;
  });
  /// Shows poses and values of a past time that are remembered; nothing is computed.
  const look = (time) => {
    held = true;
    slider.value = time;
    model.look_at({ time, robots: tracks.at(name(), time), things: tracks.things_at(name(), time) });
    show();
  };
  const ask = at_most_every(NEWS, () => document.hidden || tracks.ask(name()));
  /// The next mark before or after a time.
  const next_mark = (time, is_back) => {
    const times = tracks.marks(name()).map(({ at }) => at);
    return is_back ? times.reverse().find((at) => at < time - 1e-6) : times.find((at) => at > time + 1e-6);
  };
  slider.onpointerdown = slider.onfocus = () => tracks.ask(name(), true);
  slider.onkeydown = (event) => {
    if (event.key !== "PageUp" && event.key !== "PageDown") return;
    event.preventDefault();
    const time = next_mark(Number(slider.value), event.key === "PageDown");
    if (time !== undefined) is_real() ? look(time) : go(time);
  };
  slider.oninput = () => look(Number(slider.value));
  slider.onchange = () => is_real() || go(Number(slider.value));
  branch.onchange = () => acts.seek(branch.value);
  now.onclick = () => {
    held = false;
    model.look_at(null);
    if (!is_real()) acts.seek(past()?.away || name());
    show();
  };
  tracks.on("track", (which) => {
    if (which !== name()) return;
    if (held) look(Number(slider.value));
    show();
  });
  model.on("frame", () => {
    show();
    ask();
  });
  model.on("system", () => {
    if (!past()) return;
    branch.hidden = past().branches.length < 2;
    branch.replaceChildren(...past().branches.map((each) => el("option", { value: each.name, text: each.name })));
    branch.value = name();
    tracks.ask(name());
    show();
  });
  show();
  return node;
}
