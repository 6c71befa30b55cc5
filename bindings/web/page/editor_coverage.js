// Marks the lines that the latest run of the project's scenarios did not run.
import { el } from "./dom.js";
import { T } from "./texts.js";

export function make_coverage(editor, { model }) {
  const marked = new Map();  // document: the lines that have a mark

  const show = () => {
    if (!editor.file || marked.has(editor.present.doc) || editor.is_changed(editor.file)) return;
    const { doc } = editor.present;
    const missed = [...model.coverage.get(editor.file) ?? []].filter(([line, runs]) => runs === 0 && line <= doc.lineCount());
    const sign = () => el("span", { class: "missed-sign", title: T.editor.missed, role: "img", "aria-label": T.editor.missed, text: "▎" });
    marked.set(doc, missed.map(([line]) => doc.setGutterMarker(line - 1, "gutter-coverage", sign())));
    if (missed.length > 0) editor.say(T.editor.missed_lines(missed.length));
  };
  model.on("covered", () => {
    for (const [doc, lines] of marked) for (const line of lines) doc.setGutterMarker(line, "gutter-coverage", null);
    marked.clear();
    show();
  });
  return { opened: show };
}
