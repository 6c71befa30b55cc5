// The camera of the view: turns about a point, looks from above, follows a robot.
import * as THREE from "./lib/three/three.module.js";

const LOWEST = 0.02;  // rad above the floor
const NEAREST = 0.15;  // m
const FARTHEST = 200;

export class Eye {
  camera = new THREE.PerspectiveCamera(40, 1, 0.01, 500);
  target = new THREE.Vector3();
  distance = 3;
  azimuth = -Math.PI / 2;
  height = 0.9;  // rad above the horizon
  is_top = false;
  shows_all = false;  // no person has moved the camera since all was shown
  #size = [1, 1];
  #ray = new THREE.Raycaster();

  constructor() {
    this.camera.up.set(0, 0, 1);
  }

  resize(width, height) {
    this.#size = [width, height];
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
  }

  turn(dx, dy) {
    this.shows_all = false;
    if (this.is_top) return this.move(dx, dy);
    this.azimuth -= dx * 0.006;
    this.height = Math.min(Math.PI / 2 - 0.001, Math.max(LOWEST, this.height + dy * 0.006));
  }

  /// Moves the camera by these pixels, so that the point under the pointer stays under it.
  move(dx, dy) {
    this.shows_all = false;
    const metres = (2 * this.distance * Math.tan((this.camera.fov / 2) * (Math.PI / 180))) / this.#size[1];
    const [sin, cos] = [Math.sin(this.azimuth), Math.cos(this.azimuth)];
    const up = this.is_top ? 1 : 1 / Math.max(0.3, Math.sin(this.height));
    this.target.x += metres * (dx * sin - dy * up * cos);
    this.target.y += metres * (-dx * cos - dy * up * sin);
  }

  zoom(factor) {
    this.shows_all = false;
    this.distance = Math.min(FARTHEST, Math.max(NEAREST, this.distance * factor));
  }

  /// Shows all of this box [m].
  show({ x0, x1, y0, y1 }) {
    this.target.set((x0 + x1) / 2, (y0 + y1) / 2, 0);
    const half = Math.tan((this.camera.fov / 2) * (Math.PI / 180));
    const across = (x1 - x0) / 2 / (half * this.camera.aspect);
    const along = ((y1 - y0) / 2 / half) * (this.is_top ? 1 : 0.85);
    this.zoom((Math.max(across, along, 0.2) * 1.15 + (this.is_top ? 0 : (y1 - y0) * 0.2)) / this.distance);
    this.shows_all = true;
  }

  update() {
    const height = this.is_top ? Math.PI / 2 - 0.0005 : this.height;
    if (this.is_top) this.azimuth = -Math.PI / 2;
    const flat = Math.cos(height) * this.distance;
    this.camera.position.set(this.target.x + flat * Math.cos(this.azimuth), this.target.y + flat * Math.sin(this.azimuth),
      this.target.z + Math.sin(height) * this.distance);
    this.camera.lookAt(this.target);
    this.camera.updateMatrixWorld();
  }

  /// The viewing ray through this pixel.
  ray(x, y) {
    this.#ray.setFromCamera({ x: (2 * x) / this.#size[0] - 1, y: 1 - (2 * y) / this.#size[1] }, this.camera);
    return this.#ray.ray;
  }

  /// The point where the ray through this pixel meets the plane at height `z`, or null.
  on_floor(x, y, z = 0) {
    const { origin, direction } = this.ray(x, y);
    const t = (z - origin.z) / direction.z;
    return t > 0 ? { x: origin.x + t * direction.x, y: origin.y + t * direction.y } : null;
  }

  /// The pixel of a point, or null behind the camera.
  pixel(x, y, z) {
    point.set(x, y, z).project(this.camera);
    return point.z < 1 ? [((point.x + 1) / 2) * this.#size[0], ((1 - point.y) / 2) * this.#size[1]] : null;
  }
}
const point = new THREE.Vector3();
