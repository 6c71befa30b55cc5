// Short messages over the page: some vanish after a time, others stay until they are no longer true.
import { el } from "./dom.js";
import { T } from "./texts.js";

const SHOWN_FOR = 7000;  // ms
const MOST = 4;

export class Notices {
  node = el("div", { class: "notices", role: "status", "aria-live": "polite" });
  #lasting = new Map();

  /// `more`: a button beside the text, { text, press }.
  say(text, kind = "info", more = null) {
    const node = this.#show(text, kind);
    const press = () => {
      node.remove();
      more.press();
    };
    if (more) node.append(el("button", { text: more.text, onclick: press }));
    node.append(el("button", { class: "quiet", "aria-label": T.close, text: "×", onclick: () => node.remove() }));
    setTimeout(() => node.remove(), SHOWN_FOR);
    const passing = this.node.querySelectorAll(".notice:not(.lasting)");
    if (passing.length > MOST) passing[0].remove();
  }

  lasting(key, text, kind) {
    this.#lasting.get(key)?.remove();
    const node = this.#show(text, kind);
    node.classList.add("lasting");
    this.#lasting.set(key, node);
  }

  /// Removes a lasting message, and shows `text` if there was one.
  clear_lasting(key, text) {
    const node = this.#lasting.get(key);
    if (!node) return;
    node.remove();
    this.#lasting.delete(key);
    this.say(text);
  }

  #show(text, kind) {
    const node = el("div", { class: `notice ${kind}` }, el("span", { text }));
    this.node.append(node);
    return node;
  }
}
