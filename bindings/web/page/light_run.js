// The page of a light run in one file: it has the recorded values, and no engine.
import { Acts } from "./acts.js";
import { el } from "./dom.js";
import { make_diagram } from "./diagram.js";
import { make_header } from "./header.js";
import { make_layout } from "./layout.js";
import { make_log } from "./log.js";
import { Model } from "./model.js";
import { Notices } from "./notices.js";
import { make_parameters } from "./parameters.js";
import { Tracks } from "./past_tracks.js";
import { make_plots } from "./plots.js";
import { RecordedLink } from "./recorded_link.js";
import { RecordedRun } from "./recorded_run.js";
import { T } from "./texts.js";
import { make_world } from "./world.js";

/// The acts of this page: only time can be changed.
class ActsOnTime extends Acts {
  constructor(link, model, notices) {
    super(link, model, notices);
    this.time = (what, value) => link.ask({ do: "time", what, value });
    this.seek = (branch, tick = -1) => link.ask({ do: "act", act: "Seek", fields: { tick } });
  }
}

const run = new RecordedRun(JSON.parse(globalThis.nezumi_run.run));
const link = new RecordedLink(run);
const notices = new Notices();
const model = new Model(link);
const parts = { link, model, notices, run, acts: new ActsOnTime(link, model, notices), tracks: new Tracks({ link, model }) };
parts.layout = make_layout({ world: make_world(parts), diagram: make_diagram(parts), plots: make_plots(parts), parameters: make_parameters(parts), log: make_log(parts) });
document.body.classList.add("recorded");
document.body.append(make_header(parts), parts.layout.node, notices.node);
model.on("system", () => {
  document.title = `${model.system.name} · nezumi`;
});
document.querySelector("header .title").append(el("small", { text: T.playground.light }));
link.connect();
