// The meaning of the names in a file: from the engine's annotations, which other editors use too, and from the file itself.

const NAME = "[A-Za-z_][A-Za-z0-9_]*";
const KEYWORDS = "and break do else elseif end false for function goto if in local nil not or repeat return then true until while".split(" ");

/// Splits a text after the type at its beginning. A type has blanks only within brackets and after the `:` of a function.
function take_type(text) {
  let depth = 0;
  for (let i = 0; i < text.length; ++i) {
    if ("([{<".includes(text[i])) depth += 1;
    else if (")]}>".includes(text[i])) depth -= 1;
    else if (text[i] === " " && depth === 0 && text[i - 1] !== ":") return [text.slice(0, i), text.slice(i + 1)];
  }
  return [text, ""];
}

/// `fun(self: X, value: Y): Z` to { params: [["value", "Y"]], returns: "Z" }.
function take_function(type) {
  const inner = /^fun\((.*)\)(?::\s*(.*))?$/.exec(type);
  if (!inner) return null;
  const params = [...inner[1].matchAll(/([A-Za-z_.]+)\??:\s*([^,()]+|fun\([^)]*\)[^,]*)/g)].map(([, name, of]) => [name, of.trim()]);
  return { params: params.filter(([name]) => name !== "self"), returns: inner[2] ?? "" };
}

/// Classes and globals of annotations for the Lua language server.
export class Words {
  classes = new Map();  // name: { parent, doc, fields: name to { type, doc, usage } }
  globals = new Map();  // name: { type, doc, usage, params }
  types = [];           // types of messages
  #scopes;

  /// `scopes`: the global names for each kind of file.
  constructor(text, scopes = {}) {
    this.#scopes = scopes;
    const variables = new Map();
    let [doc, params, returns, type, owner] = [[], [], "", "", null];
    for (const line of text.split("\n")) {
      let found;
      if ((found = /^---@class (?:\(exact\) )?(\S+?)(?: : (\S+))?$/.exec(line))) {
        owner = { parent: found[2], doc: doc.join(" "), fields: new Map() };
        this.classes.set(found[1], owner);
        type = found[1];
        doc = [];
      } else if ((found = /^---@field (\S+?)\?? (.*)$/.exec(line)) && owner) {
        const [of, about] = take_type(found[2]);
        owner.fields.set(found[1], { type: of, doc: about, usage: "" });
      } else if ((found = /^---@param (\S+?)(\??) (.*)$/.exec(line))) {
        const [of, about] = take_type(found[3]);
        params.push({ name: found[1] + found[2], type: of, doc: about });
      } else if ((found = /^---@return (.*)$/.exec(line))) returns = take_type(found[1])[0];
      else if ((found = /^---@type (.*)$/.exec(line))) type = found[1];
      else if ((found = /^---@alias MessageType (.*)$/.exec(line))) this.types = [...found[1].matchAll(/"([^"]+)"/g)].map(([, name]) => name);
      else if (/^---@/.test(line)) continue;
      else if ((found = /^---\s?(.*)$/.exec(line))) doc.push(found[1]);
      else if ((found = new RegExp(`^local (${NAME}) = `).exec(line)) && owner) variables.set(found[1], owner);
      else if ((found = new RegExp(`^function (?:(${NAME}):)?(${NAME})\\((.*)\\) end$`).exec(line))) {
        const entry = { type: returns, doc: doc.join(" "), params, usage: `${found[2]}(${found[3]})` };
        if (!found[1]) this.globals.set(found[2], entry);
        else variables.get(found[1])?.fields.set(found[2], entry);
        [doc, params, returns, type] = [[], [], "", ""];
      } else if ((found = new RegExp(`^(${NAME}) = `).exec(line))) this.globals.set(found[1], { type, doc: doc.join(" "), params: [], usage: "" });
      if (line === "") [doc, params, returns, type, owner] = [[], [], "", "", null];
    }
  }

