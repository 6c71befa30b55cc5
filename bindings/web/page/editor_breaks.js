// Breakpoints: a click beside a line, or F9. Time pauses after a tick that runs the line, as with `break_at` of the console.
import { el } from "./dom.js";
import { T } from "./texts.js";

export function make_breaks(editor, parts) {
  const { text } = editor;
  const { model, link } = parts;
  const breaks = new Map();  // file: set of line handles
  let stopped = null;        // { doc, handle }

  const lines_of = (file) => [...breaks.get(file) ?? []].filter((handle) => text.getLineNumber(handle) !== null || file !== editor.file);
  const quoted = (file) => JSON.stringify(file);
  const show = () => {
    text.clearGutter("gutter-breaks");
    for (const handle of lines_of(editor.file)) {
      const line = text.getLineNumber(handle);
      if (line !== null) text.setGutterMarker(line, "gutter-breaks", el("span", { class: "break-sign", title: T.editor.break_here, text: "●" }));
    }
  };
  const toggle = async (line) => {
    if (!editor.file || !model.may_act) return;
    const handle = text.getLineHandle(line);
    const here = breaks.get(editor.file) ?? new Set();
    breaks.set(editor.file, here);
    const place = `${editor.shown_name}:${line + 1}`;
    const is_there = here.has(handle);
    const { ok, text: why } = await parts.run_line(is_there ? `unwatch(${quoted(place)})` : `break_at ${quoted(place)}`);
    if (!ok) return editor.say(why || T.link.no_answer, "bad");
    if (is_there) here.delete(handle);
    else here.add(handle);
    show();
    if (is_there) editor.say(T.editor.no_break(line + 1));
    else if (!stopped) editor.say(T.editor.break_at(line + 1));  // time may have paused there already
  };
  const leave = () => {
    stopped?.doc.removeLineClass(stopped.handle, "background", "stopped-line");
    stopped = null;
  };
  text.on("gutterClick", (_, line, gutter) => (gutter === "gutter-breaks" || gutter === "CodeMirror-linenumbers") && toggle(line));
  text.addKeyMap({ F9: () => toggle(text.getCursor().line) });
  model.on("console", async ({ event }) => {
    const found = event.is === "output" && /^(\S+):(\d+) ran at .*: time is paused$/m.exec(event.text);
    if (!found) return;
    await parts.open_file({ shown: found[1], line: Number(found[2]) });
    leave();
    const line = Number(found[2]) - 1;
    if (line >= text.lineCount()) return;
    stopped = { doc: text.getDoc(), handle: text.addLineClass(line, "background", "stopped-line") };
    editor.say(T.editor.stopped(line + 1), "bad");
  });
  model.on("frame", () => stopped && model.frame.running && leave());
  // Breakpoints belong to the connection.
  link.on("lost", () => {
    breaks.clear();
    show();
  });
  return { opened: show };
}
