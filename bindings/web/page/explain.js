// Explains one execution of a behaviour: its inputs, the executed lines with values, its outputs, and the effect of the
// robot's limits on the wheels. While time is paused, explains the last execution. Requests nothing while the view is
// hidden.
import { el } from "./dom.js";
import { error_of } from "./error_frames.js";
import { T } from "./texts.js";
import { number_text } from "./value_text.js";
import { owner_of } from "./port_name.js";

const AGAIN = 500;  // ms between two requests in following mode

/// The behaviour that drives a robot, otherwise one that reads from it.
function behavior_of(model, robot) {
  const { connections } = model.system;
  const is_behavior = (name) => model.component(name)?.kind === "behavior";
  const drives = connections.find(({ from, to }) => owner_of(to) === robot && is_behavior(owner_of(from)));
  const hears = connections.find(({ from, to }) => owner_of(from) === robot && is_behavior(owner_of(to)));
  return drives ? owner_of(drives.from) : hears ? owner_of(hears.to) : null;
}

const stage = (name, kind, ...nodes) => el("section", { class: `step ${kind}` }, el("h3", { text: name }), ...nodes);

function ports_of(ports, arrow) {
  if (ports.length === 0) return [el("p", { class: "hint", text: T.explain.none })];
  return ports.map(({ port, value, peers, override }) => el("div", { class: "port-value" },
    el("span", { text: peers.length > 0 ? `${port} ${arrow} ${peers.join(", ")}` : port }),
    el("code", { text: value || T.diagram.nothing_yet }), override && el("em", { text: override })));
}

function lines_of({ lines, is_cut }) {
  if (lines.length === 0) return [el("p", { class: "hint", text: T.explain.no_lines })];
  const rows = lines.flatMap(({ file, line, text, depth, values, turns_left_out: turns }, i) => [
    (i === 0 || lines[i - 1].file !== file) && el("li", { class: "file", text: file }),
    turns > 0 && el("li", { class: "file", text: T.explain.turns(turns) }),
    el("li", {}, el("span", { class: "place", text: String(line) }),
      el("code", { text: text.trim(), style: { paddingLeft: `${Math.max(0, depth - lines[0].depth) * 1.2}em` } }),
      el("span", { class: "values" }, ...values.map(([name, value]) => el("span", { class: "value" }, el("i", { text: name }), ` = ${value}`)))),
  ]).filter(Boolean);
  return [el("ol", {}, ...rows), is_cut && el("p", { class: "hint", text: T.explain.cut })];
}

function robot_of({ robot, asked, limits, limited, wheels }) {
  const velocity = ({ vx, va }) => `${number_text(vx)} m/s, ${number_text(va)} rad/s`;
  return [
    stage(T.explain.limits(robot), "limits", el("p", { text: T.explain.asked(velocity(asked)) }),
      el("p", { text: T.explain.limited(velocity(limited), number_text(limits.speed), number_text(limits.yaw_rate)) })),
    stage(T.explain.wheels(robot), "wheels", el("p", { text: wheels
      ? T.explain.rims(number_text(wheels.left), number_text(wheels.right)) : T.explain.free })),
  ];
}

/// Adds to the parts `explain(name)`, which opens the view for a behaviour.
export function make_explain(parts) {
  const { model, link, notices } = parts;
  const which = el("select", { "aria-label": T.explain.which });
  const look = el("button", { class: "primary", text: T.explain.look, title: T.explain.look_hint });
  const follow = el("button", { class: "toggle", "aria-pressed": false, text: T.explain.follow });
  const body = el("div", { class: "chain" }, el("p", { class: "empty", text: T.explain.about }));
  let is_shown = false;
  let waits = false;
  let timer = null;
  let shown_at = null;  // the tick of the last answer; null: nothing was asked yet

  const ask = async () => {
    if (!which.value || waits) return;
    waits = true;
    const { ok, text } = await link.ask({ do: "explain", component: which.value });
    if (!ok) refuse(text || T.link.no_answer);
  };
  /// Shows why there is no explanation, in place of the previous one.
  const refuse = (why) => {
    waits = false;
    shown_at = model.frame.tick;
    stop_following();
    body.replaceChildren(el("p", { class: "empty", text: why }), ...error_of(model.component(which.value)));
  };
  const stop_following = () => {
    follow.setAttribute("aria-pressed", false);
    clearTimeout(timer);
  };
  look.onclick = ask;
  parts.explain = (name) => {
    which.value = name;
    waits = false;
    if (is_shown) ask();
    else parts.layout.choose("explain");
  };
  which.onchange = () => {
    waits = false;
    ask();
  };
  follow.onclick = () => {
    const next = follow.getAttribute("aria-pressed") !== "true";
    follow.setAttribute("aria-pressed", next);
    if (next) ask();
    else stop_following();
  };
  model.on("explain", (seen) => {
    if (seen.component !== which.value) return;
    if (seen.waits) return notices.say(T.explain.paused);
    waits = false;
    if (seen.problem) return refuse(seen.problem);
    shown_at = model.frame.tick;
    body.replaceChildren(
      el("p", { class: "when", text: T.explain.when(seen.component, seen.at.toFixed(2), seen.tick) }),
      ...error_of(model.component(seen.component)),
      stage(T.explain.inputs, "inputs", ...ports_of(seen.inputs, "←")),
      stage(T.explain.lines, "lua", ...lines_of(seen).filter(Boolean)),
      stage(T.explain.outputs, "outputs", ...ports_of(seen.outputs, "→")),
      ...seen.robots.flatMap(robot_of));
    if (is_shown && follow.getAttribute("aria-pressed") === "true") timer = setTimeout(ask, AGAIN);
  });
  for (const what of ["restarted", "went_back"]) model.on(what, () => {
    waits = false;
    if (shown_at !== null) shown_at = -1;
    stop_following();
  });
  // After a step or a seek, the shown execution is no longer the last one.
  model.on("frame", () => {
    const is_old = shown_at !== null && shown_at !== model.frame.tick;
    if (is_shown && is_old && !model.frame.running && !model.looked) ask();
  });
  link.on("lost", () => {
    waits = false;
    stop_following();
  });
  model.on("system", () => {
    const names = model.system.components.filter(({ kind }) => kind === "behavior").map(({ name }) => name);
    if (which.dataset.names === names.join()) return;
    which.dataset.names = names.join();
    const before = which.value;
    which.replaceChildren(...names.map((name) => el("option", { value: name, text: name })));
    if (names.includes(before)) which.value = before;
    look.disabled = names.length === 0;
  });
  model.on("chosen", (robot) => {
    const name = behavior_of(model, robot);
    if (!name || name === which.value) return;
    which.value = name;
    waits = false;
    if (is_shown) ask();
  });
  return {
    node: el("div", { class: "explain" }, el("div", { class: "tools", role: "toolbar", "aria-label": T.views.explain }, which, look, follow), body),
    shown: (shown) => {
      is_shown = shown;
      if (shown) ask();
      else stop_following();
    },
  };
}
