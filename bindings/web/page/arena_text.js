// Changes the objects of the arena in the text of a system file. Comments and all other text stay as they are.
import { T } from "./texts.js";

const CALLS = /\b(box|wall|cylinder|marker|robot|arena)\b/g;
const NUMBER = String.raw`-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?`;

const written = (value) => String(Number(value.toFixed(4)));

/// The text with blanks instead of comments and the contents of strings.
function code_of(text) {
  return text.replace(/--\[(=*)\[[\s\S]*?\]\1\]|--[^\n]*|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'/g,
    (each) => (each.startsWith("--") ? each.replace(/[^\n]/g, " ") : each[0] + " ".repeat(each.length - 2) + each[0]));
}

function close_of(code, open) {
  let depth = 0;
  for (let i = open; i < code.length; ++i) {
    if ("{(".includes(code[i])) depth += 1;
    else if ("})".includes(code[i]) && --depth === 0) return i;
  }
  return -1;
}

/// The calls in CALLS that have a table: { word, name, line, from, to, open, close }.
export function calls_in(text) {
  const code = code_of(text);
  const calls = [];
  for (const found of code.matchAll(CALLS)) {
    const rest = /^\s*(\()?\s*(["'][^"'\n]*["'])?\s*,?\s*\{/.exec(code.slice(found.index + found[0].length));
    if (!rest) continue;
    const open = found.index + found[0].length + rest[0].length - 1;
    const close = close_of(code, open);
    if (close < 0) continue;
    const string_at = rest[2] ? code.indexOf(rest[2], found.index) : -1;
    const end = rest[1] ? code.indexOf(")", close) : close;
    calls.push({ word: found[0], name: string_at < 0 ? "" : text.slice(string_at + 1, string_at + rest[2].length - 1), line: text.slice(0, found.index).split("\n").length,
      from: found.index, to: end + 1, open, close });
  }
  return calls;
}

/// The fields of a table: name to [begin, end] of the value.
function fields_of(text, { open, close }) {
  const code = code_of(text);
  const fields = new Map();
  for (let at = open + 1; at < close;) {
    let end = at;
    for (; end < close && !",;".includes(code[end]); ++end) if ("{(".includes(code[end])) end = close_of(code, end);
    const found = /^(\s*)([A-Za-z_]\w*)(\s*=\s*)/.exec(code.slice(at, end));
    if (found) fields.set(found[2], [at + found[0].length, at + code.slice(at, end).trimEnd().length]);
    at = end + 1;
  }
  return fields;
}

/// The numbers of a value ({ 1, 2 }, { x = 1, y = 2 } or 1), with their places in the text.
function numbers_of(text, [begin, end], name) {
  const value = text.slice(begin, end);
  const part = String.raw`(?:[A-Za-z_]\w*\s*=\s*)?${NUMBER}`;
  if (!new RegExp(String.raw`^(?:\{\s*${part}(?:\s*,\s*${part})*\s*,?\s*\}|${NUMBER})$`).test(value)) throw new Error(T.arena.not_number(name));
  return [...value.matchAll(new RegExp(String.raw`(?:([A-Za-z_]\w*)\s*=\s*)?(${NUMBER})`, "g"))].map((found) => {
    const at = begin + found.index + found[0].length - found[2].length;
    return { name: found[1] ?? "", value: Number(found[2]), at, end: at + found[2].length };
  });
}

/// Replaces the pieces [from, to, text]. They must not overlap.
function replaced(text, pieces) {
  return [...pieces].sort((a, b) => b[0] - a[0]).reduce((all, [from, to, put]) => all.slice(0, from) + put + all.slice(to), text);
}

function inserted(text, { open, close }, field) {
  const before = code_of(text).slice(open, close).trimEnd();
  const at = open + before.length;
  return [at, at, `${/[,;{]$/.test(before) ? " " : ", "}${field}`];
}

/// The numbers of a field as [x, y], of { x, y } or { x =, y = }.
const pair = (numbers) => ["x", "y"].map((name, i) => numbers.find((each) => each.name === name) ?? numbers[i]);

/// Moves and turns what a call makes: by dx, dy [m] and turn [rad], about its own middle.
export function moved(text, call, { dx, dy, turn, to }) {
  const fields = fields_of(text, call);
  const pieces = [];
  const put = (number, value) => pieces.push([number.at, number.end, written(value)]);
  const add_to = (name, change) => {
    if (Math.abs(change) < 1e-6) return;
    if (!fields.has(name)) return pieces.push(inserted(text, call, `${name} = ${written(change)}`));
    const [number] = numbers_of(text, fields.get(name), name);
    put(number, number.value + change);
  };
  if (call.word === "robot") {
    const pose = { x: to.x, y: to.y, heading: to.yaw };
    if (!fields.has("pose")) return replaced(text, [inserted(text, call, `pose = { x = ${written(pose.x)}, y = ${written(pose.y)}, heading = ${written(pose.heading)} }`)]);
    const numbers = numbers_of(text, fields.get("pose"), "pose");
    const missing = [];
    for (const [name, value] of Object.entries(pose)) {
      const number = numbers.find((each) => each.name === name);
      if (number) put(number, value);
      else if (Math.abs(value) > 1e-6) missing.push(`${name} = ${written(value)}`);
    }
    const [begin, end] = fields.get("pose");
    if (missing.length > 0) pieces.push(inserted(text, { open: begin, close: end - 1 }, missing.join(", ")));
    return replaced(text, pieces);
  }
  if (call.word === "wall") {
    const ends = ["from", "to"].map((name) => pair(numbers_of(text, fields.get(name) ?? [0, 0], name)));
    const [cx, cy] = [0, 1].map((i) => (ends[0][i].value + ends[1][i].value) / 2);
    for (const [x, y] of ends) {
      const [rx, ry] = [x.value - cx, y.value - cy];
      put(x, cx + dx + rx * Math.cos(turn) - ry * Math.sin(turn));
      put(y, cy + dy + rx * Math.sin(turn) + ry * Math.cos(turn));
    }
    return replaced(text, pieces);
  }
  const [x, y] = pair(numbers_of(text, fields.get("at") ?? [0, 0], "at"));
  put(x, x.value + dx);
  put(y, y.value + dy);
  if (call.word !== "cylinder") add_to(call.word === "marker" ? "facing" : "yaw", turn);
  return replaced(text, pieces);
}

/// Removes a call, with its comma, and its line if nothing else stands there.
export function removed(text, call) {
  let { from, to } = call;
  to += /^\s*[,;]?/.exec(code_of(text).slice(to))[0].trimEnd().length;
  const line_begin = text.lastIndexOf("\n", from - 1) + 1;
  const rest = /^[ \t]*(\n|$)/.exec(text.slice(to));
  if (text.slice(line_begin, from).trim() === "" && rest) {
    from = line_begin;
    to += rest[0].length;
  }
  return text.slice(0, from) + text.slice(to);
}

/// Adds a call: robots after the last robot, other things to the arena.
export function added(text, word, call) {
  const calls = calls_in(text);
  const lines_end = (at) => (text.indexOf("\n", at) < 0 ? text.length : text.indexOf("\n", at) + 1);
  const line_break = text === "" || text.endsWith("\n") ? "" : "\n";
  if (word === "robot") {
    const last = calls.filter((each) => each.word === "robot").at(-1);
    const at = last ? lines_end(last.to) : text.length;
    return `${text.slice(0, at)}${at === text.length ? line_break : ""}${call}\n${text.slice(at)}`;
  }
  const arena = calls.find((each) => each.word === "arena");
  if (!arena) return `${text}${line_break}arena {\n  ${call},\n}\n`;
  if (!text.slice(arena.open, arena.close).includes("\n")) return replaced(text, [inserted(text, arena, call)]);
  const code = code_of(text).slice(arena.open, arena.close).trimEnd();
  const at = arena.open + code.length;
  const comma = /[,;{]$/.test(code) ? "" : ",";
  const line_begin = text.lastIndexOf("\n", arena.close) + 1;
  const is_alone = text.slice(line_begin, arena.close).trim() === "";
  const with_comma = text.slice(0, at) + comma + text.slice(at, is_alone ? line_begin : arena.close);
  return `${with_comma}${is_alone ? "" : "\n"}  ${call},\n${text.slice(is_alone ? line_begin : arena.close)}`;
}

/// The call that makes a thing. `things`: the number of things that this line makes; `index`: the thing's number among them.
export function call_of(text, words, line, index, things) {
  const calls = calls_in(text).filter((each) => words.includes(each.word) && each.line === line);
  if (calls.length === 0) throw new Error(T.arena.no_call(line));
  if (calls.length !== things) throw new Error(T.arena.loop(line));
  return calls[index];
}
