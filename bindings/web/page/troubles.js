// Shows errors: in the bar, as notices, at the tabs with details, and at the robots in the world.
import { el } from "./dom.js";
import { place_in } from "./editor.js";
import { T } from "./texts.js";
import { owner_of } from "./port_name.js";

const QUIET = 1000;  // ms after the connection began: log lines that arrive in this time are old, and make no notices

/// The components in ERROR: [{ name, error }, ...].
const failed = (model) => (model.system?.components ?? []).filter(({ state }) => state === "ERROR");

/// The robots that a component in ERROR commands: their names.
export function stranded_robots(model) {
  const names = new Set(failed(model).map(({ name }) => name));
  if (names.size === 0) return names;
  const ends = model.system.connections.filter(({ from }) => names.has(owner_of(from))).map(({ to }) => owner_of(to));
  return new Set(ends.filter((name) => model.system.robots.some((robot) => robot.name === name)));
}

/// The button of the bar that counts the components in ERROR; it opens the log.
export function make_troubles(parts) {
  const { model, link, notices, layout } = parts;
  const button = el("button", { class: "troubles", hidden: true, onclick: () => layout.choose("log") });
  let unseen = 0;
  let begun = Infinity;  // when the connection began

  model.on("system", (before) => {
    const now = failed(model);
    button.hidden = now.length === 0;
    button.textContent = T.troubles.count(now.length);
    button.title = now.map(({ name, error }) => `${name}: ${error}`).join("\n");
    document.body.classList.toggle("troubled", now.length > 0);
    layout.badge("diagram", now.length);
    if (before?.start === model.system.start && before.file === model.system.file) tell_versions(before);
  });
  const tell_versions = (before) => {
    const old = new Map(before.components.map(({ name, version }) => [name, version]));
    const newer = model.system.components.filter(({ name, version, state }) => old.has(name) && version > old.get(name) && state !== "ERROR");
    if (newer.length === 0) return;
    const names = newer.map(({ name }) => name);
    notices.say(T.troubles.runs(newer[0].version, names.slice(0, 3).join(", "), names.length - 3), "good");
  };

  link.on("open", () => {
    begun = performance.now();
  });
  model.on("log", ({ level, component, text }) => {
    if (level !== "error") return;
    if (!layout.is_shown("log")) layout.badge("log", ++unseen);
    if (performance.now() - begun < QUIET) return;
    const place = model.hello?.view_only ? null : place_in(text);
    notices.say(component && !text.startsWith(component) ? `${component}: ${text}` : text, "error",
      place ? { text: T.troubles.open(place.line), press: () => parts.open_file(place) } : { text: T.troubles.show, press: () => layout.choose("log") });
  });
  layout.on("shown", (name) => {
    if (name !== "log") return;
    unseen = 0;
    layout.badge("log", 0);
  });
  return button;
}
