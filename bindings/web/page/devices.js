// The lights, the buzzer, the battery, the screen and the buttons of a robot: of the selected one, or of the only one.
import { el } from "./dom.js";
import { T } from "./texts.js";

const FEW = 4;  // so few buttons are always shown, also on a phone

/// Makes the view, which keeps itself up to date. `chosen()` returns the index of the selected robot, or null.
export function make_devices({ model, acts }, chosen) {
  const lights = el("output", { class: "lights" });
  const buttons = el("div", { class: "row" });
  const summary = el("summary", { text: T.devices.buttons });
  const fold = el("details", { class: "acts not-real" }, summary, buttons);
  const screen = el("img", { class: "screen", alt: T.devices.screen });
  const node = el("div", { class: "devices", role: "group", hidden: true }, screen, lights, fold);
  let screen_port = "";
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
    const component = one && model.component(one.name);
    // Some robots have no members for lights and so on, but ports of the same names.
    const told = ["leds", "buzzer", "battery"].filter((name) => component?.members.includes(name) || component?.ports.some((port) => port.name === name));
    const display = component?.ports.find(({ way, type }) => way === "in" && type === "CameraImage");
    const now = JSON.stringify([one?.name, sensors, told, display?.name]);
    if (now === shown) return tell();  // only the permission to drive has changed
    shown = now;
    screen_port = display ? `${one.name}.${display.name}` : "";
    screen.removeAttribute("src");  // the screen shows another robot
    screen.hidden = true;  // until there is a picture
    if (one) node.setAttribute("aria-label", T.devices.of(one.name));
    model.watch("devices", one ? { ...model.wanted(told.map((name) => `${one.name}.${name}`)), pictures: screen_port ? [screen_port] : [] } : null);
    buttons.replaceChildren(...sensors.map((sensor) => button_of(one.name, sensor)));
    summary.hidden = sensors.length <= FEW;
    fold.open = sensors.length <= FEW || innerWidth >= 900;
    node.hidden = sensors.length === 0 && told.length === 0;
    tell();
  };
  const tell = () => {
    const one = robot();
    const leds = Object.values(model.value_of(`${one?.name}.leds`)?.value ?? {});
    const buzzer = Object.values(model.value_of(`${one?.name}.buzzer`)?.value ?? {})[0] ?? 0;
    const volts = Object.values(model.value_of(`${one?.name}.battery`)?.value ?? {})[0];
    const is_low = one?.may_drive === false;  // the robot's driver decides this
    lights.replaceChildren(...leds.map((is_on, i) => el("span", { class: is_on ? "led on" : "led", role: "img", "aria-label": T.devices.led(i + 1, is_on), title: T.devices.led(i + 1, is_on) })),
      buzzer > 0 ? T.devices.tone(buzzer) : "", ...(Number.isFinite(volts) ? [el("span", { class: is_low ? "battery low" : "battery", text: T.devices.battery(volts.toFixed(1), is_low) })] : []));
  };
  model.on("picture", ({ port, jpeg }) => {
    if (port !== screen_port) return;
    screen.hidden = false;
    URL.revokeObjectURL(screen.src);
    screen.src = URL.createObjectURL(new Blob([jpeg], { type: "image/jpeg" }));
  });
  model.on("system", update);
  model.on("port", (name) => /\.(leds|buzzer|battery)$/.test(name) && tell());
  model.on("restarted", () => {
    shown = "";
  });
  return { node, update };
}
