// What the live page does, in a browser: usage: node tests.mjs REPOSITORY PICTURES
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFile, cp, mkdir, mkdtemp, readFile, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { axe, browser, refined, serve, visit } from "./browser.mjs";

const [, , root, pictures] = process.argv;
const only = process.env.ONLY;
const work = await mkdtemp(join(tmpdir(), "gumption-page-"));
await mkdir(pictures, { recursive: true });
const chromium = await browser();
let failed = 0, made = 0;

/** A test in a context of its own, with a folder of its own that is served. */
async function test(name, act, { open = "", files = [], lang = "en", ...options } = {}) {
  if (only && !name.includes(only)) return;
  const folder = join(work, `case${++made}`);
  await mkdir(folder);
  for (const [from, to] of files) await cp(join(root, from), join(folder, to), { recursive: true });
  const server = await serve(join(folder, open), "--lang", lang);
  const context = await chromium.newContext({ viewport: { width: 1400, height: 1000 }, acceptDownloads: true, ...options });
  let page;
  try {
    page = await visit(context, server.address);
    await act(page, folder, context, server);
    assert.deepEqual(page.errors, [], "the browser's console");
    console.log(`ok    ${name}`);
  } catch (error) {
    failed += 1;
    console.log(`FAIL  ${name}\n${error.stack}\n${page ? page.errors.join("\n") : ""}`);
    if (page) await page.screenshot({ path: join(work, `failed-${made}.png`) }).catch(() => {});
  } finally {
    await context.close();
    server.stop();
  }
}

const text = (page, selector) => page.locator(selector).first().innerText();
const shot = (page, name, options = {}) => page.screenshot({ path: join(pictures, `live-${name}.png`), ...options });
/** Does something, and waits for the answer without or with mistakes that follows. */
async function answered(page, act) {
  const before = await page.evaluate(() => window.answered.length);
  await act();
  await page.waitForFunction(count => window.answered.length > count, before);
}
const field = (page, label) => page.getByLabel(label, { exact: true });
const until = (page, check, argument) => page.waitForFunction(check, argument, { timeout: 20000 });
/** What axe-core says against the page as it stands. */
async function violations(page) {
  await page.evaluate(await readFile(axe, "utf8") + ";window.axe = axe;0");
  const found = await page.evaluate(() => window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] }));
  return found.violations.map(of => `${of.id}: ${of.help}\n    ${of.nodes.slice(0, 3).map(node => node.html.slice(0, 160)).join("\n    ")}`);
}
const source = page => page.evaluate(() => document.getElementById("source").value);

await test("the resistor of the README from nothing, with the command line's digits", async (page, folder) => {
  await page.fill("#title", "Power in a resistor");
  await page.fill("#equations", "power = voltage^2/resistance");
  await page.locator("#missing").getByText("all of them").click();
  await field(page, "mean of voltage").fill("5.01");
  await field(page, "standard uncertainty u of voltage").fill("0.01");
  await field(page, "Unit of voltage").fill("V");
  await page.getByLabel("Distribution of resistance").selectOption("readings");
  await field(page, "values of resistance").fill("99.8 100.1 100.0 99.9");
  await field(page, "Unit of resistance").fill("ohm");
  await page.locator("#unreported").getByText("power").click();
  await field(page, "Unit of power").fill("mW");
  // the certificate's own words: expanded uncertainty with its factor
  await page.click("#view-text");
  await until(page, () => document.getElementById("source").value.includes('"mW"'));
  const typed = (await source(page)).replace('"std": 0.01', '"expanded": 0.02, "k": 2');
  await page.fill("#source", typed);
  await page.click("#view-form");
  await until(page, () => document.querySelectorAll("#mistakes li").length === 0 && /power/.test(document.getElementById("headline").innerText));
  await refined(page);
  await page.keyboard.press("Control+s");
  await page.locator("#dialog input").fill("power.json");
  await page.locator("#dialog-actions button").first().click();
  await until(page, () => document.getElementById("state").textContent === "saved");
  const run = place => JSON.parse(execFileSync(process.env.GUMPTION, ["run", place, "--format", "json", "--quiet"])).outputs.power;
  const own = run(join(folder, "power.json")), readme = run(join(root, "models/examples/power.json"));
  assert.deepEqual(own, readme, "the file that the page wrote is the README's");
  const page_ = execFileSync(process.env.GUMPTION, ["run", join(folder, "power.json"), "--format", "markdown", "--quiet"]).toString();
  const stated = page_.split("\n").find(line => line.startsWith("**power") || /power = /.test(line) && /coverage/.test(line));
  const value = stated.match(/power = ([^,]*),/)[1].replace(/[\s*]/g, "");
  const shown = (await text(page, "#headline .value")).replace(/^.*=/, "").replace(/\s/g, "");
  assert.equal(shown, value);
  await shot(page, "resistor", { fullPage: true });
  await shot(page, "first-screen");
});