  /// Fields of a type, its own and its parents': name to { type, doc, usage }.
  fields(type) {
    const all = new Map();
    for (let at = this.classes.get(type); at; at = this.classes.get(at.parent)) {
      for (const [name, field] of at.fields) if (!all.has(name) && !name.startsWith("[")) all.set(name, field);
    }
    return all;
  }

  scope(kind) {
    return this.#scopes[kind] ?? [...this.globals.keys()];
  }

  /// The type of the table that a call takes: of `box {`, `robot "x" {`, `param("x", 1, {`.
  table_of(name) {
    const params = this.globals.get(name)?.params ?? [];
    return [...params].reverse().map(({ type }) => type).find((type) => this.classes.has(type));
  }
}

/// The text without comments and long strings, of the same length.
function without_comments(text) {
  return text.replace(/"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|--\[(=*)\[[\s\S]*?\]\1\]|--[^\n]*/g,
    (each) => (each.startsWith("--") ? each.replace(/[^\n]/g, " ") : each));
}

/// The type of a message as a part of class names.
const class_of = (type) => type.replaceAll("/", ".");

/// The declarations of a file: variables with their types, and parameters.
function declarations(words, text, kind) {
  const types = new Map(kind === "scenarios" ? [["s", "Scenario"]] : []);
  const params = new Map();
  for (const [, name, way, type] of text.matchAll(new RegExp(`(${NAME})\\s*=\\s*(input|output)\\s*\\(\\s*["'][^"'\\n]*["']\\s*,\\s*["']([^"'\\n]+)["']`, "g")))
    types.set(name, `${class_of(type)}.${way === "input" ? "In" : "Out"}`);
  for (const [, name, port] of text.matchAll(new RegExp(`(${NAME})\\s*=\\s*(${NAME}):read\\s*\\(`, "g"))) {
    const read = take_function(words.fields(types.get(port)).get("read")?.type ?? "");
    if (read) types.set(name, read.returns);
  }
  for (const [, name, rest] of text.matchAll(new RegExp(`param\\s*\\(\\s*["'](${NAME})["']\\s*,([^\\n]*)`, "g"))) {
    const about = /doc\s*=\s*["']([^"'\n]*)["']/.exec(rest)?.[1] ?? "";
    const unit = /unit\s*=\s*["']([^"'\n]*)["']/.exec(rest)?.[1];
    params.set(name, { type: "", usage: "", doc: `${unit ? `[${unit}] ` : ""}${about}` });
  }
  return { types, params };
}

/// The fields that can follow a chain of names, such as ["config"].
function members(words, declared, chain) {
  const [first, ...rest] = chain;
  if (first === "config" && rest.length === 0) return declared.params;
  let type = declared.types.get(first) ?? words.globals.get(first)?.type;
  for (const name of rest) {
    const field = words.fields(type).get(name);
    type = take_function(field?.type ?? "")?.returns || field?.type;
  }
  return words.fields(type);
}

/// The call whose table is open at the end of a text: `port:write {` gives ["port", "write"]; null for none.
function open_table(text) {
  let depth = 0;
  for (let i = text.length - 1; i >= 0; --i) {
    if (text[i] === "}") depth += 1;
    else if (text[i] === "{" && depth-- === 0) {
      const call = new RegExp(`(?:(${NAME}):)?(${NAME})\\s*(?:\\(\\s*)?(?:["'][^"'\\n]*["']\\s*,?\\s*)?(?:[^(){}\\n"']*,\\s*)?$`).exec(text.slice(0, i));
      return call && [call[1], call[2]];
    }
  }
  return null;
}

/// The fields for the table that is open at the end of a text.
function table_fields(words, declared, text) {
  const call = open_table(text);
  if (!call) return new Map();
  const [owner, name] = call;
  if (!owner) return words.fields(words.table_of(name));
  const field = members(words, declared, [owner]).get(name);
  const written = take_function(field?.type ?? "")?.params.at(-1)?.[1] ?? [...field?.params ?? []].reverse().map(({ type }) => type).find((type) => words.classes.has(type));
  return words.fields(written);
}

