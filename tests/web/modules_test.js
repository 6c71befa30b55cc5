// Checks of the page's modules that need no engine: run within the page. Returns how many there were, or throws.
const { Cdr, numbers_in, to_message } = await import("/cdr.js");
const { curve, place, route } = await import("/diagram_layout.js");
const { with_hosts } = await import("/hosts.js");
const { carries_same, with_rtcs } = await import("/rtcs.js");
const { ticks, to_csv } = await import("/plot_files.js");
const { what_is_wrong } = await import("/widgets.js");
const { lines_of, lua_text } = await import("/add_form.js");
const { Trails } = await import("/world_trails.js");
const { Tracks, ghost_of } = await import("/past_tracks.js");
const { Model } = await import("/model.js");
const { Emitter } = await import("/emitter.js");
const { number_text, value_text } = await import("/value_text.js");

let count = 0;
function same(got, expected, what) {
  count += 1;
  if (JSON.stringify(got) !== JSON.stringify(expected)) throw new Error(`${what}: got ${JSON.stringify(got)}, expected ${JSON.stringify(expected)}`);
}
function refused(work, expected, what) {
  count += 1;
  try {
    work();
  } catch (wrong) {
    if (wrong.message.includes(expected)) return;
    throw new Error(`${what}: it says '${wrong.message}'`);
  }
  throw new Error(`${what}: it was taken`);
}
const bytes = (...numbers) => new Uint8Array(numbers);

const types = {
  Time: [{ name: "sec", type: "uint32" }, { name: "nsec", type: "uint32" }],
  Point: [{ name: "x", type: "double" }],
  TimedShortSeq: [{ name: "tm", type: "Time" }, { name: "data", type: "sequence<int16>" }],
  Mixed: [{ name: "on", type: "bool" }, { name: "at", type: "Point" }, { name: "words", type: "sequence<string>" }, { name: "bits", type: "sequence<bool>" }],
  Octets: [{ name: "data", type: "sequence<octet>" }],
  Nested: [{ name: "all", type: "sequence<sequence<float>>" }],
  Lost: [{ name: "data", type: "Nothing" }],
};
const cdr = new Cdr(types);

const shorts = bytes(2, 0, 0, 0, 0, 0x65, 0xcd, 0x1d, 3, 0, 0, 0, 1, 0, 0xff, 0xff, 0, 1);
same(to_message(cdr.read("TimedShortSeq", shorts)), { tm: 2.5, value: [1, -1, 256] }, "a stamp and shorts");
same(cdr.read("Mixed", bytes(1, 9, 9, 9, 9, 9, 9, 9, 0, 0, 0, 0, 0, 0, 0xf0, 0x3f, 1, 0, 0, 0, 3, 0, 0, 0, 0xc3, 0xa9, 0, 9, 2, 0, 0, 0, 1, 0)),
  { on: true, at: { x: 1 }, words: ["é"], bits: [true, false] }, "alignment counts from the first byte");
const hosts = [{ name: "ev3", here: true, ports: [{ name: "vehicle.vel", way: "out", type: "T" }] }, { name: "late", here: false, ports: [] }];
const stands_for = (name, port) => ({ name, type: "RemoteComponent", ports: [{ name: port, way: "out", type: "T" }] });
same(with_hosts({ hosts, components: [{ name: "it", type: "It", ports: [] }, stands_for("ev3/vehicle", "vel"), stands_for("ev3/vehicle2", "vel"), stands_for("late/x", "out")] })
  .map(({ name, ports }) => [name, ports.map((each) => [each.name, each.waits])]),
[["it", []], ["ev3/vehicle", [["vel", false]]], ["ev3/vehicle2", [["vel", true]]], ["late/x", [["out", true]]]], "components of other hosts");
same([...cdr.read("Octets", bytes(2, 0, 0, 0, 7, 8)).data], [7, 8], "octets");
same(cdr.read("Nested", bytes(1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0x80, 0x3f)).all, [[1]], "sequences of sequences");
const offset = new Uint8Array([9, 9, 9, 9, ...shorts]).subarray(4);
same(cdr.read("TimedShortSeq", offset).data, [1, -1, 256], "a part of a longer message");
refused(() => cdr.read("TimedShortSeq", shorts.subarray(0, 15)), "ends at byte 15", "a message cut short");
refused(() => cdr.read("Octets", bytes(255, 255, 255, 255, 1)), "ends at byte 5", "a length that lies");
refused(() => cdr.read("Lost", bytes(0)), "no type is called 'Nothing'", "an unknown type");
same(numbers_in({ position: { x: 1, y: 2 }, on: true, name: "a", list: [3] }), [["position.x", 1], ["position.y", 2], ["on", 1], ["list[1]", 3]], "numbers by their path");
same(to_message({ tm: { sec: 1, nsec: 0 }, width: 2, height: 3 }).value, { width: 2, height: 3 }, "a message of several fields");

