// Joins a class by a name, or comes back by a code.
import { el } from "./dom.js";
import { Link } from "./link.js";
import { Socket } from "./socket.js";
import { make_language_button, T } from "./texts.js";

const link = new Link(new Socket("join"));
const problem = el("p", { class: "problem", role: "alert", hidden: true });

const show = (text) => {
  problem.textContent = text;
  problem.hidden = !text;
};

async function go(what) {
  const { ok, token, text } = await link.ask({ do: "class", ...what });
  if (!ok) return show(text || T.class.join.away);
  sessionStorage.removeItem("nezumi.token");
  location.assign(`/index.html#${token}`);
}

function make_form(label, hint, button, field, key) {
  return el("form", { onsubmit: (event) => {
    event.preventDefault();
    show("");
    go({ [key]: field.value });
  } }, el("label", {}, el("span", { text: label }), field), el("small", { text: hint }), el("button", { type: "submit", class: "primary", text: button }));
}

const name = el("input", { type: "text", name: "name", required: true, maxlength: 40, autocomplete: "off" });
const code = el("input", { type: "text", name: "code", required: true, maxlength: 12, autocomplete: "off", autocapitalize: "none", spellcheck: "false" });
document.body.append(el("main", { class: "join" }, el("h1", { text: T.class.join.title }), problem,
  make_form(T.class.join.name, T.class.join.name_hint, T.class.join.go, name, "name"), el("h2", { text: T.class.join.or }),
  make_form(T.class.join.code, T.class.join.code_hint, T.class.join.back, code, "code"), make_language_button()));
link.on("lost", () => show(T.class.join.away));
link.on("open", () => show(""));
link.connect();
name.focus();
