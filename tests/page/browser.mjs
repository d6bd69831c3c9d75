// A browser and a server for the tests of the live page.
import { spawn } from "node:child_process";
import { readFile } from "node:fs/promises";
import { createRequire } from "node:module";
import { join } from "node:path";

const modules = process.env.PAGE_MODULES;
const required = createRequire(join(modules, "node_modules", "x"));
export const { chromium } = required("playwright-core");
export const axe = required.resolve("axe-core/axe.min.js");

/** Chromium without a window, and without anything that it loads for itself. */
export function browser() {
  return chromium.launch({
    executablePath: process.env.CHROMIUM || "/usr/bin/chromium",
    headless: true,
    args: ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
      "--disable-background-networking", "--disable-component-update", "--disable-sync"],
  });
}

/** `gumption open` on a folder: its address, and a way to end it. */
export async function serve(place, ...more) {
  const child = spawn(process.env.GUMPTION, ["open", "--no-browser", place, ...more], { stdio: ["ignore", "pipe", "pipe"] });
  const address = await new Promise((resolve, reject) => {
    let text = "";
    child.stdout.on("data", data => {
      text += data;
      const found = text.match(/http:\/\/\S+/);
      if (found) resolve(found[0]);
    });
    child.stderr.on("data", () => {});
    child.on("exit", code => reject(new Error(`gumption open ended with ${code}`)));
  });
  return { address, id: child.pid, stop: () => { child.removeAllListeners("exit"); child.kill("SIGINT"); } };
}

/** A page at an address. With PAGE_FILES the page's own files come from that folder instead of the program. */
export async function visit(context, address) {
  const page = await context.newPage();
  page.errors = [];
  page.on("pageerror", error => page.errors.push(String(error.stack || error)));
  page.on("console", message => {
    if (message.type() === "error" && !/status of (409|422|400)/.test(message.text())) page.errors.push(message.text());
  });
  const files = process.env.PAGE_FILES;
  if (files) {
    const kinds = { html: "text/html", js: "text/javascript", css: "text/css" };
    await page.route("**/assets/*", async (route, request) => {
      const name = new URL(request.url()).pathname.split("/").pop();
      try {
        const body = await readFile(join(files, name));
        await route.fulfill({ body, contentType: kinds[name.split(".").pop()] });
      } catch { await route.continue(); }
    });
    await page.route(url => url.pathname === "/", async route => {
      const given = await route.fetch({ maxRedirects: 0 });
      if (given.status() !== 200) return route.fulfill({ response: given });
      return route.fulfill({ response: given, body: await readFile(join(files, "index.html")) });
    });
  }
  await page.addInitScript(() => {
    window.answered = [];
    document.addEventListener("answered", event => window.answered.push(event.detail));
  });
  if (files) {
    // what follows a redirection is not routed
    const { location } = (await context.request.get(address, { maxRedirects: 0 })).headers();
    address = new URL(location || address, address).href;
  }
  await page.goto(address);
  const isThere = () => window.answered && (window.answered.length > 0 || document.querySelector("#large .card svg"));
  await page.waitForFunction(isThere, null, { timeout: 20000 }).catch(error => {
    throw new Error([error.message, ...page.errors].join("\n"));
  });
  return page;
}

/** Waits until the full answer is there. */
export function refined(page) {
  return page.waitForFunction(() => !/…/.test(document.getElementById("progress").textContent) && document.getElementById("progress").textContent !== "", null, { timeout: 60000 });
}
