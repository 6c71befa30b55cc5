// The view of parameters: a card per component, a widget per parameter.
import { el } from "./dom.js";
import { T } from "./texts.js";
import { bounds_text, make_widget } from "./widgets.js";

/// A parameter without its values. If this is unchanged, only the values in the row are updated.
const shape_of = ({ value, changed, given, ...rest }) => rest;

function make_row(component, parameter, acts) {
  const label = `${component}.${parameter.name}`;
  const widget = make_widget(parameter, label, (value) => acts.set_parameter(component, parameter, value));
  let { given } = parameter;
  const back = el("button", { class: "quiet back acts", text: "↺", onclick: () => acts.set_parameter(component, parameter, given) });
  const about = [parameter.doc, bounds_text(parameter)].filter(Boolean).join(" · ");
  const node = el("div", { class: "parameter" },
    el("div", { class: "head" }, el("span", { class: "name", text: parameter.name }),
      parameter.unit && el("small", { text: parameter.unit }), el("span", { class: "mark", text: T.parameters.changed }), back),
    widget.node, about && el("p", { class: "hint", text: about }));
  return { node, show: (now) => {
    widget.show(now.value);
    given = now.given;
    node.classList.toggle("changed", now.changed ?? false);
    back.hidden = !now.changed;
    back.title = T.parameters.back_to(JSON.stringify(given));
    back.setAttribute("aria-label", `${label}: ${back.title}`);
  } };
}

/// A card of a component's parameters: { node, show(component) }. `acts` has `set` and `use`; `has_none`: it is possible
/// to use no parameter set.
export function make_card(component, acts, has_none = true) {
  const rows = new Map(component.parameters.map((each) => [each.name, make_row(component.name, each, acts)]));
  const state = el("span", { class: "state" });
  const sets = component.sets.length > 0 && el("select", { class: "acts", "aria-label": `${component.name}: ${T.parameters.set}`,
    onchange: () => sets.value && acts.use(component.name, sets.value) },
  has_none && el("option", { value: "", text: T.parameters.no_set }), ...component.sets.map((each) => el("option", { value: each, text: each })));
  const node = el("section", { class: "card", data: { component: component.name } },
    el("header", {}, el("h2", { text: component.name }), el("small", { text: component.type }), state,
      sets && el("label", { class: "sets" }, el("span", { text: T.parameters.set }), sets)),
    ...[...rows.values()].map((row) => row.node));
  return { node, show: (now) => {
    state.className = `state ${now.state.toLowerCase()}`;
    state.textContent = T.states[now.state] ?? now.state;
    if (sets && document.activeElement !== sets) sets.value = now.set ?? "";
    for (const each of now.parameters) rows.get(each.name)?.show(each);
  } };
}

export function make_parameters({ model, acts }) {
  const cards = new Map();  // name: { shape, card }
  const body = el("div", { class: "cards" });
  const empty = el("p", { class: "empty", text: T.parameters.none, hidden: true });
  const search = el("input", { type: "search", placeholder: T.parameters.search, "aria-label": T.parameters.search });
  const find = () => {
    const words = search.value.toLowerCase();
    for (const card of body.children) {
      const is_whole = card.dataset.component.toLowerCase().includes(words);
      let any = is_whole;
      for (const row of card.querySelectorAll(".parameter")) {
        row.hidden = !is_whole && !row.querySelector(".name").textContent.toLowerCase().includes(words);
        any ||= !row.hidden;
      }
      card.hidden = !any;
    }
  };
  search.oninput = find;

  model.on("system", () => {
    const components = model.system.components.filter((each) => each.parameters.length > 0);
    const names = new Set(components.map((each) => each.name));
    let is_changed = false;
    for (const [name, { card }] of cards) {
      if (names.has(name)) continue;
      card.node.remove();
      cards.delete(name);
    }
    components.forEach((component) => {
      const { name, type, sets, parameters } = component;
      const shape = JSON.stringify([name, type, sets, parameters.map(shape_of)]);
      const before = cards.get(name);
      if (before?.shape !== shape) {
        const card = make_card(component, acts);
        if (before) before.card.node.replaceWith(card.node);
        else body.append(card.node);
        cards.set(name, { shape, card });
        is_changed = true;
      }
      cards.get(name).card.show(component);
    });
    empty.hidden = components.length > 0;
    search.hidden = components.length < 4;
    if (is_changed) find();
    for (const input of body.querySelectorAll("input, select, .list button")) {
      if (!model.may_act) input.disabled = true;
    }
  });
  return { node: el("div", { class: "parameters" }, search, body, empty) };
}
