// The teacher's page: a tile for each pupil, and what is done for one or for all.
import { el } from "./dom.js";
import { Link } from "./link.js";
import { Socket } from "./socket.js";
import { in_language, shown_code } from "./class_bar.js";
import { make_shared_tile } from "./class_shared_tile.js";
import { make_language_button, T } from "./texts.js";

function take_token() {
  const given = location.hash.slice(1);
  if (given) {
    sessionStorage.setItem("nezumi.class", given);
    history.replaceState(null, "", location.pathname);
  }
  return sessionStorage.getItem("nezumi.class") ?? "";
}

const link = new Link(new Socket(take_token()));
const told = el("p", { class: "told", role: "status", "aria-live": "polite" });

async function request(what, more = {}) {
  const answer = await link.ask({ do: "class", what, pupil: 0, ...more });
  told.textContent = answer.ok ? "" : T.class.failed(answer.text);
  return answer;
}

/// Shows a dialog that asks for texts. `fields`: { name: label }; the last text may be long. Resolves to an object with
/// the texts, or null.
function ask_for(title, fields, values = {}) {
  return new Promise((resolve) => {
    const names = Object.keys(fields);
    const inputs = names.map((name, i) => el(i === names.length - 1 ? "textarea" : "input", { name, value: values[name] ?? "", "aria-label": fields[name], placeholder: fields[name] }));
    const end = (result) => {
      dialog.remove();
      resolve(result);
    };
    const form = el("form", { onsubmit: (event) => {
      event.preventDefault();
      end(Object.fromEntries(names.map((name, i) => [name, inputs[i].value])));
    } }, el("b", { text: title }), ...inputs, el("div", { class: "row" }, el("button", { type: "submit", class: "primary", text: T.class.save })));
    const dialog = el("dialog", { onkeydown: ({ key }) => key === "Escape" && end(null) }, form);
    document.body.append(dialog);
    dialog.show();
    inputs[0].focus();
  });
}

async function give_hint(pupil, name) {
  const given = await ask_for(name ? T.class.hint_to(name) : T.class.hint_all, { text: T.class.hint });
  if (given?.text && (await request("hint", { pupil, text: given.text })).ok) told.textContent = T.class.hint_sent;
}

const time_text = (seconds) => new Date(seconds * 1000).toLocaleTimeString([], { hour: "2-digit", minute: "2-digit" });

/// A tile of a pupil. It is made once and then only updated, so that a button keeps the focus.
class Tile {
  #name = el("span", {});
  #here = el("small", {});
  #state = el("span", { class: "state-text" });
  #error = el("p", { class: "error-text" });
  #facts = el("p", { class: "facts" });
  #look = el("a", { class: "button", target: "_blank", rel: "noopener", text: T.class.look });
  #help = el("a", { class: "button", target: "_blank", rel: "noopener", text: T.class.help });
  pupil = {};
  node = null;

