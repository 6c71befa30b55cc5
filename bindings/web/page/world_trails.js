// Trails of robots: the latest segments of their paths, in one drawing.
import * as THREE from "./lib/three/three.module.js";

const MOST = 40000;  // segments of all robots
const EACH = 600;  // segments per robot
const STEP = 0.008;  // m per segment
const FASTEST = 2;  // m/s; a robot that is faster was teleported
const LONGEST = 2;  // s between updates; after a longer gap the path is unknown

/// A ring buffer of segments: a new one replaces the oldest, so only new data are uploaded.
export class Trails {
  lines = new THREE.LineSegments(new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors, transparent: true, opacity: 0.75 }));
  #ends = [];  // the last point of each robot's path
  #time = 0;
  #tints = [];
  #room = 0;
  #count = 0;  // segments since the start
  #drawn = 0;

  constructor() {
    this.lines.frustumCulled = false;
  }

  reset(count, palette) {
    this.#tints = Array.from({ length: count }, (_, i) => new THREE.Color(palette[i % palette.length]).toArray());
    this.#room = Math.min(MOST, EACH * count);
    const { geometry } = this.lines;
    geometry.dispose();
    for (const name of ["position", "color"])
      geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(this.#room * 6), 3));
    this.forget();
  }

  forget() {
    this.#ends = this.#tints.map(() => null);
    this.#count = this.#drawn = 0;
    this.lines.geometry.setDrawRange(0, 0);
  }

  /// Adds the robots' positions at a time [s].
  follow(robots, time) {
    const passed = time - this.#time;
    const farthest = passed < LONGEST ? 2 * STEP + FASTEST * passed : 0;
    this.#time = time;
    this.#ends.forEach((end, i) => {
      const pose = robots[i];
      if (!pose) return;
      const far = end ? Math.hypot(pose.x - end[0], pose.y - end[1]) : Infinity;
      if (far < STEP) return;
      if (far < farthest) this.#add(end, pose, this.#tints[i]);
      this.#ends[i] = [pose.x, pose.y];
    });
  }

  #add([x, y], to, tint) {
    const { position, color } = this.lines.geometry.attributes;
    const first = (this.#count++ % this.#room) * 6;
    position.array.set([x, y, 0.003, to.x, to.y, 0.003], first);
    color.array.set([...tint, ...tint], first);
  }

  draw() {
    const fresh = this.#count - this.#drawn;
    if (fresh === 0) return;
    const begin = this.#drawn % this.#room;
    const range = begin + fresh <= this.#room ? { offset: begin * 6, count: fresh * 6 } : { offset: 0, count: -1 };
    for (const attribute of Object.values(this.lines.geometry.attributes)) {
      attribute.updateRange = { ...range };  // set again, because the renderer resets it
      attribute.needsUpdate = true;
    }
    this.lines.geometry.setDrawRange(0, 2 * Math.min(this.#count, this.#room));
    this.#drawn = this.#count;
  }
}
