// A whole project in a link's fragment, which browsers never send.
import { deflate, from_base64url, inflate, to_base64url } from "./deflate.js";
import { checked_files } from "./project_files.js";

export const MOST = 8192;  // bytes of text

/// The fragment for a project. Throws an error if it would be longer than `MOST`.
export async function to_fragment({ name, system, files }) {
  const text = JSON.stringify({ name, system, files });
  if (Object.values(files).some((content) => typeof content !== "string")) throw new Error("pictures do not fit into a link");
  const bytes = new TextEncoder().encode(text);
  const size = Object.values(files).reduce((sum, content) => sum + new TextEncoder().encode(content).length, 0);
  if (size > MOST) throw new Error(`${size} > ${MOST} bytes`);
  return `#code=${to_base64url(await deflate(bytes))}`;
}

/// Reads the project of another person. Its content is not trusted, so it is checked.
export async function from_fragment(code) {
  const bytes = await inflate(from_base64url(code), 4 * MOST);
  const { name, system, files } = JSON.parse(new TextDecoder().decode(bytes));
  return { name: String(name).slice(0, 80), system: String(system), files: checked_files(files) };
}
