// Draws the robots and trails of another branch of the run in pale colours.
import * as THREE from "./lib/three/three.module.js";
import { matrix_of } from "./world_shapes.js";

const PALE = 0.3;
const LONGEST = 0.5;  // m between two rows; a longer way is a teleport
const hidden = new THREE.Matrix4().makeScale(0, 0, 0);
const scratch = new THREE.Matrix4();

export class Ghosts {
  lines = new THREE.LineSegments(new THREE.BufferGeometry(),
    new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors, transparent: true, opacity: PALE }));
  count = 0;  // number of robots
  #meshes = [];  // { mesh, members } of each kind of robot
  #tints = [];

  constructor() {
    this.lines.frustumCulled = false;
    this.lines.visible = false;
  }

  /// `groups`: the robots of each model; `add(mesh)` adds to the scene.
  build(groups, count, palette, add) {
    const material = new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors, transparent: true, opacity: PALE, depthWrite: false });
    this.#tints = Array.from({ length: count }, (_, i) => new THREE.Color(palette[i % palette.length]).toArray());
    this.#meshes = groups.map(({ mesh, members }) => ({ members, mesh: add(new THREE.InstancedMesh(mesh.geometry.clone(), material, members.length)) }));
    for (const { mesh } of this.#meshes) mesh.visible = false;
  }

  /// Draws the trails of the robots in these rows, from a time [s] on.
  draw_ways(rows, from) {
    const points = [];
    const colors = [];
    for (let k = 1; k < rows.length; ++k) {
      const [before, now] = [rows[k - 1], rows[k]];
      if (before[0] < from - 1e-9) continue;
      for (let i = 1; i + 2 < now.length && i + 2 < before.length; i += 3) {
        if (Math.hypot(now[i] - before[i], now[i + 1] - before[i + 1]) > LONGEST) continue;
        points.push(before[i], before[i + 1], 0.002, now[i], now[i + 1], 0.002);
        const tint = this.#tints[(i - 1) / 3] ?? [0.5, 0.5, 0.5];
        colors.push(...tint, ...tint);
      }
    }
    const { geometry } = this.lines;
    geometry.dispose();
    geometry.setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    geometry.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
    this.lines.visible = points.length > 0;
  }

  /// Draws the robots at these poses; without poses, draws none.
  place(poses = []) {
    this.count = 0;
    for (const { mesh, members } of this.#meshes) {
      mesh.visible = poses.length > 0;
      members.forEach(({ index }, i) => {
        if (poses[index]) ++this.count;
        mesh.setMatrixAt(i, poses[index] ? matrix_of({ ...poses[index], z: 0 }, undefined, scratch) : hidden);
      });
      mesh.instanceMatrix.needsUpdate = true;
    }
  }
}
