// Checks of the page's texts: run within the page. Both languages have the same, each is used, and none is beside the
// tables. Returns how many texts there are, or throws.
const { EN } = await import("/texts_en.js");
const { JA } = await import("/texts_ja.js");
const { LANGUAGES } = await import("/texts.js");

const wrong = [];

/// "views.world" to its text, for all of a table.
const texts_of = (table, before = "") => Object.entries(table).flatMap(([key, text]) =>
  text !== null && typeof text === "object" ? texts_of(text, `${before}${key}.`) : [[before + key, text]]);
const given = (text) => (typeof text === "function" ? `text of ${text.length}` : typeof text);

const english = new Map(texts_of(EN));
const japanese = new Map(texts_of(JA));
for (const [key, text] of english) {
  if (!japanese.has(key)) wrong.push(`texts_ja.js has no ${key}`);
  else if (given(text) !== given(japanese.get(key))) wrong.push(`${key} is a ${given(text)} in English and a ${given(japanese.get(key))} in Japanese`);
}
for (const key of japanese.keys()) if (!english.has(key)) wrong.push(`texts_en.js has no ${key}`);
if (Object.keys(LANGUAGES).join() !== "en,ja") wrong.push(`the languages are ${Object.keys(LANGUAGES)}`);

/// The pages' own modules, from the first one of each page on.
const sources = new Map();
async function read(name) {
  if (sources.has(name)) return;
  sources.set(name, "");
  const text = await (await fetch(`/${name}`)).text();
  sources.set(name, text);
  await Promise.all([...text.matchAll(/"\.\/([a-z_]+\.js)"/g)].map((found) => read(found[1])));
}
for (const first of ["main.js", "class.js", "join.js", "playground.js", "light_run.js"]) await read(first);
if (sources.size < 50) wrong.push(`only ${sources.size} modules were found`);

const LITERAL = /"(?:[^"\\\n]|\\.)*"|`(?:[^`\\$]|\\.|\$(?!\{)|\$\{[^{}]*\})*`/g;
const SHOWN = /(?:\b(?:text|title|placeholder|label|textContent)|"aria-label")\s*[:=]\s*$|\bsay\($|\blasting\("\w+", $|(?<![.\w])ask\($|setAttribute\("(?:title|aria-label)", $/;
const SENTENCE = /[A-Z][a-z]+ [a-z]|[a-z] [a-z]+[.!?]$/;
const UNITS = /^(?:m|cm|s|ms|rad|Hz|nezumi)$/;
const used = new Set();
for (const [name, source] of sources) {
  if (/^texts_[a-z]+\.js$/.test(name)) continue;
  const code = source.replace(/^\s*\/\/.*$/gm, "").replace(/\s\/\/ .*$/gm, "");
  for (const [, key] of code.matchAll(/\bT\.([a-z_]+(?:\.[a-z_A-Z]+)*)/g)) {
    used.add(key);
    const text = key.split(".").reduce((table, each) => table?.[each], EN);
    if (text === undefined) wrong.push(`${name} shows T.${key}, which is not a text`);
  }
  for (const found of code.matchAll(LITERAL)) {
    const before = code.slice(Math.max(0, found.index - 60), found.index);
    const words = found[0].slice(1, -1).replace(/\$\{[^{}]*\}/g, " ").match(/[A-Za-z]{2,}|(?<![A-Za-z])[a-z](?![A-Za-z])/g) ?? [];
    const is_shown = SHOWN.test(before) && words.some((each) => !UNITS.test(each));
    if (is_shown || (SENTENCE.test(found[0].slice(1, -1)) && !/Error\($/.test(before))) wrong.push(`${name} has a text of its own: ${found[0]}`);
  }
}
for (const key of english.keys()) {
  const parts = key.split(".");
  if (!parts.some((_, i) => used.has(parts.slice(0, i + 1).join(".")))) wrong.push(`nothing shows T.${key}`);
}
if (wrong.length > 0) throw new Error(wrong.join("\n"));
return english.size;
