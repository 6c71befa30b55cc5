// The history of each branch of the run that the engine remembers: marks, and poses of robots and things.
import { Emitter } from "./emitter.js";

/// Emits: track (name of a branch), when new data of the branch have arrived.
export class Tracks extends Emitter {
  #link;
  // branch: { rows: [[time, x, y, yaw, x, ...], ...], things: [[time, index, x, y, z, roll, pitch, yaw], ...],
  // marks: [{ at, kind, text }, ...] }
  #known = new Map();

  constructor({ link, model }) {
    super();
    this.#link = link;
    model.on("remembered", ({ branch, rows, things, marks }) => {
      const before = this.#known.get(branch);
      this.#known.set(branch, { rows: rows ?? before?.rows ?? [], things: things ?? before?.things ?? [], marks });
      this.emit("track", branch);
    });
    model.on("restarted", () => this.#known.clear());
  }

  /// Requests the marks of a branch. With `rows`, also the poses of robots and things.
  ask(branch, rows = false) {
    this.#link.send({ do: "remembered", branch, rows });
  }

  rows = (branch) => this.#known.get(branch)?.rows ?? [];
  marks = (branch) => this.#known.get(branch)?.marks ?? [];

  /// The poses of the things that have moved in this branch, at a time [s], by index.
  things_at(branch, time) {
    const poses = new Map();
    for (const [at, index, x, y, z, r, p, yaw] of this.#known.get(branch)?.things ?? []) {
      if (poses.has(index) && at > time + 1e-9) continue;  // the first pose of a thing is where it stood before it moved
      poses.set(index, { position: { x, y, z }, orientation: { r, p, y: yaw } });
    }
    return poses;
  }

  /// The places of robots at a time [s]: [{ x, y, yaw }, ...]; undefined if they are not known.
  at(branch, time) {
    const rows = this.rows(branch);
    let [low, high] = [0, rows.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (rows[middle][0] <= time + 1e-9) low = middle + 1;
      else high = middle;
    }
    const row = rows[Math.max(0, low - 1)];
    return row && Array.from({ length: (row.length - 1) / 3 }, (_, i) => ({ x: row[3 * i + 1], y: row[3 * i + 2], yaw: row[3 * i + 3] }));
  }
}

/// The branch that is drawn pale beside the present one: { branch, from: time [s], moves: true if its robots are drawn },
/// or null. In the past, this is the same branch, with its later part.
export function ghost_of({ branches, branch, is_past } = { branches: [] }) {
  const here = branches[branch];
  if (!here) return null;
  if (is_past) return { branch: here.name, from: 0, moves: false };
  if (branch > 0) return { branch: here.parent, from: here.left, moves: true };
  const child = branches.slice(1).reverse().find(({ parent }) => parent === here.name);
  return child ? { branch: child.name, from: child.left, moves: true } : null;
}