const POWER = { open: "power.json", files: [["models/examples/power.json", "power.json"]] };

await test("mistakes are underlined where they stand", async page => {
  await answered(page, () => page.fill("#equations", "power = voltage^2/resistanse"));
  await until(page, () => document.querySelector("#equations-box mark"));
  assert.equal(await text(page, "#equations-box mark"), "resistanse");
  assert.match(await text(page, "#mistakes"), /did you mean `resistance`/);
  await page.fill("#equations", "power = voltage + resistance");
  await until(page, () => (document.querySelector("#equations-box mark") || {}).textContent === "+");
  await page.click("#view-text");
  await until(page, () => document.querySelector("#source-box mark"));
  assert.equal(await page.locator("#source-box mark").textContent(), "+");
  await page.click("#view-form");
  await field(page, "expanded uncertainty U of voltage").fill("-1");
  await until(page, () => document.querySelector("#inputs [aria-invalid=true]"));
  await shot(page, "mistakes");
  // over the marks the letters stand where they stand in the field
  const [a, b] = await page.evaluate(() => ["#equations", "#equations-box pre"].map(of => {
    const style = getComputedStyle(document.querySelector(of));
    return [style.fontSize, style.lineHeight, style.fontFamily, style.paddingLeft, document.querySelector(of).clientWidth].join();
  }));
  assert.equal(a, b);
}, POWER);

await test("a slider moves everything, and undo takes it back", async page => {
  await refined(page);
  const before = await text(page, "#headline .value");
  const written = await source(page);
  await page.selectOption("#slid", { label: "mean of voltage" });
  await page.focus("#slide");
  for (let step = 0; step < 30; step++) await page.keyboard.press("ArrowRight");
  await until(page, before => document.querySelector("#headline .value").innerText !== before, before);
  const value = Number(await page.inputValue('[aria-label="mean of voltage"]'));
  assert(value > 5.01, String(value));
  assert.notEqual(await source(page), written);
  for (let step = 0; step < 40 && (await source(page)) !== written; step++) await page.keyboard.press("Control+z");
  assert.equal(await source(page), written);
  await until(page, () => document.querySelector('[aria-label="mean of voltage"]').value === "5.01");
  await page.click("#redo");
  assert.notEqual(await source(page), written);
}, POWER);

await test("the file keeps what was not changed, and is written by itself", async (page, folder) => {
  const before = await readFile(join(folder, "power.json"), "utf8");
  await field(page, "mean of voltage").fill("5.020");
  await until(page, () => document.getElementById("state").textContent === "saved" && document.getElementById("undo").disabled === false);
  assert.equal(await readFile(join(folder, "power.json"), "utf8"), before.replace("5.01,", "5.020,"));
}, POWER);

await test("a change on the disk shows, and a conflict asks", async (page, folder) => {
  const place = join(folder, "power.json");
  const before = await readFile(place, "utf8");
  await writeFile(place, before.replace("5.01,", "5.5,"));
  await until(page, () => document.querySelector('[aria-label="mean of voltage"]').value === "5.5");
  // a mistake is not written by itself, so that both differ
  await field(page, "mean of voltage").fill("x y");
  await until(page, () => document.querySelectorAll("#mistakes li").length > 0);
  await writeFile(place, before.replace("5.01,", "6,"));
  await until(page, () => document.getElementById("dialog").open);
  await shot(page, "conflict");
  await page.getByText("The one on the disk").click();
  await until(page, () => document.querySelector('[aria-label="mean of voltage"]').value === "6");
  assert.equal(await readFile(place, "utf8"), before.replace("5.01,", "6,"));
}, POWER);

