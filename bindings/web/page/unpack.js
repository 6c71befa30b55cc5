// The first script of a page in one file: unpacks the other scripts, the run, and the engine if there is one.
"use strict";
(async () => {
  const text_of = (id) => document.getElementById(id).textContent;
  const of_base64 = (text) => Uint8Array.from(atob(text), (each) => each.charCodeAt(0));
  /// Decodes text with seven bits in each character, as bindings/wasm/bundle writes it.
  const of_letters = (text) => {
    const bytes = new Uint8Array(Math.floor((text.length * 7) / 8));
    for (let i = 0, at = 0, bits = 0, count = 0; i < text.length; ++i) {
      bits = (bits << 7) | (text.charCodeAt(i) & 127);
      count += 7;
      if (count >= 8) bytes[at++] = bits >> (count -= 8);
    }
    return bytes;
  };
  const unpacked = (bytes) => new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")));
  const address_of = (text) => URL.createObjectURL(new Blob([text], { type: "text/javascript" }));
  const add = (type, text) => document.head.append(Object.assign(document.createElement("script"), { type, textContent: text }));

  const { first, modules, scripts, worker, shipped } = await unpacked(of_letters(text_of("packed"))).json();
  for (const each of scripts) add("text/javascript", each);
  const run = await unpacked(of_base64(text_of("run"))).text();
  globalThis.nezumi_run = worker ? { run, wasm: await unpacked(of_letters(text_of("wasm"))).arrayBuffer(), worker: address_of(worker), shipped } : { run };
  add("importmap", JSON.stringify({ imports: Object.fromEntries(Object.entries(modules).map(([name, text]) => [`nezumi/${name}`, address_of(text)])) }));
  add("module", `import "nezumi/${first}";`);
})();
