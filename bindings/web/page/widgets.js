// Widgets for parameters: each shows a value and reports a change by a person, within its bounds.
import { el } from "./dom.js";
import { T } from "./texts.js";

const is_whole = (type) => type.startsWith("integer");
const is_number = (type) => is_whole(type) || type.startsWith("number");
const element_type = (type) => type.replace(/s$/, "");
const is_given = (bound) => bound !== null && bound !== undefined;

/// Returns the reason why this text is not a value for the parameter, or "" if it is one.
export function what_is_wrong({ type, min, max }, text) {
  const value = Number(text);
  if (text.trim() === "" || !Number.isFinite(value)) return T.parameters.not_a_number;
  if (is_whole(type) && !Number.isInteger(value)) return T.parameters.not_whole;
  if (is_given(max) && value > max) return T.parameters.above(max);
  if (is_given(min) && value < min) return T.parameters.below(min);
  return "";
}

/// The bounds as text, or "".
export function bounds_text({ min, max }) {
  if (is_given(min) && is_given(max)) return T.parameters.bounds(min, max);
  return is_given(min) ? T.parameters.at_least(min) : is_given(max) ? T.parameters.at_most(max) : "";
}

function number_field(parameter, label, set) {
  const step = parameter.step || (is_whole(parameter.type) ? 1 : "any");
  const input = el("input", { type: "number", class: "number", step, min: parameter.min, max: parameter.max, "aria-label": label,
    inputmode: is_whole(parameter.type) ? "numeric" : "decimal" });
  let shown = "";
  const take = () => {
    const wrong = what_is_wrong(parameter, input.value);
    input.setCustomValidity(wrong);
    input.title = wrong;
    input.setAttribute("aria-invalid", wrong !== "");
    if (wrong) return void input.reportValidity();
    if (Number(input.value) !== Number(shown)) set(Number(input.value));
  };
  input.addEventListener("change", take);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") take();
    if (event.key === "Escape") input.value = shown;
  });
  return { node: input, show: (value) => {
    shown = String(value);
    if (document.activeElement === input && input.value !== "" && input.getAttribute("aria-invalid") === "true") return;
    if (Number(input.value) !== value || input.value === "") input.value = tidy(value);
    input.setAttribute("aria-invalid", false);
  } };
}

/// Removes the rounding digits of binary fractions.
const tidy = (value) => String(Number(value.toPrecision(12)));

function slider(parameter, label, set) {
  const { min, max } = parameter;
  const step = parameter.step || (is_whole(parameter.type) ? 1 : (max - min) / 1000);
  const range = el("input", { type: "range", min, max, step, "aria-label": label });
  const field = number_field(parameter, label, set);
  let is_dragged = false;
  let will_send = null;
  range.addEventListener("input", () => {
    is_dragged = true;
    field.node.value = tidy(Number(range.value));
    will_send ??= setTimeout(() => {
      will_send = null;
      set(Number(range.value));
    }, 40);
  });
  range.addEventListener("change", () => {
    is_dragged = false;
  });
  return { node: el("div", { class: "slider" }, range, field.node), show: (value) => {
    if (is_dragged) return;
    range.value = value;
    field.show(value);
  } };
}

function text_field(parameter, label, set) {
  const input = el("input", { type: "text", "aria-label": label, spellcheck: "false", autocapitalize: "off" });
  let shown = "";
  const take = () => input.value !== shown && set(input.value);
  input.addEventListener("change", take);
  input.addEventListener("keydown", (event) => {
    if (event.key === "Escape") input.value = shown;
  });
  return { node: input, show: (value) => {
    if (document.activeElement !== input || input.value === shown) input.value = value;
    shown = value;
  } };
}

function checkbox(parameter, label, set) {
  const input = el("input", { type: "checkbox", role: "switch", class: "switch", "aria-label": label, onchange: () => set(input.checked) });
  input.addEventListener("keydown", (event) => event.key === "Enter" && input.click());  // the space bar is reserved for stopping robots
  return { node: input, show: (value) => {
    input.checked = value;
  } };
}

let groups = 0;
function radio({ options }, label, set) {
  const name = `radio-${++groups}`;
  const inputs = options.map((option) => el("input", { type: "radio", name, onchange: () => set(option) }));
  return { node: el("div", { class: "radios", role: "radiogroup", "aria-label": label },
    ...options.map((option, i) => el("label", {}, inputs[i], el("span", { text: String(option) })))),
  show: (value) => options.forEach((option, i) => {
    inputs[i].checked = option === value;
  }) };
}

function choice({ options }, label, set) {
  const select = el("select", { "aria-label": label, onchange: () => set(options[select.selectedIndex]) },
    ...options.map((option) => el("option", { text: String(option) })));
  return { node: select, show: (value) => {
    select.selectedIndex = options.indexOf(value);
  } };
}

/// The widget for an array: values in a column that can be moved, removed and added.
function list(parameter, label, set) {
  const { options = [], min_size, max_size } = parameter;
  const one = { ...parameter, type: element_type(parameter.type) };
  const node = el("ol", { class: "list", "aria-label": label });
  const zero = { boolean: false, integer: 0, number: 0, string: "" }[one.type];
  const is_fixed = min_size !== undefined && min_size === max_size;
  let values = [];
  const with_out = (i) => values.filter((_, k) => k !== i);
  const swapped = (i, k) => values.map((value, n) => (n === i ? values[k] : n === k ? values[i] : value));
  const button = (text, sign, work, off) => el("button", { class: "quiet", title: text, "aria-label": text, text: sign, onclick: work, disabled: off });
  const row = (value, i) => {
    const widget = (options.length > 0 ? choice : one.type === "boolean" ? checkbox : is_number(one.type) ? number_field : text_field)(
      one, `${label} ${T.parameters.element(i + 1)}`, (next) => set(values.map((each, n) => (n === i ? next : each))));
    widget.show(value);
    return el("li", {}, widget.node,
      button(T.parameters.up, "↑", () => set(swapped(i, i - 1)), i === 0),
      button(T.parameters.down, "↓", () => set(swapped(i, i + 1)), i === values.length - 1),
      !is_fixed && button(T.parameters.remove, "×", () => set(with_out(i)), values.length <= (min_size ?? 0)));
  };
  return { node, show: (value) => {
    if (node.contains(document.activeElement) && JSON.stringify(value) === JSON.stringify(values)) return;
    values = value;
    const free = options.filter((each) => !values.includes(each));
    const next = options.length > 0 ? free[0] : values.length > 0 ? values[values.length - 1] : zero;
    const is_full = values.length >= (max_size ?? Infinity) || next === undefined;
    node.replaceChildren(...values.map(row), is_fixed ? "" : el("li", { class: "more" }, button(T.parameters.add, "+", () => set([...values, next]), is_full)));
  } };
}

/// The parameter's widget, or the default for its type: { node, show(value) }.
export function make_widget(parameter, label, set) {
  const { type, widget, options = [], min, max } = parameter;
  if (type.endsWith("s")) return list(parameter, label, set);
  if (type === "boolean") return checkbox(parameter, label, set);
  if (options.length > 0) return (widget === "radio" || (!widget && options.length <= 4) ? radio : choice)(parameter, label, set);
  if (!is_number(type)) return text_field(parameter, label, set);
  return (widget === "slider" && is_given(min) && is_given(max) ? slider : number_field)(parameter, label, set);
}