const parameter = { type: "number", min: -1.5, max: 1.5 };
same(what_is_wrong(parameter, "1.5"), "", "bounds are inclusive");
same(what_is_wrong(parameter, "1.51") !== "", true, "above the maximum");
same(what_is_wrong(parameter, "") !== "", true, "an empty text is not a number");
same(what_is_wrong({ type: "integer", min: null, max: null }, "2.5") !== "", true, "a fraction is not whole");
same(what_is_wrong({ type: "integer", min: null, max: null }, "-3"), "", "no bounds");

same(to_csv(["a", 'b,"c"'], [[0.1, 1, null], [0.2, 2, 3]]), 'time,a,"b,""c"""\n0.1,1,\n0.2,2,3\n', "CSV");
same(ticks(0, 1, 5), [0, 0.2, 0.4, 0.6, 0.8, 1], "round numbers");
same(number_text(0.12345), "0.123", "a small number");
same(value_text({ vx: 0.1, va: 0 }), "{ vx = 0.100, va = 0 }", "a structure");

const port = (name, way) => ({ name, way, type: "T" });
const components = [
  { name: "mouse", type: "m", kind: "robot", ports: [port("in", "in"), port("out", "out")] },
  { name: "controller", type: "c", kind: "behavior", ports: [port("in", "in"), port("out", "out")] },
  { name: "alone", type: "a", kind: "behavior", ports: [port("out", "out")] },
];
const connections = [{ from: "mouse.out", to: "controller.in" }, { from: "controller.out", to: "mouse.in" }];
const boxes = place(components, connections);
same(boxes.get("mouse").x + boxes.get("mouse").w < boxes.get("controller").x, true, "what feeds stands left, also in a circle");
const all = [...boxes.values()];
const overlap = all.some((a, i) => all.some((b, k) => i < k && a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h));
same(overlap, false, "boxes lie apart");
same(route(boxes, [...connections, { from: "mouse.gone", to: "controller.in" }]).length, 2, "what has no ports has no line");
same(place(components, connections, { alone: [500, 600] }).get("alone").x, 500, "a place that a person chose is kept");
same(curve([0, 0], [100, 0]), "M0 0C50 0 50 0 100 0", "a line");
same(lua_text('a "b"\\\n'), '"a \\034b\\034\\092\\010"', "a text as Lua reads it");
same(lines_of({ name: "x", script: "y", is_new: false }), ['behavior "x" { script = "y" }'], "a behaviour that is there");
same(lines_of({ name: "x", is_new: true, doc: "Does.", inputs: ["in:TimedDouble"], outputs: [], params: ["gain=1"], callbacks: ["on_reset"] }),
  ['new "x" { inputs = { "in:TimedDouble" }, params = { "gain=1" }, callbacks = { "on_reset" }, doc = "Does." }', 'behavior "x" { script = "x" }'], "a new behaviour");

const trails = new Trails();
const pieces = () => (trails.draw(), trails.lines.geometry.drawRange.count / 2);
const last = () => [...trails.lines.geometry.attributes.position.array.slice(0, 6)].map((each) => Number(each.toFixed(3)));
trails.reset(1, ["#ff0000"]);
let time = 0;
const drive_to = (x, passed = 0.02) => trails.follow([{ x, y: 0 }], time += passed);
drive_to(0);
drive_to(0.005);
same(pieces(), 0, "a robot that has hardly moved leaves no trail");
drive_to(0.01);
same([pieces(), last()], [1, [0, 0, 0.003, 0.01, 0, 0.003]], "a trail's first piece");
drive_to(1);
same(pieces(), 1, "who is put elsewhere leaves no trail on the way");
drive_to(1.3, 1);
same([pieces()], [2], "who drove on while few frames came leaves one");
drive_to(1.5, 60);
same([pieces()], [2], "of a way that nobody saw there is none");
for (let i = 1; i <= 600; ++i) drive_to(1.5 + 0.01 * i);
same([pieces(), last()], [600, [7.48, 0, 0.003, 7.49, 0, 0.003]], "the newest piece takes the place of the oldest");
trails.forget();
same(pieces(), 0, "a forgotten trail");
// Which branch is drawn pale: what follows a past; of a branch, its parent; of a parent, its last child.
const main = { name: "main", parent: "main", left: 0, ends: 9 };
const first = { name: "branch 1", parent: "main", left: 2, ends: 5 };
const second = { name: "branch 2", parent: "main", left: 3, ends: 6 };
same(ghost_of(undefined), null, "no ghost before the system is known");
same(ghost_of({ branches: [main], branch: 0, is_past: false }), null, "no ghost of a single branch");
same(ghost_of({ branches: [main], branch: 0, is_past: true }), { branch: "main", from: 0, moves: false }, "what follows");
same(ghost_of({ branches: [main, first], branch: 1, is_past: false }), { branch: "main", from: 2, moves: true }, "the parent");
same(ghost_of({ branches: [main, first, second], branch: 0, is_past: false }), { branch: "branch 2", from: 3, moves: true }, "the last child");

