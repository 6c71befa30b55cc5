// The engine's thread: handles the page's messages, and runs ticks when they are due.
let program;  // the module, compiled while the page still loads
if (typeof nezumi_engine === "undefined") {  // otherwise the three scripts are one file, and the page sends the program
  program = compiled();
  importScripts("nezumi.js", "engine_files.js");
}

const SLICE = 0.012;  // [s] of work before messages are handled again
const LOOK_PERIOD = 300;  // [ms] between two checks of the project's files for changes

let engine;
let due = null;
let looked = 0;
const known = new Map();

const soon = new MessageChannel();  // runs a turn immediately; a timer of 0 ms would wait 4 ms
soon.port1.onmessage = go_on;

/// Runs the next turn after this time [ms]. Only one turn waits at a time.
function go_on_after(ms) {
  clearTimeout(due);
  due = null;
  if (ms <= 0) soon.port2.postMessage(0);
  else due = setTimeout(go_on, ms);
}

function go_on() {
  const wait = engine.ccall("nezumi_go_on", "number", ["number"], [SLICE]);
  const now = performance.now();
  if (now - looked > LOOK_PERIOD) {
    looked = now;
    const saved = changed_files(engine, "/project", known);
    if (Object.keys(saved).length > 0) postMessage({ saved });
  }
  if (wait < 0) postMessage({ ended: true });
  else go_on_after(wait * 1000);
}

/// Sends the compiled module to the page, whose helpers make their engines from it.
function instantiateWasm(imports, take) {
  program.then(async (module) => {
    postMessage({ module });
    take(await WebAssembly.instantiate(module, imports), module);
  }).catch((wrong) => postMessage({ refused: String(wrong) }));
  return {};
}

/// Compiles the program. Streaming needs the right content type, which some servers do not send.
async function compiled() {
  const answer = await fetch("nezumi.wasm");
  if (answer.headers.get("content-type")?.startsWith("application/wasm")) return WebAssembly.compileStreaming(answer);
  return WebAssembly.compile(await answer.arrayBuffer());
}

/// `start`: { wasm?, shipped, project, system or journal }: the program if it is not beside this file, files by name, and the system
/// file, or the text of a run to repeat.
async function open({ start }) {
  const errors = [];
  engine = await nezumi_engine({
    noInitialRun: true, printErr: (line) => errors.push(line), send: (message) => postMessage({ message }, typeof message === "string" ? [] : [message]),
    ...(start.wasm ? { wasmBinary: start.wasm } : { instantiateWasm }),
  });
  write_files(engine, "/share/nezumi", start.shipped);
  engine.FS.mkdirTree("/project");
  write_files(engine, "/project", start.project);
  engine.FS.chdir("/project");
  changed_files(engine, "/project", known);
  postMessage({ opened: true });
  if (start.journal !== undefined) engine.FS.writeFile("/run.journal", start.journal);
  const status = start.journal !== undefined ? engine.ccall("nezumi_open_run", "number", ["string"], ["/run.journal"])
    : engine.ccall("nezumi_open", "number", ["string"], [start.system]);
  if (status !== 0) return postMessage({ refused: errors.join("\n") });
  go_on();
}

onmessage = ({ data }) => {
  if (data.start) return open(data);
  if (data.startsWith('{"do":"edit","what":"save"')) looked = 0;  // checks the files soon, for the helpers
  engine.ccall("nezumi_receive", null, ["string"], [data]);
  clearTimeout(due);
  if (due !== null) go_on_after(0);
};
