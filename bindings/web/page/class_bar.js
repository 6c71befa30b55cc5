// The bar of a pupil's page in a class: exercise, hints, checks, mark, and what the teacher does.
import { el } from "./dom.js";
import { make_shared } from "./class_shared.js";
import { language, T } from "./texts.js";

/// The code "abcdef" in the form that people read: "abc-def".
export const shown_code = (code) => `${code.slice(0, 3)}-${code.slice(3)}`;

/// The text of an exercise in the page's language.
export const in_language = (english, japanese) => (language === "ja" && japanese ? japanese : english);

/// Markdown as exercises use it: headings, lists, code, paragraphs, `code` and **words** in lines.
export function markdown(text) {
  const inline = (line) => line.split(/(`[^`]+`|\*\*[^*]+\*\*)/).map((part) => {
    if (/^`.+`$/.test(part)) return el("code", { text: part.slice(1, -1) });
    if (/^\*\*.+\*\*$/.test(part)) return el("b", { text: part.slice(2, -2) });
    return part;
  });
  const blocks = [];
  for (const [i, part] of text.split(/^```.*$/m).entries()) {
    if (i % 2 === 1) {
      blocks.push(el("pre", { text: part.replace(/^\n|\n$/g, "") }));
      continue;
    }
    for (const block of part.split(/\n\s*\n/).map((each) => each.trim()).filter(Boolean)) {
      const lines = block.split("\n");
      const heading = /^(#+) (.*)/.exec(block);
      if (heading) blocks.push(el(heading[1].length === 1 ? "h2" : "h3", {}, ...inline(heading[2])));
      else if (/^([-*]|\d+\.) /.test(block)) {
        const items = block.split(/\n(?=(?:[-*]|\d+\.) )/).map((item) => item.replace(/^([-*]|\d+\.) /, "").replaceAll("\n", " "));
        blocks.push(el(/^\d/.test(block) ? "ol" : "ul", {}, ...items.map((item) => el("li", {}, ...inline(item)))));
      } else blocks.push(el("p", {}, ...inline(lines.join(" "))));
    }
  }
  return blocks;
}

function make_bar({ link, notices }) {
  document.head.append(el("link", { rel: "stylesheet", href: "class.css" }));
  const title = el("b", {});
  const who = el("span", { class: "pupil" });
  const code = el("span", { class: "code", title: T.class.bar.code_hint });
  const told = el("span", { class: "told" });
  const mark = el("span", { class: "mark-text" });
  const frozen = el("span", { class: "frozen", role: "alert", text: T.class.bar.frozen, hidden: true });
  const again = el("button", { text: T.class.bar.again, onclick: () => request("restart") });
  const why = el("span", {});
  const broken = el("p", { class: "broken", role: "alert", hidden: true }, why, again);
  const check = el("button", { class: "check acts", onclick: () => request("check") });
  const results = el("div", { class: "results" });
  const text = el("div", { class: "task-text" });
  const hints = el("div", { class: "hints" });
  const open = el("details", { class: "task" }, el("summary", { text: T.class.bar.exercise }), el("div", { class: "task-sheet" }, text, hints, results));
  const leave = el("button", { class: "quiet", text: T.class.bar.leave, title: T.class.bar.leave_hint, onclick: () => {
    sessionStorage.removeItem("nezumi.token");
    location.assign("/");
  } });
  const shared = make_shared({ request: (what) => request(what), link, notices });
  const node = el("section", { class: "class-bar" }, title, open, check, code, who, told, mark, frozen, shared.node, leave, broken);
  document.body.querySelector("header").after(node);
  document.body.classList.add("in-class");
  // Notices are shown below the bar, so that they don't hide the buttons of the bar.
  new ResizeObserver(() => (notices.node.style.top = `${node.getBoundingClientRect().bottom + 8}px`)).observe(node);
  let hints_before = -1;
  let text_before = null;

  async function request(what) {
    const { ok, text: reason } = await link.ask({ do: "class", what });
    if (!ok && reason) notices.say(reason, "error");
  }

  function show_results({ check: state, checked = [], hidden = { count: 0 } }) {
    check.disabled = state === "waits" || state === "runs";
    check.textContent = state === "runs" ? T.class.bar.checking : state === "waits" ? T.class.bar.waits : T.class.bar.check;
    const all = checked.length + hidden.count;
    results.replaceChildren(
      ...(state && !check.disabled ? [el("p", { class: "wrong", text: T.class.bar.could_not(state) })] : []),
      all ? el("ul", {}, ...checked.map(({ name, passed }) => el("li", { class: passed ? "passed" : "failed", text: name })),
        hidden.count ? el("li", { class: hidden.passed === hidden.count ? "passed" : "failed", text: T.class.bar.hidden(hidden.passed, hidden.count) }) : null)
        : el("p", { class: "hint", text: T.class.bar.not_checked }));
  }

  return (state) => {
    const own = state.role === "pupil";
    const at_shared = state.role === "guest" || state.role === "shared";
    shared.show(state.shared, at_shared);
    frozen.hidden = !state.frozen;
    if (at_shared) {
      title.textContent = T.class.shared.title(state.shared.name);
      document.body.classList.toggle("guest", state.role === "guest");
      check.hidden = open.hidden = code.hidden = leave.hidden = broken.hidden = true;
      return;
    }
    const written = in_language(state.text ?? "", state.text_ja ?? "");
    const [first, ...rest] = written.split("\n");
    title.textContent = own || state.role === "helper" ? first.replace(/^#+ /, "") : T.class.bar.of(state.name);
    who.textContent = own ? state.name : state.role === "helper" ? T.class.bar.of(state.name) : "";
    code.hidden = !own;
    leave.hidden = !own;
    if (own) code.textContent = T.class.bar.code(shown_code(state.code));
    told.textContent = [own && state.helps && T.class.bar.helps, own && state.looks && T.class.bar.looks, own && state.projected && T.class.bar.projected].filter(Boolean).join(" · ");
    mark.textContent = state.mark ? T.class.bar.mark(state.mark) : "";
    document.body.classList.toggle("frozen", state.frozen && own);
    broken.hidden = !state.broken;
    why.textContent = T.class.bar.broken(state.broken);
    check.hidden = open.hidden = state.role === "spectator";
    if (state.role === "spectator") return;
    show_results(state);
    if (written !== text_before) {
      text.replaceChildren(...markdown(rest.join("\n")));
      open.open = own && text_before !== null && text_before !== written;  // opens the text of a new exercise
      text_before = written;
    }
    hints.replaceChildren(...(state.hints.length ? [el("h3", { text: T.class.bar.hints }), ...state.hints.map((hint) => el("p", { text: hint }))] : []),
      ...(state.comment ? [el("h3", { text: T.class.bar.comment }), el("p", { class: "comment", text: state.comment })] : []));
    if (own && hints_before >= 0 && state.hints.length > hints_before) notices.say(T.class.bar.new_hint(state.hints.at(-1)), "good");
    hints_before = state.hints.length;
  };
}

let show = null;

/// Shows the state of the class; the first call makes the bar.
export function show_class(parts, state) {
  show ??= make_bar(parts);
  show(state);
}
