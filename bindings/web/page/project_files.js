// Checks the files of another person's project: only files with plain names within the project are allowed.

const MOST_FILES = 500;
const ENDINGS = /\.(lua|csv|png|msg|idl|txt|md)$/;

export const is_name = (name) => name.length < 200 && ENDINGS.test(name) && name.split("/").every((part) => /^[\w.+@ -]+$/u.test(part) && !/^\.+$/.test(part));

/// Returns the files, or throws an error. The content of a file is a text or { base64 }.
export function checked_files(files) {
  const names = Object.keys(files ?? {});
  if (names.length === 0 || names.length > MOST_FILES) throw new Error(`${names.length} files`);
  const checked = {};
  for (const name of names) {
    if (!is_name(name)) throw new Error(`'${name.slice(0, 80)}' is not the name of a file of the project`);
    const content = files[name];
    if (typeof content !== "string" && typeof content?.base64 !== "string") throw new Error(`'${name}' has no content`);
    checked[name] = typeof content === "string" ? content : { base64: content.base64 };
  }
  return checked;
}

/// The system files of a project: those in behaviors/systems, or, if there are none, all files in behaviors.
export function systems_in(files) {
  const all = Object.keys(files).filter((name) => name.endsWith(".lua")).sort();
  const within = all.filter((name) => name.startsWith("behaviors/systems/"));
  return within.length > 0 ? within : all;
}
