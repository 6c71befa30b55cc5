// The editor: a list of the project's files, the open file, its errors, and its versions.
import { ask } from "./ask.js";
import { el } from "./dom.js";
import { make_breaks } from "./editor_breaks.js";
import { show_difference } from "./editor_diff.js";
import { drafts, Files } from "./editor_files.js";
import { make_coverage } from "./editor_coverage.js";
import { make_findings } from "./editor_findings.js";
import { make_help } from "./editor_help.js";
import { make_list, make_sheet } from "./editor_parts.js";
import { make_values } from "./editor_values.js";
import { T } from "./texts.js";

const WAITS = 2500;  // ms to wait for the engine's reaction to a saved file

class Editor {
  file = "";
  #parts;
  #docs = new Map();  // file: { doc, mark, saved (generation), shown, kind }
  #waits = null;      // set while the editor waits for the engine's reaction to a saved file

  constructor(parts, CodeMirror) {
    this.#parts = parts;
    this.CodeMirror = CodeMirror;
    this.files = new Files(parts.link);
    this.place = el("div", { class: "text" });
    this.state = el("span", { class: "told", role: "status" });
    this.name = el("h2", { text: T.editor.none });
    this.save_button = el("button", { class: "primary acts", text: T.editor.save, title: T.editor.save_hint, disabled: true, onclick: () => this.save() });
    this.undo_button = el("button", { class: "quiet", text: "↶", title: T.editor.undo, "aria-label": T.editor.undo, onclick: () => this.text.undo() });
    this.versions_button = el("button", { text: T.editor.versions, disabled: true, onclick: () => this.show_versions() });
    this.sheet_node = el("section", { class: "sheet-over", hidden: true, role: "dialog", "aria-label": T.editor.versions });
    this.sheet = make_sheet(this.sheet_node);
    this.list = make_list((file) => this.open(file));
    this.text = CodeMirror(this.place, {
      mode: "lua", lineNumbers: true, indentUnit: 2, tabSize: 2, matchBrackets: true, gutters: ["gutter-breaks", "gutter-ran", "gutter-coverage", "CodeMirror-linenumbers", "gutter-findings"],
      readOnly: true, screenReaderLabel: T.editor.text, inputStyle: matchMedia("(pointer: coarse)").matches ? "contenteditable" : "textarea",
      extraKeys: { "Ctrl-S": () => this.save(), "Cmd-S": () => this.save(), "Ctrl-/": "toggleComment", "Shift-Tab": "indentLess",
        Tab: (text) => (this.leaves ? this.#leave() : text.somethingSelected() ? text.indentSelection("add") : text.replaceSelection("  ", "end")),
        Esc: () => { this.leaves = true; this.say(T.editor.leave); },
        "Shift-Esc": false },
    });
    this.text.on("keydown", (_, { key }) => {
      if (!["Escape", "Tab", "Shift"].includes(key)) this.leaves = false;
    });
    this.text.on("change", () => this.#changed());
    this.findings = make_findings(this, parts);
    this.help = make_help(this, parts);
    this.values = make_values(this, parts);
    this.breaks = make_breaks(this, parts);
    this.coverage = make_coverage(this, parts);
    addEventListener("beforeunload", (event) => this.#docs.size > 0 && [...this.#docs.keys()].some((file) => this.is_changed(file)) && event.preventDefault());
    addEventListener("focus", () => this.look_again());
    parts.model.on("system", (before) => this.#take_system(before));
    parts.model.on("log", (line) => this.#take_log(line));
  }

  get present() {
    return this.#docs.get(this.file);
  }

  get shown_name() {
    return this.files.get(this.file)?.shown ?? this.file;
  }

  get kind() {
    return this.present?.kind ?? "";
  }

  say(text, kind = "") {
    this.state.textContent = text;
    this.state.className = `told ${kind}`;
  }

  /// Moves the focus out of the text: after Esc, Tab does this, as elsewhere in the page.
  #leave() {
    this.leaves = false;
    this.save_button.disabled ? this.versions_button.focus() : this.save_button.focus();
  }

  is_changed(file) {
    const each = this.#docs.get(file);
    return Boolean(each) && !each.doc.isClean(each.saved);
  }

  show_list() {
    this.list.show(this.files.all, this.file, (file) => this.is_changed(file));
  }

  async begin() {
    if (!this.#parts.model.may_act) return this.say(T.editor.view_only);
    const listed = await this.files.list();
    if (!listed.ok) return this.say(listed.text || T.link.no_answer, "bad");
    this.show_list();
    this.help.load();
    const { model } = this.#parts;
    const scripts = (model.system?.components ?? []).map(({ script }) => script).filter(Boolean);
    const first = [...scripts, model.system?.file].map((shown) => shown && this.files.named(shown)).find(Boolean);
    if (first && !this.file) this.open(first.file);
  }

  async open_shown(shown, line, column) {
    if (this.files.all.length === 0) await this.files.list();
    const found = this.files.named(shown);
    if (!found) return this.say(T.editor.not_here(shown), "bad");
    await this.open(found.file);
    if (line) this.go_to(line, column);
  }

  go_to(line, column = 0) {
    this.text.focus();
    this.text.setCursor({ line: line - 1, ch: Math.max(0, column - 1) });
    this.text.scrollIntoView(null, 120);
  }

  async open(file) {
    this.sheet.close();
    if (!this.#docs.has(file)) {
      const answer = await this.files.ask("read", { file });
      if (!answer.ok) return this.say(answer.text || T.link.no_answer, "bad");
      this.#add(file, answer.content, answer.mark);
    }
    this.#show(file);
    this.look_again();
  }

  #add(file, content, mark) {
    const doc = this.CodeMirror.Doc(content, "lua");
    const draft = drafts.get(file);
    this.#docs.set(file, { doc, mark, saved: doc.changeGeneration(true), kind: this.files.get(file)?.kind ?? "" });
    if (!draft || draft.text === content) return;
    doc.setValue(draft.text);  // restores the unsaved text after a reload of the page
    this.#docs.get(file).mark = draft.mark;
  }

  #show(file) {
    this.file = file;
    this.place.parentElement.parentElement.classList.remove("choosing");
    this.name.textContent = file.slice(file.lastIndexOf("/") + 1);
    this.name.title = file;
    this.text.swapDoc(this.present.doc);
    this.text.setOption("readOnly", !this.#parts.model.may_act);
    this.versions_button.disabled = false;
    this.say(this.is_changed(file) ? T.editor.unsaved : "");
    this.#update();
    this.findings.look(0);
    this.values.opened();
    this.breaks.opened();
    this.coverage.opened();
  }

  #update() {
    this.save_button.disabled = !this.file || !this.is_changed(this.file);
    this.show_list();
  }

  #changed() {
    const { present } = this;
    if (!present) return;
    if (this.is_changed(this.file)) drafts.set(this.file, { text: present.doc.getValue(), mark: present.mark });
    else drafts.remove(this.file);
    this.#update();
    this.findings.look();
    this.values.changed();
  }

  /// Saves the open file, if its text on the disk still has this `mark`.
  async save(mark = this.present?.mark) {
    const { file, present } = this;
    if (!present || (!this.is_changed(file) && mark === present.mark)) return;
    const content = present.doc.getValue();
    const generation = present.doc.changeGeneration(true);
    this.say(T.editor.saving);
    const ends = this.#watch_for(file);
    const answer = await this.files.ask("save", { file, text: content, mark });
    if (answer.ok) {
      Object.assign(present, { mark: answer.mark, saved: generation });
      if (this.is_changed(file)) drafts.set(file, { text: present.doc.getValue(), mark: answer.mark });
      else drafts.remove(file);
      this.#update();
      this.say(answer.text || T.editor.saved, answer.text ? "bad" : "");
      this.#parts.model.emit("file_saved", file);
      const end = await ends;
      this.#tell(end);
      if (end.version) this.breaks.saved(file);
    } else if (answer.changed) {
      this.#waits = null;
      this.say(answer.text, "bad");
      this.#ask_which(file, content, answer);
    } else {
      this.#waits = null;
      this.say(T.editor.not_saved(answer.text || T.link.no_answer), "bad");
    }
  }

  /// Resolves to the engine's reaction to the file that is being saved.
  #watch_for(file) {
    const shown = this.files.get(file)?.shown ?? file;
    return new Promise((resolve) => {
      const waits = { shown, done: (what) => {
        clearTimeout(late);
        if (this.#waits === waits) this.#waits = null;
        resolve({ file, ...what });
      } };
      const late = setTimeout(() => waits.done({}), WAITS);
      this.#waits = waits;
    });
  }

  #take_system(before) {
    if (!before || !this.#waits) return;
    const old = new Map(before.components.map(({ name, version }) => [name, version]));
    const newer = this.#parts.model.system.components.filter(({ name, version }) => old.has(name) && version > old.get(name));
    if (newer.length > 0) this.#waits.done({ version: newer[0].version, names: newer.map(({ name }) => name).join(", ") });
  }

  #take_log({ level, text }) {
    if (!this.#waits) return;
    if (level === "error" && text.includes("still running version")) this.#waits.done({ why: text });
    else if (level === "warn" && text.includes("restart() to use it")) this.#waits.done({ restart: true });
  }

  #tell({ file, version, names, why, restart }) {
    if (file !== this.file) return;
    if (version) this.say(T.editor.runs(version, names), "good");
    else if (why) this.say(why, "bad");
    else if (restart) {
      this.say(T.editor.restart);
      this.state.append(" ", el("button", { text: T.time.restart, onclick: async () => (await ask(T.time.restart_sure, T.time.restart)) && this.#parts.acts.time("restart") }));
    }
    if (file.endsWith("_test.lua") || !this.files.get(file)) this.files.list().then(() => this.show_list());
  }

  /// Asks which text to keep, because another program has changed the file.
  #ask_which(file, mine, { content, mark, text }) {
    this.sheet.show(text, [el("p", { class: "hint", text: T.editor.which }), show_difference(content ?? "", mine)], [
      [T.editor.overwrite, () => {
        this.sheet.close();
        this.save(mark);
      }],
      ...(content === null ? [] : [[T.editor.take_theirs, () => {
        this.sheet.close();
        this.#replace(file, content, mark);
      }]]),
    ]);
  }

  /// Replaces the edited text by the present text of the file; undo goes back to the edited text.
  #replace(file, content, mark) {
    const each = this.#docs.get(file);
    each.doc.setValue(content);
    Object.assign(each, { mark, saved: each.doc.changeGeneration(true) });
    drafts.remove(file);
    this.#update();
    this.say(T.editor.taken);
  }

  /// Checks if another program has changed the open file, and takes its text or shows a message.
  async look_again() {
    const { file, present } = this;
    if (!present || !this.#parts.model.may_act) return;
    const answer = await this.files.ask("read", { file });
    if (!answer.ok || answer.mark === present.mark || this.#docs.get(file) !== present) return;
    if (this.is_changed(file)) this.say(T.editor.changed_meanwhile, "bad");
    else this.#replace(file, answer.content, answer.mark);
  }

  async show_versions() {
    const { file, present } = this;
    const answer = await this.files.ask("versions", { file });
    if (!answer.ok) return this.say(answer.text || T.link.no_answer, "bad");
    const about = el("div", { class: "about" }, el("p", { class: "hint", text: answer.versions.length > 0 ? T.editor.versions_hint : T.editor.no_versions }));
    const choose = async (number, button) => {
      const old = await this.files.ask("version", { file, number });
      if (!old.ok) return this.say(old.text || T.link.no_answer, "bad");
      for (const each of rows.children) each.removeAttribute("aria-current");
      button.setAttribute("aria-current", "true");
      about.replaceChildren(show_difference(old.content, present.doc.getValue()), el("button", { class: "primary", text: T.editor.go_back(number), onclick: () => {
        this.sheet.close();
        present.doc.setValue(old.content);
        this.save();
      } }));
    };
    const rows = el("div", { class: "rows" }, ...answer.versions.map(({ number, saved_at, bytes }) => {
      const button = el("button", { class: "file", onclick: () => choose(number, button) }, el("b", { text: T.editor.version(number) }),
        el("span", { text: new Date(saved_at * 1000).toLocaleString() }), el("small", { text: T.bytes(bytes) }));
      return button;
    }));
    this.sheet.show(T.editor.versions_of(file), [el("div", { class: "versions" }, rows, about)], []);
  }

  /// Makes a new empty file.
  async make() {
    const file = await ask(T.editor.new_name, T.editor.make, "behaviors/");
    if (!file) return;
    const answer = await this.files.ask("save", { file, text: "", mark: "" });
    if (!answer.ok) return this.say(answer.text || T.link.no_answer, "bad");
    await this.files.list();
    this.open(file);
  }
}

export function make_editor_view(parts, CodeMirror) {
  const editor = new Editor(parts, CodeMirror);
  const choose = el("button", { class: "choose", text: T.editor.files, onclick: () => body.classList.toggle("choosing") });
  const tools = el("div", { class: "tools", role: "toolbar", "aria-label": T.views.editor }, choose, editor.name, editor.save_button, editor.undo_button,
    editor.versions_button, editor.help.button, ...editor.values.tools, el("span", { class: "gap" }), el("button", { class: "acts", text: T.editor.new, onclick: () => editor.make() }));
  const body = el("div", { class: "desk" }, editor.list.node, el("div", { class: "paper" }, editor.place, editor.findings.node, editor.sheet_node));
  new ResizeObserver(() => editor.text.refresh()).observe(editor.place);
  return { nodes: [tools, body, editor.state], begin: () => editor.begin(), open_shown: (...place) => editor.open_shown(...place), shown: (is_shown) => {
    if (is_shown) {
      editor.text.refresh();
      editor.look_again();
    }
    editor.values.shown(is_shown);
  } };
}
