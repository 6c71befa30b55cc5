// The joystick: dragged by a pointer, or moved by keys while the pad has the focus.
import { svg } from "./dom.js";
import { T } from "./texts.js";

export const RADIUS = 150;  // px, as in the tutorial's pad: half of 300
const KEYS = {
  ArrowUp: [0, 1], ArrowDown: [0, -1], ArrowLeft: [-1, 0], ArrowRight: [1, 0],
  KeyW: [0, 1], KeyS: [0, -1], KeyA: [-1, 0], KeyD: [1, 0],
};

/// `moved(x, y, held)`: the stick's offset from the centre [px], y up, at most RADIUS.
export function make_pad(moved) {
  const shaft = svg("line", { class: "shaft", x1: 0, y1: 0, x2: 0, y2: 0 });
  const knob = svg("circle", { class: "knob", r: 38 });
  const node = svg("svg", { class: "pad", viewBox: "-172 -172 344 344", tabindex: 0, role: "application", "aria-label": T.drive.label },
    svg("circle", { class: "plate", r: 170 }),
    ...[50, 100, 150].map((r) => svg("circle", { class: "scale", r })),
    svg("path", { class: "scale", d: "M-150 0H150M0-150V150" }),
    ...[0, 90, 180, 270].map((angle) => svg("path", { class: "tip", d: "M-9-153 0-163 9-153z", transform: `rotate(${angle})` })),
    shaft, knob);
  const keys = new Set();
  let pointer = null;
  let is_held = false;

  const put = (x, y, held) => {
    const far = Math.hypot(x, y);
    const fit = far > RADIUS ? RADIUS / far : 1;
    [x, y] = [x * fit, y * fit];
    is_held = held;
    knob.setAttribute("transform", `translate(${x} ${-y})`);
    shaft.setAttribute("x2", x);
    shaft.setAttribute("y2", -y);
    node.classList.toggle("held", held);
    moved(x, y, held);
  };
  const let_go = () => {
    keys.clear();
    pointer = null;
    if (is_held) put(0, 0, false);
  };
  const by_pointer = (event) => {
    const box = node.getBoundingClientRect();
    const unit = 344 / box.width;
    put((event.clientX - box.left - box.width / 2) * unit, -(event.clientY - box.top - box.height / 2) * unit, true);
  };
  const by_keys = (half) => {
    if (keys.size === 0) return put(0, 0, false);
    const sum = [0, 1].map((i) => [...keys].reduce((all, key) => all + KEYS[key][i], 0));
    const reach = half ? RADIUS / 2 : RADIUS;
    put(Math.sign(sum[0]) * reach, Math.sign(sum[1]) * reach, true);
  };

  node.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || pointer !== null) return;
    pointer = event.pointerId;
    node.setPointerCapture(pointer);
    node.focus({ preventScroll: true });
    by_pointer(event);
  });
  node.addEventListener("pointermove", (event) => event.pointerId === pointer && by_pointer(event));
  for (const ended of ["pointerup", "pointercancel", "lostpointercapture"])
    node.addEventListener(ended, (event) => event.pointerId === pointer && let_go());
  node.addEventListener("keydown", (event) => {
    if (event.key === "Escape") return let_go();
    if (!KEYS[event.code] || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    keys.add(event.code);
    by_keys(event.shiftKey);
  });
  node.addEventListener("keyup", (event) => {
    if (keys.delete(event.code)) by_keys(event.shiftKey);
  });
  node.addEventListener("blur", let_go);
  node.addEventListener("contextmenu", (event) => event.preventDefault());

  return {
    node,
    let_go,
    /// For other devices; pointer and keys have priority.
    move_to: (x, y, held) => {
      if (pointer !== null || keys.size > 0) return;
      if (held) put(x, y, true);
      else if (is_held) let_go();
    },
  };
}
