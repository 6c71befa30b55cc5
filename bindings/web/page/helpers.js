// Runs scenarios and checks of a project in separate workers. Answers the same messages that a page sends to a server.
import { read_report } from "./tap.js";

const COVERAGE = "# coverage\n";
const none_kept = (text) => text.replace(/^ {4}- "?files: .*\n/gm, "");  // a page keeps no folders of failed runs

/// A worker that answers requests. To cancel a request, the worker is ended and a new one begins.
class Helper {
  #make;
  #start = null;
  #worker = null;
  #waiting = new Map();  // id: { resolve, said }
  #last = 0;

  constructor(make) {
    this.#make = make;
    this.#begin();
  }

  #begin() {
    this.#worker = this.#make();
    this.#worker.onmessage = ({ data: { id, said, status, errors } }) => {
      const asked = this.#waiting.get(id);
      if (!asked) return;
      if (said !== undefined) return asked.said(said);
      this.#waiting.delete(id);
      asked.resolve({ status, errors });
    };
    if (this.#start) this.#worker.postMessage({ start: this.#start });
  }

  set start(start) {
    this.#start = start;
    this.#worker.postMessage({ start });
  }

  /// Calls a function of the engine's program. Resolves to { status, errors }; `said` gets each text that it sends.
  ask(files, call, words, said) {
    const id = ++this.#last;
    return new Promise((resolve) => {
      this.#waiting.set(id, { resolve, said });
      this.#worker.postMessage({ id, files, call, words });
    });
  }

  end() {
    this.#worker.terminate();
    for (const { resolve } of this.#waiting.values()) resolve({ status: 2, errors: "stopped" });
    this.#waiting.clear();
  }

  begin_anew() {
    this.end();
    this.#begin();
  }
}

export class Helpers {
  #tests;
  #checks;
  #files;
  #tell;
  #is_running = false;

  /// `make` returns a new Worker, `files` returns the present files of the project, `tell` sends an object to the page.
  constructor(make, files, tell) {
    this.#tests = new Helper(make);
    this.#checks = new Helper(make);
    this.#files = files;
    this.#tell = tell;
  }

  /// Sets { module, shipped }, from which the engines of the workers are made.
  set start(start) {
    this.#tests.start = start;
    this.#checks.start = start;
  }

  end() {
    this.#tests.end();
    this.#checks.end();
  }

  /// Handles a message of the page. False: the message is for the engine.
  takes(text) {
    if (text.startsWith('{"do":"test"')) this.#test(JSON.parse(text));
    else if (text.startsWith('{"do":"edit","what":"check"')) this.#check(JSON.parse(text));
    else return false;
    return true;
  }

  /// Runs scenarios with these files. Resolves to their results, as `read_report` gives them, and why none could be run.
  async results(files, file) {
    let report = "";
    const { errors } = await this.#tests.ask(files, "nezumi_run_scenarios", [file, ""], (said) => (report += said.startsWith(COVERAGE) ? "" : said));
    return { results: read_report(none_kept(report)), errors };
  }

  /// Answers a request. The answer is sent later, when the page already waits for it.
  #answer = (id, ok, text, more = {}) => queueMicrotask(() => this.#tell({ is: "answer", id, ok, text, ...more }));

  async #check({ id, file, text }) {
    let said = "";
    const { status, errors } = await this.#checks.ask(this.#files(), "nezumi_check", [file, text], (piece) => (said += piece));
    if (!said) return this.#answer(id, false, errors || String(status));
    this.#answer(id, true, "", { shown: file, findings: JSON.parse(said) });
  }

  async #list(id) {
    let said = "";
    const { status, errors } = await this.#tests.ask(this.#files(), "nezumi_list_scenarios", [], (piece) => (said += piece));
    const has_none = status !== 0 && said === "";
    this.#answer(id, status === 0, has_none ? errors : "", { content: said });
  }

  async #run({ file = "", name = "" }) {
    this.#is_running = true;
    let coverage = "";
    const { status, errors } = await this.#tests.ask(this.#files(), "nezumi_run_scenarios", [file, name], (said) => {
      if (said.startsWith(COVERAGE)) coverage = said.slice(COVERAGE.length);
      else this.#tell({ is: "tests", text: none_kept(said) });
    });
    this.#is_running = false;
    this.#tell({ is: "tests", done: true, problem: status > 1 ? errors : "", plots: {}, coverage });
  }

  #test({ id, what, file, name }) {
    if (what === "list") return this.#list(id);
    if (what === "recordings") return this.#answer(id, true, "", { content: "[]" });
    if (what === "stop") {
      if (this.#is_running) this.#tests.begin_anew();
      return this.#answer(id, true, "");
    }
    if (what !== "run") return this.#answer(id, false, what);
    if (this.#is_running) return this.#answer(id, false, "scenarios are running already: stop them first");
    this.#answer(id, true, "");
    this.#run({ file, name });
  }
}