async function exported(page, format) {
  await page.click("#export");
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#dialog .entry", { hasText: new RegExp(`^${format}$`) }).click()]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

await test("export of HTML and XLSX", async page => {
  const html = await exported(page, "html");
  assert.equal(html.name, "power.html");
  assert.match(html.bytes.toString(), /Power in a resistor[\s\S]*Monte Carlo/);
  const workbook = await exported(page, "xlsx");
  assert.equal(workbook.bytes.subarray(0, 2).toString(), "PK");
}, POWER);

await test("a certificate is shown and exported as DCC", async page => {
  await until(page, () => (document.getElementById("report").src || "").includes("api/page"));
  const frame = page.frameLocator("#report");
  await frame.locator("h1").waitFor();
  await shot(page, "certificate");
  const dcc = await exported(page, "dcc");
  assert.match(dcc.bytes.toString(), /<dcc:digitalCalibrationCertificate/);
}, { open: "certificates/three_axis_accelerometer.json", files: [["models", "."]] });

const CERTIFICATE = { files: [["models/examples/power.json", "measured/power.json"], ["models/laboratory/pictures/logo.svg", "logo.svg"]] };
const EMPTY_CERTIFICATE = '{\n  "format": 1,\n  "rows": []\n}\n';

/** An empty certificate in the folder, opened. */
async function emptyCertificate(page, folder) {
  await writeFile(join(folder, "c.json"), EMPTY_CERTIFICATE);
  await page.click("#open");
  await page.locator("#dialog .entry", { hasText: "c.json" }).click();
  await page.locator("#certificate-form details").first().waitFor();
}

await test("a certificate from nothing, by its fields", async (page, folder) => {
  await emptyCertificate(page, folder);
  // nothing is red, and what is missing is said
  assert.equal(await page.locator("#mistakes li, #certificate-form [aria-invalid]").count(), 0);
  assert.match(await text(page, "#lacking"), /Add a row: choose a model and one of its outputs/);
  await shot(page, "certificate-empty", { fullPage: true });
  await page.locator("#lacking button").first().click();
  await until(page, () => document.activeElement.dataset.key === "rows#model");
  await field(page, "Number of the certificate").fill("2026-017");
  await field(page, "What it is of Device").fill("wattmeter");
  await field(page, "Serial number of Device").fill("0815");
  await field(page, "Name of Customer").fill("Rossi & Co <Torino>");
  await field(page, "City of Customer").fill("Torino");
  await field(page, "First day of the calibration").fill("2026-03-02");
  await field(page, "Last day of the calibration").fill("2026-03-03");
  await field(page, "Add a row").selectOption("measured/power.json");
  await page.getByRole("button", { name: /^power/ }).click();
  await field(page, "Nominal value of row 1").fill("251");
  await page.getByRole("button", { name: /^power/ }).focus();
  await page.keyboard.press("Enter");
  await field(page, "Change a value … of row 2").selectOption("voltage");
  await until(page, () => document.activeElement.getAttribute("aria-label") === "voltage of row 2");
  await page.keyboard.type("6.0");
  await field(page, "Name of the row of row 2").fill("at 6 V");
  const frame = page.frameLocator("#report");
  await frame.getByText("2026-017").first().waitFor();
  await frame.getByText("at 6 V").first().waitFor();
  // columns of one's own
  await page.locator("summary", { hasText: /^Table$/ }).click();
  await field(page, "Columns").selectOption("own");
  await field(page, "Add a column").selectOption({ label: "voltage" });
  await field(page, "Heading of column 5").fill("Applied voltage");
  await page.getByLabel("Move voltage up").click();
  await until(page, () => document.activeElement.getAttribute("aria-label") === "Move voltage up");
  await page.locator("summary", { hasText: /^Letterhead$/ }).click();
  await field(page, "Logo").selectOption("logo.svg");
  await frame.getByText("Applied voltage").first().waitFor();
  // the page keeps its place
  await until(page, () => document.querySelectorAll(".pages iframe").length === 1);
  await page.evaluate(() => document.getElementById("report").contentWindow.scrollTo(0, 300));
  await field(page, "Responsible person").fill("A. Metrologist");
  await frame.getByText("A. Metrologist").first().waitFor();
  await until(page, () => document.querySelectorAll(".pages iframe").length === 1 && document.getElementById("report").contentWindow.scrollY === 300);
  await page.evaluate(() => document.getElementById("report").contentWindow.scrollTo(0, 0));
  assert.deepEqual(await violations(page), []);
  await shot(page, "certificate-form", { fullPage: true });
  await until(page, () => document.getElementById("state").textContent === "saved");
  const written = JSON.parse(await readFile(join(folder, "c.json"), "utf8"));
  assert.deepEqual(written.rows, [
    { model: "measured/power.json", output: "power", nominal: 251 },
    { model: "measured/power.json", output: "power", set: { voltage: 6.0 }, label: "at 6 V" },
  ]);
  assert.deepEqual(written.calibration_date, ["2026-03-02", "2026-03-03"]);
  assert.equal(written.device.serial_number, "0815");
  const told = execFileSync(process.env.GUMPTION, ["certificate", join(folder, "c.json"), "--quiet"]).toString();
  assert.match(told, /Rossi & Co <Torino>/);
  assert.match(told, /Applied voltage/);
}, CERTIFICATE);

await test("a gap case is shown with its diagnosis", async page => {
  await until(page, () => (document.getElementById("report").src || "").includes("api/page"));
  const frame = page.frameLocator("#report");
  await frame.locator("h1").waitFor();
  await frame.locator("svg").first().waitFor();
  await shot(page, "gap");
}, { open: "case.json", files: [["models/gap/radius", "."]] });

await test("new from a published example and from a template", async page => {
  await page.click("#new");
  await page.locator("#dialog input").fill("h1");
  await page.locator("#dialog .entry", { hasText: "gum-h1-end-gauge" }).click();
  await until(page, () => /l = |E|gauge|end/i.test(document.getElementById("title").value) && document.querySelector("#headline .value"));
  await page.click("#new");
  await page.locator("#dialog .entry", { hasText: "inclined-plane" }).first().click();
  await until(page, () => document.querySelectorAll("#output-tabs button").length === 3);
  await page.locator("#output-tabs button").nth(2).click();
  await until(page, () => /^a_z/.test(document.querySelector("#headline .value").innerText));
});

await test("import of a spreadsheet", async page => {
  const imported = async csv => {
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#import")]);
    await chooser.setFiles({ name: "budget.csv", mimeType: "text/csv", buffer: Buffer.from(csv) });
  };
  // coefficients without units of V and A do not tell the unit of the result
  await imported("Quantity,Estimate,Unit,Standard uncertainty,Sensitivity\nV,5.0,V,0.01,1\nI,0.1,A,0.001,-2\n");
  await until(page, () => /^budget.csv:1:1: nothing says the unit of the result/m.test(document.body.innerText));
  await imported("Quantity,Estimate,Unit,Standard uncertainty\nV,5.0,V,0.01\nI,0.1,A,0.001\nR = V/I\n");
  await until(page, () => document.getElementById("dialog").open);
  assert.match(await text(page, "#dialog-body"), /Understood/);
  await page.locator("#dialog-actions button").first().click();
  await until(page, () => document.querySelector('[aria-label="mean of V"]') !== null);
});

await test("inputs come, go and get other names", async page => {
  await page.click("#add-input");
  await field(page, "mean of x").fill("1");
  await until(page, () => document.activeElement.getAttribute("aria-label") === "mean of x");
  await page.getByLabel("Remove x").click();
  await until(page, () => document.querySelector('[aria-label="mean of x"]') === null);
  await page.locator("input.name").first().fill("V");
  await page.locator("input.name").first().press("Enter");
  await until(page, () => document.getElementById("equations").value === "power = V^2/resistance");
  await until(page, () => document.querySelectorAll("#mistakes li").length === 0);
}, POWER);

await test("a file of markup is text", async (page, folder) => {
  const evil = "<img src=x onerror=\"window.hit=1\"><script>window.hit=1</script>";
  const file = { title: evil, inputs: { a: { unit: "m", distribution: "normal", mean: 1, std: 0.1, about: evil, group: evil } }, equations: { y: "a*a" }, outputs: { y: { unit: "m^2", about: evil } } };
  await answered(page, () => page.click("#view-text").then(() => page.fill("#source", JSON.stringify(file))));
  await until(page, () => /^y/.test(document.querySelector("#headline .value")?.innerText || ""));
  await page.click("#view-form");
  await refined(page);
  await page.waitForTimeout(1500);
  assert.equal(await page.evaluate(() => window.hit), undefined);
  assert.equal(await page.locator("main img, main script").count(), 0);
});

await test("phone width", async page => {
  await refined(page);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert(wide <= 390, `the page is ${wide} wide`);
  await shot(page, "phone", { fullPage: true });
}, { ...POWER, viewport: { width: 390, height: 844 } });

await test("dark, and in German", async page => {
  await refined(page);
  assert.match(await text(page, "#answer-title"), /Ergebnis/);
  await field(page, "Mittelwert von voltage").fill("5,02");
  await until(page, () => document.getElementById("source").value.includes("5.02"));
  await until(page, () => document.querySelector("#part-audit table") !== null);
  await shot(page, "dark-german", { fullPage: true });
}, { ...POWER, lang: "de", colorScheme: "dark" });

await test("keyboard alone", async page => {
  // every control of the page is reached, in order, and none keeps the focus
  const reached = [];
  await page.locator("body").press("Tab");
  for (let step = 0; step < 80; step++) {
    const now = await page.evaluate(() => {
      const of = document.activeElement;
      const visible = of === document.body || getComputedStyle(of).outlineStyle !== "none" || of.matches(":focus-visible");
      return { name: of.id || of.dataset.key || of.getAttribute("aria-label") || of.tagName, visible };
    });
    assert(now.visible, `${now.name} shows no focus`);
    if (now.name === "BODY" || reached.length && now.name === reached[0]) break;
    reached.push(now.name);
    await page.keyboard.press("Tab");
  }
  for (const id of ["new", "open", "save", "export", "view-text", "title", "equations", "slid", "slide", "add-input"]) {
    assert(reached.includes(id), `${id} is not reached: ${reached.join(", ")}`);
  }
  // a change, and its undoing
  await page.focus('[aria-label="mean of voltage"]');
  await page.keyboard.press("Control+a");
  await page.keyboard.type("6");
  await until(page, () => document.getElementById("source").value.includes('"mean": 6'));
  await page.keyboard.press("Control+z");
  await until(page, () => document.getElementById("source").value.includes('"mean": 5.01'));
  await until(page, () => document.querySelector('[aria-label="mean of voltage"]').value === "5.01");
  await page.focus("#export");
  await page.keyboard.press("Enter");
  await until(page, () => document.getElementById("dialog").open);
  await page.keyboard.press("Escape");
  await until(page, () => !document.getElementById("dialog").open);
}, POWER);

for (const [name, colorScheme] of [["light", "light"], ["dark", "dark"]]) {
  await test(`axe-core, ${name}`, async page => {
    await refined(page);
    await until(page, () => document.querySelector("#part-audit table") !== null);
    await page.click("#more summary");
    const look = async state => assert.deepEqual(await violations(page), [], state);
    await look("with results");
    await page.fill("#equations", "power = voltage^2/resistanse");
    await until(page, () => document.querySelectorAll("#mistakes li").length > 0);
    await look("with mistakes");
    await page.click("#new");
    await until(page, () => document.getElementById("dialog").open);
    await look("with a question");
    await page.locator("#dialog-actions button").first().click();
    await page.locator("#dialog .entry").first().waitFor();
    await look("with a list");
  }, { ...POWER, colorScheme });
}

const SWEEP = { open: "m.json", files: [["models/examples/published/gum-h1-end-gauge.json", "m.json"]] };

await test("a row of a sweep is chosen, and has headline and budget", async page => {
  const model = { format: 1, title: "Speed", conditions: { f: { unit: "Hz", values: [10, 20, 30] } },
    inputs: { a: { unit: "m", distribution: "normal", mean: 2, std: 0.1 } }, equations: { v: "a*f", w: "2*v" },
    outputs: { v: { unit: "m/s" }, w: { unit: "m/s" } } };
  await page.click("#view-text");
  await page.fill("#source", JSON.stringify(model, null, 1));
  await page.click("#view-form");
  await until(page, () => /20\.0/.test((document.querySelector("#headline .value") || {}).innerText || ""));
  await page.selectOption("#rows", { label: "f = 20 Hz" });
  await until(page, () => /40\.0/.test(document.querySelector("#headline .value").innerText));
  await page.click("#row-after");
  await until(page, () => /60\.0/.test(document.querySelector("#headline .value").innerText));
  await page.locator("#output-tabs button").nth(1).click();
  await until(page, () => /120\.0|120/.test(document.querySelector("#headline .value").innerText));
  assert.equal(await page.locator("#part-budget th[scope=row]").first().innerText(), "a");
  assert.equal(await page.locator("#part-together table").count() >= 2, true);
  await shot(page, "sweep", { fullPage: true });
}, SWEEP);

await test("mistakes of a certificate are underlined, and mended there", async page => {
  await until(page, () => (document.getElementById("report").src || "").includes("api/page"));
  await page.click("#view-text");
  const whole = await source(page);
  await answered(page, () => page.fill("#source", whole.replace('"output": "R"', '"output": "Q"')));
  await until(page, () => (document.querySelector("#source-box mark") || {}).textContent === '"Q"');
  assert.match(await text(page, "#mistakes"), /`Q`/);
  await shot(page, "certificate-mistake");
  await page.click("#view-form");
  assert.equal(await field(page, "Result of row 1").getAttribute("aria-invalid"), "true");
  await page.click("#view-text");
  await answered(page, () => page.fill("#source", whole));
  await until(page, () => document.querySelectorAll("#mistakes li").length === 0);
}, { open: "certificate.json", files: [["models/examples", "."]] });

await test("what only the evaluation of a recipe finds is underlined too", async page => {
  // the recording that it names is not there
  await until(page, () => (document.querySelector("#source-box mark") || {}).textContent === '"no.csv"');
  assert.match(await text(page, "#mistakes"), /no\.csv/);
}, { open: "recipe.json", files: [["tests/data/page-recipe.json", "recipe.json"]] });

await test("readings are pasted from a spreadsheet", async (page, _, context) => {
  await context.grantPermissions(["clipboard-read", "clipboard-write"]);
  for (const [pasted, wanted] of [["99,8\t100,1\r\n100\t99,9\r\n", "[99.8, 100.1, 100, 99.9]"], ["1.5\n2.5\n3\n", "[1.5, 2.5, 3]"], ["1.000,5; 1.001,25", "[1000.5, 1001.25]"]]) {
    await page.evaluate(text => navigator.clipboard.writeText(text), pasted);
    await field(page, "values of resistance").focus();
    await page.keyboard.press("Control+a");
    await page.keyboard.press("Control+v");
    await until(page, wanted => document.getElementById("source").value.includes(`"values": ${wanted}`), wanted);
  }
}, POWER);

/** Sentences that are English, of what a page shows. */
const english = page => page.evaluate(() => {
  const own = document.getElementById("source").value.toLowerCase();
  const words = /\b(the|of|is|are|and|with|from|which|by|not|that|to|for|no|row|what|how)\b/gi;
  const found = [];
  const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  for (let node = walk.nextNode(); node; node = walk.nextNode()) {
    const of = node.parentElement;
    if (of.closest("script, noscript, pre, code, textarea, #mistakes, [lang=en]")) continue;
    const left = (node.data.match(words) || []).filter(word => !own.includes(word.toLowerCase()));
    if (left.length) found.push(node.data.trim());
  }
  for (const of of document.querySelectorAll("[aria-label], [title], [placeholder]")) {
    for (const name of ["aria-label", "title", "placeholder"]) {
      const said = of.getAttribute(name) || "";
      if (words.test(said)) found.push(said);
    }
  }
  return found;
});

await test("no English sentence is left on the German page", async page => {
  await page.click("#more summary");
  for (const name of ["gum-h1-end-gauge", "gum-h3-thermometer-line", "tn1900-e7-thermistor"]) {
    await page.click("#new");
    await page.locator("#dialog input").fill(name);
    await page.locator("#dialog .entry", { hasText: name }).first().click();
    await until(page, () => document.querySelector("#headline .value") && !document.getElementById("results").hidden);
    await refined(page);
    await until(page, () => document.querySelector("#part-audit table") !== null || document.getElementById("box-audit").hidden === false);
    assert.deepEqual(await english(page), [], name);
  }
  // a value without a name of a distribution
  assert.equal(await page.inputValue('[aria-label="Verteilung von t"]'), "constant");
  await shot(page, "german", { fullPage: true });
  await page.selectOption("#language", "en");
  await until(page, () => /Subtotals|Sensitivity/.test(document.getElementById("part-budget").innerText));
}, { lang: "de" });

await test("a certificate in German on a phone, in two languages", async (page, folder) => {
  await emptyCertificate(page, folder);
  await field(page, "Zeile hinzufügen").selectOption("measured/power.json");
  await page.getByRole("button", { name: /^power/ }).click();
  await page.locator("summary", { hasText: /^Sprachen/ }).click();
  await field(page, "Gegenstand von Gerät").fill("Leistungsmesser");
  await page.getByLabel("Deutsch", { exact: true }).last().check();
  await field(page, "Gegenstand (Deutsch) von Gerät").fill("Leistungsmessgerät");
  await page.getByLabel("Zuerst:").selectOption("de");
  await field(page, "Einen Wert ändern … von Zeile 1").selectOption("voltage");
  await field(page, "voltage von Zeile 1").fill("6,5");
  await until(page, () => document.getElementById("state").textContent === "gespeichert" && document.getElementById("source").value.includes("6.5"));
  const written = JSON.parse(await source(page));
  assert.deepEqual([written.language, written.device.name, written.rows[0].set], [["de", "en"], { en: "Leistungsmesser", de: "Leistungsmessgerät" }, { voltage: 6.5 }]);
  // fewer languages take no text away
  await page.getByLabel("Englisch", { exact: true }).last().uncheck();
  await until(page, () => JSON.parse(document.getElementById("source").value).language === "de");
  assert.equal(await field(page, "Gegenstand (Englisch) von Gerät").inputValue(), "Leistungsmesser");
  await page.frameLocator("#report").getByText("Leistungsmessgerät").first().waitFor();
  for (const summary of ["Tabelle", "Briefkopf", "Weitere Einstellungen"]) await page.locator("summary", { hasText: new RegExp(`^${summary}$`) }).click();
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  assert(wide <= 390, `the page is ${wide} wide`);
  assert.deepEqual(await english(page), []);
  assert.deepEqual(await violations(page), []);
  await shot(page, "certificate-german-phone", { fullPage: true });
}, { ...CERTIFICATE, lang: "de", viewport: { width: 390, height: 844 } });

await test("a certificate from a result", async (page, folder) => {
  await mkdir(join(folder, "certificates"));
  await writeFile(join(folder, ".gumption-root"), "");
  await refined(page);
  await page.click("#certify");
  await page.frameLocator("#report").getByText("251.1").first().waitFor();
  await shot(page, "certificate-from-result");
  // from another folder the model has another path
  await page.keyboard.press("Control+s");
  await page.locator("#dialog input").fill("certificates/c.json");
  await page.locator("#dialog-actions button").first().click();
  await until(page, () => document.getElementById("state").textContent === "saved");
  assert.deepEqual(JSON.parse(await readFile(join(folder, "certificates/c.json"), "utf8")).rows, [{ model: "../power.json", output: "power" }]);
  execFileSync(process.env.GUMPTION, ["certificate", join(folder, "certificates/c.json"), "--quiet"]);
}, POWER);

await test("a certificate keeps what its form cannot say", async (page, folder) => {
  const whole = `{
  "device": "meter", "customer": "Rossi", "laboratory": {"name": "L"}, "remarks": ["a", "b"],
  "issue_date": "2026-13-01",
  "layout": {"tables": [{"name": "t", "columns": ["power"]}, {"name": "u", "columns": ["power", "U"]}]},
  "rows": [{"model": "power.json", "output": "power", "table": "t", "set": {"voltage": "5 V"}}, {"model": "power.json", "output": "power", "table": "u"}]
}`;
  await writeFile(join(folder, "c.json"), whole);
  await page.click("#open");
  await page.locator("#dialog .entry", { hasText: "c.json" }).click();
  await field(page, "What it is of Device").waitFor();
  assert.equal(await field(page, "Name of Customer").inputValue(), "Rossi");
  assert.equal(await field(page, "Issued on").inputValue(), "2026-13-01");
  await page.locator("summary", { hasText: /^Table$/ }).click();
  assert.match(await text(page, "#certificate-form"), /has 2 tables/);
  await field(page, "City of Customer").pressSequentially("Roma");
  await field(page, "Issued on").fill("2026-03-01");
  await until(page, () => document.getElementById("state").textContent === "saved" && document.getElementById("source").value.includes("2026-03-01"));
  await field(page, "voltage of row 1").fill("5.5 V");
  await page.getByLabel("Move row 2 up").click();
  await until(page, () => /"u"}, {"model"/.test(document.getElementById("source").value));
  const expected = whole.replace('"customer": "Rossi"', '"customer": {"city": "Roma", "name": "Rossi"}').replace("2026-13-01", "2026-03-01")
    .replace(/"rows".*/, '"rows": [{"model": "power.json", "output": "power", "table": "u"}, {"model": "power.json", "output": "power", "table": "t", "set": {"voltage": "5.5 V"}}]');
  assert.equal((await source(page)).replace('"name": "Rossi", "city": "Roma"', '"city": "Roma", "name": "Rossi"'), expected);
}, { ...POWER, open: "" });

await test("speed with 20 inputs", async page => {
  const inputs = {}, terms = [];
  for (let number = 1; number <= 20; number++) {
    const shape = ["normal", "rectangular", "triangular", "arcsine"][number % 4];
    inputs[`x${number}`] = { unit: "1", distribution: shape, mean: number, [shape === "normal" ? "std" : "half_width"]: 0.01 * number };
    terms.push(number % 3 ? `x${number}` : `sin(x${number})*x${number}`);
  }
  const model = { format: 1, title: "Twenty inputs", inputs, equations: { y: terms.join(" + ") }, outputs: { y: { unit: "1" } } };
  await page.click("#view-text");
  await page.fill("#source", JSON.stringify(model, null, 1));
  await page.click("#view-form");
  await until(page, () => document.querySelector('[aria-label="mean of x1"]') && document.querySelector("#headline .value"));
  await refined(page);
  await page.focus('[aria-label="mean of x1"]');
  const took = [];
  for (let key = 0; key < 100; key++) {
    took.push(await page.evaluate(key => new Promise(resolve => {
      const field = document.activeElement;
      const start = performance.now();
      // shown is what stands there when the frame after it begins
      document.addEventListener("answered", () => requestAnimationFrame(() => resolve(performance.now() - start)), { once: true });
      field.value = `1.${String(100 + key)}`;
      field.dispatchEvent(new InputEvent("input", { bubbles: true }));
    }), key));
    await page.waitForTimeout(120);
  }
  took.sort((a, b) => a - b);
  const at = share => took[Math.floor(share * (took.length - 1))].toFixed(0);
  console.log(`      key press to shown answer, 20 inputs, 1e5 trials: median ${at(0.5)} ms, p95 ${at(0.95)} ms, largest ${at(1)} ms`);
});

await test("a day's editing", async (page, folder, _, server) => {
  const resident = async () => Number((await readFile(`/proc/${server.id}/status`, "utf8")).match(/VmRSS:\s*(\d+)/)[1]) / 1024;
  await refined(page);
  await page.waitForTimeout(6000);
  const idle = await resident();
  // as the page does it, with a save after every tenth change
  const work = (from, to) => page.evaluate(async ([from, to]) => {
    const ask = async (path, body) => (await fetch(path, { method: "POST", body: JSON.stringify(body), headers: { "X-Gumption": localStorage.getItem("gumption"), "Content-Type": "application/json" } })).json();
    let { text, version } = await ask("api/open", { path: "power.json" });
    for (let key = from; key < to; key++) {
      const edits = [{ path: ["inputs", "voltage", "mean"], typed: `5.${1000 + key % 997}` }];
      ({ text } = await ask("api/call/answer?path=power.json", { text, edits, name: "power.json", output: 0, trials: 100000 }));
      if (key % 10 === 0) ({ version } = await ask("api/save", { path: "power.json", text, version }));
      if (key % 100 === 0) await ask("api/call/audit", { text });
    }
  }, [from, to]);
  await work(0, 500);
  const early = await resident();
  await work(500, 500 + Number(process.env.EDITS || 1000));
  await page.waitForTimeout(6000);
  const late = await resident();
  console.log(`      memory of the server: idle ${idle.toFixed(0)} MB, after 500 edits ${early.toFixed(0)} MB, after ${500 + Number(process.env.EDITS || 1000)} ${late.toFixed(0)} MB`);
  if (late > early + 15) throw new Error(`a day's editing takes ${(late - early).toFixed(0)} MB of the server`);
}, POWER);

await test("a server that is gone", async (page, folder, _, server) => {
  await refined(page);
  server.stop();
  await until(page, () => document.getElementById("results").classList.contains("stale"));
  await page.fill('[aria-label="mean of voltage"]', "9");
  await page.waitForTimeout(500);
  const shown = await page.evaluate(() => ({
    stale: document.getElementById("results").classList.contains("stale"),
    said: document.getElementById("progress").textContent,
    state: document.getElementById("state").textContent,
    filter: getComputedStyle(document.getElementById("results")).filter,
  }));
  if (!shown.stale || shown.filter !== "grayscale(1)") throw new Error("the old result looks like a new one");
  if (!/no longer answers/.test(shown.said) || !/no connection/.test(shown.state)) throw new Error(JSON.stringify(shown));
  page.errors = page.errors.filter(text => !/ERR_CONNECTION_REFUSED|ERR_EMPTY_RESPONSE|ERR_INCOMPLETE_CHUNKED|ERR_CONNECTION_RESET/.test(text));
}, POWER);

await test("opening", async page => {
  // from the address to the first answer on the page
  const took = [];
  for (let turn = 0; turn < 5; turn++) {
    await page.reload();
    await page.waitForFunction(() => window.answered && window.answered.length > 0);
    took.push(await page.evaluate(() => document.timeline.currentTime));
  }
  took.sort((a, b) => a - b);
  console.log(`      opening a model: median ${took[2].toFixed(0)} ms, largest ${took[4].toFixed(0)} ms`);
}, POWER);

await chromium.close();
if (failed === 0) await rm(work, { recursive: true, force: true });
console.log(failed === 0 ? "all of the live page's tests pass" : `${failed} of ${made} tests fail; pictures in ${work}`);
process.exit(failed === 0 ? 0 : 1);
