// The page of a running system: its token, its connection, its parts.
import { Link } from "./link.js";
import { make_page } from "./page.js";
import { Socket } from "./socket.js";
import { T } from "./texts.js";

/// Takes the token from the fragment of the address (after the #), which is not sent to servers. It is kept in this tab.
function take_token() {
  const given = location.hash.slice(1);
  if (given) {
    sessionStorage.setItem("nezumi.token", given);
    history.replaceState(null, "", location.pathname + location.search);
  }
  return sessionStorage.getItem("nezumi.token") ?? "";
}

async function start() {
  const token = take_token();
  const link = new Link(new Socket(token));
  const { notices } = await make_page(link);
  addEventListener("hashchange", () => location.hash.length > 1 && location.reload());
  if (token) link.connect();
  else notices.lasting("link", T.link.no_token, "error");
}

start();
