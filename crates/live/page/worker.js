// The program itself, as WebAssembly, beside the page so that it never waits for it.
let program = null;
let started = null;

// a module that has failed is not to be trusted any more: the next call gets a new one, whose files
// are handed over again
async function start() {
  if (program) return;
  started ??= (async () => {
    const found = await fetch("gumption.wasm");
    if (!found.ok) throw new Error("gumption.wasm is missing");
    const module = await WebAssembly.compile(await found.arrayBuffer());
    // what libraries bring for programs with scripts of their own; nothing of it is reached
    const imports = {};
    for (const { module: from, name } of WebAssembly.Module.imports(module)) {
      (imports[from] ??= {})[name] = () => { throw new Error(`${name} is not there`); };
    }
    return [module, imports];
  })();
  program = (await WebAssembly.instantiate(...await started)).exports;
  for (const [name, bytes] of held) hold(name, bytes);
}

const held = new Map();

function put(bytes) {
  const place = program.alloc(bytes.length);
  new Uint8Array(program.memory.buffer, place, bytes.length).set(bytes);
  return [place, bytes.length];
}

// lends bytes to the program for as long as the work takes
function lent(parts, work) {
  const places = parts.map(put);
  const result = work(...places.flat());
  for (const [place, length] of places) program.dealloc(place, length);
  return result;
}

function hold(name, bytes) {
  lent([new TextEncoder().encode(name), bytes], program.hold);
}

function called(name, request) {
  const texts = [name, request].map(text => new TextEncoder().encode(text));
  const block = lent(texts, program.call);
  const head = new DataView(program.memory.buffer, block, 8);
  const [status, length] = [head.getUint32(0, true), head.getUint32(4, true)];
  const answer = new TextDecoder().decode(new Uint8Array(program.memory.buffer, block + 8, length));
  program.dealloc(block, length + 8);
  return { status, answer };
}

self.onmessage = async ({ data }) => {
  try {
    await start();
    if (data.hold) {
      held.set(data.hold, new Uint8Array(data.bytes));
      hold(data.hold, held.get(data.hold));
      self.postMessage({ number: data.number, status: 0, answer: "null" });
      return;
    }
    self.postMessage({ number: data.number, ...called(data.name, data.request) });
  } catch (error) {
    program = null;
    self.postMessage({ number: data.number, status: 2, answer: String(error && error.message || error) });
  }
};
