// The view of the editor. The editor itself is loaded when the view is first shown.
import { el } from "./dom.js";
import { T } from "./texts.js";

/// "behaviors/guide.lua:4:2: ..." in a message: { shown, line, column } or null.
export function place_in(text) {
  const found = /((?:[^\s:'"]+\/)*[^\s:'"/]+\.(?:lua|msg|idl)):(\d+)(?::(\d+))?/.exec(text ?? "");
  return found && { shown: found[1], line: Number(found[2]), column: Number(found[3] ?? 0) };
}

export function make_editor(parts) {
  const node = el("div", { class: "editor" }, el("p", { class: "empty", text: T.editor.loading }));
  let loaded = null;
  const load = () => {
    loaded ??= (async () => {
      try {
        const [{ load_editor_library }, { make_editor_view }] = await Promise.all([import("./editor_library.js"), import("./editor_view.js")]);
        const view = make_editor_view(parts, await load_editor_library());
        node.replaceChildren(...view.nodes);
        if (parts.model.hello) view.begin();
        else {
          const off = parts.model.on("hello", () => {
            off();
            view.begin();
          });
        }
        return view;
      } catch (wrong) {
        console.warn(wrong);
        node.replaceChildren(el("p", { class: "empty", text: T.missing("libjs-codemirror") }));
        return null;
      }
    })();
    return loaded;
  };
  /// Opens the file that messages show as `shown`, at a line, counted from 1.
  parts.open_file = async ({ shown, line, column }) => {
    parts.layout.choose("editor");
    (await load())?.open_shown(shown, line, column);
  };
  return { node, shown: async (is_shown) => {
    if (is_shown) load();
    if (loaded) (await loaded)?.shown(is_shown);
  } };
}
