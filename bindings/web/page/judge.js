// Judges the present version of a behaviour by a recording of the project: shows the first difference as text, and both
// curves.
import { el } from "./dom.js";
import { T } from "./texts.js";

const PATIENCE = 120000;  // ms to wait for the result of a long recording

export function make_judge({ link, model, notices }) {
  const recording = el("select", { "aria-label": T.judge.recording });
  const behavior = el("select", { "aria-label": T.judge.behavior });
  const again = el("input", { type: "checkbox" });
  const start = el("button", { class: "acts", text: T.judge.start, disabled: true, onclick: () => judge() });
  const told = el("pre", { class: "told", role: "status" });
  const plot = el("img", { class: "plot", alt: T.judge.plot, hidden: true });
  const chooser = el("div", { class: "tools" }, recording, behavior, start, el("label", {}, again, T.judge.again));
  const none = el("p", { class: "empty", text: T.judge.none });
  const node = el("details", { class: "judge" }, el("summary", { text: T.judge.label }), none, chooser, told, plot);
  chooser.hidden = true;
  let is_judging = false;
  let will_judge = false;

  const fill = (select, names) => {
    const before = select.value;
    select.replaceChildren(...names.map((name) => el("option", { value: name, text: name })));
    if (names.includes(before)) select.value = before;
  };
  const look = async () => {
    const [recordings, files] = await Promise.all([
      link.ask({ do: "test", what: "recordings" }, PATIENCE), link.ask({ do: "edit", what: "list" }, PATIENCE)]);
    if (!recordings.ok || !files.ok) return notices.say(recordings.text || files.text || T.link.no_answer, "error");
    fill(recording, JSON.parse(recordings.content));
    fill(behavior, files.files.filter(({ kind }) => kind === "behaviors").map(({ file }) => file));
    chooser.hidden = !recording.value || !behavior.value;
    none.hidden = !chooser.hidden;
    start.disabled = is_judging;
  };
  const judge = async () => {
    if (is_judging) {
      will_judge = true;
      return;
    }
    start.disabled = is_judging = true;
    told.textContent = T.judge.judging;
    const { ok, text, content } = await link.ask({ do: "test", what: "judge", file: recording.value, name: behavior.value }, PATIENCE);
    told.textContent = (text || T.link.no_answer).trimEnd();
    told.classList.toggle("error", !ok);
    plot.hidden = !content;
    // As the source of an image, an SVG can't run scripts.
    if (content) plot.src = `data:image/svg+xml;charset=utf-8,${encodeURIComponent(content)}`;
    start.disabled = is_judging = false;
    if (!will_judge) return;
    will_judge = false;
    judge();
  };
  node.ontoggle = () => node.open && look();
  model.on("file_saved", () => again.checked && node.open && behavior.value && judge());
  return node;
}
