// RTCs of other programs in the diagram: their boxes, and the connections between them.
import { split_port } from "./port_name.js";

const PREFIX = "rtm:";
const key_of = ({ from, to }) => `${from} ${to}`;

export const is_rtc = (name) => name.startsWith(PREFIX);
/// The name of an RTC without "rtm:", as requests to RTCs need it.
export const without_prefix = (name) => name.slice(PREFIX.length);

/// A system file may use several names for an RTC. Returns the name that the diagram uses: short if the RTC is on this
/// computer.
function known_name(name, boxes, context) {
  if (!is_rtc(name)) return name;
  const own = `${PREFIX}${context}/`;
  if (context && name.startsWith(own)) name = PREFIX + name.slice(own.length);
  if (boxes.has(name) || name.includes("/")) return name;
  const elsewhere = [...boxes.keys()].filter((each) => each.endsWith(`/${without_prefix(name)}`));
  return elsewhere.length === 1 ? elsewhere[0] : name;
}

/// { boxes, connections }: all components, and all connections { from, to, given }. `given` has the names in the system's
/// own connection; null for a connection that only the RTCs have. An RTC that a connection waits for is MISSING.
export function with_rtcs(components, system, rtcs) {
  const boxes = new Map((rtcs?.rtcs ?? []).map(({ ports, ...rest }) =>
    [rest.name, { kind: "rtc", ...rest, ports: ports.map((port) => ({ doc: "", waits: false, ...port })) }]));
  const types = new Map(components.flatMap(({ name, ports }) => ports.map((port) => [`${name}.${port.name}`, port.type])));
  const connections = new Map();
  const add = (connection, given) => {
    const ends = ["from", "to"].map((end) => {
      const [owner, port] = split_port(connection[end]);
      return [known_name(owner, boxes, rtcs?.context ?? ""), port];
    });
    ends.forEach(([owner, port], i) => {
      if (!is_rtc(owner)) return;
      if (!boxes.has(owner)) boxes.set(owner, { kind: "rtc", name: owner, type: "", state: "MISSING", ports: [], parameters: [], sets: [] });
      const { ports } = boxes.get(owner);
      if (ports.some(({ name }) => name === port)) return;
      const type = types.get(ends[1 - i].join(".")) ?? "";
      ports.push({ name: port, way: i === 0 ? "out" : "in", type, doc: "", waits: true });
    });
    const named = { from: ends[0].join("."), to: ends[1].join(".") };
    const before = connections.get(key_of(named));
    connections.set(key_of(named), { ...named, given: before?.given ?? given });
  };
  for (const each of system.connections) add(each, each);
  for (const each of rtcs?.connections ?? []) add(each, null);
  return { boxes: [...components, ...boxes.values()], connections: [...connections.values()] };
}

/// For two ports, at least one of an RTC: whether their message types are equal. A port of ours must be exported to RTCs.
export function carries_same(rtcs, one, other) {
  const type_of = ([name, { component, type }]) => (component.kind === "rtc" ? type : rtcs?.ports[name]);
  const [a, b] = [type_of(one), type_of(other)];
  return a !== undefined && a === b;
}
