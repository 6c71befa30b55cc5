// The shared system in a pupil's page: who drives, the place in the queue, and the way there and back.
import { el } from "./dom.js";
import { T } from "./texts.js";

/// Formats seconds as 4:05.
export const clock = (seconds) => `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, "0")}`;

/// The text about who drives, for all pupils.
export const who_drives = ({ driver, left }) => (driver ? T.class.shared.drives(driver, clock(left)) : T.class.shared.free);

/// `request` sends a request to the class over `link`. The result shows the state of the shared system.
export function make_shared({ request, link, notices }) {
  const { shared: words } = T.class;
  const way = el("a", { class: "button" });
  const told = el("span", { class: "shared-told", role: "status" });
  const wrong = el("span", { class: "shared-wrong" });
  const queue = el("button", { onclick: () => request(waits ? "leave_queue" : "queue") });
  const load = el("button", { text: words.load, title: words.load_hint, onclick: () => request("load") });
  const stop = el("button", { class: "stop-shared", text: words.stop, title: words.stop_hint, onclick: () => (at_shared ? link.send({ do: "stop" }) : request("stop_shared")) });
  const node = el("span", { class: "shared", hidden: true }, told, wrong, queue, load, stop, way);
  let waits = false;
  let drove = null;
  let at_shared = false;

  function show(shared, here) {
    node.hidden = !shared;
    if (!shared) return;
    const { place = 0, driving = false, own } = shared;
    waits = place > 0 || driving;
    told.textContent = driving ? words.you_drive(clock(shared.left)) : [who_drives(shared), place ? words.place(place) : ""].filter(Boolean).join(" · ");
    node.classList.toggle("driving", driving);
    const why = [shared.problem, driving && shared.not_taken ? words.not_taken(shared.not_taken) : ""].filter(Boolean).join(" · ");
    if (wrong.textContent !== why) wrong.textContent = why;
    queue.hidden = own === undefined;
    queue.textContent = driving ? words.give_back : place ? words.leave_queue : words.queue;
    load.hidden = !driving;
    at_shared = here;
    stop.hidden = here && !document.body.classList.contains("view-only");  // the header has a stop button already
    way.hidden = own === undefined;
    way.textContent = here ? words.back : words.open(shared.name);
    way.href = `/index.html#${here ? own : shared.link}`;
    if (drove === false && driving) notices.say(words.your_turn, "good");
    if (drove === true && !driving) notices.say(words.turn_over, "warn");
    drove = driving;
  }
  return { node, show };
}
