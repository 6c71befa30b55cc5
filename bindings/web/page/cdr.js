// Reads plain CDR (little endian, aligned from the start of the stream), using the type descriptions.

const utf8 = new TextDecoder();

// Size, alignment and DataView getter of types with a fixed size.
const NUMBERS = {
  int8: [1, "getInt8"], uint8: [1, "getUint8"], octet: [1, "getUint8"],
  int16: [2, "getInt16"], uint16: [2, "getUint16"],
  int32: [4, "getInt32"], uint32: [4, "getUint32"], float: [4, "getFloat32"],
  int64: [8, "getBigInt64"], uint64: [8, "getBigUint64"], double: [8, "getFloat64"],
};

class Stream {
  constructor(bytes) {
    this.bytes = bytes;
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
  }

  /// Returns the position of the next `size` bytes with this alignment, and moves behind them.
  take(size, alignment) {
    const begin = Math.ceil(this.at / alignment) * alignment;
    if (begin + size > this.bytes.length) throw new Error(`the message ends at byte ${this.bytes.length}`);
    this.at = begin + size;
    return begin;
  }

  length() {
    return this.view.getUint32(this.take(4, 4), true);
  }
}

function read_text(stream) {
  const size = stream.length();
  if (size === 0) throw new Error("a text without its end");
  const begin = stream.take(size, 1);
  return utf8.decode(stream.bytes.subarray(begin, begin + size - 1));
}

/// Readers for `types`: { NAME: [{ name, type }, ...] }.
export class Cdr {
  #types;
  #readers = new Map();

  constructor(types) {
    this.#types = types;
  }

  /// Returns the bytes as a value of this type. Throws if they are too short or the type is unknown.
  read(type, bytes) {
    return this.#reader(type)(new Stream(bytes));
  }

  #reader(type) {
    if (!this.#readers.has(type)) {
      this.#readers.set(type, (stream) => this.#readers.get(type)(stream));  // a type may contain itself
      this.#readers.set(type, this.#make(type));
    }
    return this.#readers.get(type);
  }

  #make(type) {
    const number = NUMBERS[type];
    if (number) {
      const [size, get] = number;
      const is_big = size === 8 && type !== "double";
      return (stream) => {
        const value = stream.view[get](stream.take(size, size), true);
        if (!is_big) return value;
        return Number.isSafeInteger(Number(value)) ? Number(value) : String(value);
      };
    }
    if (type === "bool") return (stream) => stream.view.getUint8(stream.take(1, 1)) !== 0;
    if (type === "string") return read_text;
    const choices = /^enum<(.+)>$/.exec(type)?.[1].split(",");
    if (choices) return (stream) => choices[stream.view.getUint32(stream.take(4, 4), true)] ?? "";
    const array = /^array<(.+),(\d+)>$/.exec(type);
    if (array) {
      const read = this.#reader(array[1]);
      return (stream) => Array.from({ length: Number(array[2]) }, () => read(stream));
    }
    const element = /^sequence<(.+)>$/.exec(type)?.[1];
    if (element === "octet" || element === "uint8") {
      return (stream) => {
        const size = stream.length();
        const begin = stream.take(size, 1);
        return stream.bytes.subarray(begin, begin + size);
      };
    }
    if (element) {
      const read = this.#reader(element);
      return (stream) => {
        const values = [];
        for (let left = stream.length(); left > 0; --left) values.push(read(stream));
        return values;
      };
    }
    const fields = this.#types[type];
    if (!fields) throw new Error(`no type is called '${type}'`);
    const readers = fields.map((field) => [field.name, this.#reader(field.type)]);
    return (stream) => {
      const value = {};
      for (const [name, read] of readers) value[name] = read(stream);
      return value;
    };
  }
}

/// A message in the form that a behaviour sees: { tm, value }.
export function to_message({ tm, ...fields }) {
  const names = Object.keys(fields);
  const value = names.length === 1 && names[0] === "data" ? fields.data : fields;
  return { tm: tm && typeof tm === "object" ? tm.sec + tm.nsec * 1e-9 : tm ?? 0, value };
}

/// The numbers within a value, with their paths: [["position.x", 0.5], ...]. Booleans are 0 and 1.
export function numbers_in(value, path = "", found = []) {
  if (typeof value === "number") found.push([path, value]);
  else if (typeof value === "boolean") found.push([path, value ? 1 : 0]);
  else if (Array.isArray(value)) {
    value.slice(0, 64).forEach((each, i) => numbers_in(each, `${path}[${i + 1}]`, found));
  } else if (value && typeof value === "object" && !ArrayBuffer.isView(value)) {
    for (const [name, each] of Object.entries(value)) numbers_in(each, path ? `${path}.${name}` : name, found);
  }
  return found;
}
