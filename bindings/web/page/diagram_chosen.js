// The chosen component or connection of the diagram: its state and its buttons.
import { ask } from "./ask.js";
import { el } from "./dom.js";
import { error_of } from "./error_frames.js";
import { make_card } from "./parameters.js";
import { is_rtc, without_prefix } from "./rtcs.js";
import { owner_of } from "./port_name.js";
import { T } from "./texts.js";

/// Connects two ports, of the system or of RTCs.
export function connect_ports(acts, { from, to }) {
  const is_of_others = is_rtc(from) && is_rtc(to);
  return is_of_others ? acts.peer("connect", { from: without_prefix(from), to: without_prefix(to) }) : acts.connect(from, to);
}

/// Ends a connection of `model.connections`. A connection that a tool has made to a port of ours can be ended only by the
/// tool.
export function disconnect_ports(acts, { from, to, given }) {
  if (given) return acts.disconnect(given.from, given.to);
  return acts.peer("disconnect", { from: without_prefix(from), to: without_prefix(to) });
}

const can_be_ended = ({ from, to, given }) => Boolean(given) || (is_rtc(from) && is_rtc(to));

/// { node, card, show(chosen, begun) }: `chosen` is { component } or { from, to } or null, `begun` a port. The card has
/// the configuration of an RTC.
export function make_chosen(parts) {
  const { model, acts } = parts;
  const node = el("div", { class: "chosen", role: "status" });
  const card = el("div", { class: "rtc-card", hidden: true });
  const button = (text, onclick, disabled = false) => el("button", { class: "acts", text, onclick, disabled });
  const state_of = (state) => el("span", { class: `state ${state.toLowerCase()}`, text: T.states[state] ?? state });
  let shown = { shape: "", card: null };

  const sure = (question, yes, work) => async () => (await ask(question, yes)) && work();

  function component_bar(component) {
    const { name, state, about, script } = component;
    const explain = script && state === "ERROR" ? [el("button", { text: T.explain.look, title: T.explain.failed_hint, onclick: () => parts.explain(name) })] : [];
    return [el("b", { text: name }), state_of(state), el("small", { text: script ?? "" }),
      button(T.diagram.activate, () => acts.activate(name), state !== "INACTIVE"),
      button(T.diagram.deactivate, () => acts.deactivate(name), state !== "ACTIVE"),
      button(T.diagram.reset, () => acts.reset(name), state !== "ERROR"),
      button(T.diagram.remove, sure(T.diagram.remove_sure(name), T.diagram.remove, () => acts.remove(name))),
      ...explain, ...error_of(component), about && state !== "ERROR" && typeof about === "string" ? el("small", { text: about }) : ""];
  }

  function rtc_bar({ name, type, state }) {
    const tell = (what) => acts.peer(what, { name: without_prefix(name) });
    const head = [el("b", { text: name }), state_of(state), el("small", { text: type })];
    if (state === "GONE") return [...head, button(T.rtc.forget, () => tell("forget")), el("small", { text: T.rtc.gone })];
    if (state === "MISSING") return [...head, el("small", { text: T.rtc.missing })];
    return [...head,
      button(T.diagram.activate, () => tell("activate"), state !== "INACTIVE"),
      button(T.diagram.deactivate, () => tell("deactivate"), state !== "ACTIVE"),
      button(T.diagram.reset, () => tell("reset"), state !== "ERROR"),
      button(T.rtc.exit, sure(T.rtc.exit_sure(name), T.rtc.exit, () => tell("exit")))];
  }

  function show_card(component) {
    card.hidden = component?.kind !== "rtc" || component.parameters.length === 0;
    if (card.hidden) return;
    const { name, sets, parameters } = component;
    const shape = JSON.stringify([name, sets, parameters.map(({ value, ...rest }) => rest)]);
    if (shape !== shown.shape) {
      const own = without_prefix(name);
      shown = { shape, card: make_card(component, {
        set_parameter: (_, parameter, value) => acts.set_peer_parameter(own, parameter, value),
        use: (_, set) => acts.peer("use", { name: own, set }),
      }, false) };
      card.replaceChildren(shown.card.node);
    }
    shown.card.show(component);
    for (const input of card.querySelectorAll("input, select, .list button")) if (!model.may_act) input.disabled = true;
  }

  function bar_of(chosen, begun) {
    if (begun) return [el("span", { text: T.diagram.connecting(begun, model.port(begun)?.type ?? "") })];
    const component = chosen?.component && model.component(chosen.component);
    if (component?.host) return [el("b", { text: component.name }), el("span", { text: T.diagram.of_host(component.host) })];
    if (component) return component.kind === "rtc" ? rtc_bar(component) : component_bar(component);
    const connection = chosen?.from && model.connections.find(({ from, to }) => from === chosen.from && to === chosen.to);
    if (connection) {
      const { from, to } = connection;
      const end = can_be_ended(connection) ? button(T.diagram.disconnect, () => disconnect_ports(acts, connection))
        : el("small", { text: T.rtc.by_tool(is_rtc(from) ? owner_of(from) : owner_of(to)) });
      return [el("b", { text: `${from} → ${to}` }), end];
    }
    const problem = model.rtcs?.problem;
    return [el("span", { class: "hint", text: problem ? T.rtc.problem(problem) : T.diagram.about })];
  }

  return { node, card, show: (chosen, begun) => {
    node.replaceChildren(...bar_of(chosen, begun));
    show_card(!begun && chosen?.component ? model.component(chosen.component) : null);
  } };
}
