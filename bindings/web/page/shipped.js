// The shipped systems as projects: a system with the files that it names.

const SYSTEMS = "behaviors/systems/";
const names_in = (text) => [...text.matchAll(/["']([\w./-]+)["']/g)].map(([, name]) => name);

/// The file with all files that it names, directly or through others. Other files stay among the installed ones.
function with_named(shipped, file, found = {}) {
  if (typeof shipped[file] !== "string" || found[file] !== undefined) return found;
  found[file] = shipped[file];
  for (const name of names_in(shipped[file])) {
    for (const named of [`behaviors/${name}.lua`, `behaviors/lib/${name}.lua`, `behaviors/${name.replaceAll(".", "/")}.lua`]) with_named(shipped, named, found);
  }
  return found;
}

const needs_camera = (text) => text.includes('"Camera"');

/// The first sentence of a file's first comment.
export const about = (text) => (/^(?:---? ?.*\n)+/.exec(text)?.[0] ?? "").replace(/^---? ?/gm, "").replaceAll("\n", " ").trim().split(/(?<=\.) /)[0];

/// [{ name, text, file, runs }], by name.
export const shipped_systems = (shipped) => Object.keys(shipped).filter((file) => file.startsWith(SYSTEMS) && file.endsWith(".lua"))
  .map((file) => ({ name: file.slice(SYSTEMS.length, -4), file, text: about(shipped[file]), runs: !needs_camera(shipped[file]) }));

/// A project without an id, because the browser has not stored it yet.
export const shipped_project = (shipped, name) => ({ name, system: `${SYSTEMS}${name}.lua`, files: with_named(shipped, `${SYSTEMS}${name}.lua`) });
