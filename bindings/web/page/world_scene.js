// The world in three dimensions: objects of the arena, robots, sensor rays and trails.
import * as THREE from "./lib/three/three.module.js";
import { marker_atlas, matrix_of, merge, painted_lines, robot_geometry, solids_of } from "./world_shapes.js";
import { Ghosts } from "./world_ghosts.js";
import { Trails } from "./world_trails.js";

const MOST_RAYS = 8192;
const MOST_WITH_RAYS = 8;  // with more robots, only the chosen one shows its rays
const MOST_CONTACTS = 1024;
/// The engine's name of the walls around an arena, which can't be moved.
export const BORDER = "wall";
const shaded = () => new THREE.MeshLambertMaterial({ vertexColors: THREE.VertexColors });
const hidden = new THREE.Matrix4().makeScale(0, 0, 0);

/// A texture for a round shadow or a ring, drawn below robots.
function disc_texture(paint) {
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = 128;
  paint(canvas.getContext("2d"));
  return new THREE.CanvasTexture(canvas);
}
const shadow_texture = () => disc_texture((pen) => {
  const shade = pen.createRadialGradient(64, 64, 16, 64, 64, 64);
  shade.addColorStop(0, "rgba(0,0,0,0.32)");
  shade.addColorStop(1, "rgba(0,0,0,0)");
  pen.fillStyle = shade;
  pen.fillRect(0, 0, 128, 128);
});
const ring_texture = () => disc_texture((pen) => {
  pen.lineWidth = 9;
  pen.strokeStyle = "#fff";
  pen.beginPath();
  pen.arc(64, 64, 56, 0, 2 * Math.PI);
  pen.stroke();
});

const dot_texture = () => disc_texture((pen) => {
  pen.fillStyle = "#fff";
  pen.arc(64, 64, 62, 0, 2 * Math.PI);
  pen.fill();
});

export class Scene {
  three = new THREE.Scene();
  bounds = { x0: -1, x1: 1, y0: -1, y1: 1 };
  trails = new Trails();
  ghosts = new Ghosts();
  #colors = {};
  #tints = {};  // colours of rays
  #made = [];  // objects made for this system
  #groups = [];  // robots of one model: { mesh, members }
  #solids = [];  // objects of one shape and colour: { mesh, members }
  #discs = {};

