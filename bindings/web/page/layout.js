// The arrangement of the views: three groups side by side on wide screens, one view at a time on a phone.
import { el } from "./dom.js";
import { T } from "./texts.js";

const GROUPS = {
  stage: ["world", "diagram", "plots"],
  side: ["drive", "parameters", "cameras", "explain"],
  dock: ["console", "log"],
};
const ICONS = { world: "◎", diagram: "⇄", plots: "∿", drive: "✛", parameters: "≡", cameras: "▣", console: "❯", explain: "?", log: "☰" };

/// Tabs as in ARIA: one has the focus, arrow keys change it.
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
  return { node, update };
}

/// `views`: name to { node, shown?(whether) }.
export function make_layout(views) {
  const chosen = { stage: "world", side: "drive", dock: "console", ...JSON.parse(localStorage.getItem("nezumi.views") ?? "{}") };
  let current = chosen.current ?? "world";
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
      }
    }
  };
  const choose = (name) => {
    current = name;
    chosen[group_of(name)] = name;
    localStorage.setItem("nezumi.views", JSON.stringify({ ...chosen, current }));
    update();
  };

  const all_tabs = [];
  const make = (label, names, which) => {
    const tabs = make_tabs(label, names, which, choose);
    all_tabs.push(tabs);
    return tabs.node;
  };
  const groups = Object.entries(GROUPS).map(([group, names]) => {
    const sections = names.map((name) => {
      Object.assign(views[name].node, { id: `view-${name}` });
      views[name].node.classList.add("view");
      views[name].node.setAttribute("role", "tabpanel");
      views[name].node.setAttribute("aria-label", T.views[name]);
      return views[name].node;
    });
    return el("section", { class: `group ${group}` }, make(T.parts[group], names, () => chosen[group]), ...sections);
  });
  const bottom = el("nav", { class: "bottom" }, make(T.parts.all, Object.keys(ICONS), () => current));
  narrow.addEventListener("change", update);
  update();
  return el("main", {}, ...groups, bottom);
}
