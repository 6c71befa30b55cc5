// The playground: shows the gallery, or runs the project that the address's fragment names.
import { el } from "./dom.js";
import { EngineWorker } from "./engine_worker.js";
import { load_editor_library } from "./editor_library.js";
import { show_gallery } from "./gallery.js";
import { guided_project, make_guide } from "./guide.js";
import { Helpers } from "./helpers.js";
import { Link } from "./link.js";
import { make_page } from "./page.js";
import { systems_in } from "./project_files.js";
import { from_fragment, to_fragment } from "./project_link.js";
import { find_project, keep_project, new_id } from "./projects.js";
import { shipped_project } from "./shipped.js";
import { T } from "./texts.js";
import { write_zip } from "./zip.js";

const W = T.playground;

/// The project of the fragment, or undefined.
async function find(shipped, docs) {
  const [kind, value] = location.hash.slice(1).split(/=(.*)/s);
  if (kind === "run" && shipped[`behaviors/systems/${value}.lua`]) return shipped_project(shipped, value);
  if (kind === "project") return find_project(value);
  if (kind === "code") return from_fragment(value);
  if (kind === "guide") return guided_project(docs.guide);
  if (kind === "example" && docs.examples[value]) {
    const { files } = docs.examples[value];
    return { name: value, system: systems_in(files)[0], files };
  }
  return undefined;
}

/// Stores the saved files under the key of the project. A shipped system, or a project of a link, gets a key at the first
/// save.
async function keep(project, saved) {
  project.files = { ...project.files, ...saved };
  if (!project.id) {
    project.id = new_id();
    history.replaceState(null, "", `#project=${project.id}`);
  }
  await keep_project(project);
}

function make_bar(project, engine, start) {
  const told = el("span", { class: "told", role: "status", "aria-live": "polite" });
  const button = (text, title, work) => el("button", { text, title, onclick: async () => {
    try {
      told.textContent = (await work()) ?? "";
    } catch (wrong) {
      told.textContent = wrong.message;
    }
  } });
  const bar = el("nav", { class: "playground-bar" },
    el("a", { href: "#", text: W.title }), el("span", { class: "name", text: project.name }), told,
    button(W.link, W.link_hint, async () => {
      const address = location.href.replace(/#.*/, "") + (await to_fragment(project));
      await navigator.clipboard?.writeText(address);
      return W.link_copied(address.length);
    }),
    button(W.export, W.export_hint, async () => {
      const link = el("a", { href: URL.createObjectURL(await write_zip(project.files)), download: `${project.name}.zip` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    }),
    button(W.anew, W.anew_hint, () => engine.connect(start())));
  engine.on("silent", () => (told.textContent = W.silent));
  return bar;
}

/// For a system that can't be loaded: shows its files as plain texts, so that they can be corrected.
function show_mending(project, why) {
  const named = Object.keys(project.files).find((name) => why.includes(name)) ?? project.system;
  const text = el("textarea", { spellcheck: "false", "aria-label": named, value: project.files[named] });
  document.body.replaceChildren(el("main", { class: "gallery" }, el("p", {}, el("a", { href: "#", text: W.title })), el("pre", { role: "alert", text: why }),
    el("h2", { text: named }), text, el("button", { class: "primary", text: W.try_again, onclick: async () => {
      await keep(project, { [named]: text.value });
      location.reload();
    } })));
}

async function run(project, shipped, docs) {
  const start = () => ({ shipped, project: project.files, system: project.system });
  const engine = new EngineWorker(() => new Worker("worker.js"), start());
  engine.helpers = new Helpers(() => new Worker("helper_worker.js"), () => project.files, (what) => engine.emit("message", JSON.stringify(what)));
  engine.on("module", (module) => (engine.helpers.start = { module, shipped }));
  const [{ notices }] = await Promise.all([  // after this, nothing more is loaded
    make_page(new Link(engine)), load_editor_library(), import("./editor_view.js"), import("./arena_edit.js")]);
  document.body.classList.add("in-playground");
  document.body.prepend(make_bar(project, engine, start));
  if (project.guide) document.body.append(make_guide(docs.guide, project, engine.helpers, () => project.id && keep_project(project)));
  engine.on("saved", (files) => keep(project, files));
  engine.on("refused", (why) => show_mending(project, why));
  engine.on("ended", () => notices.say(T.link.bye(W.ended), "warn"));
  engine.connect();
}

async function start() {
  const [shipped, docs] = await Promise.all(["files.json", "docs.json"].map(async (name) => (await fetch(name)).json()));
  addEventListener("hashchange", () => location.reload());
  try {
    const project = await find(shipped, docs);
    if (project) await run(project, shipped, docs);
    else await show_gallery(shipped, docs);
  } catch (wrong) {
    await show_gallery(shipped, docs, W.not_opened(wrong.message));
  }
}

start();
