// Formats values with few characters.
import { T } from "./texts.js";

/// A number with its significant decimals.
export function number_text(value) {
  if (!Number.isFinite(value)) return String(value);
  if (Number.isInteger(value)) return String(value);
  const size = Math.abs(value);
  return size >= 1000 ? value.toFixed(0) : size >= 100 ? value.toFixed(1) : size >= 1 ? value.toFixed(2) : value.toFixed(3);
}

/// "{ vx = 0.100, va = 0 }", as in the console.
export function value_text(value, most = 120) {
  let text;
  if (value === undefined || value === null) text = "–";
  else if (typeof value === "number") text = number_text(value);
  else if (ArrayBuffer.isView(value)) text = T.bytes(value.length);
  else if (typeof value !== "object") text = typeof value === "string" ? `"${value}"` : String(value);
  else if (Array.isArray(value)) text = `{ ${value.slice(0, 64).map((each) => value_text(each)).join(", ")} }`;
  else text = `{ ${Object.entries(value).map(([name, each]) => `${name} = ${value_text(each)}`).join(", ")} }`;
  return text.length > most ? `${text.slice(0, most - 1)}…` : text;
}
