// Reads a recording of nezumi with @mcap/core, and writes one for nezumi to read.
// Usage: node mcap_core.mjs read FILE     prints { topic: { type, encoding, messages } } as JSON
//        node mcap_core.mjs write FILE plain|zstd
import { open, writeFile } from "node:fs/promises";
import { McapIndexedReader, McapWriter } from "@mcap/core";
import zstd from "@foxglove/wasm-zstd";

await zstd.isLoaded;

async function read(path) {
  const file = await open(path);
  const readable = {
    size: async () => BigInt((await file.stat()).size),
    read: async (offset, length) => {
      const bytes = new Uint8Array(Number(length));
      await file.read(bytes, 0, Number(length), Number(offset));
      return bytes;
    },
  };
  const decompressHandlers = { zstd: (bytes, size) => zstd.decompress(bytes, Number(size)) };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const topics = {};
  for (const { topic, schemaId, messageEncoding } of reader.channelsById.values()) {
    const { name, encoding } = reader.schemasById.get(schemaId);
    topics[topic] = { type: name, encoding: `${messageEncoding} ${encoding}`, messages: 0 };
  }
  for await (const { channelId } of reader.readMessages()) ++topics[reader.channelsById.get(channelId).topic].messages;
  console.log(JSON.stringify(topics));
  await file.close();
}

const cdr = (length, fill) => {
  const bytes = new Uint8Array(4 + length);
  bytes[1] = 1;  // little endian
  fill(new DataView(bytes.buffer, 4));
  return bytes;
};
const distances = (numbers) => cdr(12 + 2 * numbers.length, (view) => {
  view.setUint32(8, numbers.length, true);
  numbers.forEach((each, i) => view.setInt16(12 + 2 * i, each, true));
});
const velocity = (vx) => cdr(48, (view) => view.setFloat64(0, vx, true));
const vector3 = "\n================================================================================\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";
const layout = "\n================================================================================\nMSG: std_msgs/MultiArrayLayout\nMultiArrayDimension[] dim\nuint32 data_offset\n" +
  "\n================================================================================\nMSG: std_msgs/MultiArrayDimension\nstring label\nuint32 size\nuint32 stride\n";

// A second of a robot that comes near a wall, and of what drives it: 0.4 m/s until a distance is above 300.
async function write(path, compression) {
  const parts = [];
  let size = 0n;
  const writable = {
    position: () => size,
    write: async (bytes) => {
      parts.push(Buffer.from(bytes));
      size += BigInt(bytes.byteLength);
    },
  };
  const writer = new McapWriter({ writable, ...(compression === "zstd" && {
    compressChunk: (bytes) => ({ compression: "zstd", compressedData: zstd.compress(bytes) }) }) });
  await writer.start({ profile: "ros2", library: "elsewhere" });
  const channel = async (topic, name, text) => writer.registerChannel({ topic, messageEncoding: "cdr", metadata: new Map(),
    schemaId: await writer.registerSchema({ name, encoding: "ros2msg", data: new TextEncoder().encode(text) }) });
  const ir = await channel("/ir", "std_msgs/msg/Int16MultiArray", "MultiArrayLayout layout\nint16[] data\n" + layout);
  const out = await channel("/cmd_vel", "geometry_msgs/msg/Twist", "Vector3 linear\nVector3 angular\n" + vector3);
  for (let i = 0; i < 100; ++i) {
    const time = { sequence: i, logTime: BigInt(i) * 10_000_000n, publishTime: BigInt(i) * 10_000_000n };
    await writer.addMessage({ channelId: ir, ...time, data: distances([i * 5, 0, 0, 0]) });
    await writer.addMessage({ channelId: out, ...time, data: velocity(i * 5 > 300 ? 0 : 0.4) });
  }
  await writer.end();
  await writeFile(path, Buffer.concat(parts));
}

const [what, ...given] = process.argv.slice(2);
await (what === "read" ? read(...given) : write(...given));
