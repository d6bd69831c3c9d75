// Calls the program of a browser as the page does: the published values recomputed, and the hash over
// all trials, which is to be that of the baseline path of any machine.
//
//     node page/try-wasm.mjs FILE.wasm HASH MODEL.json
import { readFile } from "node:fs/promises";

const [path, hash, modelPath] = process.argv.slice(2);
const bytes = await readFile(path);
const module = await WebAssembly.compile(bytes);
const imports = {};
for (const { module: from, name, kind } of WebAssembly.Module.imports(module)) {
  if (kind !== "function") throw new Error(`the module imports the ${kind} ${from}.${name}`);
  // what libraries bring for programs with JavaScript of their own; nothing of it is reached
  (imports[from] ??= {})[name] = () => { throw new Error(`${from}.${name} was called`); };
}
const { exports } = await WebAssembly.instantiate(module, imports);
const encoder = new TextEncoder();
const decoder = new TextDecoder();

function written(bytes) {
  const start = exports.alloc(bytes.length);
  new Uint8Array(exports.memory.buffer).set(bytes, start);
  return [start, bytes.length];
}

function call(name, request) {
  const parts = [written(encoder.encode(name)), written(encoder.encode(JSON.stringify(request)))];
  const block = exports.call(...parts.flat());
  const view = new DataView(exports.memory.buffer);
  const [status, length] = [view.getUint32(block, true), view.getUint32(block + 4, true)];
  const text = decoder.decode(new Uint8Array(exports.memory.buffer, block + 8, length));
  exports.dealloc(block, length + 8);
  parts.forEach(([start, length]) => exports.dealloc(start, length));
  if (status !== 0) throw new Error(`${name}: ${text}`);
  return JSON.parse(text);
}

function timed(label, work) {
  const begun = performance.now();
  const result = work();
  console.log(`${label}: ${(performance.now() - begun).toFixed(0)} ms`);
  return result;
}

let failed = false;
function check(right, text) {
  console.log(`${right ? "right" : "WRONG"}: ${text}`);
  failed ||= !right;
}

const verified = timed("verify", () => call("verify", {}));
const { rows } = verified;
const passed = rows.filter((row) => row.verdict === "PASS");
check(rows.length > 100 && passed.length === rows.length, `${passed.length} of ${rows.length} published values pass`);
const [{ path: name, hash: found }] = timed("1e6 trials hashed", () => call("paths", {})).paths;
check(found === hash, `hash ${found} of the path ${name}, ${hash} of this machine's baseline`);

const text = await readFile(modelPath, "utf8");
const wish = { text, name: "model.json" };
for (const trials of [1e4, 1e5, 1e6]) {
  const answer = timed(`answer with ${trials} trials`, () => call("answer", { ...wish, trials }));
  check(answer.diagnostics.length === 0, `no mistakes in ${modelPath}`);
}
const page = timed("page", () => call("page", wish));
check(page.html.startsWith("<!DOCTYPE html>"), "a page");
const table = call("export", { ...wish, format: "csv" });
check(Buffer.from(table.base64, "base64").toString().includes(","), `an export, ${table.name}`);
check(call("examples", {}) !== null, "examples to start from");
let refused = "";
try { call("export", { ...wish, format: "xlsx" }); } catch (error) { refused = error.message; }
check(refused.includes("browser alone"), `workbooks are refused: ${refused}`);
let wrong = "";
try { call("none", {}); } catch (error) { wrong = error.message; }
check(wrong.includes("there is no call"), `other calls are refused: ${wrong}`);
exports.forget();
console.log(`memory: ${(exports.memory.buffer.byteLength / 2 ** 20).toFixed(0)} MiB`);
process.exit(failed ? 1 : 0);
