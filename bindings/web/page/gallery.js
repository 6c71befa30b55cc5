// The gallery: the projects that this browser keeps, and the shipped systems.
import { el } from "./dom.js";
import { forget_project, keep_project, list_projects, new_id } from "./projects.js";
import { systems_in } from "./project_files.js";
import { shipped_systems } from "./shipped.js";
import { make_language_button, T } from "./texts.js";
import { read_zip } from "./zip.js";

const W = T.playground;

async function import_archive(file) {
  const files = await read_zip(new Uint8Array(await file.arrayBuffer()));
  const [system] = systems_in(files);
  if (!system) throw new Error(W.no_system);
  const id = new_id();
  await keep_project({ id, name: file.name.replace(/\.zip$/i, ""), system, files });
  location.hash = `project=${id}`;
}

function make_import(problem) {
  const chosen = el("input", { type: "file", accept: ".zip,application/zip", onchange: async () => {
    try {
      await import_archive(chosen.files[0]);
    } catch (wrong) {
      problem.textContent = W.not_imported(wrong.message);
    }
  } });
  return el("label", { class: "import" }, el("span", { text: `${W.import} ` }), chosen);
}

function make_kept(project, show_again) {
  const remove = el("button", { class: "quiet", text: W.forget, onclick: async () => {
    if (!confirm(W.forget_question(project.name))) return;
    await forget_project(project.id);
    show_again();
  } });
  return el("li", {}, el("a", { href: `#project=${project.id}`, text: project.name }), el("p", { text: new Date(project.changed).toLocaleString() }), remove);
}

const make_shipped = ({ name, text, runs }) => el("li", { class: runs ? "" : "off" },
  runs ? el("a", { href: `#run=${name}`, text: name }) : el("span", { text: name }), el("p", { text: runs ? text : W.no_cameras }));

const make_example = ([name, { title }]) => el("li", {}, el("a", { href: `#example=${name}`, text: name }), el("p", { text: title }));

export async function show_gallery(shipped, docs, told = "") {
  const kept = await list_projects();
  const problem = el("p", { role: "alert", class: "problem", text: told });
  document.title = `${W.title} · nezumi`;
  document.body.replaceChildren(el("main", { class: "gallery" },
    el("div", { class: "playground-bar" }, el("h1", { text: W.title }), make_language_button()), el("p", { text: W.about }), problem,
    el("p", {}, el("a", { class: "guide-link", href: "#guide", text: W.guide.begin })),
    kept.length > 0 && el("h2", { text: W.kept }), el("ul", {}, ...kept.map((each) => make_kept(each, () => show_gallery(shipped, docs)))), make_import(problem),
    el("h2", { text: W.shipped }), el("ul", {}, ...shipped_systems(shipped).map(make_shipped)),
    el("h2", { text: W.examples }), el("ul", {}, ...Object.entries(docs.examples).map(make_example))));
}
