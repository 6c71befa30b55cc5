// The time line of a simulation: a slider over what has happened, and the branches.
import { at_most_every, el } from "./dom.js";
import { T } from "./texts.js";

export function make_timeline({ model, acts }) {
  const slider = el("input", { type: "range", class: "acts", min: 0, max: 0, step: 0.01, value: 0, "aria-label": T.past.time });
  const told = el("output", { class: "told" });
  const branch = el("select", { class: "acts", "aria-label": T.past.branch, title: T.past.branch, hidden: true });
  const sign = el("span", { class: "is-past", text: T.past.is_past, title: T.past.hint, hidden: true });
  const now = el("button", { class: "acts quiet", text: T.past.now, title: T.past.now_hint, hidden: true });
  const node = el("div", { class: "timeline not-real", role: "group", "aria-label": T.past.label }, slider, told, sign, now, branch);
  let held = false;  // a person moves the slider

  const past = () => model.system?.past;
  const name = () => past()?.branches[past().branch].name ?? "";
  const end = () => (past()?.is_past ? past().branches[past().branch].ends : model.frame.time);
  const seconds = (time) => T.time.seconds(time.toFixed(2));

  const show = at_most_every(100, () => {
    const at = held ? Number(slider.value) : model.frame.time;
    slider.max = Math.max(end(), at);
    slider.step = 1 / (model.system?.rate ?? 100);
    if (!held) slider.value = at;
    told.textContent = T.past.of(seconds(at), seconds(end()));
    slider.setAttribute("aria-valuetext", told.textContent);
  });
  slider.oninput = () => {
    held = true;
    show();
  };
  slider.onchange = async () => {
    await acts.seek(name(), Math.round(Number(slider.value) * model.system.rate));
    held = false;
    show();
  };
  branch.onchange = () => acts.seek(branch.value);
  now.onclick = () => acts.seek(name());
  model.on("frame", show);
  model.on("system", () => {
    if (!past()) return;
    sign.hidden = now.hidden = !past().is_past;
    branch.hidden = past().branches.length < 2;
    branch.replaceChildren(...past().branches.map((each) => el("option", { value: each.name, text: each.name })));
    branch.value = name();
    show();
  });
  show();
  return node;
}
