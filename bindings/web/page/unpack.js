// The first script of a page of one file: unpacks the others, the run, and the engine if there is one.
"use strict";
(async () => {
  const text_of = (id) => document.getElementById(id).textContent.trim();
  const bytes_of = (id) => Uint8Array.from(atob(text_of(id)), (each) => each.charCodeAt(0));
  const unpacked = (id) => new Response(new Blob([bytes_of(id)]).stream().pipeThrough(new DecompressionStream("gzip")));
  const address_of = (text) => URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  const add = (type, text) => document.head.append(Object.assign(document.createElement("script"), { type, textContent: text }));

  const { first, modules, scripts, worker, shipped } = await unpacked("packed").json();
  for (const each of scripts) add("text/javascript", each);
  const run = await unpacked("run").text();
  globalThis.nezumi_run = worker ? { run, wasm: await unpacked("wasm").arrayBuffer(), worker: address_of(worker), shipped } : { run };
  add("importmap", JSON.stringify({ imports: Object.fromEntries(Object.entries(modules).map(([name, text]) => [`nezumi/${name}`, address_of(text)])) }));
  add("module", `import "nezumi/${first}";`);
})();
