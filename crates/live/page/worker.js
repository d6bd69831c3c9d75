// The program itself, as WebAssembly, beside the page so that it never waits for it.
let program = null;
const ready = (async () => {
  const found = await fetch("gumption.wasm");
  if (!found.ok) throw new Error("gumption.wasm is not there");
  program = (await WebAssembly.instantiate(await found.arrayBuffer(), {})).instance.exports;
})();

function put(bytes) {
  const place = program.alloc(bytes.length);
  new Uint8Array(program.memory.buffer, place, bytes.length).set(bytes);
  return place;
}

function called(name, request) {
  const write = text => { const bytes = new TextEncoder().encode(text); return [put(bytes), bytes.length]; };
  const block = program.call(...write(name), ...write(request));
  const head = new DataView(program.memory.buffer, block, 8);
  const [status, length] = [head.getUint32(0, true), head.getUint32(4, true)];
  const answer = new TextDecoder().decode(new Uint8Array(program.memory.buffer, block + 8, length));
  program.dealloc(block, length + 8);
  return { status, answer };
}

self.onmessage = async ({ data }) => {
  try {
    await ready;
    if (data.hold) {
      const name = new TextEncoder().encode(data.hold), bytes = new Uint8Array(data.bytes);
      program.hold(put(name), name.length, put(bytes), bytes.length);
      self.postMessage({ number: data.number, status: 0, answer: "null" });
      return;
    }
    self.postMessage({ number: data.number, ...called(data.name, data.request) });
  } catch (error) {
    self.postMessage({ number: data.number, status: 2, answer: String(error && error.message || error) });
  }
};
