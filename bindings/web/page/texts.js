// Every text of the page in one table, so that another language needs only another table.

const EN = {
  views: { world: "World", diagram: "System", plots: "Plots", drive: "Drive", parameters: "Parameters",
    cameras: "Cameras", console: "Console", explain: "Explain", log: "Log" },
  parts: { stage: "System", side: "Controls", dock: "Console and log", all: "Views", more: "More" },
  real: "real robots",
  simulated: "simulated",
  view_only: "view only",
  systems: { hint: "Systems that run on this machine", here: "this page", process: (id) => `process ${id}`,
    about: "Through a tunnel, make one for each." },
  share: { hint: "Copy a view-only address", copied: "Copied. This address shows everything but controls nothing.",
    here: (address) => `View-only address: ${address}` },
  theme: { label: "Colours", auto: "Automatic", light: "Light", dark: "Dark" },

  link: {
    connecting: "Connecting…",
    open: "Connected",
    away: (s) => `Connection lost. The robot that you drove has stopped. Trying again in ${s} s.`,
    refused: "The engine was restarted and does not know this page's token. Open the new address that it printed.",
    no_token: "Open the address that `nezumi run` printed, with the part after the #.",
    back: "Connected again.",
    bye: (text) => `The engine has ended: ${text}`,
    lost: (count) => `${count} log lines were dropped.`,
    no_answer: "No answer.",
  },

  stop: { label: "Stop", hint: "Stop all robots at once (space bar)", rearm: "Re-arm",
    rearm_hint: "Let the robots move again", not_sent: "Not sent: there is no connection.", held: "Stopped. Commands are ignored until you re-arm." },

  time: { label: "Time", pause: "Pause", resume: "Run", step: "Step", step_hint: "One tick", restart: "Restart",
    restart_sure: "Restart the system? Every component starts again; components that were added are lost.",
    speed: "Speed", max: "max", late: (ms) => `${ms} ms late`, on_time: "on time", paused: "paused",
    running: "running", seconds: (s) => `${s} s` },

  splits: { dock: "Height of the console", side: "Width of the controls", hint: "Drag, or move by arrow keys; a double click puts it back" },

  troubles: { count: (n) => (n === 1 ? "1 error" : `${n} errors`), show: "Show",
    runs: (version, names, more) => `Version ${version} runs: ${names}${more > 0 ? ` and ${more} more` : ""}.` },

  past: { label: "Time line", time: "Go to this time", branch: "Branch", now: "Now", now_hint: "To the end of this branch",
    of: (time, end) => `${time} of ${end}`, is_past: "past", hint: "What followed happens again when time runs. Every change begins a new branch." },

  world: {
    label: "The world, seen from above. Drag to turn, two fingers or the right button to move, the wheel to zoom.",
    top: "Top", follow: "Follow", rays: "Rays", trails: "Trails", names: "Names", whole: "Whole",
    whole_hint: "Show the whole arena", none: "none",
    about: "Drag a robot, marker, box or wall to move it. Selected: arrow keys move it, [ and ] turn it.",
    select: "Select", no_gl: "This browser shows no 3D pictures (WebGL is off). Everything else works.",
    no_truth: "The true poses of real robots are unknown: they are drawn at their odometry poses.",
    pose: (x, y, deg) => `x ${x}  y ${y}  ${deg}°`,
    touching: (what) => `touching ${what}`, value: (cm, value) => (value === undefined ? `${cm} cm` : `${cm} cm · ${value}`),
  },

  drive: {
    port: "Drives", label: "Joystick: drag the stick, or use the arrow keys. Releasing it stops the robot.",
    x: "x", y: "y", r: "r", theta: "θ", px: "px", deg: "°",
    scale: "Full stick", gamepad: "Gamepad", no_gamepad: "Press a button of a gamepad to use it.",
    gamepad_in_use: (id) => `In use: ${id}`,
    nobody: "No driver.", you: "You drive.", other: (who) => `${who} drives.`,
    take: "Take over",
    keys: "Arrow keys or W A S D while the pad has the focus; Shift for half.",
    nothing: "This system has no port that can be driven.", v: "v", w: "ω",
    connected: (from) => `While you drive, messages from ${from} are blocked.`,
  },

  parameters: {
    none: "No component has parameters.", search: "Search parameters",
    changed: "changed by hand", back_to: (v) => `Reset to ${v}`, set: "Set", no_set: "none",
    bounds: (min, max) => `${min} … ${max}`, at_least: (min) => `at least ${min}`, at_most: (max) => `at most ${max}`,
    not_a_number: "a number is needed", not_whole: "a whole number is needed",
    above: (max) => `above its maximum ${max}`, below: (min) => `below its minimum ${min}`,
    add: "Add", remove: "Remove", up: "Up", down: "Down", element: (i) => `element ${i}`,
  },

  diagram: {
    label: "Components and their connections",
    activate: "Activate", deactivate: "Deactivate", reset: "Reset", remove: "Remove", disconnect: "Disconnect",
    all: "All", fit: "Fit", arrange: "Arrange", zoom_in: "Closer", zoom_out: "Farther",
    about: "Drag from a port to one of the same type. By keyboard: Enter on a port, then on another.",
    connecting: (port, type) => `${port} (${type}): choose a port that lights up, or press Esc.`,
    remove_sure: (name) => `Remove ${name} and its connections?`,
    connection: (from, to, waits) => `Connection from ${from} to ${to}${waits ? ", which waits" : ""}`,
    remote: ({ host }) => (host.here ? "other host" : "offline"),
    of_host: ({ name, here, version }) => (here ? `of host ${name}, which runs nezumi ${version}` : `of host ${name}, which is offline: its connections wait`),
    waits: ({ name, here }) => (here ? `host ${name} has no such port` : `waits for host ${name}`),
    port: (name, way, type) => `${{ in: "In-port", out: "Out-port" }[way] ?? "Service port"} ${name}, ${type}`,
    nothing_yet: "no message yet", age: (s) => `${s} s ago`,
    in: "in", out: "out", service: "service", add: "Add…", save: "Save…", save_now: "Save", save_as: "Save the system as it is now, within its project, as",
    saved: (name) => `Saved as ${name}; the console says where.`,
  },
  rtc: { forget: "Remove its name", gone: "Its program has crashed and left its name in the name service.",
    missing: "It is not in the name service; its connections wait.", exit: "Exit", exit_sure: (name) => `End ${name}? Its program decides what that means.`,
    by_tool: (name) => `made by a tool; ${name} can end it`, problem: (text) => `RTCs: ${text}` },
  add: { title: "Add a behaviour", name: "name", name_hint: "lower-case letters, digits and _", is_new: "write a new file for it", script: "script",
    script_hint: "the name of a behaviour of the project", doc: "a sentence: what it does", input: "in-port", output: "out-port", port: "port",
    type: "message type", about: "its content", param: "parameter", callbacks: "callbacks besides on_execute", param_hint: "name=default, as in gain=0.5", add: "Add" },
  states: { INACTIVE: "inactive", ACTIVE: "active", ERROR: "error", CREATED: "created", REMOTE: "on another host",
    UNKNOWN: "without a state", SILENT: "does not answer", GONE: "gone", UNASKED: "not asked", MISSING: "not there" },

  plots: { add: "Add a field", port: "Port", field: "Field", plot: "Plot", pause: "Pause", resume: "Resume", csv: "CSV",
    svg: "SVG", clear: "Clear", remove: (name) => `Remove ${name}`, empty: "Choose a port and one of its numbers.",
    zoom_out: "Last minute", time: "time [s]", no_fields: "no message yet", zoom: "Drag across the plot to zoom; double-click shows all." },

  cameras: { none: "This system has no camera.", waiting: "No picture yet." },

  console: { label: "Console", input: "A line of Lua; Tab completes, ↑ and ↓ recall", run: "Run", interrupt: "Interrupt",
    clear: "Clear", hello: "The system's names are in scope: try ls() or help()." },

  explain: {
    which: "Behaviour", look: "Explain", look_hint: "Look at the next execution, line by line", follow: "Repeat",
    about: "Choose a robot in the world, or a behaviour here: its next execution is shown, from its sensor values to the commands of its wheels.",
    none: "none", no_lines: "No line of Lua ran.", cut: "… and more lines", turns: (count) => `… ${count} more turns`,
    paused: "Time is paused: press Step to execute it.",
    when: (name, at, tick) => `${name} at ${at} s, tick ${tick}`,
    inputs: "Inputs", lines: "Executed lines with their values", outputs: "Outputs",
    limits: (robot) => `${robot}: limits`, wheels: (robot) => `${robot}: wheels`,
    asked: (v) => `command ${v}`, limited: (v, speed, rate) => `limited to ${v} (limits: ${speed} m/s, ${rate} rad/s)`,
    rims: (left, right) => `left ${left} m/s, right ${right} m/s`, free: "They roll freely.",
  },

  log: { label: "Log", search: "Search", level: "Level", debug: "debug", info: "info", warn: "warn", error: "error",
    clear: "Clear", follow: "Newest", empty: "Nothing yet.", count: (n) => (n === 1 ? "1 line" : `${n} lines`) },

  failed: (what, text) => (text ? text : `${what} failed.`),
  missing: (library) => `Debian's package ${library} is not installed where the engine runs: this view needs it.`,
  close: "Close",
  cancel: "Cancel",
};

export const T = EN;