  constructor() {
    const button = (text, press) => el("button", { text, onclick: press });
    const one = (what) => () => request(what, { pupil: this.pupil.number });
    this.node = el("article", {}, el("h2", {}, this.#name, this.#here), this.#error, this.#facts,
      el("div", { class: "row" }, this.#look, this.#help, button(T.class.hint, () => give_hint(this.pupil.number, this.pupil.name)), button(T.class.check_one, one("check")),
        button(T.class.mark_it, () => this.#mark()), button(T.class.projector, one("project")), button(T.class.restart, one("restart")),
        button(T.class.exercise_one, () => request("exercise", { pupil: this.pupil.number, exercise: chooser.value })),
        button(T.class.renew, () => confirm(T.class.renew_sure(this.pupil.name)) && request("renew", { pupil: this.pupil.number }))));
  }

  async #mark() {
    const { number, mark, comment } = this.pupil;
    const given = await ask_for(this.pupil.name, { mark: T.class.mark, text: T.class.comment }, { mark, text: comment });
    if (given) request("mark", { pupil: number, ...given });
  }

  show(pupil) {
    this.pupil = pupil;
    this.node.className = `tile ${pupil.state}`;
    this.node.dataset.name = pupil.name;
    this.#name.textContent = pupil.name;
    this.#here.textContent = pupil.here ? T.class.windows(pupil.here) : T.class.away;
    this.#error.textContent = pupil.error;
    this.#error.hidden = !pupil.error;
    this.#state.textContent = T.class.states[pupil.state] + (pupil.since ? ` ${T.class.since(time_text(pupil.since))}` : "");
    const checked = (T.class.checks[pupil.check] ?? pupil.check) || (pupil.scenarios ? T.class.passed(pupil.passed, pupil.scenarios) : T.class.unchecked);
    const facts = [pupil.exercise, pupil.saved ? T.class.saved(time_text(pupil.saved)) : T.class.never, checked, pupil.memory ? T.class.memory(pupil.memory) : "",
      pupil.mark ? `${T.class.mark}: ${pupil.mark}` : "", T.class.code(shown_code(pupil.code))].filter(Boolean);
    this.#facts.replaceChildren(this.#state, ...facts.map((text) => el("span", { text })));
    this.#look.href = `/index.html#${pupil.look}`;
    this.#help.href = `/index.html#${pupil.help}`;
  }
}

const count = el("span", { class: "hint" });
const address = el("span", { class: "address" });
const freeze = el("button", { onclick: () => request(state.frozen ? "thaw" : "freeze") });
const door = el("button", { onclick: () => request("door", { open: !state.open }) });
const chooser = el("select", { "aria-label": T.class.exercise });
const project = el("button", { text: T.class.stop_projecting, onclick: () => request("project", { pupil: 0 }) });
const frozen = el("p", { class: "told frozen", text: T.class.frozen, hidden: true });
const projector = el("p", { class: "told projector", hidden: true });
const collected = el("p", { class: "told collected", hidden: true });
const tiles = el("div", { class: "tiles" });
const shared = make_shared_tile(request);
const nobody = el("p", { class: "empty", text: T.class.nobody });
const shown = new Map();
let state = {};

document.body.append(el("div", { class: "class" },
  el("header", {}, el("h1", { text: T.class.title }), count, el("span", { class: "hint", text: T.class.address }), address,
    el("button", { class: "stop", text: T.class.stop, title: T.class.stop_hint, onclick: () => request("stop") }), make_language_button(),
    el("div", { class: "row" }, freeze, door, chooser, el("button", { text: T.class.send, onclick: () => request("exercise", { exercise: chooser.value }) }),
      el("button", { text: T.class.hint_all, onclick: () => give_hint(0, "") }), el("button", { text: T.class.check, onclick: () => request("check") }),
      el("button", { text: T.class.collect, onclick: () => request("collect") }), project)),
  told, frozen, projector, collected, shared.node, nobody, tiles));

function show(next) {
  state = next;
  const { pupils } = state;
  count.textContent = `${T.class.pupils(pupils.length)}, ${T.class.here(pupils.filter(({ here }) => here).length)}`;
  address.textContent = state.address;
  freeze.textContent = state.frozen ? T.class.thaw : T.class.freeze;
  door.textContent = state.open ? T.class.door_open : T.class.door_closed;
  frozen.hidden = !state.frozen;
  project.hidden = projector.hidden = !state.projected;
  projector.textContent = T.class.projector_link(`${location.origin}/index.html#${state.spectator}`);
  collected.hidden = !state.collected;
  collected.textContent = T.class.collected(state.collected);
  nobody.hidden = pupils.length > 0;
  if (chooser.options.length !== state.exercises.length) {
    chooser.replaceChildren(...state.exercises.map(({ name, title, title_ja }) => el("option", { value: name, text: in_language(title, title_ja).replace(/^#+ /, "") })));
    chooser.value = state.first;
  }
  shared.show(state.shared);
  for (const pupil of pupils) {
    if (!shown.has(pupil.number)) {
      const tile = new Tile();
      shown.set(pupil.number, tile);
      tiles.append(tile.node);
    }
    shown.get(pupil.number).show(pupil);
  }
}

link.on("said", (said) => said.is === "class" && show(said));
link.on("lost", () => {
  told.textContent = T.class.lost;
});
link.on("open", () => {
  told.textContent = "";
  document.title = `${T.class.title} · nezumi`;
});
link.connect();
