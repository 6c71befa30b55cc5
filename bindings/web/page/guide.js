// The guided tutorial, with a project of its own: each step says what to type, and a scenario checks the result.
import { el } from "./dom.js";
import { language, T } from "./texts.js";

const W = T.playground.guide;
const BEHAVIOR = "behaviors/keep_distance.lua", SYSTEM = "behaviors/systems/keep_distance.lua", TEST = "tests/keep_distance_test.lua";
const STEPS = [{ name: "behavior", file: BEHAVIOR }, { name: "system", file: SYSTEM }, { name: "change" }, { name: "test", file: TEST }];
const CHECK = "tests/guide_test.lua";

/// A behaviour that does nothing, and a system without it.
export function guided_project({ files }) {
  const texts = files[language];
  const world = texts[SYSTEM].split("\n").filter((line) => !/^(behavior|connect)\b/.test(line)).join("\n");
  return { name: "keep_distance", system: SYSTEM, guide: { step: 0 }, files: { [SYSTEM]: `${world.trim()}\n`, [BEHAVIOR]: "function on_execute()\nend\n" } };
}

const why = ({ results, errors }) => {
  const failed = results.find(({ state }) => state !== "passed");
  return failed ? [failed.message, ...failed.lines.slice(0, 3)].filter(Boolean).join("\n") : results.length === 0 ? errors || W.too_few : "";
};

/// Checks a step. Resolves to the problem, or "".
async function look_at(step, guide, files, helpers) {
  if (step.name !== "test") {
    const system = guide.files[language][SYSTEM];
    return why(await helpers.results({ ...files, [CHECK]: guide.checks[step.name], "behaviors/systems/guide.lua": system }, CHECK));
  }
  if (!files[TEST]) return W.too_few;
  const own = why(await helpers.results(files, TEST));
  if (own) return own;
  const slow = files[BEHAVIOR].replace(/("gain",\s*)[\d.]+/, "$10.1");
  return why(await helpers.results({ ...files, [BEHAVIOR]: slow }, TEST)) ? "" : W.too_good;
}

/// The panel of a guided project. `keep` stores the number of the present step.
export function make_guide(guide, project, helpers, keep) {
  const node = el("aside", { class: "guide", "aria-label": W.begin });
  document.body.classList.add("guided");
  const show = () => {
    const number = project.guide.step;
    const step = STEPS[number];
    if (!step) return node.replaceChildren(el("p", { class: "good", text: W.done }));
    const { title, text } = W.steps[step.name];
    const code = step.file && guide.files[language][step.file];
    const told = el("p", { role: "status" });
    const next = el("button", { class: "primary", text: W.next, hidden: true, onclick: () => {
      project.guide.step = number + 1;
      keep();
      show();
    } });
    const check = el("button", { class: "primary check-step", text: W.check, onclick: async () => {
      check.disabled = true;
      told.className = "";
      told.textContent = W.checking;
      const wrong = await look_at(step, guide, project.files, helpers);
      told.className = wrong ? "wrong" : "good";
      told.textContent = wrong ? W.failed(wrong) : W.passed;
      next.hidden = Boolean(wrong);
      check.disabled = false;
    } });
    node.replaceChildren(el("small", { text: W.of(number + 1, STEPS.length) }), el("h2", { text: title }), el("p", { text }),
      ...(code ? [el("div", { class: "row" }, el("small", { text: W.file(step.file) }), el("button", { class: "quiet", text: W.copy, onclick: () => navigator.clipboard?.writeText(code) })), el("pre", { text: code })] : []),
      el("div", { class: "row" }, check, next), told);
  };
  show();
  return node;
}
