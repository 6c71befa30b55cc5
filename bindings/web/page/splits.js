// The borders between the groups of views. They can be dragged, moved with arrow keys, and reset with a double click.
import { el } from "./dom.js";
import { T } from "./texts.js";

const STEP = 24;  // px for each press of an arrow key
const LEAST = 90;  // px, smallest size of a group

/// Makes the borders of `main`. They set its style properties --dock (height of the dock) and --side (width of the side),
/// which this browser keeps. `moved(name)` is called when a person has moved a border.
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
