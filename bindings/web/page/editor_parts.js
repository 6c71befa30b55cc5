// Parts of the editor: the list of files, and the sheet over the text.
import { el } from "./dom.js";
import { T } from "./texts.js";

const KINDS = ["behaviors", "modules", "systems", "robots", "scenarios", "messages", ""];

/// Makes the list of files: grouped by kind, with a search for parts of names.
export function make_list(open) {
  const search = el("input", { type: "search", placeholder: T.editor.search, "aria-label": T.editor.search });
  const rows = el("div", { class: "rows" });
  let files = [];
  let current = "";
  let is_changed = () => false;
  const show = () => {
    const wanted = search.value.toLowerCase();
    rows.replaceChildren(...KINDS.flatMap((kind) => {
      const those = files.filter((each) => (KINDS.includes(each.kind) ? each.kind : "") === kind && each.file.toLowerCase().includes(wanted));
      if (those.length === 0) return [];
      return [el("h3", { text: T.editor.kinds[kind] }), ...those.map(({ file }) => el("button", {
        class: "file", title: file, "aria-current": file === current ? "true" : null, onclick: () => open(file), data: { file },
      }, el("span", { text: file.slice(file.lastIndexOf("/") + 1) }), is_changed(file) && el("span", { class: "unsaved", title: T.editor.unsaved, text: "•" })))];
    }));
    if (rows.childElementCount === 0) rows.append(el("p", { class: "hint", text: T.editor.no_files }));
  };
  search.oninput = show;
  return { node: el("nav", { class: "files", "aria-label": T.editor.files }, search, rows), show: (all, now, changed) => {
    [files, current, is_changed] = [all, now, changed];
    show();
  } };
}

/// Makes a sheet over the text with a title, contents, and buttons, each given as [text, work, class].
export function make_sheet(node) {
  const close = () => {
    node.hidden = true;
    node.replaceChildren();
  };
  node.addEventListener("keydown", (event) => event.key === "Escape" && close());
  return { close, show: (title, contents, buttons) => {
    node.replaceChildren(el("h2", { text: title }), ...contents, el("div", { class: "row" },
      ...buttons.map(([text, work, kind = ""]) => el("button", { class: kind, text, onclick: work })), el("button", { text: T.close, onclick: close })));
    node.hidden = false;
    node.querySelector("button")?.focus();
  } };
}
