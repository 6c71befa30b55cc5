// The texts of system files after changes by hand. Returns how many were compared; throws the first that is different.
const { added, call_of, calls_in, moved, removed } = await import("/arena_text.js");
let count = 0;
const is = (have, want) => {
  count += 1;
  if (have !== want) throw new Error(`${count}: have\n${have}\nwant\n${want}`);
};
const fails = (work, part) => {
  count += 1;
  try {
    work();
  } catch (wrong) {
    if (wrong.message.includes(part)) return;
    throw new Error(`${count}: ${wrong.message} does not say ${part}`);
  }
  throw new Error(`${count}: did not fail`);
};
const by = (dx, dy, turn = 0, to = {}) => ({ dx, dy, turn, to });
const first = (text, word) => calls_in(text).find((each) => each.word === word);

const room = `-- A room, with box { at = { 9, 9 } } only in this comment.
arena {
  size = { 2.0, 2.0 },
  box { at = { 0.6, 0.3 }, size = { 0.2, 0.2, 0.1 } },  -- the table
  wall { from = { 0, -0.2 }, to = { 0, 0.2 } }
}

robot    "mouse"    { model = "raspimouse" }  -- small
robot "other" { model = "raspimouse", pose = { x = 1, y = 0 } }
`;
is(calls_in(room).map(({ word, line }) => `${word} ${line}`).join(), "arena 2,box 4,wall 5,robot 8,robot 9");
is(moved(room, first(room, "box"), by(0.1, -0.1)), room.replace("{ 0.6, 0.3 }", "{ 0.7, 0.2 }"));
is(moved(room, first(room, "box"), by(0, 0, 0.5)), room.replace("{ 0.2, 0.2, 0.1 } }", "{ 0.2, 0.2, 0.1 }, yaw = 0.5 }"));
is(moved(room, first(room, "wall"), by(1, 0, Math.PI / 2)), room.replace("from = { 0, -0.2 }, to = { 0, 0.2 }", "from = { 1.2, 0 }, to = { 0.8, 0 }"));
is(moved(room, first(room, "robot"), by(0, 0, 0, { x: 0.5, y: 0.25, yaw: 0 })), room.replace('"raspimouse" }  --', '"raspimouse", pose = { x = 0.5, y = 0.25, heading = 0 } }  --'));
is(moved(room, calls_in(room)[4], by(0, 0, 0, { x: 1, y: 0.5, yaw: 1 })), room.replace("{ x = 1, y = 0 }", "{ x = 1, y = 0.5, heading = 1 }"));
is(removed(room, first(room, "box")), room.replace("box { at = { 0.6, 0.3 }, size = { 0.2, 0.2, 0.1 } },", ""));
is(removed(room, first(room, "wall")), room.replace("  wall { from = { 0, -0.2 }, to = { 0, 0.2 } }\n", ""));
is(added(room, "box", "box { at = { 1, 1 } }"), room.replace("{ 0, 0.2 } }\n", "{ 0, 0.2 } },\n  box { at = { 1, 1 } },\n"));
is(added(room, "robot", 'robot "third" { model = "raspimouse" }'), `${room}robot "third" { model = "raspimouse" }\n`);
is(added("arena { size = { 1, 1 } }\n", "box", "box { at = { 1, 1 } }"), "arena { size = { 1, 1 }, box { at = { 1, 1 } } }\n");
is(added("arena {}\n", "box", "box { at = { 1, 1 } }"), "arena { box { at = { 1, 1 } }}\n");
is(added('robot "mouse" { model = "raspimouse" }', "wall", "wall { }"), 'robot "mouse" { model = "raspimouse" }\narena {\n  wall { },\n}\n');
const computed = "local x = 1\narena { box { at = { x, 0 }, size = { 0.1, 0.1, 0.1 } } }\n";
fails(() => moved(computed, first(computed, "box"), by(1, 0)), "'at' is computed");
fails(() => call_of("for i = 1, 3 do things[i] = box { at = { i, 0 } } end\n", ["box"], 1, 0, 3), "makes several things");
fails(() => call_of("arena { maze {} }\n", ["box", "wall"], 1, 0, 12), "a map or a function makes this thing");
const turned = "arena { marker { id = 1, at = { 1, 2, 0.1 }, facing = 3.0 } }";
is(moved(turned, first(turned, "marker"), by(0, 0, -1)), turned.replace("3.0", "2"));
is(moved(turned, first(turned, "marker"), by(-2, 0.5)), turned.replace("{ 1, 2, 0.1 }", "{ -1, 2.5, 0.1 }"));
return count;
