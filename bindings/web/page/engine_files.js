// The files of the engine's program. A script, not a module: a worker loads it beside nezumi.js, and node requires it.

/// Writes files into the program's file system: texts, or { base64 } for others.
function write_files(engine, folder, files) {
  for (const [name, content] of Object.entries(files)) {
    const path = `${folder}/${name}`;
    engine.FS.mkdirTree(path.slice(0, path.lastIndexOf("/")));
    engine.FS.writeFile(path, typeof content === "string" ? content : bytes_of(content.base64));
  }
}

const bytes_of = (base64) => Uint8Array.from(atob(base64), (each) => each.charCodeAt(0));

/// The files below a folder that have changed since `known` (times of change by path), which is brought up to date.
function changed_files(engine, folder, known) {
  const changed = {};
  const look = (path) => {
    for (const name of engine.FS.readdir(path)) {
      if (name.startsWith(".")) continue;  // hidden files, such as kept versions
      const child = `${path}/${name}`;
      const { mode, mtime } = engine.FS.stat(child);
      if (engine.FS.isDir(mode)) {
        look(child);
      } else if (known.get(child) !== mtime.getTime()) {
        known.set(child, mtime.getTime());
        changed[child.slice(folder.length + 1)] = text_or_bytes(engine.FS.readFile(child));
      }
    }
  };
  look(folder);
  return changed;
}

function text_or_bytes(bytes) {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return { base64: btoa(String.fromCharCode(...bytes)) };
  }
}

if (typeof module === "object") module.exports = { write_files };
