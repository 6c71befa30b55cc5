// Plays a recorded run, in place of the link to an engine. The run can be seen at any time and speed, but not changed.
import { Emitter } from "./emitter.js";

const TURN = 33;  // ms
const FASTEST = 1000;

/// Emits what `Link` emits, and `state`: where everything is, with the values of the watched ports.
export class RecordedLink extends Emitter {
  is_open = false;
  #run;
  #watched = [];
  #frame = 0;
  #time = 0;
  #speed = 1;
  #is_running = true;
  #starts = 1;
  #told = "";  // the number of the description of the system that was sent last
  #turned = 0;

  constructor(run) {
    super();
    this.#run = run;
  }

  connect() {
    this.is_open = true;
    this.emit("open");
    this.emit("said", this.#run.hello);
    for (const line of this.#run.log) this.emit("said", line);
    this.#show();
    this.#turned = performance.now();
    setInterval(() => this.#turn(), TURN);
  }

  send(what) {
    if (what.do === "watch") {
      this.#watched = [...what.ports, ...what.members].filter(Boolean);
      if (this.#told) this.#show();
    } else if (what.do === "remembered") {
      this.emit("said", this.#run.remembered(what.branch));
    } else if (what.do === "floor" && this.#run.floor) {
      this.emit("frame", 3, Uint8Array.from(atob(this.#run.floor), (each) => each.charCodeAt(0)));
    }
    return true;
  }

  async ask(what) {
    if (what.do === "act" && what.act === "Seek") this.#go(what.fields.tick < 0 ? Infinity : what.fields.tick / this.#run.system(this.#frame).rate);
    else if (what.do === "time") this.#set_time(what);
    else return { ok: false, text: "" };
    this.#show();
    return { ok: true, text: "" };
  }

  #set_time({ what, value }) {
    if (what === "speed") this.#speed = value === "max" ? Infinity : value;
    this.#is_running = what === "resume" || (what === "speed" && this.#is_running);
    if (what === "step") this.#time = this.#run.time(Math.min(this.#run.last, this.#frame + 1));
    if (what === "resume" && this.#frame === this.#run.last) this.#go(0);  // from the beginning
  }

  #go(time) {
    this.#is_running &&= time === 0;
    this.#time = Math.max(this.#run.time(0), Math.min(time, this.#run.time(this.#run.last)));
    ++this.#starts;
  }

  #turn() {
    const now = performance.now();
    const passed = (now - this.#turned) / 1000;
    this.#turned = now;
    if (!this.#is_running) return;
    this.#time = Math.min(this.#time + passed * Math.min(this.#speed, FASTEST), this.#run.time(this.#run.last));
    if (this.#run.frame_at(this.#time) === this.#run.last) this.#is_running = false;
    this.#show();
  }

  #show() {
    this.#frame = this.#run.frame_at(this.#time);
    const is_past = this.#frame < this.#run.last;
    const system = this.#run.system(this.#frame);
    const told = JSON.stringify([this.#starts, is_past, this.#run.system_number(this.#frame)]);
    if (told !== this.#told) {
      this.#told = told;
      const branch = { name: "main", parent: "main", left: 0, ends: this.#run.time(this.#run.last) };
      this.emit("said", { ...system, start: this.#starts, starts: 1, past: { branches: [branch], branch: 0, is_past, away: "" } });
    }
    const values = new Map(this.#watched.map((name) => [name, this.#run.value(name, this.#frame)]).filter(([, value]) => value !== undefined));
    this.emit("state", { time: this.#time, tick: Math.round(this.#time * system.rate), running: this.#is_running, speed: this.#speed, late: 0, ...this.#run.state(this.#frame), values });
  }
}
