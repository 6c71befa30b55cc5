// Zip archives of a project: written and read by the browser alone.
import { deflate, inflate } from "./deflate.js";
import { is_name } from "./project_files.js";

const MOST_BYTES = 1 << 24;
const LOCAL = 0x04034b50, CENTRAL = 0x02014b50, END = 0x06054b50;
const DEFLATED = 8, UTF8 = 0x0800, TEXT_DATE = 0x21;  // always 1980-01-01: equal projects give equal archives

const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, n) => {
  for (let k = 0; k < 8; ++k) n = n & 1 ? 0xedb88320 ^ (n >>> 1) : n >>> 1;
  return n;
});
const crc_of = (bytes) => ~bytes.reduce((crc, each) => CRC_TABLE[(crc ^ each) & 255] ^ (crc >>> 8), -1) >>> 0;

/// The bytes of a record. Each number is given as [value, size in bytes].
function record(...numbers) {
  const bytes = new Uint8Array(numbers.reduce((sum, [, size]) => sum + size, 0));
  let at = 0;
  for (const [value, size] of numbers) for (let i = 0; i < size; ++i) bytes[at++] = (value >>> (8 * i)) & 255;
  return bytes;
}

const bytes_of = (content) => (typeof content === "string" ? new TextEncoder().encode(content) : Uint8Array.from(atob(content.base64), (each) => each.charCodeAt(0)));

export async function write_zip(files) {
  const parts = [];
  const central = [];
  let at = 0;
  for (const [name, content] of Object.entries(files)) {
    const bytes = bytes_of(content);
    const packed = await deflate(bytes);
    const named = new TextEncoder().encode(name);
    const common = [[20, 2], [UTF8, 2], [DEFLATED, 2], [0, 2], [TEXT_DATE, 2], [crc_of(bytes), 4], [packed.length, 4], [bytes.length, 4], [named.length, 2], [0, 2]];
    central.push(record([CENTRAL, 4], [20, 2], ...common, [0, 2], [0, 2], [0, 2], [0, 4], [at, 4]), named);
    const local = [record([LOCAL, 4], ...common), named, packed];
    parts.push(...local);
    at += local.reduce((sum, each) => sum + each.length, 0);
  }
  const count = Object.keys(files).length;
  const size = central.reduce((sum, each) => sum + each.length, 0);
  return new Blob([...parts, ...central, record([END, 4], [0, 2], [0, 2], [count, 2], [count, 2], [size, 4], [at, 4], [0, 2])], { type: "application/zip" });
}

/// The files of an archive by name, without files that a project can't use. A folder that contains all files is removed
/// from the names.
export async function read_zip(bytes) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  let end = bytes.length - 22;
  while (end >= 0 && view.getUint32(end, true) !== END) --end;
  if (end < 0) throw new Error("this is not a zip archive");
  const files = {};
  let total = 0;
  let at = view.getUint32(end + 16, true);
  for (let left = view.getUint16(end + 10, true); left > 0; --left) {
    if (view.getUint32(at, true) !== CENTRAL) throw new Error("the zip archive is damaged");
    const [method, packed, size] = [view.getUint16(at + 10, true), view.getUint32(at + 20, true), view.getUint32(at + 24, true)];
    const [name_size, extra, comment] = [28, 30, 32].map((offset) => view.getUint16(at + offset, true));
    const local = view.getUint32(at + 42, true);
    const name = new TextDecoder().decode(bytes.subarray(at + 46, at + 46 + name_size));
    at += 46 + name_size + extra + comment;
    if (!is_name(name)) continue;
    total += size;
    if (total > MOST_BYTES) throw new Error("the zip archive is too large");
    const begin = local + 30 + view.getUint16(local + 26, true) + view.getUint16(local + 28, true);
    const content = bytes.subarray(begin, begin + packed);
    const whole = method === DEFLATED ? await inflate(content, size) : content;
    files[name] = text_or_bytes(whole);
  }
  return without_folder(files);
}

function text_or_bytes(bytes) {
  try {
    return new TextDecoder("utf-8", { fatal: true }).decode(bytes);
  } catch {
    return { base64: btoa(Array.from(bytes, (each) => String.fromCharCode(each)).join("")) };
  }
}

function without_folder(files) {
  const names = Object.keys(files);
  const folder = names[0]?.split("/")[0];
  if (folder === "behaviors" || folder === "scenarios" || !names.every((name) => name.startsWith(`${folder}/`))) return files;
  return Object.fromEntries(names.map((name) => [name.slice(folder.length + 1), files[name]]));
}
