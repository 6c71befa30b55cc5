// Actions of a person on the system: each is an act of the engine, and a refusal is shown.
import { T } from "./texts.js";

/// A parameter's value as an act needs it: an array becomes an object that names the type of its elements.
const as_parameter = (type, value) => (Array.isArray(value) ? { [type === "strings" ? "texts" : type]: value } : value);

/// A resolution of 1 um and 1 urad is enough.
const round = (value) => Math.round(value * 1e6) / 1e6;

export class Acts {
  #link;
  #model;
  #notices;

  constructor(link, model, notices) {
    this.#link = link;
    this.#model = model;
    this.#notices = notices;
  }

  async #ask(what, may = this.#model.may_act, within = undefined) {
    if (!may) return false;
    const { ok, text } = await this.#link.ask(what, within);
    if (!ok) this.#notices.say(text || T.link.no_answer, "error");
    return ok;
  }

  act = (name, fields = {}) => this.#ask({ do: "act", act: name, fields });
  time = (what, value) => this.#ask({ do: "time", what, ...(value === undefined ? {} : { value }) }, this.#model.may_act || this.#model.hello?.paces);

  /// Stops all robots. Does not wait for an answer, and is sent even before the page knows its permissions.
  stop = () => this.#link.send({ do: "stop" }) || this.#notices.say(T.stop.not_sent, "error");
  rearm = () => this.#ask({ do: "rearm" });

  set_parameter = (component, { name, type }, value) =>
    this.act("SetParameter", { component, parameter: name, value: as_parameter(type, value) });
  use = (component, set) => this.act("Use", { component, set });
  activate = (component) => this.act("Activate", { component });
  deactivate = (component) => this.act("Deactivate", { component });
  reset = (component) => this.act("Reset", { component });
  /// Goes to a tick of the branch; without `tick`, to the end of the branch.
  seek = (branch, tick = -1) => this.act("Seek", { branch, tick, start: 0 });
  /// Requests the earlier numbers of a port for a plot. They come in a separate message.
  earlier = (port) => this.#ask({ do: "earlier", port }, true, 600_000);
  remove = (component) => this.act("Remove", { component });
  connect = (from, to) => this.act("Connect", { from, to });
  disconnect = (from, to) => this.act("Disconnect", { from, to });
  /// A request to an RTC of another program.
  peer = (what, fields) => this.#ask({ do: "peer", what, ...fields });
  set_peer_parameter = (name, { name: parameter, type }, value) => this.peer("configure", { name, parameter, value: as_parameter(type, value) });
  teleport = (robot, { x, y, yaw }) =>
    this.act("Teleport", { robot, pose: { position: { x: round(x), y: round(y) }, heading: round(yaw) } });
  move_thing = (thing, { x, y, yaw }) =>
    this.act("MoveThing", { thing, pose: { position: { x: round(x), y: round(y) }, heading: round(yaw) } });
  move_marker = (marker, { x, y, z, yaw }) =>
    this.act("MoveMarker", { marker, pose: { position: { x: round(x), y: round(y), z: round(z) }, orientation: { r: 0, p: 0, y: round(yaw) } } });
}
