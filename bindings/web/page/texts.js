// The page's texts, in the language that a person has chosen in the bar, or else in the browser's first language that the
// page has.
import { el } from "./dom.js";
import { EN } from "./texts_en.js";
import { JA } from "./texts_ja.js";

const TABLES = { en: EN, ja: JA };
const KEPT = "nezumi.language";

/// The name of each language, in this language.
export const LANGUAGES = { en: "English", ja: "日本語" };
export const language = [localStorage.getItem(KEPT), ...navigator.languages.map((each) => each.split("-")[0])].find((each) => Object.hasOwn(TABLES, each)) ?? "en";
export const T = TABLES[language];
document.documentElement.lang = language;

/// The button that shows the page in the next language. It has the name of that language.
export function make_language_button() {
  const all = Object.keys(LANGUAGES);
  const next = all[(all.indexOf(language) + 1) % all.length];
  return el("button", { class: "quiet language", lang: next, text: LANGUAGES[next], title: T.language, onclick: () => {
    localStorage.setItem(KEPT, next);
    location.reload();
  } });
}
