// Completion and documentation in the editor: from the annotations, the file, and the running system.
import { el } from "./dom.js";
import { put_snippet, snippets_for } from "./editor_snippets.js";
import { complete, describe, Words } from "./editor_words.js";
import { T } from "./texts.js";

const RESTS = 450;  // ms that the pointer must rest on a name to see its documentation
const MOST = 300;

export function make_help(editor, parts) {
  const { CodeMirror, text } = editor;
  let words = new Words("");
  const tip = el("div", { class: "word-tip", role: "tooltip", hidden: true });
  document.body.append(tip);
  const load = async () => {
    const answer = await editor.files.ask("words");
    if (answer.ok) words = new Words(answer.content, answer.names);
  };

  const show = (about, { left, bottom, top }) => {
    tip.replaceChildren(el("code", { text: about.title }), about.doc && el("p", { text: about.doc }), ...about.params.map((each) => el("p", { class: "param", text: each })));
    tip.hidden = false;
    const below = bottom + 4 + tip.offsetHeight < innerHeight;
    Object.assign(tip.style, { left: `${Math.max(4, Math.min(left, innerWidth - tip.offsetWidth - 8))}px`, top: `${below ? bottom + 4 : Math.max(4, top - tip.offsetHeight - 4)}px` });
  };
  const hide = () => {
    tip.hidden = true;
  };
  const about_at = (place) => describe(words, text.getValue(), text.indexFromPos(place), editor.kind);
  let timer = null;
  const wrapper = text.getWrapperElement();
  wrapper.addEventListener("mousemove", ({ clientX, clientY, buttons }) => {
    clearTimeout(timer);
    hide();
    if (buttons) return;
    timer = setTimeout(() => {
      const place = text.coordsChar({ left: clientX, top: clientY }, "window");
      const box = text.charCoords(place, "window");
      if (Math.abs(clientX - box.left) > 20 || clientY < box.top || clientY > box.bottom) return;
      const about = about_at(place);
      if (about) show(about, { left: clientX, top: box.top, bottom: box.bottom });
    }, RESTS);
  });
  wrapper.addEventListener("mouseleave", () => {
    clearTimeout(timer);
    hide();
  });
  const show_at_cursor = () => {
    const about = about_at(text.getCursor());
    if (!about) return editor.say(T.editor.no_doc);
    show(about, text.cursorCoords(true, "window"));
    editor.say(`${about.title} ${about.doc}`);
  };
  text.on("keydown", (_, { key }) => key !== "F1" && hide());
  text.on("scroll", hide);

  const to_hint = ({ name, doc, usage }) => ({ text: name, displayText: usage || name, doc, render: (node) => {
    node.append(el("span", { text: usage || name }), doc && el("small", { text: doc }));
  } });
  const to_snippet = (word, snippet) => ({ ...to_hint({ name: `${word} …`, doc: T.editor.snippet }), hint: (_, { from, to }) => put_snippet(text, snippet, from, to) });
  /// Asks the running system about a name, as its console does.
  const ask_system = async (whole, cursor) => {
    const before = whole.slice(0, cursor);
    const bytes = new TextEncoder().encode(before);
    const { from, items = [] } = await parts.ask_console({ do: "complete", text: before, cursor: bytes.length });
    return { from: new TextDecoder().decode(bytes.slice(0, from)).length, items: items.map((name) => ({ name, doc: "" })) };
  };
  const hint = async () => {
    const whole = text.getValue();
    const cursor = text.indexFromPos(text.getCursor());
    let found = complete(words, whole, cursor, editor.kind);
    if ((found.quoted || found.unknown) && found.items.length === 0) found = { ...found, ...await ask_system(whole, cursor) };
    const [from, to] = [text.posFromIndex(found.from), text.posFromIndex(cursor)];
    const snippets = found.quoted || found.chained ? [] : snippets_for(words, editor.kind, whole.slice(found.from, cursor));
    return { from, to, list: [...snippets.map(({ word, text: snippet }) => to_snippet(word, snippet)), ...found.items.slice(0, MOST).map(to_hint)] };
  };
  const offer = () => text.showHint({ hint, completeSingle: false, alignWithWord: true, container: document.body });
  const map = { "Ctrl-Space": () => text.showHint({ hint, completeSingle: true, container: document.body }), F1: show_at_cursor };
  text.addKeyMap(map);
  text.on("inputRead", (_, { text: [typed] }) => {
    if (/[A-Za-z_.:"']$/.test(typed) && !text.state.completionActive) offer();
  });
  return { load, button: el("button", { class: "touch", text: T.editor.complete, title: T.editor.complete_hint, onclick: () => {
    text.focus();
    offer();
  } }) };
}
