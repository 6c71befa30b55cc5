// Dialogs of the page. Unlike the browser's own, they do not block the emergency stop or the view of the world.
import { el } from "./dom.js";
import { T } from "./texts.js";

/// Resolves to true or false; if a `value` is given, to a text or null. `yes` is the label of the button.
export function ask(question, yes, value) {
  return new Promise((resolve) => {
    const field = value === undefined ? null : el("input", { type: "text", value, "aria-label": question, autocomplete: "off" });
    const go = el("button", { type: "submit", class: "primary", text: yes });
    const end = (answer) => {
      sheet.remove();
      resolve(answer);
    };
    const leave = () => end(field ? null : false);
    const form = el("form", { onsubmit: (event) => {
      event.preventDefault();
      end(field ? field.value : true);
    } }, el("p", { text: question }), field, el("div", { class: "row" }, go, el("button", { type: "button", text: T.cancel, onclick: leave })));
    const sheet = el("dialog", { class: "over ask", onkeydown: ({ key }) => key === "Escape" && leave() }, form);
    document.body.append(sheet);
    sheet.show();
    (field ?? go).focus();
  });
}
