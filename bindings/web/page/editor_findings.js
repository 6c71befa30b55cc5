// The findings of `nezumi check` in the edited text: marks in the text, and a list below it.
import { el } from "./dom.js";
import { T } from "./texts.js";

const PAUSE = 400;  // ms without a key before the text is checked

export function make_findings(editor, { model }) {
  const node = el("div", { class: "findings", role: "log", "aria-label": T.editor.findings, hidden: true });
  let marks = [];
  let timer = null;
  let is_asking = false;
  let is_wanted = false;

  const clear = () => {
    for (const mark of marks) mark.clear();
    marks = [];
    editor.text.clearGutter("gutter-findings");
  };
  /// The range to mark: the name at this place, or else the rest of the line.
  const range_at = (line, column) => {
    const text = editor.text.getLine(line) ?? "";
    const from = column > 0 ? Math.min(column - 1, Math.max(0, text.length - 1)) : text.search(/\S|$/);
    const name = column > 0 ? /^[A-Za-z_0-9]+|^./.exec(text.slice(from)) : null;
    return [{ line, ch: from }, { line, ch: from + (name ? name[0].length : Math.max(1, text.trimEnd().length - from)) }];
  };
  const show = (findings, shown) => {
    clear();
    const here = findings.filter(({ file, line }) => file === shown && line > 0 && line <= editor.text.lineCount());
    const by_line = new Map();
    for (const { line, message } of here) by_line.set(line, [...by_line.get(line) ?? [], message]);
    for (const { line, column = 0 } of here) {
      const [from, to] = range_at(line - 1, column);
      marks.push(editor.text.markText(from, to, { className: "finding" }));
    }
    for (const [line, messages] of by_line)
      editor.text.setGutterMarker(line - 1, "gutter-findings", el("span", { class: "finding-sign", title: messages.join("\n"), text: "!" }));
    node.hidden = findings.length === 0;
    node.replaceChildren(...findings.map(({ file, line, column, message }) => {
      const place = [file === shown ? null : file, line, column].filter(Boolean).join(":");
      return el("button", { class: "finding-row", onclick: () => (file === shown ? editor.go_to(line, column) : editor.open_shown(file, line, column)) },
        el("b", { text: place }), el("span", { text: message }));
    }));
    editor.save_button.classList.toggle("doubtful", findings.length > 0);
  };
  const check = async () => {
    if (!editor.file || !model.may_act) return;
    if (is_asking) {
      is_wanted = true;
      return;
    }
    is_asking = true;
    const { file } = editor;
    const generation = editor.present.doc.changeGeneration();
    const answer = await editor.files.ask("check", { file, text: editor.present.doc.getValue() });
    is_asking = false;
    if (file === editor.file && editor.present.doc.isClean(generation)) {
      if (answer.ok) show(answer.findings, answer.shown);
      else show([{ file: editor.shown_name, message: answer.text || T.link.no_answer }], editor.shown_name);
    }
    if (is_wanted) {
      is_wanted = false;
      check();
    }
  };
  return { node, look: (pause = PAUSE) => {
    clearTimeout(timer);
    if (pause === 0) {
      clear();
      node.hidden = true;
    }
    timer = setTimeout(check, pause);
  } };
}
