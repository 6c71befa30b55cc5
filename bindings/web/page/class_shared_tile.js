// The shared system in the teacher's page: who drives, who waits, and for how long.
import { el } from "./dom.js";
import { who_drives } from "./class_shared.js";
import { T } from "./texts.js";

/// `request` sends a request to the class. The tile is hidden while the class has no shared system.
export function make_shared_tile(request) {
  const { shared: words } = T.class;
  const order = (go, more = {}) => request("shared", { go, ...more });
  const name = el("span", {});
  const real = el("small", {});
  const error = el("p", { class: "error-text" });
  const facts = el("p", { class: "facts" });
  const queue = el("ol", {});
  const nobody = el("p", { class: "hint", text: words.nobody });
  const open = el("a", { class: "button", target: "_blank", rel: "noopener", text: words.look });
  const limit = el("input", { type: "number", min: 1, max: 120, step: 1, onchange: () => order("limit", { minutes: Number(limit.value) }) });
  const end = el("button", { text: words.end, onclick: () => order("end") });
  const node = el("article", { class: "tile shared-tile", hidden: true }, el("h2", {}, name, real), error, facts, nobody, queue,
    el("div", { class: "row" }, open, end, el("button", { text: T.class.restart, onclick: () => order("restart") }),
      el("button", { text: T.class.projector, onclick: () => request("project", { pupil: number }) }), el("label", {}, words.limit, " ", limit)));
  let number = 0;
  let listed = "";

  function show(shared) {
    node.hidden = !shared;
    if (!shared) return;
    ({ number } = shared);
    node.className = `tile shared-tile ${shared.state}`;
    name.textContent = words.title(shared.name);
    real.textContent = shared.real ? words.real : "";
    error.textContent = shared.problem;
    error.hidden = !shared.problem;
    facts.replaceChildren(el("span", { text: T.class.states[shared.state] }), el("span", { text: who_drives(shared) }));
    end.disabled = !shared.driver;
    if (document.activeElement !== limit) limit.value = shared.limit;
    open.href = `/index.html#${shared.help}`;
    nobody.hidden = shared.waiting.length > 0;
    const now = JSON.stringify(shared.waiting);
    if (now === listed) return;  // unchanged rows are not made again, so that a button keeps the focus
    listed = now;
    queue.replaceChildren(...shared.waiting.map(({ number: pupil, name: text }, i) => el("li", {}, el("span", { text }), " ",
      i ? el("button", { text: words.up, onclick: () => order("up", { pupil }) }) : null, el("button", { text: words.remove, onclick: () => order("remove", { pupil }) }))));
  }
  return { node, show };
}
