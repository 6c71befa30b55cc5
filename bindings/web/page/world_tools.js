// The tools of the world's view: they choose the selected object and what is shown, and edit the arena.
import { at_most_every, el } from "./dom.js";
import { T } from "./texts.js";
import { BORDER } from "./world_scene.js";

const toggle = (text, is_on, set) => {
  const button = el("button", { class: "toggle", "aria-pressed": is_on, text });
  button.onclick = () => {
    const next = button.getAttribute("aria-pressed") !== "true";
    button.setAttribute("aria-pressed", next);
    set(next);
  };
  return button;
};

/// The button that starts editing the arena, and the tools for this, which are loaded at the first use.
function make_arena_tools(world, parts) {
  const place = el("div", {});
  const button = toggle(T.arena.edit, false, async (is_on) => {
    if (!world.arena) {
      const { ArenaEdit } = await import("./arena_edit.js");
      world.arena ??= new ArenaEdit(parts, world);
      place.replaceChildren(world.arena.node);
    }
    world.arena.set(is_on);
  });
  button.classList.add("acts", "not-real");
  button.title = T.arena.edit_hint;
  world.canvas.addEventListener("keydown", (event) => {
    if (!world.arena?.is_on || event.key !== "Delete") return;
    world.arena.remove();
    event.preventDefault();
  });
  // Ctrl-Z works with any focus, except in a text field, which has its own undo.
  addEventListener("keydown", (event) => {
    const is_undo = event.key === "z" && (event.ctrlKey || event.metaKey);
    if (!is_undo || !world.arena?.is_on || !world.canvas.offsetParent || event.target.closest?.("input, textarea, .CodeMirror")) return;
    world.arena.undo();
    event.preventDefault();
  });
  return [button, place];
}

export function make_tools(world, parts) {
  const { model } = parts;
  const top = toggle(T.world.top, false, (is_on) => {
    world.eye.is_top = is_on;
    if (!world.follows) world.whole();
  });
  const follow = toggle(T.world.follow, false, (is_on) => {
    world.follows = is_on;
    if (is_on && world.chosen?.kind !== "robot") world.choose("robot", 0);
    world.draw();
  });
  const select = el("select", { "aria-label": T.world.select, onchange: () => {
    const [kind, index] = select.value.split(" ");
    world.choose(kind || null, Number(index));
  } });
  const readout = el("output", { class: "readout" });
  world.on_chosen = () => {
    select.value = world.chosen ? `${world.chosen.kind} ${world.chosen.index}` : "";
    follow.setAttribute("aria-pressed", world.follows);
    show();
  };
  world.on_layout = () => {
    const { robots, markers, arena } = model.system;
    const options = (kind, all) => all.map(({ name }, i) => name !== BORDER && el("option", { value: `${kind} ${i}`, text: name })).filter(Boolean);
    select.replaceChildren(el("option", { value: "", text: T.world.none }), ...options("robot", robots), ...options("marker", markers),
      ...options("thing", arena.things));
    world.on_chosen();
  };
  const show = at_most_every(100, () => {
    const pose = world.chosen && world.pose_of(world.chosen);
    const fixed = (value, digits) => value.toFixed(digits).replace(/^-(0\.0+)$/, "$1");
    readout.textContent = pose
      ? T.world.pose(fixed(pose.x, 3), fixed(pose.y, 3), fixed((pose.yaw * 180) / Math.PI, 1)) + (pose.collided ? `  ${T.world.touching(pose.touches)}` : "")
      : "";
  });
  model.on("frame", show);
  model.on("looked", show);
  const [edit, edit_tools] = make_arena_tools(world, parts);
  return [
    el("div", { class: "tools", role: "toolbar", "aria-label": T.views.world }, select, follow, top,
      el("button", { text: T.world.whole, title: T.world.whole_hint, onclick: () => world.whole() }),
      ...["rays", "trails", "names"].map((each) => toggle(T.world[each], world.shows[each], (is_on) => world.set(each, is_on))), edit),
    edit_tools, readout,
  ];
}
