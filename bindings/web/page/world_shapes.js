// Geometry of the world's parts, merged so that a whole arena is drawn in one call.
import * as THREE from "./lib/three/three.module.js";

/// Merges parts { geometry, matrix, color } into one geometry with a colour per vertex.
export function merge(parts) {
  const positions = [];
  const normals = [];
  const colors = [];
  for (const { geometry, matrix, color } of parts) {
    const part = (geometry.index ? geometry.toNonIndexed() : geometry.clone()).applyMatrix(matrix ?? new THREE.Matrix4());
    const { r, g, b } = new THREE.Color(color);
    positions.push(...part.attributes.position.array);
    normals.push(...part.attributes.normal.array);
    for (let i = 0; i < part.attributes.position.count; ++i) colors.push(r, g, b);
  }
  const merged = new THREE.BufferGeometry();
  merged.setAttribute("position", new THREE.Float32BufferAttribute(positions, 3));
  merged.setAttribute("normal", new THREE.Float32BufferAttribute(normals, 3));
  merged.setAttribute("color", new THREE.Float32BufferAttribute(colors, 3));
  return merged;
}

/// The matrix of a pose: yaw about z, then pitch about y, then roll about x.
export function matrix_of({ x, y, z = 0, yaw = 0, pitch = 0, roll = 0 }, scale = [1, 1, 1], out = new THREE.Matrix4()) {
  euler.set(roll, pitch, yaw, "ZYX");
  return out.compose(place.set(x, y, z), turn.setFromEuler(euler), size.set(...scale));
}
const euler = new THREE.Euler();
const place = new THREE.Vector3();
const turn = new THREE.Quaternion();
const size = new THREE.Vector3();

export const unit_box = new THREE.BoxBufferGeometry(1, 1, 1);
export const unit_cylinder = new THREE.CylinderBufferGeometry(0.5, 0.5, 1, 32).rotateX(Math.PI / 2);
const wheel = new THREE.CylinderBufferGeometry(1, 1, 1, 24);  // its axis along y

/// The objects of an arena, in the engine's order: [{ geometry, scale, color }]. Their poses come with each frame.
export function solids_of(arena) {
  return (arena.things ?? []).map(({ shape, size, color }) =>
    ({ geometry: shape === "cylinder" ? unit_cylinder : unit_box, scale: size, color }));
}

/// Lines painted on the floor, slightly above it.
export function painted_lines(lines) {
  const parts = [];
  const z = 0.0008;
  for (const { points, width, color } of lines) {
    points.forEach(([x, y], i) => {
      parts.push({ color, geometry: new THREE.CircleBufferGeometry(width / 2, 20), matrix: matrix_of({ x, y, z }) });
      if (i === 0) return;
      const [px, py] = points[i - 1];
      parts.push({ color, geometry: new THREE.PlaneBufferGeometry(1, 1), matrix: matrix_of(
        { x: (x + px) / 2, y: (y + py) / 2, z, yaw: Math.atan2(y - py, x - px) }, [Math.hypot(x - px, y - py), width, 1]) });
    });
  }
  return merge(parts);
}

/// The geometry of a robot: hull, wheels, and a plate with an arrow for its heading.
export function robot_geometry({ hull, wheels, sensors = [] }, colors) {
  const [l, w, h] = hull.size;
  const [x, y, z] = hull.at;
  const parts = [];
  const is_round = hull.shape === "cylinder";
  parts.push({ geometry: is_round ? unit_cylinder : rounded_box(l, w, h), color: colors.hull,
    matrix: matrix_of({ x, y, z }, is_round ? [l, l, h] : [1, 1, 1]) });
  const top = z + h / 2;
  const arrow = new THREE.Shape();
  const [ax, ay] = [Math.min(l, w) * 0.3, Math.min(l, w) * 0.24];
  arrow.moveTo(ax * 1.15, 0).lineTo(-ax * 0.75, ay).lineTo(-ax * 0.35, 0).lineTo(-ax * 0.75, -ay);
  parts.push({ geometry: new THREE.ShapeBufferGeometry(arrow), color: colors.arrow, matrix: matrix_of({ x: x + l * 0.1, y, z: top + 0.001 }) });
  for (const side of wheels ? [1, -1] : []) {
    const { radius, track } = wheels;
    parts.push({ geometry: wheel, color: colors.wheel, matrix: matrix_of({ x: 0, y: (side * track) / 2, z: radius }, [radius, radius * 0.35, radius]) });
  }
  for (const { kind, at, yaw = 0 } of sensors) {
    if ((kind !== "range" && kind !== "scan") || !at) continue;
    parts.push({ geometry: unit_box, color: colors.sensor, matrix: matrix_of({ x: at[0], y: at[1], z: at[2], yaw }, [0.008, 0.008, 0.008]) });
  }
  return merge(parts);
}

function rounded_box(l, w, h) {
  const bevel = Math.min(l, w, h) * 0.12;
  const [a, b] = [l / 2 - bevel, w / 2 - bevel];
  const outline = new THREE.Shape();
  outline.moveTo(-a, -b).lineTo(a, -b).lineTo(a, b).lineTo(-a, b).lineTo(-a, -b);
  const geometry = new THREE.ExtrudeBufferGeometry(outline,
    { depth: h - 2 * bevel, bevelEnabled: true, bevelSize: bevel, bevelThickness: bevel, bevelSegments: 3 });
  return geometry.translate(0, 0, -(h - 2 * bevel) / 2);
}

/// One texture with all markers, and the area of each marker in it: [u0, v0, u1, v1].
export function marker_atlas(markers) {
  const columns = Math.ceil(Math.sqrt(markers.length)) || 1;
  const cell = 64;
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = columns * cell;
  const pen = canvas.getContext("2d");
  const places = markers.map(({ id, modules }, i) => {
    const [x, y] = [(i % columns) * cell, Math.floor(i / columns) * cell];
    pen.fillStyle = "#fff";
    pen.fillRect(x, y, cell, cell);
    pen.fillStyle = "#111";
    const unit = cell / 10;
    pen.fillRect(x + unit, y + unit, 8 * unit, 8 * unit);
    pen.fillStyle = "#fff";
    if (modules) {
      modules.forEach((row, r) => [...row].forEach((bit, c) =>
        bit === "1" && pen.fillRect(x + (c + 1) * unit, y + (r + 1) * unit, unit, unit)));
    } else {
      pen.font = `bold ${cell / 2.4}px sans-serif`;
      pen.textAlign = "center";
      pen.textBaseline = "middle";
      pen.fillText(String(id), x + cell / 2, y + cell / 2);
    }
    const n = columns * cell;
    return [x / n, 1 - (y + cell) / n, (x + cell) / n, 1 - y / n];
  });
  return { texture: new THREE.CanvasTexture(canvas), places };
}
