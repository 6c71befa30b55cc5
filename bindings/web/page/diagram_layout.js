// Computes the places of boxes and connection lines: a source is left of its target.
import { owner_of, split_port } from "./port_name.js";

const HEAD = 34;  // px of a box's title
const ROW = 22;  // px of a port
const GAP = 26;  // px between boxes of a column
const LANE = 13;  // px between backward lines
const BETWEEN = 96;  // px between columns
const APART = 56;  // px between unconnected groups

/// The size of a component's box and the places of its ports: { w, h, ports: Map(name: [x, y]) }.
export function box_of({ name, type, kind, ports, error }) {
  const ins = ports.filter((each) => each.way === "in");
  const outs = ports.filter((each) => each.way !== "in");
  const longest = (all) => Math.max(0, ...all.map((each) => each.name.length));
  const w = Math.max(170, 6.7 * (longest(ins) + longest(outs)) + 56, 8 * name.length + 6 * (kind === "remote" ? 14 : type.length) + 70);
  const rows = Math.max(1, ins.length, outs.length);
  const places = new Map();
  ins.forEach((port, i) => places.set(port.name, [0, HEAD + ROW * (i + 0.5) + 4]));
  outs.forEach((port, i) => places.set(port.name, [w, HEAD + ROW * (i + 0.5) + 4]));
  return { w, h: HEAD + rows * ROW + 8 + (error ? ROW : 0), ports: places };
}

/// The sets of components that are connected with each other.
function groups_of(names, links) {
  const of = new Map(names.map((name) => [name, name]));
  const root = (name) => (of.get(name) === name ? name : root(of.get(name)));
  for (const [a, b] of links) of.set(root(b), root(a));
  const groups = new Map();
  for (const name of names) {
    if (!groups.has(root(name))) groups.set(root(name), []);
    groups.get(root(name)).push(name);
  }
  return [...groups.values()];
}

/// The column of each component: the length of the longest path from a source. Links that close a cycle are ignored.
function columns_of(names, links, starts) {
  const state = new Map();
  const forward = [];
  const visit = (name) => {
    state.set(name, "open");
    for (const [from, to] of links.filter(([each]) => each === name)) {
      if (state.get(to) === "open") continue;
      forward.push([from, to]);
      if (!state.has(to)) visit(to);
    }
    state.set(name, "done");
  };
  for (const name of [...names.filter((each) => starts.has(each)), ...names]) if (!state.has(name)) visit(name);
  const column = new Map(names.map((name) => [name, 0]));
  for (let round = 0; round < names.length; ++round) {
    let is_still = true;
    for (const [from, to] of forward) {
      if (column.get(to) > column.get(from)) continue;
      column.set(to, column.get(from) + 1);
      is_still = false;
    }
    if (is_still) break;
  }
  return column;
}

/// Places one group from (0, 0): { boxes: Map(name: { x, y, w, h, ports }), w, h }.
function place_group(names, links, boxes, starts) {
  const column = columns_of(names, links, starts);
  const columns = [];
  for (const name of names) (columns[column.get(name)] ??= []).push(name);
  const order = new Map(names.map((name, i) => [name, i]));
  for (let round = 0; round < 4; ++round) {
    for (const members of columns) {
      const wish = (name) => {
        const near = links.filter((each) => each.includes(name)).map(([a, b]) => order.get(a === name ? b : a));
        return near.length > 0 ? near.reduce((sum, each) => sum + each, 0) / near.length : order.get(name);
      };
      const wishes = new Map(members.map((name) => [name, wish(name)]));
      members.sort((a, b) => wishes.get(a) - wishes.get(b));
      members.forEach((name, i) => order.set(name, i));
    }
  }
  const tall = (members) => members.reduce((sum, name) => sum + boxes.get(name).h + GAP, -GAP);
  const h = Math.max(...columns.map(tall));
  const placed = new Map();
  let x = 0;
  for (const members of columns) {
    let y = (h - tall(members)) / 2;
    const w = Math.max(...members.map((name) => boxes.get(name).w));
    for (const name of members) {
      placed.set(name, { ...boxes.get(name), x: x + (w - boxes.get(name).w) / 2, y });
      y += boxes.get(name).h + GAP;
    }
    x += w + BETWEEN;
  }
  const back = links.filter(([a, b]) => column.get(b) <= column.get(a)).length;
  return { boxes: placed, w: x - BETWEEN, h: h + (back > 0 ? 18 + LANE * back : 0) };
}

