// Questions over the page: unlike the browser's own they leave the emergency stop in reach, and the world goes on.
import { el } from "./dom.js";
import { T } from "./texts.js";

/// Resolves to true or false, or where a `value` is offered to a text, null for none. `yes` is what the button says.
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
