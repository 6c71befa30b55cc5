// A thread for scenarios or checks. It has its own engine, so that the engine of the page continues meanwhile.
importScripts("nezumi.js", "engine_files.js");

let start;   // { module, shipped }
let engine;
let errors = [];
let told = () => {};

function make() {
  return nezumi_engine({
    noInitialRun: true, print: () => {}, printErr: (line) => errors.push(line), send: (text) => told(text),
    instantiateWasm: (imports, take) => {
      WebAssembly.instantiate(start.module, imports).then((instance) => take(instance, start.module));
      return {};
    },
  });
}

function remove(path) {
  if (!engine.FS.analyzePath(path).exists) return;
  for (const name of engine.FS.readdir(path)) {
    if (name === "." || name === "..") continue;
    const child = `${path}/${name}`;
    if (engine.FS.isDir(engine.FS.stat(child).mode)) remove(child);
    else engine.FS.unlink(child);
  }
  engine.FS.rmdir(path);
}

async function work({ id, files, call, words }) {
  if (!engine) {
    engine = await make();
    write_files(engine, "/share/nezumi", start.shipped);
  }
  engine.FS.chdir("/");
  remove("/project");
  engine.FS.mkdirTree("/project");
  write_files(engine, "/project", files);
  engine.FS.chdir("/project");
  errors = [];
  told = (said) => postMessage({ id, said });
  const status = engine.ccall(call, "number", words.map(() => "string"), words);
  postMessage({ id, status, errors: errors.join("\n") });
}

// Runs requests one after the other, because the first may still wait for the engine.
let last = Promise.resolve();
onmessage = ({ data }) => {
  if (data.start) start = data.start;
  else last = last.then(() => work(data)).catch((wrong) => postMessage({ id: data.id, status: 2, errors: String(wrong) }));
};
