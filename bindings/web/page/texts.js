// The page's texts, in the language that a person chose in the bar, or else in the first one of the browser's that there is.
import { el } from "./dom.js";
import { EN } from "./texts_en.js";
import { JA } from "./texts_ja.js";

const TABLES = { en: EN, ja: JA };
const KEPT = "nezumi.language";

/// Names of the languages, each in its own.
export const LANGUAGES = { en: "English", ja: "日本語" };
export const language = [localStorage.getItem(KEPT), ...navigator.languages.map((each) => each.split("-")[0])].find((each) => Object.hasOwn(TABLES, each)) ?? "en";
export const T = TABLES[language];
document.documentElement.lang = language;

/// Shows the page again in the next language, whose name it has.
export function make_language_button() {
  const all = Object.keys(LANGUAGES);
  const next = all[(all.indexOf(language) + 1) % all.length];
  return el("button", { class: "quiet language", lang: next, text: LANGUAGES[next], title: T.language, onclick: () => {
    localStorage.setItem(KEPT, next);
    location.reload();
  } });
}
