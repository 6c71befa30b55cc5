// Other hosts in the diagram: each of their components is a box with all ports that it offers.
import { split_port } from "./port_name.js";

/// The components of the system and of other hosts. A port `waits` if its host is missing or has no port of this name.
export function with_hosts({ components, hosts }) {
  const boxes = new Map();
  const box_of = (name, host) => {
    if (!boxes.has(name))
      boxes.set(name, { name, kind: "remote", type: "", state: "REMOTE", host, ports: [], parameters: [], sets: [] });
    return boxes.get(name);
  };
  for (const host of hosts) {
    for (const { name, ...port } of host.ports) {
      const [component, own] = split_port(name);
      box_of(`${host.name}/${component}`, host).ports.push({ name: own, doc: "", waits: false, ...port });
    }
  }
  const own = [];
  for (const each of components) {
    const host = each.type === "RemoteComponent" && hosts.find(({ name }) => each.name.startsWith(`${name}/`));
    if (!host) {
      own.push(each);
      continue;
    }
    const box = box_of(each.name, host);
    const offered = new Set(box.ports.map(({ name }) => name));
    for (const port of each.ports) if (!offered.has(port.name)) box.ports.push({ ...port, waits: true });
  }
  return [...own, ...[...boxes.values()].filter(({ ports }) => ports.length > 0)];
}