// What is remembered: the last row before a time.
const model = new Emitter();
const asked = [];
const tracks = new Tracks({ model, link: { send: (what) => asked.push(what) } });
tracks.ask("main", true);
same(asked, [{ do: "remembered", branch: "main", rows: true }], "the question");
same(tracks.at("main", 1), undefined, "nothing is known yet");
model.emit("remembered", { branch: "main", rows: [[0.05, 1, 2, 3], [0.1, 4, 5, 6]], things: [[0.05, 2, 1, 0, 0, 0, 0, 0], [0.1, 2, 7, 0, 0, 0, 0, 0]], marks: [{ at: 0.1, kind: "act", text: "x" }] });
same(tracks.at("main", 0), [{ x: 1, y: 2, yaw: 3 }], "before the first row");
same(tracks.at("main", 0.09), [{ x: 1, y: 2, yaw: 3 }], "between rows");
same(tracks.at("main", 7), [{ x: 4, y: 5, yaw: 6 }], "after the last row");
model.emit("remembered", { branch: "main", marks: [] });
same(tracks.rows("main").length, 2, "rows stay when only marks were asked for");
same(tracks.marks("main").length, 0, "marks are new");
const x_of_thing = (time) => tracks.things_at("main", time).get(2)?.position.x;
same([0, 0.05, 0.09, 0.1, 9].map(x_of_thing), [1, 1, 1, 7, 7], "a thing before and after it moved");
same(tracks.things_at("main", 1).size, 1, "only what moved is known");

const shown = new Model({ on: () => {}, is_open: true });
const then_of = (x) => ({ time: 1, robots: [{ x, y: 0, yaw: 0 }], things: new Map([[1, { position: { x, y: 0, z: 0 } }]]) });
const places = () => [shown.robots[0].x, ...shown.things.map(({ pose }) => pose.position.x)];
shown.robots = [{ index: 0, x: 5 }];
shown.things = [{ index: 0, pose: { position: { x: 8 } } }, { index: 1, pose: { position: { x: 9 } } }];
shown.look_at(then_of(1));
same(places(), [1, 8, 1], "robots and things are shown where they were");
shown.look_at(then_of(2));
same(places(), [2, 8, 2], "at another time, too");
shown.look_at(null);
same(places(), [5, 8, 9], "then where they are");

const own_boxes = [{ name: "mouse", kind: "robot", ports: [{ name: "speed", way: "in", type: "TimedLong" }, { name: "pose", way: "out", type: "TimedPose2D" }] }];
const rtc_box = (name, ...ports) => ({ name, type: "T", state: "ACTIVE", ports, parameters: [], sets: [] });
const rtc_out = { name: "out", way: "out", type: "TimedLong" };
const rtcs_seen = { context: "pc.host_cxt", rtcs: [rtc_box("rtm:A0", rtc_out), rtc_box("rtm:far.host_cxt/B0", rtc_out)], ports: { "mouse.speed": "TimedLong" },
  connections: [{ from: "rtm:A0.out", to: "mouse.speed" }, { from: "rtm:A0.out", to: "rtm:far.host_cxt/B0.in" }] };
const wired_rtcs = (rtcs, ...given) => with_rtcs(own_boxes, { connections: given.map(([from, to]) => ({ from, to })) }, rtcs);
const names_of = ({ connections }) => connections.map(({ from, to, given }) => [from, to, given?.from ?? null]);
same(names_of(wired_rtcs(rtcs_seen, ["rtm:pc.host_cxt/A0.out", "mouse.speed"])),
  [["rtm:A0.out", "mouse.speed", "rtm:pc.host_cxt/A0.out"], ["rtm:A0.out", "rtm:far.host_cxt/B0.in", null]], "an RTC by two of its names");
same(names_of(wired_rtcs(rtcs_seen, ["rtm:B0.out", "mouse.speed"]))[0], ["rtm:far.host_cxt/B0.out", "mouse.speed", "rtm:B0.out"], "an RTC of another computer by its short name");
const late_rtc = wired_rtcs(null, ["mouse.pose", "rtm:Late0.in"]).boxes.find(({ name }) => name === "rtm:Late0");
same([late_rtc.state, late_rtc.ports.map(({ name, way, type, waits }) => [name, way, type, waits])], ["MISSING", [["in", "in", "TimedPose2D", true]]], "an RTC that is waited for");
const rtc_port = (name, kind, type) => [name, { component: { kind }, type }];
same(carries_same(rtcs_seen, rtc_port("rtm:A0.out", "rtc", "TimedLong"), rtc_port("mouse.speed", "robot", "TimedLong")), true, "an exported port");
same(carries_same(rtcs_seen, rtc_port("rtm:A0.out", "rtc", "TimedLong"), rtc_port("other.in", "behavior", "TimedLong")), false, "a port that is not exported");
return count;
