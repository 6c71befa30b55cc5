// The difference of two texts, line by line.
import { el } from "./dom.js";
import { T } from "./texts.js";

const AROUND = 3;  // equal lines that are shown around different ones
const MOST = 4e6;  // cells of the table of lengths; larger parts count as completely different

/// Rows [sign, line]: " " in both, "-" only in the first text, "+" only in the second.
export function difference(first, second) {
  const a = first.split("\n");
  const b = second.split("\n");
  let begin = 0;
  while (begin < a.length && begin < b.length && a[begin] === b[begin]) begin += 1;
  let end = 0;
  while (end < a.length - begin && end < b.length - begin && a[a.length - 1 - end] === b[b.length - 1 - end]) end += 1;
  const left = a.slice(begin, a.length - end);
  const right = b.slice(begin, b.length - end);
  return [...a.slice(0, begin).map((line) => [" ", line]), ...middle(left, right), ...a.slice(a.length - end).map((line) => [" ", line])];
}

/// The rows between the equal beginnings and ends, by the longest common subsequence.
function middle(a, b) {
  if (a.length * b.length > MOST) return [...a.map((line) => ["-", line]), ...b.map((line) => ["+", line])];
  const width = b.length + 1;
  const length = new Uint32Array((a.length + 1) * width);
  for (let i = a.length - 1; i >= 0; --i) {
    for (let j = b.length - 1; j >= 0; --j)
      length[i * width + j] = a[i] === b[j] ? length[(i + 1) * width + j + 1] + 1 : Math.max(length[(i + 1) * width + j], length[i * width + j + 1]);
  }
  const rows = [];
  for (let i = 0, j = 0; i < a.length || j < b.length;) {
    if (i < a.length && j < b.length && a[i] === b[j]) {
      rows.push([" ", a[i]]);
      i += 1;
      j += 1;
    } else if (j === b.length || (i < a.length && length[(i + 1) * width + j] >= length[i * width + j + 1])) rows.push(["-", a[i++]]);
    else rows.push(["+", b[j++]]);
  }
  return rows;
}

/// Shows the difference; equal parts are shortened.
export function show_difference(first, second) {
  const rows = difference(first, second);
  if (rows.every(([sign]) => sign === " ")) return el("p", { class: "hint", text: T.editor.no_difference });
  const is_near = rows.map((_, i) => rows.slice(Math.max(0, i - AROUND), i + AROUND + 1).some(([sign]) => sign !== " "));
  const nodes = [];
  rows.forEach(([sign, line], i) => {
    if (is_near[i]) nodes.push(el("div", { class: { "-": "gone", "+": "came", " ": "same" }[sign] }, el("span", { class: "sign", text: sign }), el("span", { text: line || " " })));
    else if (i === 0 || is_near[i - 1]) nodes.push(el("div", { class: "skipped", text: "⋯" }));
  });
  return el("div", { class: "difference", role: "group", "aria-label": T.editor.difference, tabindex: 0 }, ...nodes);
}
