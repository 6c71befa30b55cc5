// Where robots were: the last seconds of each, in one drawing.
import * as THREE from "/lib/three/three.module.js";

const MOST_POINTS = 40000;  // of all together
const LONGEST = 600;  // points of one
const STEP = 0.008;  // m between two points

export class Trails {
  lines = new THREE.LineSegments(new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors, transparent: true, opacity: 0.75 }));
  #of = [];
  #length = LONGEST;

  constructor() {
    this.lines.frustumCulled = false;
  }

  reset(count, palette) {
    this.#length = Math.max(2, Math.min(LONGEST, Math.floor(MOST_POINTS / Math.max(1, count))));
    this.#of = Array.from({ length: count }, () => ({ points: [], is_changed: true }));
    const room = count * this.#length * 2 * 3;
    const { geometry } = this.lines;
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(room), 3));
    const color = new THREE.BufferAttribute(new Float32Array(room), 3);
    for (let i = 0; i < count; ++i) {
      const tint = new THREE.Color(palette[i % palette.length]);
      for (let k = 0; k < 2 * this.#length; ++k) color.setXYZ(i * 2 * this.#length + k, tint.r, tint.g, tint.b);
    }
    geometry.setAttribute("color", color);
  }

  forget() {
    for (const each of this.#of) Object.assign(each, { points: [], is_changed: true });
  }

  /// Takes where the robots are now. Returns whether anything is longer.
  follow(robots) {
    let is_longer = false;
    this.#of.forEach((trail, i) => {
      const pose = robots[i];
      if (!pose) return;
      const last = trail.points[trail.points.length - 1];
      const far = last ? Math.hypot(pose.x - last[0], pose.y - last[1]) : Infinity;
      if (far < STEP) return;
      if (last && far > 0.25) trail.points.length = 0;  // put elsewhere
      trail.points.push([pose.x, pose.y]);
      if (trail.points.length > this.#length) trail.points.shift();
      trail.is_changed = is_longer = true;
    });
    return is_longer;
  }

  draw() {
    const { position } = this.lines.geometry.attributes;
    if (!position) return;
    this.#of.forEach((trail, i) => {
      if (!trail.is_changed) return;
      trail.is_changed = false;
      const first = i * 2 * this.#length;
      for (let k = 0; k < this.#length; ++k) {
        const [a, b] = [trail.points[k - 1], trail.points[k]];
        const [ax, ay] = a && b ? a : [0, 0];
        const [bx, by] = a && b ? b : [0, 0];
        position.setXYZ(first + 2 * k, ax, ay, 0.003);
        position.setXYZ(first + 2 * k + 1, bx, by, 0.003);
      }
      position.needsUpdate = true;
    });
  }
}
