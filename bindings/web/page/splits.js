// The borders between the groups of views: dragged, moved by arrow keys, put back by a double click.
import { el } from "./dom.js";
import { T } from "./texts.js";

const STEP = 24;  // px, of an arrow key
const LEAST = 90;  // px

/// Borders of `main` that set its style properties --dock (the dock's height) and --side (the width of the side), kept in
/// this browser. `moved(name)`: a person moved this one.
export function make_splits(main, moved) {
  const kept = JSON.parse(localStorage.getItem("nezumi.splits") ?? "{}");
  const make = (name, is_row) => {
    const split = el("div", { class: `split ${name}`, role: "separator", tabindex: 0, title: T.splits.hint, "aria-label": T.splits[name],
      "aria-orientation": is_row ? "horizontal" : "vertical" });
    const most = () => (is_row ? main.clientHeight : main.clientWidth) - 2 * LEAST;
    const size = () => {
      const group = main.querySelector(`.group.${name}`).getBoundingClientRect();
      return is_row ? group.height : group.width;
    };
    const set = (pixels) => {
      if (pixels === undefined) delete kept[name];
      else kept[name] = Math.round(Math.max(LEAST, Math.min(most(), pixels)));
      main.style.setProperty(`--${name}`, kept[name] ? `${kept[name]}px` : "");
      split.setAttribute("aria-valuenow", Math.round(size()));
      localStorage.setItem("nezumi.splits", JSON.stringify(kept));
    };
    split.addEventListener("pointerdown", (event) => {
      split.setPointerCapture(event.pointerId);
      event.preventDefault();
    });
    split.addEventListener("pointermove", (event) => {
      if (!split.hasPointerCapture(event.pointerId)) return;
      const box = main.querySelector(`.group.${name}`).getBoundingClientRect();
      moved(name);
      set(is_row ? box.bottom - event.clientY - 5 : box.right - event.clientX - 5);
    });
    split.addEventListener("dblclick", () => set(undefined));
    split.addEventListener("keydown", ({ key }) => {
      const step = is_row ? { ArrowUp: STEP, ArrowDown: -STEP }[key] : { ArrowLeft: STEP, ArrowRight: -STEP }[key];
      if (!step) return;
      moved(name);
      set(size() + step);
    });
    if (kept[name]) main.style.setProperty(`--${name}`, `${kept[name]}px`);
    return split;
  };
  main.append(make("dock", true), make("side", false));
}
