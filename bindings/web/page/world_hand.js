// Pointer and key input on the world: turns and moves the camera, or drags a robot or a marker.
import { BORDER } from "./world_scene.js";

const CLICK = 5;  // px: a shorter movement is a click
const NUDGE = 0.02;  // m
const TURN = Math.PI / 36;
const EDGE = 0.01;  // m added around thin objects to make them easier to pick
const REACH = 14;  // px added around small objects to make them easier to pick

/// `asks`: { eye, scene, model, may_act(), choose(kind, index), carry(kind, index, pose), drop(), changed(), chosen()
/// }.
export function put_hands_on(canvas, asks) {
  const { eye, scene, model } = asks;
  const pointers = new Map();
  let carried = null;  // { kind, index, dx, dy, z, pose }
  let moved = 0;

  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };

  /// The object nearest to the camera at this pixel: { kind, index, pose }.
  function pick(x, y) {
    let best = null;
    const look_at = (kind, index, pose, z, radius) => {
      const pixel = eye.pixel(pose.x, pose.y, z);
      if (!pixel) return;
      const rim = eye.pixel(pose.x + radius * Math.sin(eye.azimuth), pose.y - radius * Math.cos(eye.azimuth), z) ?? pixel;
      const reach = Math.max(REACH, Math.hypot(rim[0] - pixel[0], rim[1] - pixel[1]));
      const away = Math.hypot(x - pixel[0], y - pixel[1]) / reach;
      if (away < 1 && (!best || away < best.away)) best = { kind, index, pose, z, away };
    };
    model.robots.forEach((pose, i) => pose && look_at("robot", i, pose, 0.03, (scene.sizes[i] ?? 0.1) / 2));
    (scene.marker_specs ?? []).forEach(({ size }, i) => {
      const pose = scene.marker_pose(model.markers, i);
      look_at("marker", i, pose, pose.z, size / 2);
    });
    return best ?? pick_thing(x, y);
  }

  /// The box or cylinder whose top or middle is at this pixel, assuming that it is upright.
  function pick_thing(x, y) {
    let best = null;
    (scene.thing_specs ?? []).forEach(({ name, size }, i) => {
      const pose = name !== BORDER && scene.thing_pose(model.things, i);
      if (!pose) return;
      for (const z of [pose.z + size[2] / 2, pose.z]) {
        const at = eye.on_floor(x, y, z);
        if (!at || (best && z <= best.z)) continue;
        const [dx, dy] = [at.x - pose.x, at.y - pose.y];
        const [cos, sin] = [Math.cos(pose.yaw), Math.sin(pose.yaw)];
        const is_within = Math.abs(dx * cos + dy * sin) <= size[0] / 2 + EDGE && Math.abs(dy * cos - dx * sin) <= size[1] / 2 + EDGE;
        if (is_within) best = { kind: "thing", index: i, pose, z };
      }
    });
    return best;
  }

  canvas.addEventListener("pointerdown", (event) => {
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    const [x, y] = place(event);
    pointers.set(event.pointerId, { x, y });
    moved = 0;
    if (pointers.size > 1) {
      carried = null;
      asks.carry(null);
      return;
    }
    const hit = event.button === 0 && !event.shiftKey ? pick(x, y) : null;
    if (!hit) return;
    asks.choose(hit.kind, hit.index);
    const on_floor = eye.on_floor(x, y, hit.z);
    if (asks.may_move(hit.kind) && on_floor)
      carried = { ...hit, dx: hit.pose.x - on_floor.x, dy: hit.pose.y - on_floor.y };
  });

  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = place(event);
    const before = pointers.get(event.pointerId);
    if (!before) {
      canvas.classList.toggle("pointing", pick(x, y) !== null);
      return;
    }
    const [dx, dy] = [x - before.x, y - before.y];
    moved += Math.abs(dx) + Math.abs(dy);
    if (pointers.size === 2) two_fingers(event.pointerId, x, y);
    else if (carried && moved > CLICK) {
      const at = eye.on_floor(x, y, carried.z);
      if (at) asks.carry(carried.kind, carried.index, { x: at.x + carried.dx, y: at.y + carried.dy });
    } else if (!carried) {
      if (event.buttons & 6 || event.shiftKey) eye.move(dx, dy);
      else eye.turn(dx, dy);
    }
    Object.assign(before, { x, y });
    asks.changed();
  });

  function two_fingers(id, x, y) {
    const other = [...pointers].find(([each]) => each !== id)[1];
    const before = pointers.get(id);
    const gap = (p) => Math.hypot(p.x - other.x, p.y - other.y);
    eye.zoom(gap(before) / Math.max(1, gap({ x, y })));
    eye.move((x - before.x) / 2, (y - before.y) / 2);
  }

  const up = (event) => {
    if (!pointers.delete(event.pointerId)) return;
    if (carried && moved > CLICK && event.type === "pointerup") asks.drop();
    else if (carried) asks.carry(null);
    else if (moved <= CLICK && event.type === "pointerup" && event.button === 0 && !pick(...place(event))) asks.choose(null);
    carried = null;
  };
  canvas.addEventListener("pointerup", up);
  canvas.addEventListener("pointercancel", up);
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    eye.zoom(Math.exp(Math.max(-60, Math.min(60, event.deltaY)) * 0.003));
    asks.changed();
  }, { passive: false });

  canvas.addEventListener("keydown", (event) => {
    const chosen = asks.chosen();
    const arrows = { ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] }[event.key];
    const turn = { "[": TURN, "]": -TURN }[event.key];
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "+" || event.key === "=") eye.zoom(0.85);
    else if (event.key === "-") eye.zoom(1 / 0.85);
    else if (event.key === "Escape") asks.choose(null);
    else if ((arrows || turn) && chosen && asks.may_move(chosen.kind)) asks.nudge(arrows ? arrows.map((step) => step * NUDGE) : [0, 0], turn ?? 0);
    else if (arrows) eye.is_top ? eye.move(-arrows[0] * 30, arrows[1] * 30) : eye.turn(-arrows[0] * 20, arrows[1] * 20);
    else return;
    event.preventDefault();
    asks.changed();
  });
}
