// Pictures of cameras, requested only while the view is shown.
import { el } from "./dom.js";
import { T } from "./texts.js";

export function make_cameras({ model }) {
  const frames = new Map();  // port: { node, image, note, url }
  const body = el("div", { class: "pictures" });
  const empty = el("p", { class: "empty", text: T.cameras.none });
  let is_shown = false;

  const watch = () => model.watch("cameras", is_shown && frames.size > 0 && { pictures: [...frames.keys()] });
  model.on("system", () => {
    const ports = model.all_ports().filter(([, { way, type }]) => way === "out" && type === "CameraImage").map(([name]) => name);
    if (ports.join() === [...frames.keys()].join()) return;
    frames.clear();
    for (const port of ports) {
      const image = el("img", { alt: port });
      const note = el("figcaption", {}, el("b", { text: port }), el("span", { text: T.cameras.waiting }));
      frames.set(port, { node: el("figure", {}, image, note), image, note: note.lastChild, url: null });
    }
    body.replaceChildren(...[...frames.values()].map(({ node }) => node));
    empty.hidden = frames.size > 0;
    watch();
  });
  model.on("picture", ({ port, tm, width, height, jpeg }) => {
    const frame = frames.get(port);
    if (!frame) return;
    const before = frame.url;
    frame.url = URL.createObjectURL(new Blob([jpeg], { type: "image/jpeg" }));
    frame.image.src = frame.url;
    [frame.image.width, frame.image.height] = [width, height];
    frame.note.textContent = `${width} × ${height}, ${T.time.seconds(tm.toFixed(2))}`;
    if (before) URL.revokeObjectURL(before);
  });
  return { node: el("div", { class: "cameras" }, body, empty), shown: (shown) => {
    is_shown = shown;
    watch();
  } };
}
