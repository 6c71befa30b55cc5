// Snippets: common pieces of files. A snippet is offered as a completion of the word with which it begins, in files that
// may use this word.

/// For each kind of file: word to text. A text between « and » is a place that the person fills in.
export const SNIPPETS = {
  behaviors: {
    input: 'local «range» = input("«in»", "«TimedShortSeq»", "«distance sensors»")',
    output: 'local «target» = output("«out»", "«TimedVelocity2D»", "«target velocity»")',
    param: 'param("«speed»", «0.1», { min = «0.0», max = «1.0», unit = "«m/s»", doc = "«forward speed»" })',
    task: 'task("«patrol»", function()\n  wait(«1.0»)\nend, { repeating = «true» })',
  },
  systems: {
    arena: "arena { box { at = { «0.8», «0.0» }, size = { «0.1», «1.0», «0.3» } } }",
    robot: 'robot "«mouse»" { model = "«raspimouse»", pose = { x = «0», y = «0», heading = «0» } }',
    behavior: 'behavior "«controller»" { script = "«robot_controller»" }',
    connect: 'connect("«controller.out»", "«mouse.target_velocity_in»")',
  },
  scenarios: {
    scenario: 'scenario("«stops in time»", function(s)\n  local world = s:load "«stop_at_wall»"\n  s:never("«touches anything»", function() return world.«mouse».collided end)\n  s:run(«10»)\nend)',
  },
};

/// Snippets whose word begins with `part`, among the words that the file may use.
export const snippets_for = (words, kind, part) =>
  Object.entries(SNIPPETS[kind] ?? {}).filter(([word]) => part && word.startsWith(part) && words.scope(kind).includes(word)).map(([word, text]) => ({ word, text }));

/// The text without its marks, and the places: [[begin, end], ...].
export function places_in(snippet) {
  const places = [];
  let text = "";
  snippet.split(/[«»]/).forEach((part, i) => {
    if (i % 2 === 1) places.push([text.length, text.length + part.length]);
    text += part;
  });
  return { text, places };
}

/// Replaces a range by a snippet, and selects its places one after the other: Tab goes to the next place, Esc ends.
export function put_snippet(editor, snippet, from, to) {
  const begin = editor.indexFromPos(from);
  const { text, places } = places_in(snippet);
  const indent = " ".repeat(from.ch);
  const indented = (part) => part.replaceAll("\n", `\n${indent}`);
  editor.replaceRange(indented(text), from, to);
  const at = (index) => editor.posFromIndex(begin + indented(text.slice(0, index)).length);
  const marks = places.map(([first, end]) => editor.markText(at(first), at(end), { className: "place", inclusiveLeft: true, inclusiveRight: true, clearWhenEmpty: false }));
  const end = editor.setBookmark(at(text.length));
  const leave = () => {
    for (const mark of [...marks, end]) mark.clear();
    editor.removeKeyMap(keys);
  };
  const next = () => {
    const range = marks.shift()?.find();
    if (range) return editor.setSelection(range.from, range.to);
    const last = end.find();
    leave();
    if (last) editor.setCursor(last);
  };
  const keys = { Tab: next, Esc: leave };
  editor.addKeyMap(keys);
  next();
}
