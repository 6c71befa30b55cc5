// Debian's CodeMirror, loaded when the editor is first used.

const HOME = new URL("./lib/codemirror/", import.meta.url).href;
const SCRIPTS = ["lib/codemirror.js", "mode/lua/lua.js", "addon/hint/show-hint.js", "addon/edit/matchbrackets.js", "addon/comment/comment.js",
  "addon/search/searchcursor.js", "addon/dialog/dialog.js", "addon/search/search.js"];
const STYLES = [`${HOME}lib/codemirror.css`, `${HOME}addon/hint/show-hint.css`, `${HOME}addon/dialog/dialog.css`, new URL("./editor.css", import.meta.url).href];

function load(node) {
  return new Promise((resolve, reject) => {
    node.onload = resolve;
    node.onerror = () => reject(new Error(`${node.src || node.href} is missing`));
    document.head.append(node);
  });
}

/// Resolves to CodeMirror; fails if the library is not installed.
export async function load_editor_library() {
  if (globalThis.CodeMirror) return globalThis.CodeMirror;
  // The scripts load at the same time and run in their order.
  await Promise.all([...STYLES.map((href) => load(Object.assign(document.createElement("link"), { rel: "stylesheet", href }))),
    ...SCRIPTS.map((name) => load(Object.assign(document.createElement("script"), { src: HOME + name, async: false })))]);
  return globalThis.CodeMirror;
}
