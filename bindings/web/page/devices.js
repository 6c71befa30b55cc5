// The lights, the buzzer and the buttons of a robot: of the selected one, or of the only one.
import { el } from "./dom.js";
import { T } from "./texts.js";

/// Keeps its node up to date; `chosen()` is the index of the robot, or null.
export function make_devices({ model, acts }, chosen) {
  const lights = el("output", { class: "lights" });
  const buttons = el("div", { class: "row acts not-real" });
  const node = el("div", { class: "devices", hidden: true }, lights, buttons);
  let shown = "";

  const robot = () => {
    const robots = model.system?.robots ?? [];
    return robots[chosen() ?? (robots.length === 1 ? 0 : -1)];
  };
  const button_of = (name, sensor) => {
    const button = el("button", { text: sensor, title: T.devices.press(sensor), "aria-pressed": false });
    const press = (pressed) => {
      if ((button.getAttribute("aria-pressed") === "true") === pressed) return;
      button.setAttribute("aria-pressed", pressed);
      acts.act("Press", { robot: name, sensor, pressed });
    };
    button.addEventListener("pointerdown", (event) => {
      button.setPointerCapture(event.pointerId);
      press(true);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture", "blur"]) button.addEventListener(end, () => press(false));
    button.addEventListener("keydown", ({ key, repeat }) => key === "Enter" && !repeat && press(true));
    button.addEventListener("keyup", ({ key }) => key === "Enter" && press(false));
    return button;
  };
  const update = () => {
    const one = robot();
    const sensors = (one?.sensors ?? []).filter(({ kind }) => kind === "button" || kind === "touch").map(({ name }) => name);
    const members = (one ? model.component(one.name)?.members ?? [] : []).filter((name) => name === "leds" || name === "buzzer");
    const now = JSON.stringify([one?.name, sensors, members]);
    if (now === shown) return;
    shown = now;
    model.watch("devices", members.length > 0 ? { members: members.map((name) => `${one.name}.${name}`) } : null);
    buttons.replaceChildren(...sensors.map((sensor) => button_of(one.name, sensor)));
    node.hidden = sensors.length === 0 && members.length === 0;
    tell();
  };
  const tell = () => {
    const one = robot();
    const leds = Object.values(model.value_of(`${one?.name}.leds`)?.value ?? {});
    const buzzer = Object.values(model.value_of(`${one?.name}.buzzer`)?.value ?? {})[0] ?? 0;
    lights.replaceChildren(...leds.map((is_on, i) => el("span", { class: is_on ? "led on" : "led", role: "img", "aria-label": T.devices.led(i + 1, is_on), title: T.devices.led(i + 1, is_on) })),
      buzzer > 0 ? T.devices.tone(buzzer) : "");
  };
  model.on("system", update);
  model.on("port", (name) => /\.(leds|buzzer)$/.test(name) && tell());
  model.on("restarted", () => {
    shown = "";
  });
  return { node, update };
}