const chain_before = new RegExp(`((?:${NAME}[.:])*)(${NAME})?$`);

/// Completes the text before the cursor: { from, items: [{ name, doc }], quoted } where `from` is the begin of the part;
/// `quoted`: the cursor is in a text, whose candidates the running system may know; `chained`: after a dot or colon, or in a table.
export function complete(words, text, cursor, kind) {
  const before = without_comments(text.slice(0, cursor));
  const line = before.slice(before.lastIndexOf("\n") + 1);
  if (text.slice(cursor - 1, cursor).trim() !== "" && before.slice(-1).trim() === "") return { from: cursor, items: [], quoted: false };
  const declared = declarations(words, text, kind);
  const in_text = /^(?:[^"']|"(?:\\.|[^"\\])*"|'(?:\\.|[^'\\])*')*(["'])((?:\\.|(?!\1).)*)$/.exec(line);
  if (in_text) {
    const typed = in_text[2];
    const wants_type = /(?:input|output)\s*\(\s*["'][^"']*["']\s*,\s*["'][^"']*$/.test(line);
    const names = wants_type ? words.types : [];
    return { from: cursor - typed.length, quoted: !wants_type, items: names.filter((name) => name.startsWith(typed)).map((name) => ({ name, doc: words.classes.get(`${class_of(name)}.Out`)?.doc ?? "" })) };
  }
  const [, chain, part = ""] = chain_before.exec(before);
  const from = cursor - part.length;
  const found = new Map();
  const add = (name, { usage, doc } = {}) => name.startsWith(part) && !found.has(name) && found.set(name, { name, usage, doc: doc ?? "" });
  if (chain) {
    for (const [name, field] of members(words, declared, chain.slice(0, -1).split(/[.:]/))) add(name, field);
    return { from, items: sorted(found), quoted: false, chained: true, unknown: found.size === 0 };
  }
  for (const [name, field] of table_fields(words, declared, before)) add(name, field);
  if (found.size > 0 && /[{,]\s*[A-Za-z_0-9]*$/.test(before)) return { from, items: sorted(found), quoted: false, chained: true };
  for (const name of words.scope(kind)) add(name, words.globals.get(name));
  if (part) {
    for (const name of KEYWORDS) add(name);
    for (const [name] of without_comments(text).replace(/"(?:\\.|[^"\\\n])*"/g, "").matchAll(new RegExp(`\\b${NAME}\\b`, "g"))) if (name !== part) add(name);
  }
  return { from, items: sorted(found), quoted: false };
}

const sorted = (found) => [...found.values()].sort((a, b) => (a.name < b.name ? -1 : 1));

/// The documentation of the name at a place: { title, doc, params }, or null.
export function describe(words, text, at, kind) {
  const end = at + /^[A-Za-z0-9_]*/.exec(text.slice(at))[0].length;
  const [, chain, part] = chain_before.exec(without_comments(text.slice(0, end)));
  if (!part || at < end - part.length) return null;
  const declared = declarations(words, text, kind);
  const of = declared.types.get(part);
  const entry = chain ? members(words, declared, chain.slice(0, -1).split(/[.:]/)).get(part)
    : of ? { type: of, doc: words.classes.get(of)?.doc ?? "", usage: "" }
    : words.scope(kind).includes(part) ? words.globals.get(part) : table_fields(words, declared, text.slice(0, end)).get(part);
  if (!entry || (!entry.doc && !entry.usage && !entry.type)) return null;
  const title = entry.usage || `${part}${entry.type ? `: ${entry.type}` : ""}`;
  return { title, doc: entry.doc, params: (entry.params ?? []).map((each) => `${each.name}: ${each.type}${each.doc ? ` – ${each.doc}` : ""}`) };
}
