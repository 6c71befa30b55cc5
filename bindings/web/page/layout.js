// The arrangement of the views: three groups side by side on wide screens, one view at a time on a phone.
import { el } from "./dom.js";
import { Emitter } from "./emitter.js";
import { make_splits } from "./splits.js";
import { T } from "./texts.js";

const GROUPS = {
  stage: ["world", "diagram", "plots", "editor"],
  side: ["drive", "parameters", "cameras", "explain"],
  dock: ["console", "log", "scenarios"],
};
const PHONE = ["world", "drive", "parameters", "console"];  // directly available on a phone; the others are under "More"
const ICONS = { world: "◎", diagram: "⇄", plots: "∿", editor: "✎", drive: "✛", parameters: "≡", cameras: "▣", console: "❯", explain: "?", log: "☰", scenarios: "✓" };

/// Tabs as ARIA describes them: arrow keys move the focus between tabs.
function make_tabs(label, names, chosen, choose) {
  const tabs = new Map(names.map((name) => [name, el("button", {
    class: "tab", role: "tab", "aria-controls": `view-${name}`, data: { view: name },
    onclick: () => choose(name),
  }, el("span", { class: "icon", "aria-hidden": "true", text: ICONS[name] }), el("span", { text: T.views[name] }))]));
  const node = el("div", { class: "tabs", role: "tablist", "aria-label": label }, ...tabs.values());
  node.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const next = names[(names.indexOf(chosen()) + step + names.length) % names.length];
    choose(next);
    tabs.get(next).focus();
  });
  const update = () => {
    for (const [name, tab] of tabs) {
      tab.setAttribute("aria-selected", name === chosen());
      tab.tabIndex = name === chosen() ? 0 : -1;
    }
  };
  const badge = (name, count) => {
    const tab = tabs.get(name);
    tab?.querySelector(".badge")?.remove();
    if (tab && count > 0) tab.append(el("span", { class: "badge", text: count }));
  };
  return { node, update, badge };
}

/// `views`: name to { node, shown?(whether) }. Emits `shown` with the name of a view when the view becomes visible.
export function make_layout(views) {
  const layout = new Emitter();
  const present = (names) => names.filter((name) => views[name]);
  const chosen = { stage: "world", side: "drive", dock: "console", ...JSON.parse(localStorage.getItem("nezumi.views") ?? "{}") };
  for (const [group, names] of Object.entries(GROUPS)) if (!views[chosen[group]]) chosen[group] = present(names)[0];
  let current = views[chosen.current] ? chosen.current : "world";
  const narrow = matchMedia("(max-width: 899px)");
  const group_of = (name) => Object.keys(GROUPS).find((group) => GROUPS[group].includes(name));

  const is_shown = (name) => {
    if (!narrow.matches) return chosen[group_of(name)] === name;
    return name === current || (current === "drive" && name === "world");
  };
  const update = () => {
    document.body.dataset.view = current;
    for (const tabs of all_tabs) tabs.update();
    for (const [name, view] of Object.entries(views)) {
      const shown = is_shown(name);
      if (view.node.hidden !== !shown || !view.node.dataset.placed) {
        view.node.dataset.placed = "yes";
        view.node.hidden = !shown;
        view.shown?.(shown);
        if (shown) layout.emit("shown", name);
      }
    }
  };
  const choose = (name) => {
    current = name;
    if (GROUPS.dock.includes(name)) use_dock();
    more.open = false;
    chosen[group_of(name)] = name;
    localStorage.setItem("nezumi.views", JSON.stringify({ ...chosen, current }));
    update();
  };

  /// Shows the whole console. It has only one line until a person uses the console or the log.
  const use_dock = () => layout.node.classList.remove("dock-unused");
  const more = el("details", { class: "more" });
  const all_tabs = [];
  const make = (label, names, which) => {
    const tabs = make_tabs(label, names, which, choose);
    all_tabs.push(tabs);
    return tabs.node;
  };
  Object.assign(layout, { choose, is_shown, badge: (name, count) => all_tabs.forEach((tabs) => tabs.badge(name, count)) });
  const groups = Object.entries(GROUPS).map(([group, all]) => {
    const names = present(all);
    const sections = names.map((name) => {
      Object.assign(views[name].node, { id: `view-${name}` });
      views[name].node.classList.add("view");
      views[name].node.setAttribute("role", "tabpanel");
      views[name].node.setAttribute("aria-label", T.views[name]);
      return views[name].node;
    });
    return el("section", { class: `group ${group}` }, make(T.parts[group], names, () => chosen[group]), ...sections);
  });
  const others = present(Object.keys(ICONS)).filter((name) => !PHONE.includes(name));
  more.append(el("summary", { class: "tab" }, el("span", { class: "icon", "aria-hidden": "true", text: "⋯" }), el("span", { text: T.parts.more })),
    make(T.parts.more, others, () => current));
  const bottom = el("nav", { class: "bottom" }, make(T.parts.all, present(PHONE), () => current), more);
  narrow.addEventListener("change", update);
  update();
  layout.node = el("main", { class: "dock-unused" }, ...groups, bottom);
  make_splits(layout.node, (name) => name === "dock" && use_dock());
  layout.node.querySelector(".dock").addEventListener("focusin", ({ target }) => target.matches("textarea, input") && use_dock());
  return layout;
}
