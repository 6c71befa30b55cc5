// Builds the page and connects its parts.
import { el } from "./dom.js";
import { Model } from "./model.js";
import { Tracks } from "./past_tracks.js";
import { T } from "./texts.js";
import { Acts } from "./acts.js";
import { Notices } from "./notices.js";
import { make_header } from "./header.js";
import { make_layout } from "./layout.js";
import { make_drive } from "./drive.js";
import { make_parameters } from "./parameters.js";
import { make_diagram } from "./diagram.js";
import { make_cameras } from "./cameras.js";
import { make_explain } from "./explain.js";
import { make_editor } from "./editor.js";
import { make_console } from "./console.js";
import { make_log } from "./log.js";
import { make_scenarios } from "./scenarios.js";

/// A view that needs a library which may be missing; then it says which one.
async function load(file, make, library) {
  try {
    return (await import(file))[make];
  } catch (wrong) {
    console.warn(wrong);
    return () => ({ node: el("div", {}, el("p", { class: "empty", text: T.missing(library) })) });
  }
}

/// Builds the page on a link that is not connected yet. Resolves to its parts.
export async function make_page(link) {
  const [make_world, make_plots] = await Promise.all([load("./world.js", "make_world", "libjs-three"), load("./plots.js", "make_plots", "libjs-dygraphs")]);
  const notices = new Notices();
  const model = new Model(link);
  const acts = new Acts(link, model, notices);
  const parts = { link, model, acts, notices, tracks: new Tracks({ link, model }) };

  const views = {
    world: make_world(parts), diagram: make_diagram(parts), plots: make_plots(parts), editor: make_editor(parts), explain: make_explain(parts), drive: make_drive(parts),
    parameters: make_parameters(parts), cameras: make_cameras(parts), console: make_console(parts), log: make_log(parts), scenarios: make_scenarios(parts),
  };
  parts.layout = make_layout(views);
  document.body.append(make_header(parts), parts.layout.node, notices.node);

  model.on("hello", () => {
    document.body.classList.toggle("view-only", model.hello.view_only);
    document.body.classList.toggle("paces", Boolean(model.hello.paces));
    document.body.classList.toggle("real", model.hello.real);
  });
  model.on("system", () => {
    document.title = `${model.system.name || T.scenarios.one} · nezumi`;
  });
  model.on("class", async (state) => (await import("./class_bar.js")).show_class(parts, state));
  model.on("ended", ({ text, good }) => notices.lasting("ended", text, good ? "good" : "error"));
  model.on("bye", ({ text }) => notices.say(T.link.bye(text), "warn"));
  link.on("open", () => notices.clear_lasting("link", T.link.back));
  link.on("lost", (why, wait) => {
    document.body.classList.add("offline");
    const text = why === "refused" ? T.link.refused : T.link.away(Math.round(wait / 100) / 10);
    notices.lasting("link", text, "error");
  });
  link.on("open", () => document.body.classList.remove("offline"));
  return parts;
}
