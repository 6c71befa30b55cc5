// The page of a run in one file: the engine repeats the journal of the run, and can continue from any moment.
import { EngineWorker } from "./engine_worker.js";
import { Link } from "./link.js";
import { make_page } from "./page.js";
import { T } from "./texts.js";

async function start() {
  const { wasm, worker, shipped, run } = globalThis.nezumi_run;
  const engine = new EngineWorker(() => new Worker(worker), { wasm, shipped, journal: run, project: {} });
  const { notices } = await make_page(new Link(engine));
  engine.on("refused", (why) => notices.lasting("link", why, "error"));
  engine.on("ended", () => notices.say(T.link.bye(T.playground.ended), "warn"));
  engine.connect();
}

start();
