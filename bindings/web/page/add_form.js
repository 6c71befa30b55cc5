// The form that adds a behaviour to the running system: an existing one of the project, or a new one, whose file is
// written as by `nezumi new behavior`. The form uses console commands, so that the console shows what was done.
import { el } from "./dom.js";
import { T } from "./texts.js";

/// A text as a Lua string literal.
export const lua_text = (text) =>
  `"${text.replace(/[\\"\x00-\x1f\x7f]/g, (each) => `\\${String(each.charCodeAt(0)).padStart(3, "0")}`)}"`;
const lua_list = (texts) => `{ ${texts.map(lua_text).join(", ")} }`;

/// The console lines that make the behaviour's file, if it is new, and add the behaviour. All texts are as typed in the form.
export function lines_of({ name, script, is_new, doc, inputs, outputs, params, callbacks }) {
  const add = `behavior ${lua_text(name)} { script = ${lua_text(is_new ? name : script)} }`;
  if (!is_new) return [add];
  const fields = [["inputs", inputs], ["outputs", outputs], ["params", params], ["callbacks", callbacks]].filter(([, texts]) => texts.length > 0)
    .map(([field, texts]) => `${field} = ${lua_list(texts)}`);
  if (doc) fields.push(`doc = ${lua_text(doc)}`);
  return [`new ${lua_text(name)} { ${fields.join(", ")} }`, add];
}

/// Rows that a person adds and removes. `make_row` returns { node, text() }.
function make_rows(label, make_row) {
  const rows = [];
  const box = el("div", { class: "rows" });
  const add = el("button", { type: "button", class: "quiet", text: `+ ${label}`, onclick: () => {
    const row = make_row();
    const away = el("button", { type: "button", class: "quiet", text: "×", "aria-label": `${T.parameters.remove} ${label}`, onclick: () => {
      rows.splice(rows.indexOf(row), 1);
      line.remove();
    } });
    const line = el("div", { class: "row" }, ...row.nodes, away);
    rows.push(row);
    box.append(line);
    row.nodes[0].focus();
  } });
  return { node: el("fieldset", {}, el("legend", { text: label }), box, add), texts: () => rows.map((row) => row.text()).filter(Boolean) };
}

/// A switch for each callback of a behaviour besides on_execute.
function make_callbacks(names) {
  const chosen = names.filter((name) => name !== "on_execute").map((name) => ({ name, box: el("input", { type: "checkbox" }) }));
  return { node: el("fieldset", {}, el("legend", { text: T.add.callbacks }), el("div", { class: "row switches" },
    ...chosen.map(({ name, box }) => el("label", { class: "switch" }, box, el("span", { text: name }))))),
  texts: () => chosen.filter(({ box }) => box.checked).map(({ name }) => name) };
}

const field = (label, props = {}) => el("input", { type: "text", placeholder: label, "aria-label": label, autocomplete: "off", ...props });

export function make_add_form(parts) {
  const { model } = parts;
  const name = field(T.add.name, { required: true, pattern: "[a-z][a-z0-9_]*", title: T.add.name_hint });
  const script = field(T.add.script, { title: T.add.script_hint });
  const doc = field(T.add.doc);
  const is_new = el("input", { type: "checkbox", checked: true });
  // Types of existing ports first: a new port will usually be connected to one of them.
  const types = () => {
    const all = Object.entries(model.types).filter(([, fields]) => fields[0]?.name === "tm").map(([type]) => type).sort();
    return [...new Set([...model.all_ports().map(([, { type }]) => type).filter((type) => all.includes(type)).sort(), ...all])];
  };
  const port_row = () => {
    const port = field(T.add.port, { pattern: "[A-Za-z_][A-Za-z0-9_]*" });
    const type = el("select", { "aria-label": T.add.type }, ...types().map((each) => el("option", { value: each, text: each })));
    const about = field(T.add.about);
    return { nodes: [port, type, about], text: () => port.value && [port.value, type.value, about.value].filter(Boolean).join(":") };
  };
  const param_row = () => {
    const text = field(T.add.param, { title: T.add.param_hint });
    return { nodes: [text], text: () => text.value };
  };
  const [inputs, outputs, params] = [make_rows(T.add.input, port_row), make_rows(T.add.output, port_row), make_rows(T.add.param, param_row)];
  const callbacks = make_callbacks(model.hello.callbacks);
  const wrong = el("p", { class: "error", role: "alert" });
  const of_new = el("div", {}, doc, inputs.node, outputs.node, params.node, callbacks.node);
  const form = el("form", { method: "dialog" }, el("h2", { text: T.add.title }), name,
    el("label", { class: "switch" }, is_new, el("span", { text: T.add.is_new })), script, of_new, wrong,
    el("div", { class: "row" }, el("button", { type: "submit", class: "primary", text: T.add.add }),
      el("button", { type: "button", text: T.close, onclick: () => dialog.close() })));
  const dialog = el("dialog", { class: "over add-form" }, form);
  const show = () => {
    of_new.hidden = !is_new.checked;
    script.hidden = is_new.checked;
    script.required = !is_new.checked;
  };
  is_new.onchange = show;
  dialog.addEventListener("keydown", ({ key }) => key === "Escape" && dialog.close());
  form.onsubmit = async (event) => {
    event.preventDefault();
    wrong.textContent = "";
    const wish = { name: name.value, script: script.value, is_new: is_new.checked, doc: doc.value,
      inputs: inputs.texts(), outputs: outputs.texts(), params: params.texts(), callbacks: callbacks.texts() };
    for (const line of lines_of(wish)) {
      const { ok, text } = await parts.run_line(line);
      if (ok) continue;
      wrong.textContent = text || T.link.no_answer;
      return;
    }
    dialog.close();
  };
  show();
  document.body.append(dialog);
  return { open: () => {
    wrong.textContent = "";
    dialog.show();  // not modal: the emergency stop stays usable
    name.focus();
  } };
}
