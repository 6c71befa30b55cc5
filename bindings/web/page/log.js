// The log: filtered by level and text, the newest line last.
import { el } from "./dom.js";
import { place_in } from "./editor.js";
import { T } from "./texts.js";

const LEVELS = ["debug", "info", "warn", "error"];
const SIGNS = { debug: "·", info: "i", warn: "▲", error: "✖" };
const MOST = 3000;

export function make_log(parts) {
  const { model } = parts;
  const lines = el("div", { class: "lines", role: "log", "aria-label": T.log.label, tabindex: 0 });
  const level = el("select", { "aria-label": T.log.level }, ...LEVELS.map((each) => el("option", { value: each, text: T.log[each] })));
  level.value = "info";
  const search = el("input", { type: "search", placeholder: T.log.search, "aria-label": T.log.search });
  const count = el("span", { class: "hint" });

  let start = 0;  // number of the start; lines of earlier starts have other times
  const fits = (line) => LEVELS.indexOf(line.dataset.level) >= LEVELS.indexOf(level.value) &&
    line.textContent.toLowerCase().includes(search.value.toLowerCase());
  const tell = () => {
    count.textContent = T.log.count(lines.childElementCount);
  };
  const add = ({ level: how, component, text, at }) => {
    const is_low = lines.scrollHeight - lines.scrollTop - lines.clientHeight < 40;
    const name = LEVELS.includes(how) ? how : "info";
    const line = el("div", { class: `entry ${name}`, data: { level: name, at: Number.isFinite(at) ? at : "", start } },
      el("time", { text: Number.isFinite(at) ? at.toFixed(2) : "" }), el("span", { class: "sign", title: T.log[name], text: SIGNS[name] }),
      el("b", { text: component ?? "" }), el("span", { class: "text", text }));
    const place = place_in(text);
    if (place) line.append(el("button", { class: "quiet open acts", text: T.troubles.open(place.line), onclick: () => parts.open_file(place) }));
    line.hidden = !fits(line);
    lines.append(line);
    if (lines.childElementCount > MOST) lines.firstChild.remove();
    if (is_low) lines.scrollTop = lines.scrollHeight;
    tell();
  };
  const filter = () => {
    for (const line of lines.children) line.hidden = !fits(line);
    lines.scrollTop = lines.scrollHeight;
  };
  level.onchange = filter;
  search.oninput = filter;
  // While the slider of time is moved: later lines are pale, and the last line before this time is visible.
  const look = () => {
    let last = null;
    for (const line of lines.children) {
      const is_later = model.looked !== null && line.dataset.start === String(start) && Number(line.dataset.at) > model.looked.time + 1e-9;
      line.classList.toggle("later", is_later);
      if (!is_later && !line.hidden) last = line;
    }
    if (last) lines.scrollTop += last.getBoundingClientRect().bottom - lines.getBoundingClientRect().bottom;
  };
  model.on("looked", look);
  model.on("restarted", () => ++start);
  model.on("log", add);
  model.on("lost", ({ count: lost }) => add({ level: "warn", text: T.link.lost(lost) }));
  const clear = el("button", { class: "quiet", text: T.log.clear, onclick: () => {
    lines.replaceChildren();
    tell();
  } });
  tell();
  return { node: el("div", { class: "log" }, el("div", { class: "tools" }, level, search, count, clear), lines),
    shown: () => {
      lines.scrollTop = lines.scrollHeight;
    } };
}
