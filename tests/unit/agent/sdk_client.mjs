// The protocol's own client in JavaScript against `nezumi mcp`: it lists, reads, writes a draft and looks at a world.
import { Client } from "@modelcontextprotocol/sdk/client/index.js";
import { StdioClientTransport } from "@modelcontextprotocol/sdk/client/stdio.js";

const [nezumi, project] = process.argv.slice(2);
const transport = new StdioClientTransport({ command: nezumi, args: ["mcp", "--project", project], env: process.env });
const client = new Client({ name: "test", version: "1.0.0" });
await client.connect(transport);

const expect = (truth, what) => {
  if (!truth) throw new Error(what);
};
const call = async (name, args = {}) => (await client.callTool({ name, arguments: args })).content[0];

const { tools } = await client.listTools();
expect(tools.some((tool) => tool.name === "go_live"), "go_live is a tool");
const { resources } = await client.listResources();
expect(resources.length > 20, "the pages are resources");
const page = await client.readResource({ uri: "nezumi://docs/agents.md" });
expect(page.contents[0].text.includes("rehearse"), "a page is read");
expect((await call("list_files")).text.includes("behaviors/explorer.lua"), "files are listed");
const text = (await call("read_file", { path: "behaviors/explorer.lua" })).text;
expect((await call("write_behavior", { name: "explorer", text })).text.includes("the check passes"), "a draft is kept");
expect((await call("go_live", { name: "explorer" })).text.includes("is live"), "it goes live");
await call("open_world", { system: "behaviors/systems/room.lua" });
await call("run", { seconds: 1 });
expect((await call("picture")).mimeType === "image/png", "a picture is taken");
await client.ping();
await client.close();
console.log("ok");
