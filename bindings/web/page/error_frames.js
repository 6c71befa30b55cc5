// An error of a component: its text, and the functions that were running with their local variables.
import { el } from "./dom.js";
import { T } from "./texts.js";

/// The nodes for a component in ERROR; none for others.
export function error_of({ state, error, frames = [] } = {}) {
  if (state !== "ERROR") return [];
  const text = el("code", { class: "error", text: error });
  // A single function without variables says no more than the place in the text.
  if (frames.length < 2 && !frames[0]?.locals.length) return [text];
  return [text, el("ol", { class: "frames", "aria-label": T.troubles.frames },
    ...frames.map(({ file, line, name, locals }) => el("li", {},
      el("code", { text: `${file}:${line}${name ? ` ${name}` : ""}` }),
      ...locals.map(([variable, value]) => el("span", { class: "value" }, el("i", { text: variable }), ` = ${value}`)))))];
}
