// The bar that is always visible: the system's name, time, and the emergency stop.
import { ask } from "./ask.js";
import { at_most_every, el, is_typing, svg } from "./dom.js";
import { make_language_button, T } from "./texts.js";
import { make_timeline } from "./timeline.js";
import { make_troubles } from "./troubles.js";

const LASTS = 2000;  // ms: lateness is shown in red only if it lasts longer
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, "max"];

function make_theme_button() {
  const choices = ["auto", "light", "dark"];
  const signs = { auto: "◐", light: "☀", dark: "☾" };
  let chosen = localStorage.getItem("nezumi.theme") ?? "auto";
  const dark = matchMedia("(prefers-color-scheme: dark)");
  const button = el("button", { class: "quiet theme" });
  const show = () => {
    document.documentElement.dataset.theme = chosen === "auto" ? (dark.matches ? "dark" : "light") : chosen;
    button.textContent = signs[chosen];
    button.title = `${T.theme.label}: ${T.theme[chosen]}`;
    button.setAttribute("aria-label", button.title);
    dispatchEvent(new Event("theme"));
  };
  button.onclick = () => {
    chosen = choices[(choices.indexOf(chosen) + 1) % choices.length];
    localStorage.setItem("nezumi.theme", chosen);
    show();
  };
  dark.addEventListener("change", show);
  show();
  return button;
}

function make_time({ model, acts }) {
  const clock = el("output", { class: "clock", "aria-label": T.time.label });
  const late = el("span", { class: "late" });
  const run = el("button", { class: "run acts pace" });
  const step = el("button", { class: "acts pace not-real", text: T.time.step, title: T.time.step_hint,
    onclick: () => acts.time("step", 1) });
  const speed = el("select", { class: "acts pace not-real", "aria-label": T.time.speed, title: T.time.speed,
    onchange: () => acts.time("speed", speed.value === "max" ? "max" : Number(speed.value)) },
  ...SPEEDS.map((each) => el("option", { value: String(each), text: each === "max" ? T.time.max : `${each}×` })));
  const restart = el("button", { class: "acts not-real wide", text: T.time.restart,
    onclick: async () => (await ask(T.time.restart_sure, T.time.restart)) && acts.time("restart") });
  let late_since = Infinity;
  run.onclick = () => acts.time(model.frame.running ? "pause" : "resume");

  const show = at_most_every(100, () => {
    const { time, running, late: ms, speed: now } = model.frame;
    clock.textContent = T.time.seconds(time.toFixed(time < 1000 ? 2 : 1));
    late.textContent = !running ? T.time.paused : ms >= 1 ? T.time.late(ms.toFixed(ms < 10 ? 1 : 0)) : T.time.on_time;
    if (!running || ms < 5) late_since = Infinity;
    else late_since = Math.min(late_since, performance.now());
    late.classList.toggle("bad", performance.now() - late_since > LASTS);
    run.textContent = running ? T.time.pause : T.time.resume;
    run.setAttribute("aria-pressed", !running);
    const chosen = SPEEDS.includes(now) ? String(now) : "max";
    if (document.activeElement !== speed && speed.value !== chosen) speed.value = chosen;
  });
  model.on("frame", show);
  show();
  return el("div", { class: "time", role: "group", "aria-label": T.time.label }, clock, late, run, step, speed, restart);
}

function make_stop({ model, acts, notices }) {
  const stop = el("button", { class: "stop acts", title: T.stop.hint, "aria-keyshortcuts": "Space", onclick: acts.stop },
    el("span", { class: "sign", "aria-hidden": "true", text: "■" }), el("span", { text: T.stop.label }));
  const rearm = el("button", { class: "rearm acts", text: T.stop.rearm, title: T.stop.rearm_hint, onclick: () => acts.rearm(), hidden: true });
  model.on("system", () => {
    const stopped = Boolean(model.system.stopped);
    if (rearm.hidden === !stopped) return;
    rearm.hidden = !stopped;
    document.body.classList.toggle("stopped", stopped);
    if (stopped) notices.say(T.stop.held, "warn");
  });
  addEventListener("keydown", (event) => {
    if (event.code !== "Space" || is_typing(event.target) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    if (!event.repeat && !model.hello?.view_only) acts.stop();
  }, true);
  addEventListener("keyup", (event) => {  // otherwise releasing the space bar would press the focused button
    if (event.code === "Space" && !is_typing(event.target)) event.preventDefault();
  }, true);
  return el("div", { class: "stopping" }, rearm, stop);
}

/// The system's name; a click lists the other systems on this machine.
function make_systems({ model, link }) {
  const list = el("ul", {});
  const name = el("h1", { text: "nezumi" });
  const node = el("details", { class: "systems" }, el("summary", { title: T.systems.hint }, name), list);
  node.addEventListener("toggle", () => node.open && link.send({ do: "systems" }));
  model.on("systems", ({ systems }) => {
    const rows = systems.map((each) => el("li", {}, each.here ? el("b", { text: each.name })
      : el("a", { href: each.url, target: "_blank", rel: "noopener noreferrer", text: each.name }),
    el("small", { text: each.here ? T.systems.here : T.systems.process(each.process) })));
    list.replaceChildren(...rows, el("li", { class: "hint", text: T.systems.about }));
  });
  addEventListener("click", (event) => {
    if (!node.contains(event.target)) node.open = false;
  });
  return { node, name };
}

/// Copies the address for viewing only.
function make_share({ model, notices }) {
  const sign = svg("svg", { class: "icon", viewBox: "0 0 16 16", "aria-hidden": "true" },
    svg("path", { d: "M6 5.5V3q0-1 1-1h6q1 0 1 1v6q0 1-1 1h-2.5M3 6h6q1 0 1 1v6q0 1-1 1H3q-1 0-1-1V7q0-1 1-1z" }));
  const button = el("button", { class: "quiet share acts", title: T.share.hint, "aria-label": T.share.hint }, sign);
  button.onclick = async () => {
    const address = `${location.origin}/#${model.hello.view_token}`;
    try {
      await navigator.clipboard.writeText(address);
      notices.say(T.share.copied);
    } catch {
      notices.say(T.share.here(address));  // the page has no access to the clipboard
    }
  };
  model.on("hello", () => {
    button.hidden = !model.hello.view_token;  // in a class there is no view token
  });
  return button;
}

export function make_header(parts) {
  const { model, link } = parts;
  const { node: systems, name } = make_systems(parts);
  const kind = el("span", { class: "kind" });
  const dot = el("span", { class: "dot", role: "img", title: T.link.connecting, "aria-label": T.link.connecting });
  const say = (text, is_open) => {
    dot.title = text;
    dot.setAttribute("aria-label", text);
    dot.classList.toggle("open", is_open);
  };
  link.on("open", () => say(T.link.open, true));
  link.on("lost", () => say(T.link.connecting, false));
  model.on("system", () => {
    name.textContent = model.system.name || T.scenarios.one;  // the system of a scenario may have no file, and so no name
    name.title = model.system.file;
  });
  model.on("hello", () => {
    const words = [model.hello.real ? T.real : T.simulated, model.hello.paces ? T.watching : model.hello.view_only && T.view_only];
    kind.textContent = words.filter(Boolean).join(" · ");
  });
  return el("header", {}, el("div", { class: "title" }, dot, systems, kind, make_troubles(parts)), make_time(parts),
    make_share(parts), make_language_button(), make_theme_button(), make_stop(parts), make_timeline(parts));
}
