// The tree of all numbers of a system: components, their ports, and the numbers of each. Items with data come first.
import { numbers_in } from "./cdr.js";
import { at_most_every, el } from "./dom.js";
import { split_port } from "./port_name.js";
import { T } from "./texts.js";

const SURVEY = 700;  // ms
const MOST_SURVEYED = 200;
const MOST_ROWS = 400;
const OPEN_AT_FIRST = 3;  // up to so many components with data are open at first; with more, all are closed

/// `plots`: { has(port, path), toggle(port, path) }.
export function make_plot_tree(plots, { model, run }) {
  const search = el("input", { type: "search", placeholder: T.plots.search, "aria-label": T.plots.search });
  const tree = el("div", { class: "tree", role: "tree", "aria-label": T.plots.tree, "aria-multiselectable": true });
  const more = el("p", { class: "hint", hidden: true });
  const fields = new Map();  // port: the paths of its numbers
  const with_data = new Set();  // ports
  const open = new Set();  // components and ports
  let all = [];
  let listed = "";
  let focused = "";  // a row's key
  let is_shown = false;
  let is_first = true;

  const words = () => search.value.toLowerCase().split(/[\s.]+/).filter(Boolean);
  const is_open = (key) => open.has(key) || words().length > 0;
  /// Learns the numbers of a port from its value. Returns whether they differ from before, or the port has its first data.
  const learn = (port) => {
    const now = model.values.get(port);
    const paths = numbers_in(now?.value).map(([path]) => path);
    if (paths.length === 0) return false;
    const is_first_data = now.count > 0 && !with_data.has(port);
    if (is_first_data) with_data.add(port);
    if (paths.join() === fields.get(port)?.join()) return is_first_data;
    fields.set(port, paths);
    return true;
  };

  /// The visible rows: { key, level, text, port, path, is_open, has }; `path` only for a number.
  const rows_of = () => {
    const wanted = words();
    const fits = (name) => wanted.every((word) => name.toLowerCase().includes(word));
    const components = new Map();
    for (const port of all) {
      const paths = (fields.get(port) ?? []).filter((path) => fits(`${port} ${path}`));
      if (paths.length === 0 && !fits(port)) continue;
      const [owner, name] = split_port(port);
      if (!components.has(owner)) components.set(owner, []);
      components.get(owner).push({ port, name, paths });
    }
    const first = (list, has) => [...list.filter(has), ...list.filter((each) => !has(each))];
    const found = [];
    for (const [owner, ports] of first([...components], ([, those]) => those.some(({ port }) => with_data.has(port)))) {
      found.push({ key: owner, level: 1, text: owner, is_open: is_open(owner), has: ports.some(({ port }) => with_data.has(port)) });
      if (!is_open(owner)) continue;
      for (const { port, name, paths } of first(ports, (each) => with_data.has(each.port))) {
        const is_single = paths.length === 1 && paths[0] === "";
        const has = with_data.has(port);
        found.push(is_single ? { key: port, level: 2, text: name, port, path: "", has }
          : { key: port, level: 2, text: name, is_open: paths.length > 0 ? is_open(port) : undefined, has });
        if (is_single || !is_open(port)) continue;
        for (const path of paths) found.push({ key: `${port} ${path}`, level: 3, text: path, port, path, has });
      }
    }
    return found;
  };

  const use = ({ key, port, path, is_open: opened }) => {
    if (path !== undefined) plots.toggle(port, path);
    else if (opened !== undefined) open[open.has(key) ? "delete" : "add"](key);
    focused = key;
    fill();
  };
  let rows = [];
  const fill = () => {
    const found = rows_of();
    rows = found.slice(0, MOST_ROWS);
    more.hidden = rows.length === found.length;
    more.textContent = T.plots.more(found.length - rows.length);
    if (!rows.some(({ key }) => key === focused)) focused = rows[0]?.key ?? "";
    const had_focus = tree.contains(document.activeElement);
    tree.replaceChildren(...rows.map((row) => {
      const { key, level, text, port, path, is_open: opened, has } = row;
      const sign = path === undefined ? (opened === undefined ? "" : opened ? "▾" : "▸") : plots.has(port, path) ? "☑" : "☐";
      return el("div", { class: has ? "row" : "row none", role: "treeitem", "aria-level": level, tabindex: key === focused ? 0 : -1, data: { key },
        ...(opened === undefined ? {} : { "aria-expanded": opened }), ...(path === undefined ? {} : { "aria-checked": plots.has(port, path) }),
        onclick: () => use(row) },
      el("span", { class: "sign", "aria-hidden": "true", text: sign }), el("span", { text }), has || level > 2 ? "" : el("small", { text: T.plots.without_data }));
    }));
    if (had_focus) focus_on(focused);
    watch();
  };
  const focus_on = (key) => {
    focused = key;
    for (const node of tree.children) {
      node.tabIndex = node.dataset.key === key ? 0 : -1;
      if (node.tabIndex === 0) node.focus();
    }
  };
  const fill_soon = at_most_every(200, () => is_shown && fill());

  /// Watches the ports in the visible rows, because their numbers are known only from a message.
  const watch = () => {
    const seen = rows.filter(({ level, path }) => level === 2 && path === undefined).map(({ key }) => key).slice(0, MOST_SURVEYED);
    model.watch("plot chooser", is_shown && seen.length > 0 ? model.wanted(seen) : null);
  };
  const survey = () => {
    model.watch("plot survey", model.wanted(all.slice(0, MOST_SURVEYED)));
    setTimeout(() => {
      model.watch("plot survey", null);
      if (is_first) {
        const owners = new Set(all.filter((port) => with_data.has(port)).map((port) => split_port(port)[0]));
        if (owners.size <= OPEN_AT_FIRST) for (const owner of owners) open.add(owner);
        is_first = owners.size === 0;
      }
      if (is_shown) fill();
    }, run ? 0 : SURVEY);
  };

  tree.addEventListener("keydown", (event) => {
    const at = rows.findIndex(({ key }) => key === focused);
    const row = rows[at];
    if (!row || event.ctrlKey || event.altKey || event.metaKey) return;
    const parent = rows.slice(0, at).reverse().find(({ level }) => level < row.level);
    if (event.key === "ArrowDown") focus_on(rows[Math.min(at + 1, rows.length - 1)].key);
    else if (event.key === "ArrowUp") focus_on(rows[Math.max(at - 1, 0)].key);
    else if (event.key === "Home") focus_on(rows[0].key);
    else if (event.key === "End") focus_on(rows.at(-1).key);
    else if (event.key === "ArrowRight" && row.is_open === false) use(row);
    else if (event.key === "ArrowRight" && row.is_open) focus_on(rows[Math.min(at + 1, rows.length - 1)].key);
    else if (event.key === "ArrowLeft" && row.is_open && open.has(row.key)) use(row);
    else if (event.key === "ArrowLeft" && parent) focus_on(parent.key);
    else if (event.key === "Enter") use(row);
    else return;
    event.preventDefault();
  });
  model.on("restarted", () => with_data.clear());
  model.on("port", (name) => is_shown && all.includes(name) && learn(name) && fill_soon());
  model.on("system", () => {
    all = model.all_ports().filter(([, { type }]) => !/String|CameraImage/.test(type)).map(([name]) => name).concat(model.all_members());
    if (all.join() === listed) return;
    listed = all.join();
    for (const port of fields.keys()) if (!all.includes(port)) fields.delete(port), with_data.delete(port);
    if (is_shown) survey(), fill();
  });
  search.oninput = fill;
  return { node: el("div", { class: "chooser" }, search, tree, more), fill: () => is_shown && fill(), shown: (whether) => {
    is_shown = whether;
    watch();
    if (whether) survey(), fill();
  } };
}
