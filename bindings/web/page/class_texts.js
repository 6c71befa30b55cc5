// The texts of the classroom's pages.
export const C = {
  join: {
    title: "Join the class", name: "Your name", name_hint: "in any script", go: "Join", code: "Your code", code_hint: "six letters and digits that the class gave you",
    back: "Come back", or: "You were here before?", away: "The class can't be reached. Is it still open?",
  },
  bar: {
    code: (code) => `Your code: ${code}`, code_hint: "With this code you come back to your work, also on another computer. Write it down.",
    exercise: "Exercise", check: "Check my work", checking: "It is checked…", waits: "The check waits for others…",
    hidden: (passed, count) => `${passed} of ${count} more checks passed`, not_checked: "Not checked yet.", could_not: (why) => `The work could not be checked: ${why}`,
    hints: "Hints of the teacher", new_hint: (text) => `The teacher: ${text}`, mark: (mark) => `Mark: ${mark}`, comment: "Comment of the teacher",
    frozen: "The teacher has paused the class.", helps: "The teacher helps here", looks: "The teacher looks on", projected: "This is on the projector",
    broken: (why) => `Your system can't run: ${why}. Correct it in the editor, then`, again: "Start again",
    of: (name) => `System of ${name}`, leave: "Leave", leave_hint: "Forget this pupil in this browser",
  },
  teacher: {
    title: "Class", pupils: (n) => (n === 1 ? "1 pupil" : `${n} pupils`), here: (n) => `${n} here`, address: "Pupils open", nobody: "Nobody has joined yet.",
    stop: "Stop all", stop_hint: "Emergency stop of all robots", freeze: "Freeze all", thaw: "Go on", frozen: "The class is frozen: time is paused everywhere.",
    door_open: "Let nobody in", door_closed: "Let pupils in", check: "Check all", collect: "Collect", collected: (folder) => `All work and results are in ${folder}`,
    send: "Send to all", exercise: "Exercise", hint: "Hint", hint_to: (name) => `Hint to ${name}`, hint_all: "Hint to all", hint_sent: "The hint is sent.",
    stop_projecting: "End projector", projector: "Projector", projector_link: (address) => `Open on the projector: ${address}`,
    look: "Look", help: "Help", renew: "New code", renew_sure: (name) => `Give ${name} a new code? The old one, and the pupil's open pages, then no longer work.`,
    check_one: "Check", mark_it: "Mark…", mark: "Mark", comment: "Comment", save: "Save", more: "More", restart: "Restart", exercise_one: "Send this exercise",
    states: { starting: "starts", runs: "runs", paused: "paused", stopped: "stopped", error: "error", broken: "can't run", off: "not started" },
    since: (time) => `since ${time}`, saved: (time) => `saved ${time}`, never: "nothing saved", passed: (passed, all) => `${passed} of ${all} passed`, unchecked: "not checked",
    away: "away", windows: (n) => (n === 1 ? "here" : `here, ${n} windows`), memory: (n) => `${n} MB`, code: (code) => `code ${code}`, failed: (why) => why || "It failed.",
    lost: "The connection to the class is lost; it connects again.",
  },
};

/// "abcdef" as people read it.
export const shown_code = (code) => `${code.slice(0, 3)}-${code.slice(3)}`;

/// The text of an exercise in the reader's language.
export const in_language = (english, japanese) => ((localStorage.getItem("nezumi.language") ?? navigator.language).startsWith("ja") && japanese ? japanese : english);
