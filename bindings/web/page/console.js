// The console: the protocol of `nezumi attach`, with history and completion.
import { el } from "./dom.js";
import { T } from "./texts.js";

const MOST_LINES = 2000;
const MOST_KEPT = 200;

/// The number of UTF-8 bytes of a text; the protocol counts positions in bytes.
const bytes_of = (text) => new TextEncoder().encode(text).length;
/// The index of the text after the first `count` bytes.
function index_at(text, count) {
  return new TextDecoder().decode(new TextEncoder().encode(text).slice(0, count)).length;
}

class History {
  #lines = JSON.parse(localStorage.getItem("nezumi.history") ?? "[]");
  #at = this.#lines.length;
  #begun = "";

  add(line) {
    if (line && this.#lines[this.#lines.length - 1] !== line) this.#lines.push(line);
    this.#lines = this.#lines.slice(-MOST_KEPT);
    localStorage.setItem("nezumi.history", JSON.stringify(this.#lines));
    this.#at = this.#lines.length;
  }

  /// The previous line (-1) or the next one (1), or null at the end.
  go(step, present) {
    const next = this.#at + step;
    if (next < 0 || next > this.#lines.length) return null;
    if (this.#at === this.#lines.length) this.#begun = present;
    this.#at = next;
    return next === this.#lines.length ? this.#begun : this.#lines[next];
  }
}

export function make_console(parts) {
  const { link, model, notices } = parts;
  const history = new History();
  const waiting = new Map();  // id: function for the answer
  let next = 1;
  let running = 0;
  let drawing = null;  // the output that the next drawing replaces

  const output = el("div", { class: "output", role: "log", "aria-label": T.console.label, tabindex: 0 });
  const input = el("textarea", { rows: 1, placeholder: T.console.input, "aria-label": T.console.input, spellcheck: "false",
    autocapitalize: "off", autocomplete: "off" });
  const found = el("div", { class: "found", role: "listbox", hidden: true });
  const run = el("button", { text: T.console.run, onclick: () => send() });
  const interrupt = el("button", { text: T.console.interrupt, disabled: true, onclick: () => stop() });
  const clear = el("button", { class: "quiet", text: T.console.clear, onclick: () => output.replaceChildren() });

  const say = (text, kind) => {
    const is_low = output.scrollHeight - output.scrollTop - output.clientHeight < 40;
    const line = output.appendChild(el("pre", { class: kind, text }));
    while (output.children.length > MOST_LINES) output.firstChild.remove();
    if (is_low) output.scrollTop = output.scrollHeight;
    return line;
  };
  const ask = (request, answered) => {
    const id = next++;
    if (!link.send({ do: "console", request: { ...request, id } })) return notices.say(T.link.connecting, "warn");
    waiting.set(id, answered);
  };
  const show_running = () => {
    interrupt.disabled = running === 0;
    input.classList.toggle("waits", running > 0);
  };
  const stop = () => link.send({ do: "console", request: { do: "interrupt" } });

  let last_error = "";
  const evaluate = (text, answered = () => {}) => {
    say(text, "asked");
    drawing = null;
    running += 1;
    show_running();
    last_error = "";
    ask({ do: "eval", text }, (answer) => {
      running -= 1;
      drawing = null;
      show_running();
      if (answer.ok) model.emit("console_line", text);
      answered(answer);
    });
  };
  const send = () => {
    const text = input.value.trimEnd();
    if (!text) return;
    history.add(text);
    input.value = "";
    fit();
    evaluate(text);
  };
  /// Runs a console line for another view. Resolves to { ok, text }, where text is the error.
  parts.run_line = (text) => new Promise((resolve) => {
    if (!link.is_open) return resolve({ ok: false, text: T.link.no_answer });
    evaluate(text, ({ ok }) => resolve({ ok, text: last_error }));
  });
  /// Sends a request for another view, such as for completions. Resolves to the answer.
  parts.ask_console = (request) => new Promise((resolve) => {
    if (!link.is_open) return resolve({});
    ask(request, resolve);
  });
  /// Sends the input if it is complete; otherwise it continues on the next line.
  const send_when_whole = () => {
    const text = input.value;
    ask({ do: "is_complete", text }, ({ ok }) => {
      if (input.value !== text) return;
      if (ok) return send();
      put(`${text}\n`);
    });
  };
  const put = (text, cursor = text.length) => {
    input.value = text;
    input.setSelectionRange(cursor, cursor);
    fit();
  };
  const fit = () => {
    input.rows = Math.min(8, input.value.split("\n").length);
  };

  const complete = () => {
    const text = input.value;
    const cursor = input.selectionStart;
    ask({ do: "complete", text, cursor: bytes_of(text.slice(0, cursor)) }, ({ from = 0, items = [] }) => {
      if (input.value !== text || input.selectionStart !== cursor || items.length === 0) return;
      const begin = index_at(text, from);
      const use = (item) => {
        put(text.slice(0, begin) + item + text.slice(cursor), begin + item.length);
        hide();
        input.focus();
      };
      let common = items[0];
      for (const item of items) while (!item.startsWith(common)) common = common.slice(0, -1);
      if (items.length === 1) return use(items[0]);
      if (common.length > cursor - begin) put(text.slice(0, begin) + common + text.slice(cursor), begin + common.length);
      const present = input.value;
      found.replaceChildren(...items.slice(0, 200).map((item) => el("button", { role: "option", text: item, onclick: () => {
        if (input.value === present) put(present.slice(0, begin) + item + text.slice(cursor), begin + item.length);
        hide();
        input.focus();
      } })));
      found.hidden = false;
    });
  };
  const hide = () => {
    found.hidden = true;
  };

  input.addEventListener("input", () => {
    hide();
    fit();
  });
  input.addEventListener("keydown", (event) => {
    const is_one_line = !input.value.includes("\n");
    if (event.key === "Tab" && !event.shiftKey && input.value.trim()) complete();
    else if (event.key === "Enter" && !event.shiftKey) send_when_whole();
    else if (event.key === "c" && event.ctrlKey && input.selectionStart === input.selectionEnd) stop();
    else if (event.key === "l" && event.ctrlKey) output.replaceChildren();
    else if (event.key === "Escape") hide();
    else if ((event.key === "ArrowUp" || event.key === "ArrowDown") && is_one_line) {
      const line = history.go(event.key === "ArrowUp" ? -1 : 1, input.value);
      if (line !== null) put(line);
    } else return;
    event.preventDefault();
  });

  model.on("console", ({ event }) => {
    if (event.is === "answer" || event.is === "completions") {
      waiting.get(event.id)?.(event);
      waiting.delete(event.id);
    } else if (event.is === "output" && event.level === "in_place") {
      if (drawing?.isConnected) drawing.textContent = event.text;
      else drawing = say(event.text, "output");
    } else if (event.is === "output" || event.is === "error") {
      drawing = null;
      if (event.is === "error") last_error = event.text;
      say(event.text, event.is);
    } else if (event.is === "bye") say(event.text, "error");
  });
  link.on("lost", () => {
    waiting.clear();
    running = 0;
    show_running();
  });

  say(T.console.hello, "hint");
  return { node: el("div", { class: "console" }, output, found,
    el("div", { class: "line acts" }, el("span", { class: "prompt", "aria-hidden": "true", text: "❯" }), input, run, interrupt, clear)) };
}
