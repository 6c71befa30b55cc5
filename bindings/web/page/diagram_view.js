// The drawing area of the diagram, moved and zoomed by wheel, fingers and buttons.

const CLOSEST = 2.2;
const FARTHEST = 0.08;
const READABLE = 0.75;

export class Sheet {
  #svg;
  #at = { x: 0, y: 0, scale: 1 };  // the point of the drawing area in the corner of the view, and pixels per unit
  #fingers = new Map();
  #is_fitted = true;

  constructor(svg) {
    this.#svg = svg;
    svg.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoom(Math.exp(-Math.max(-60, Math.min(60, event.deltaY)) * 0.003), event.clientX, event.clientY);
    }, { passive: false });
    svg.addEventListener("pointerdown", (event) => {
      if (event.target.closest(".port, .title, .wire")) return;
      this.#fingers.set(event.pointerId, [event.clientX, event.clientY]);
      svg.setPointerCapture(event.pointerId);
    });
    svg.addEventListener("pointermove", (event) => this.#move(event));
    for (const ended of ["pointerup", "pointercancel"]) svg.addEventListener(ended, (event) => this.#fingers.delete(event.pointerId));
    new ResizeObserver(() => (this.#is_fitted ? this.on_size?.() : this.#show())).observe(svg);
  }

  #move(event) {
    const before = this.#fingers.get(event.pointerId);
    if (!before) return;
    const now = [event.clientX, event.clientY];
    const other = [...this.#fingers].find(([id]) => id !== event.pointerId)?.[1];
    const part = other ? 0.5 : 1;
    this.#at.x -= (part * (now[0] - before[0])) / this.#at.scale;
    this.#at.y -= (part * (now[1] - before[1])) / this.#at.scale;
    this.#is_fitted = false;
    if (other) {
      const gap = (p) => Math.max(1, Math.hypot(p[0] - other[0], p[1] - other[1]));
      this.zoom(gap(now) / gap(before), other[0], other[1]);
    }
    this.#fingers.set(event.pointerId, now);
    this.#show();
  }

  #show() {
    const { clientWidth: w, clientHeight: h } = this.#svg;
    if (!w || !h) return;
    const { x, y, scale } = this.#at;
    this.#svg.setAttribute("viewBox", `${x} ${y} ${w / scale} ${h / scale}`);
  }

  /// Converts a point of the window to the drawing area.
  point({ clientX, clientY }) {
    const box = this.#svg.getBoundingClientRect();
    const { x, y, scale } = this.#at;
    return [x + (clientX - box.left) / scale, y + (clientY - box.top) / scale];
  }

  zoom(factor, clientX, clientY) {
    const box = this.#svg.getBoundingClientRect();
    const about = { clientX: clientX ?? box.left + box.width / 2, clientY: clientY ?? box.top + box.height / 2 };
    const before = this.point(about);
    this.#at.scale = Math.min(CLOSEST, Math.max(FARTHEST, this.#at.scale * factor));
    const after = this.point(about);
    this.#at.x += before[0] - after[0];
    this.#at.y += before[1] - after[1];
    this.#is_fitted = false;
    this.#show();
  }

  /// Shows all boxes. With a `centre`, names stay readable: boxes that do not fit around this box are outside of the view.
  fit(boxes, centre = null) {
    const all = [...boxes.values()];
    const { clientWidth: w, clientHeight: h } = this.#svg;
    if (all.length === 0 || !w || !h) return;
    const margin = 34;
    const [x0, y0] = [Math.min(...all.map((b) => b.x)) - margin, Math.min(...all.map((b) => b.y)) - margin];
    const [x1, y1] = [Math.max(...all.map((b) => b.x + b.w)) + margin, Math.max(...all.map((b) => b.y + b.h)) + margin + 14];
    const scale = Math.max(centre ? READABLE : 0, Math.min(1.25, w / (x1 - x0), h / (y1 - y0)));
    // If the drawing is larger than the view, the centre box is in the middle.
    const corner = (from, to, size, middle) => (to - from <= size + 1 || !centre ? (from + to - size) / 2 : Math.max(from, Math.min(to - size, middle - size / 2)));
    this.#at = { scale, x: corner(x0, x1, w / scale, centre && centre.x + centre.w / 2), y: corner(y0, y1, h / scale, centre && centre.y + centre.h / 2) };
    this.#is_fitted = true;
    this.#show();
  }
}