  constructor() {
    this.sky = new THREE.HemisphereLight(0xffffff, 0x8a93a5, 0.85);
    const sun = new THREE.DirectionalLight(0xffffff, 0.55);
    sun.position.set(1.5, -2.5, 4);
    this.rays = new THREE.LineSegments(new THREE.BufferGeometry(),
      new THREE.LineBasicMaterial({ vertexColors: THREE.VertexColors, transparent: true, opacity: 0.85 }));
    for (const name of ["position", "color"])
      this.rays.geometry.setAttribute(name, new THREE.BufferAttribute(new Float32Array(MOST_RAYS * 6), 3));
    this.contacts = new THREE.Points(new THREE.BufferGeometry(),
      new THREE.PointsMaterial({ map: dot_texture(), size: 8, sizeAttenuation: false, depthTest: false, transparent: true }));
    this.contacts.geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(MOST_CONTACTS * 3), 3));
    this.rays.frustumCulled = this.contacts.frustumCulled = false;
    this.contacts.renderOrder = 2;
    this.three.add(this.sky, sun, this.rays, this.contacts, this.trails.lines, this.ghosts.lines);
  }

  paint(colors) {
    this.#colors = colors;
    this.three.background = new THREE.Color(colors.background);
    this.contacts.material.color.set(colors.error);
    this.#tints = { near: new THREE.Color(colors.ray_near).toArray(), far: new THREE.Color(colors.ray).toArray() };
  }

  #add(object) {
    object.frustumCulled = false;
    this.#made.push(object);
    this.three.add(object);
    return object;
  }

  /// Builds all objects for a new layout, at their present poses.
  build({ arena = {}, robots = [], markers = [] }, now) {
    for (const object of this.#made.splice(0)) {
      this.three.remove(object);
      object.geometry.dispose();
    }
    const colors = this.#colors;
    const solids = solids_of(arena);
    this.thing_specs = arena.things ?? [];
    this.#find_bounds(arena, solids, now);
    this.#build_floor(arena, now.floor);
    this.#build_solids(solids);
    this.#build_robots(robots);
    this.#build_markers(markers);
    this.trails.reset(robots.length, colors.trails);
    this.ghosts.build(this.#groups, robots.length, colors.trails, (mesh) => this.#add(mesh));
  }

  #find_bounds(arena, solids, { things, robots }) {
    if (arena.size) {
      const [w, h] = arena.size;
      this.bounds = { x0: -w / 2, x1: w / 2, y0: -h / 2, y1: h / 2 };
      return;
    }
    const box = { x0: Infinity, x1: -Infinity, y0: Infinity, y1: -Infinity };
    const include = ({ x, y, yaw }, l, w) => {
      const [cos, sin] = [Math.abs(Math.cos(yaw)), Math.abs(Math.sin(yaw))];
      const [dx, dy] = [(l * cos + w * sin) / 2, (l * sin + w * cos) / 2];
      box.x0 = Math.min(box.x0, x - dx);
      box.x1 = Math.max(box.x1, x + dx);
      box.y0 = Math.min(box.y0, y - dy);
      box.y1 = Math.max(box.y1, y + dy);
    };
    solids.forEach(({ scale }, i) => things[i] && include(flat(things[i].pose), scale[0], scale[1]));
    robots.forEach((pose) => pose && include(pose, 0.5, 0.5));
    this.bounds = box.x0 < box.x1 ? box : { x0: -1, x1: 1, y0: -1, y1: 1 };
  }

  #build_floor(arena, image) {
    const { x0, x1, y0, y1 } = this.bounds;
    const margin = arena.size ? 0 : 1;
    const [w, h] = [x1 - x0 + 2 * margin, y1 - y0 + 2 * margin];
    const place = (mesh, z) => this.#add(mesh).position.set((x0 + x1) / 2, (y0 + y1) / 2, z);
    place(new THREE.Mesh(new THREE.PlaneBufferGeometry(w, h), new THREE.MeshBasicMaterial({ color: arena.lines?.length ? this.#colors.painted : this.#colors.floor })), -0.002);
    if (arena.floor && image) {
      const [fw, fh] = arena.floor.size;
      const material = new THREE.MeshBasicMaterial({ transparent: true });
      const picture = this.#add(new THREE.Mesh(new THREE.PlaneBufferGeometry(fw, fh), material));
      picture.visible = false;
      material.map = new THREE.TextureLoader().load(image, () => {
        picture.visible = true;
        this.on_loaded?.();
      });
      material.map.anisotropy = 8;
    }
    const step = Math.max(w, h) > 12 ? 1 : 0.1;
    const points = [];
    const line = (...numbers) => points.push(...numbers);
    for (let x = Math.ceil((x0 - margin) / step); x * step <= x1 + margin + 1e-9; ++x) line(x * step, y0 - margin, 0, x * step, y1 + margin, 0);
    for (let y = Math.ceil((y0 - margin) / step); y * step <= y1 + margin + 1e-9; ++y) line(x0 - margin, y * step, 0, x1 + margin, y * step, 0);
    const grid = new THREE.BufferGeometry().setAttribute("position", new THREE.Float32BufferAttribute(points, 3));
    this.#add(new THREE.LineSegments(grid, new THREE.LineBasicMaterial({ color: this.#colors.grid })))
      .visible = !(arena.floor && image) && !arena.lines?.length;
    if (arena.lines?.length) this.#add(new THREE.Mesh(painted_lines(arena.lines), new THREE.MeshBasicMaterial({ vertexColors: THREE.VertexColors })));
  }

  #build_solids(solids) {
    const kinds = new Map();
    solids.forEach((solid, index) => {
      const key = `${solid.geometry.uuid} ${solid.color}`;
      if (!kinds.has(key)) kinds.set(key, []);
      kinds.get(key).push({ ...solid, index, placed: null });
    });
    this.#solids = [...kinds.values()].map((members) => {
      const material = new THREE.MeshLambertMaterial({ color: members[0].color });
      return { members, mesh: this.#add(new THREE.InstancedMesh(members[0].geometry.clone(), material, members.length)) };
    });
  }

  #build_robots(robots) {
    const kinds = new Map();
    robots.forEach((robot, index) => {
      const { name, ...looks } = robot;
      const color = this.#colors.trails[index % this.#colors.trails.length];
      const key = JSON.stringify([looks, color]);
      if (!kinds.has(key)) kinds.set(key, []);
      kinds.get(key).push({ robot, index, color });
    });
    this.#groups = [...kinds.values()].map((members) => ({ members,
      mesh: this.#add(new THREE.InstancedMesh(robot_geometry(members[0].robot, { ...this.#colors, arrow: members[0].color }), shaded(), members.length)) }));
    const disc = (texture, color, z) => {
      const material = new THREE.MeshBasicMaterial({ map: texture, color, transparent: true, depthWrite: false });
      const mesh = this.#add(new THREE.InstancedMesh(new THREE.PlaneBufferGeometry(1, 1).translate(0, 0, z), material, Math.max(1, robots.length)));
      mesh.renderOrder = 1;
      return mesh;
    };
    this.#discs = {
      shadow: disc(shadow_texture(), 0xffffff, 0.001),
      chosen: disc(ring_texture(), this.#colors.accent, 0.0015),
      touching: disc(ring_texture(), this.#colors.error, 0.002),
    };
    this.sizes = robots.map(({ hull }) => Math.hypot(hull.size[0], hull.size[1]));
  }

  #build_markers(markers) {
    this.marker_specs = markers;
    this.marker_mesh = null;
    if (markers.length === 0) return;
    const { texture, places } = marker_atlas(markers);
    const uv = places.flatMap(([u0, v0, u1, v1]) => [u0, v0, u1, v0, u1, v1, u0, v1]);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(markers.length * 12), 3));
    geometry.setAttribute("uv", new THREE.Float32BufferAttribute(uv, 2));
    geometry.setIndex(markers.flatMap((_, i) => [0, 1, 2, 0, 2, 3].map((k) => 4 * i + k)));
    texture.magFilter = THREE.NearestFilter;
    this.marker_mesh = this.#add(new THREE.Mesh(geometry, new THREE.MeshBasicMaterial({ map: texture, side: THREE.DoubleSide })));
  }

  /// Moves all objects to their present poses. `chosen`: the index of a robot.
  update({ robots, things, markers, rays }, { chosen, shows_rays, carried }) {
    const at = (index) => (carried?.kind === "robot" && carried.index === index ? { ...robots[index], ...carried.pose } : robots[index]);
    for (const { mesh, members } of this.#groups) {
      members.forEach(({ index }, i) => mesh.setMatrixAt(i, at(index) ? matrix_of(at(index), undefined, scratch) : hidden));
      mesh.instanceMatrix.needsUpdate = true;
    }
    const lay = (mesh, scale, when) => {
      const { array } = mesh.instanceMatrix;
      array.fill(0);
      for (let i = 0; i < mesh.count; ++i) {
        const pose = at(i);
        if (!pose || !when(i, pose)) continue;
        array[16 * i] = array[16 * i + 5] = array[16 * i + 10] = this.sizes[i] * scale;
        array[16 * i + 12] = pose.x;
        array[16 * i + 13] = pose.y;
        array[16 * i + 15] = 1;
      }
      mesh.instanceMatrix.needsUpdate = true;
    };
    lay(this.#discs.shadow, 1.45, () => true);
    this.#discs.chosen.visible = chosen !== null;
    this.#discs.touching.visible = robots.some((each) => each?.collided);
    if (this.#discs.chosen.visible) lay(this.#discs.chosen, 1.5, (i) => i === chosen);
    if (this.#discs.touching.visible) lay(this.#discs.touching, 1.25, (_, pose) => pose.collided);
    this.#move_solids(things, carried);
    this.#update_markers(markers, carried);
    const seen = robots.length > MOST_WITH_RAYS ? rays[chosen] ?? [] : rays.flat();
    this.#update_rays(shows_rays ? seen : []);
    this.#update_contacts(robots.flatMap((each) => each?.contacts ?? []));
  }

  /// Most things stand still, so only those that have moved are updated.
  #move_solids(things, carried) {
    for (const { mesh, members } of this.#solids) {
      members.forEach((each, i) => {
        const now = carried?.kind === "thing" && carried.index === each.index ? carried.pose : things[each.index];
        if (each.placed === now) return;
        each.placed = now;
        mesh.setMatrixAt(i, now ? matrix_of(this.thing_pose(things, each.index, carried), each.scale, scratch) : hidden);
        mesh.instanceMatrix.needsUpdate = true;
      });
    }
  }

  /// The pose of a thing: { x, y, z, yaw, pitch, roll }; undefined if unknown.
  thing_pose(things, i, carried) {
    const pose = flat(things[i]?.pose);
    return pose && carried?.kind === "thing" && carried.index === i ? { ...pose, ...carried.pose } : pose;
  }

  /// The pose of a marker: { x, y, z, yaw }.
  marker_pose(markers, i, carried) {
    const pose = flat(markers[i]?.pose) ?? { x: 0, y: 0, z: -1, yaw: 0 };
    return carried?.kind === "marker" && carried.index === i ? { ...pose, ...carried.pose } : pose;
  }

  #update_markers(markers, carried) {
    if (!this.marker_mesh) return;
    const { position } = this.marker_mesh.geometry.attributes;
    this.marker_specs.forEach(({ size }, i) => {
      matrix_of(this.marker_pose(markers, i, carried), undefined, scratch);
      const half = size * 0.625;  // half of the marker with its white border
      [[1, -1], [-1, -1], [-1, 1], [1, 1]].forEach(([y, z], k) => {
        corner.set(0, -y * half, z * half).applyMatrix4(scratch);
        position.setXYZ(4 * i + k, corner.x, corner.y, corner.z);
      });
    });
    position.needsUpdate = true;
  }

  /// Draws the points where robots touch something.
  #update_contacts(points) {
    const { position } = this.contacts.geometry.attributes;
    const count = Math.min(points.length, MOST_CONTACTS);
    for (let i = 0; i < count; ++i) position.setXYZ(i, points[i].x, points[i].y, points[i].z);
    this.contacts.geometry.setDrawRange(0, count);
    this.contacts.visible = count > 0;
    this.contact_count = count;
    position.needsUpdate = count > 0;
  }

  #update_rays(rays) {
    const { position, color } = this.rays.geometry.attributes;
    const count = Math.min(rays.length, MOST_RAYS);
    for (let i = 0; i < count; ++i) {
      const { from, to, hit } = rays[i];
      const tint = hit ? this.#tints.near : this.#tints.far;
      position.array.set([from.x, from.y, from.z, to.x, to.y, to.z], 6 * i);
      color.array.set([...tint, ...tint], 6 * i);
    }
    for (const attribute of [position, color]) attribute.updateRange = { offset: 0, count: 6 * count };
    this.rays.geometry.setDrawRange(0, 2 * count);
    position.needsUpdate = color.needsUpdate = true;
  }
}

const scratch = new THREE.Matrix4();
const corner = new THREE.Vector3();

/// A Pose3D of the engine as { x, y, z, yaw, pitch, roll }.
function flat(pose) {
  if (!pose) return undefined;
  const { position, orientation } = pose;
  return { ...position, yaw: orientation.y, pitch: orientation.p, roll: orientation.r };
}
