// Breakpoints: a click beside a line, or F9. Time pauses after a tick that runs the line, as with `break_at` of the console.
import { el } from "./dom.js";
import { T } from "./texts.js";

export function make_breaks(editor, parts) {
  const { text } = editor;
  const { model, link } = parts;
  const breaks = new Map();  // file: Map of line handle to the place under which the engine knows the breakpoint
  let stopped = null;        // { doc, handle }

  const breaks_of = (file) => breaks.get(file) ?? breaks.set(file, new Map()).get(file);
  const quoted = (file) => JSON.stringify(file);
  const show = () => {
    text.clearGutter("gutter-breaks");
    if (!editor.file) return;
    for (const handle of breaks_of(editor.file).keys()) {
      const line = text.getLineNumber(handle);
      if (line !== null) text.setGutterMarker(line, "gutter-breaks", el("span", { class: "break-sign", title: T.editor.break_here, text: "●" }));
    }
  };
  let latest = Promise.resolve();  // the last change; each change begins after the one before it
  const in_turn = (change) => (...given) => {
    latest = latest.then(() => change(...given));
    return latest;
  };
  const toggle = in_turn(async (handle) => {
    const line = text.getLineNumber(handle);
    if (line === null || !editor.file || !model.may_act) return;
    const here = breaks_of(editor.file);
    const is_there = here.has(handle);
    const place = is_there ? here.get(handle) : `${editor.shown_name}:${line + 1}`;
    const { ok, text: why } = await parts.run_line(is_there ? `unwatch(${quoted(place)})` : `break_at ${quoted(place)}`);
    if (!ok) return editor.say(why || T.link.no_answer, "bad");
    if (is_there) here.delete(handle);
    else here.set(handle, place);
    show();
    if (is_there) editor.say(T.editor.no_break(line + 1));
    else if (!stopped) editor.say(T.editor.break_at(line + 1));  // if the line ran already, the message about it stays
  });
  /// Called after a file was saved: moves the engine's breakpoints of lines that have moved.
  const saved = in_turn(async (file) => {
    const shown = editor.files.get(file)?.shown ?? file;
    const moved = [...breaks_of(file)].map(([handle, place]) => {
      const line = text.getLineNumber(handle);
      return { handle, place, now: line === null ? null : `${shown}:${line + 1}` };
    }).filter(({ place, now }) => place !== now);
    for (const { place } of moved) await parts.run_line(`unwatch(${quoted(place)})`);
    for (const { handle, now } of moved) {
      breaks_of(file).delete(handle);
      if (now && (await parts.run_line(`break_at ${quoted(now)}`)).ok) breaks_of(file).set(handle, now);
    }
    show();
  });
  /// Called for a console line: `unwatch` removes breakpoints.
  const unwatched = (line) => {
    const [, whole, place] = /\bunwatch\s*(?:(\(\s*\))|\(?\s*["']([^"']+)["'])/.exec(line) ?? [];
    if (whole) breaks.clear();
    for (const here of breaks.values()) {
      for (const [handle, its] of here) if (its === place) here.delete(handle);
    }
    show();
  };
  model.on("console_line", unwatched);
  const leave = () => {
    stopped?.doc.removeLineClass(stopped.handle, "background", "stopped-line");
    stopped = null;
  };
  text.on("gutterClick", (_, line, gutter) => (gutter === "gutter-breaks" || gutter === "CodeMirror-linenumbers") && toggle(text.getLineHandle(line)));
  text.addKeyMap({ F9: () => toggle(text.getLineHandle(text.getCursor().line)) });
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
  // The engine ends the breakpoints of a connection that is lost.
  link.on("lost", () => {
    breaks.clear();
    show();
  });
  return { opened: show, saved };
}
