// Serves the folder of `gumption open --static` to Chromium, lets the page's own worker recompute the
// published values there, and compares.
//
//     node page/try-static.mjs FOLDER HASH CHROMIUM
import { spawn } from "node:child_process";
import { mkdtemp, readFile, rm } from "node:fs/promises";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

const [folder, hash, chromium] = process.argv.slice(2);
const kinds = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".wasm": "application/wasm" };

// what runs in the browser: through the worker that the page has
const script = `
const worker = new Worker("assets/worker.js");
const waiting = new Map();
let number = 0;
worker.onmessage = ({ data }) => waiting.get(data.number)?.(data);
worker.onerror = (error) => tell({ error: error.message });
const ask = (name, request) => new Promise((done) => {
  waiting.set(++number, done);
  worker.postMessage({ number, name, request: JSON.stringify(request) });
});
const tell = (found) => fetch("found", { method: "POST", body: JSON.stringify(found) });
const begun = performance.now();
const verified = await ask("verify", {});
const ended = performance.now();
const paths = await ask("paths", {});
await tell({ verified, paths, time: ended - begun });
`;
const page = '<!DOCTYPE html><html lang="en"><title>Try</title><script type="module" src="try.js"></script></html>';

let told;
const found = new Promise((done) => { told = done; });
const server = createServer(async (request, response) => {
  const path = normalize(new URL(request.url, "http://x").pathname);
  if (request.method === "POST") {
    let body = "";
    for await (const part of request) body += part;
    response.end();
    told(JSON.parse(body));
    return;
  }
  const made = { "/try.html": page, "/try.js": script }[path];
  try {
    const content = made ?? (await readFile(join(folder, path)));
    response.setHeader("Content-Type", kinds[extname(path)] ?? "text/plain");
    response.end(content);
  } catch {
    response.statusCode = 404;
    response.end();
  }
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const profile = await mkdtemp(join(tmpdir(), "gumption-chromium-"));
const browser = spawn(chromium, [
  "--headless", "--no-sandbox", "--disable-gpu", `--user-data-dir=${profile}`,
  `http://127.0.0.1:${server.address().port}/try.html`,
], { stdio: "ignore" });
const late = setTimeout(() => told({ error: "Chromium gave no answer in ten minutes" }), 600_000);
const { error, verified, paths, time } = await found;
clearTimeout(late);
browser.kill();
await new Promise((done) => browser.once("exit", done));
server.close();
await rm(profile, { recursive: true, force: true, maxRetries: 5 });

let failed = false;
function check(right, text) {
  console.log(`${right ? "right" : "WRONG"} in Chromium: ${text}`);
  failed ||= !right;
}
if (error) {
  check(false, error);
} else if (verified.status !== 0) {
  check(false, verified.answer);
} else {
  const { rows } = JSON.parse(verified.answer);
  const passed = rows.filter((row) => row.verdict === "PASS").length;
  check(rows.length > 100 && passed === rows.length, `${passed} of ${rows.length} published values pass, in ${time.toFixed(0)} ms`);
  const own = paths.status === 0 ? JSON.parse(paths.answer).paths[0].hash : paths.answer;
  check(own === hash, `hash ${own}, ${hash} of this machine's baseline`);
}
process.exit(failed ? 1 : 0);