/// Places all boxes: Map(name: { x, y, w, h, ports }). `kept`: places that a person has chosen: { name: [x, y] }.
export function place(components, connections, kept = {}) {
  const names = components.map((each) => each.name);
  const known = new Set(names);
  const links = connections.map(({ from, to }) => [owner_of(from), owner_of(to)]).filter(([a, b]) => known.has(a) && known.has(b));
  const boxes = new Map(components.map((each) => [each.name, box_of(each)]));
  const starts = new Set(components.filter((each) => each.kind === "robot" || !each.ports.some((port) => port.way === "in")).map((each) => each.name));
  const groups = groups_of(names, links).map((each) => place_group(each, links.filter(([a]) => each.includes(a)), boxes, starts));

  const area = groups.reduce((sum, { w, h }) => sum + (w + APART) * (h + APART), 0);
  const widest = Math.max(Math.sqrt(area * 1.5), ...groups.map(({ w }) => w));
  const placed = new Map();
  let [x, y, shelf] = [0, 0, 0];
  for (const group of groups) {
    if (x > 0 && x + group.w > widest) [x, y, shelf] = [0, y + shelf + APART, 0];
    for (const [name, box] of group.boxes) placed.set(name, { ...box, x: box.x + x, y: box.y + y });
    x += group.w + APART;
    shelf = Math.max(shelf, group.h);
  }
  for (const [name, [kx, ky]] of Object.entries(kept)) if (placed.has(name)) Object.assign(placed.get(name), { x: kx, y: ky });
  return placed;
}

/// The position of a port: [x, y], or null.
export function port_at(boxes, port) {
  const [owner, name] = split_port(port);
  const box = boxes.get(owner);
  const at = box?.ports.get(name);
  return at ? [box.x + at[0], box.y + at[1]] : null;
}

/// The lines of all connections: [{ from, to, path }].
export function route(boxes, connections) {
  const lanes = [];  // lanes in use: [height of the lane, left end, right end]
  return connections.flatMap(({ from, to }) => {
    const [a, b] = [port_at(boxes, from), port_at(boxes, to)];
    if (!a || !b) return [];
    if (b[0] > a[0] + 16) return [{ from, to, path: curve(a, b) }];
    const [one, other] = [from, to].map((port) => boxes.get(owner_of(port)));
    const low = Math.max(one.y + one.h, other.y + other.h);
    const [left, right] = [b[0] - 30, a[0] + 30];
    const lane = lanes.filter(([height, x0, x1]) => height === low && x0 < right && left < x1).length;
    lanes.push([low, left, right]);
    return [{ from, to, path: around(a, b, low + 16 + LANE * lane, 22 + 7 * lane) }];
  });
}

/// The path of a connection from left to right.
export function curve([ax, ay], [bx, by]) {
  const reach = Math.max(24, Math.abs(bx - ax) / 2);
  return `M${ax} ${ay}C${ax + reach} ${ay} ${bx - reach} ${by} ${bx} ${by}`;
}

/// The path of a connection from right to left: below the boxes, with round corners.
function around([ax, ay], [bx, by], low, out) {
  const r = 9;
  return `M${ax} ${ay}H${ax + out - r}q${r} 0 ${r} ${r}V${low - r}q0 ${r} ${-r} ${r}H${bx - out + r}q${-r} 0 ${-r} ${-r}V${by + r}q0 ${-r} ${r} ${-r}H${bx}`;
}
