// What the live page does, in a browser: usage: node tests.mjs REPOSITORY PICTURES
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFile, cp, mkdir, mkdtemp, readFile, rm, utimes, writeFile } from "node:fs/promises";
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
  await page.click("#begin-empty");
  await page.fill("#title", "Power in a resistor");
  await page.fill("#equations", "power = voltage^2/resistance");
  await page.locator("#missing").getByText("all of them").click();
  await field(page, "How voltage is known").selectOption({ label: "U and k" });
  await field(page, "mean of voltage").fill("5.01");
  await field(page, "expanded uncertainty U of voltage").fill("0.02");
  await field(page, "Unit of voltage").fill("V");
  await field(page, "How resistance is known").selectOption("readings");
  await field(page, "values of resistance").fill("99.8 100.1 100.0 99.9");
  await field(page, "Unit of resistance").fill("ohm");
  await page.locator("#unreported").getByText("power").click();
  await field(page, "Unit of power").fill("mW");
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
  await until(page, () => Number(document.querySelector('[aria-label="mean of voltage"]').value) > 5.01);
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
  const [download] = await Promise.all([page.waitForEvent("download"), page.locator("#dialog .entry", { hasText: format }).click()]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

await test("export of HTML and XLSX", async page => {
  const html = await exported(page, "Web page");
  assert.equal(html.name, "power.html");
  assert.match(html.bytes.toString(), /Power in a resistor[\s\S]*Monte Carlo/);
  const workbook = await exported(page, "Excel");
  assert.equal(workbook.bytes.subarray(0, 2).toString(), "PK");
}, POWER);

await test("a certificate is shown and exported as DCC", async page => {
  await until(page, () => (document.getElementById("report").src || "").includes("api/page"));
  const frame = page.frameLocator("#report");
  await frame.locator("h1").waitFor();
  await shot(page, "certificate");
  const dcc = await exported(page, "Digital Calibration");
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

/** What the page shows of a mistake or in the colour of one. */
const red = page => page.evaluate(() => [...document.querySelectorAll("#mistakes li, #told, [aria-invalid=true], mark")].filter(of => of.textContent !== "" || of.matches("input")).length);
const isNarrow = async page => assert(await page.evaluate(() => document.documentElement.scrollWidth) <= 390, "the page scrolls sideways");
const shown = page => until(page, () => !document.getElementById("file").hidden && document.querySelector("#headline .value") && !document.getElementById("results").hidden);

await test("the start page has examples with their results, and no red", async page => {
  await until(page, () => document.querySelectorAll("#large .card svg").length === 3);
  const [power] = await page.locator("#large .card").allInnerTexts();
  assert.match(power, /Power in a resistor[\s\S]*power = [(]251.*mW/);
  assert.equal(await red(page), 0);
  await shot(page, "start", { fullPage: true });
  await page.locator("#large .card").first().click();
  await shown(page);
  assert.equal(await page.inputValue("#title"), "Power in a resistor");
  // the name of the program leads back, and the open file stays
  await page.click("#home");
  await until(page, () => !document.getElementById("start").hidden && document.querySelectorAll("#large .card svg").length === 3);
  await page.click("#go-on");
  await shown(page);
  // an empty file says calmly what comes first, with the keyboard alone
  await page.focus("#home");
  await page.keyboard.press("Enter");
  await page.focus("#begin-empty");
  await page.keyboard.press("Enter");
  await until(page, () => /First write the equation/.test(document.getElementById("nothing").innerText) && !document.getElementById("nothing").hidden);
  await page.fill("#title", "Mine");
  await page.waitForTimeout(500);
  assert.equal(await red(page), 0);
  await page.focus("#home");
  await page.keyboard.press("Enter");
  await page.locator("#large .card").nth(1).focus();
  await page.keyboard.press("Enter");
  await page.locator("#dialog-actions button").first().click();
  await shown(page);
  assert.match(await page.inputValue("#title"), /Gauge block/);
  // a certificate and a case begin without red as well
  for (const way of ["certificate", "case"]) {
    await page.click("#new");
    await page.click(`#begin-${way}`);
    await page.locator(way === "case" ? "#case-lacks li" : "#lacking button").first().waitFor();
    assert.equal(await red(page), 0, way);
  }
});

await test("the gallery has fields of work, titles, and a search", async page => {
  await until(page, () => document.querySelectorAll("#gallery details").length > 10);
  const names = JSON.parse(await page.evaluate(() => JSON.stringify([...document.querySelectorAll("#gallery .entry")].map(of => of.textContent))));
  assert(names.length > 75 && new Set(names).size === names.length, `${names.length} entries`);
  assert.deepEqual(names.filter(name => /\b(ea402|jcgm101|gum|quam|nist1900|tn1900)-/.test(name)), []);
  await page.fill("#gallery-search", "end gauge");
  assert.equal(await page.locator("#gallery .entry:visible").count(), 1);
  assert.equal(await text(page, "#gallery-found"), "1 example");
  await page.locator("#gallery .entry:visible").click();
  await shown(page);
  assert.match(await page.inputValue("#title"), /end gauge/);
  await page.click("#new");
  await page.fill("#gallery-search", "inclined plane 35 deg");
  await page.locator("#gallery .entry:visible").first().click();
  await until(page, () => document.querySelectorAll("#output-tabs button").length === 3);
  await page.locator("#output-tabs button").nth(2).click();
  await until(page, () => /^a_z/.test(document.querySelector("#headline .value").innerText));
});

await test("files of the folder by kind, and those that were changed last", async (page, folder) => {
  await until(page, () => document.querySelectorAll("#folder-files .entry").length > 2);
  assert.match(await text(page, "#folder-files"), /Measurements/);
  assert.equal(await page.locator("#recent-files .entry").count(), 5);
  const later = new Date(Date.now() + 5000);
  await utimes(join(folder, "power.json"), later, later);
  await page.reload();
  await until(page, () => document.querySelectorAll("#recent-files .entry").length === 5);
  await page.locator("#recent-files .entry").first().click();
  await shown(page);
  assert.equal(await text(page, "#path"), "power.json");
}, { files: ["power.json", "certificate.json", "last_year.json", "this_year.json", "results.csv"].map(name => [`models/examples/${name}`, name]).concat([["models/laboratory/weight.json", "weight.json"], ["models/mean_of_repetitions.json", "mean.json"]]) });

const paste = async (page, table) => {
  await page.fill("#pasted", table.map(row => row.join("\t")).join("\n"));
  await until(page, () => !document.getElementById("sheet").hidden);
};

await test("a budget is pasted and used", async page => {
  await page.click("#begin-paste");
  await paste(page, [["Quantity", "Estimate", "Unit", "Standard uncertainty"], ["V", "5,0", "V", "0,01"], ["I", "0,1", "A", "0,001"], ["R = V/I", "", "", ""]]);
  await page.locator("#use-budget:enabled").waitFor();
  assert.match(await text(page, "#sheet-state"), /can be used/);
  assert.equal(await page.inputValue('[aria-label="What column D holds"]'), "standard-uncertainty");
  await page.click("#use-budget");
  await until(page, () => document.querySelector('[aria-label="mean of V"]') !== null);
  await shown(page);
  assert.equal(await page.inputValue('[aria-label="mean of V"]'), "5.0");
});

await test("what a pasted budget does not say is asked and answered by clicks", async page => {
  await page.click("#import");
  await paste(page, [["Quantity", "Estimate", "Unit", "Error"], ["a", "5.0", "mm", "0.01"], ["b", "7.0", "mm", "0.02"]]);
  await until(page, () => document.querySelectorAll("#sheet-questions li").length > 0);
  assert.equal(await page.isDisabled("#use-budget"), true);
  assert.doesNotMatch(await text(page, "#sheet-questions"), /--/);
  await shot(page, "import", { fullPage: true });
  // a press on the question goes to the head of the column, whose choice answers it
  await page.locator("#sheet-questions .asked").first().click();
  assert.equal(await page.evaluate(() => document.activeElement.getAttribute("aria-label")), "What column D holds");
  await page.selectOption('[aria-label="What column D holds"]', "U");
  await page.getByRole("button", { name: "Coverage factor k: 2" }).first().click();
  await page.getByRole("button", { name: /none: the sum of the quantities/ }).first().click();
  await page.locator("#use-budget:enabled").waitFor();
  await page.click("#use-budget");
  await shown(page);
  assert.equal(await page.inputValue('[aria-label="expanded uncertainty U of a"]'), "0.01");
});

await test("a spreadsheet of a file is asked about, row by row", async page => {
  const imported = async csv => {
    await page.click("#import");
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#pick-sheet")]);
    await chooser.setFiles({ name: "budget.csv", mimeType: "text/csv", buffer: Buffer.from(csv) });
    await until(page, () => document.getElementById("sheet-file").textContent === "budget.csv" && document.getElementById("sheet-table").rows.length > 2);
  };
  // coefficients without units of V and A do not tell the unit of the result
  await imported("Quantity,Estimate,Unit,Standard uncertainty,Sensitivity\nV,5.0,V,0.01,1\nI,0.1,A,0.001,-2\n");
  await until(page, () => /nothing says the unit of the result/.test(document.getElementById("sheet-questions").innerText));
  await page.getByRole("button", { name: "Unit of the result" }).first().click();
  assert.equal(await page.evaluate(() => document.activeElement.dataset.key), "field unit");
  await imported("Quantity,Estimate,Unit,Standard uncertainty\nV,5.0,V,0.01\nI,0.1,A,0.001\nTotal ?,3,V,\nR = V/I\n");
  await until(page, () => /Row 4:/.test(document.getElementById("sheet-questions").innerText));
  await page.selectOption('[aria-label="What row 4 is"]', "ignore");
  await page.locator("#use-budget:enabled").waitFor();
  await page.click("#use-budget");
  await shown(page);
});

await test("a workbook is shown, and one of this program comes back", async (page, folder) => {
  const choose = async name => {
    await page.click("#import");
    const [chooser] = await Promise.all([page.waitForEvent("filechooser"), page.click("#pick-sheet")]);
    await chooser.setFiles(join(folder, name));
    await until(page, name => document.getElementById("sheet-file").textContent === name, name);
  };
  execFileSync(process.env.GUMPTION, ["import", "--template", join(folder, "empty.xlsx")]);
  execFileSync(process.env.GUMPTION, ["run", join(root, "models/examples/power.json"), "--format", "xlsx", "--output", join(folder, "power.xlsx"), "--quiet", "--trials", "10000"]);
  await choose("empty.xlsx");
  await page.locator("#use-budget:enabled").waitFor();
  assert.equal(await page.inputValue('[aria-label="What row 4 is"]'), "heading");
  // another sheet has no budget
  await page.selectOption('[aria-label="Sheet"]', { index: 2 });
  await until(page, () => /no budget is found/.test(document.getElementById("sheet-questions").innerText));
  assert.doesNotMatch(await text(page, "#sheet-questions"), /--/);
  assert.equal(await page.isDisabled("#use-budget"), true);
  await choose("power.xlsx");
  await page.locator("#use-budget:enabled").waitFor();
  await page.click("#use-budget");
  await shown(page);
  assert.equal(await page.inputValue("#title"), "Power in a resistor");
});

for (const [name, options] of [["at 390 px", { viewport: { width: 390, height: 844 } }], ["in German, dark", { lang: "de", colorScheme: "dark" }]]) {
  await test(`start page and import, ${name}`, async page => {
    const look = async state => {
      await page.evaluate(await readFile(axe, "utf8") + ";window.axe = axe;0");
      const found = await page.evaluate(() => window.axe.run(document, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] }));
      assert.deepEqual(found.violations.map(of => `${of.id}: ${of.nodes.slice(0, 3).map(node => node.html.slice(0, 160)).join("\n")}`), [], state);
      if (options.viewport) await isNarrow(page);
      if (options.lang) assert.deepEqual(await english(page), [], state);
    };
    await until(page, () => document.querySelectorAll("#large .card svg").length === 3);
    await page.fill("#gallery-search", "pt100");
    await shot(page, options.lang ? "start-german" : "start-phone", { fullPage: true });
    await look("start");
    await page.click("#import");
    await paste(page, [["Quantity", "Estimate", "Unit", "Error"], ["a", "5.0", "mm", "0.01"], ["b", "7.0", "mm", "0.02"]]);
    await until(page, () => document.querySelectorAll("#sheet-questions li").length > 0);
    await shot(page, options.lang ? "import-german" : "import-phone", { fullPage: true });
    await look("import");
  }, options);
}

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
  await page.click("#begin-empty");
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
    await page.click("#open");
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

const EMPTY = { open: "m.json", files: [["tests/data/page-empty.json", "m.json"]] };
const value = page => text(page, "#headline .value");

await test("an input says how it is known, and takes what is typed", async page => {
  await page.fill("#equations", "P = V^2/R");
  await page.locator("#missing").getByText("all of them").click();
  // nothing is red before it can be wrong
  await until(page, () => /mean of V/.test(document.getElementById("points").innerText));
  assert.equal(await page.locator("#mistakes li, [aria-invalid=true], mark").count(), 0);
  await field(page, "mean of V").click();
  await page.keyboard.type("5.0112(23) V");
  await page.keyboard.press("Tab");
  await until(page, () => document.querySelector('[aria-label="Unit of V"]').value === "V");
  assert.deepEqual([await field(page, "mean of V").inputValue(), await field(page, "standard uncertainty u of V").inputValue()], ["5.0112", "0.0023"]);
  // ± is asked about, and the way decides
  await field(page, "mean of R").click();
  await page.keyboard.type("100 ohm ± 0.1 %");
  await page.keyboard.press("Tab");
  await page.locator("#inputs .chip", { hasText: "± limits" }).click();
  await until(page, () => (document.querySelector('[aria-label="half-width of R"]') || {}).value === "0.1 %");
  // the unit of the result is offered
  await page.locator("#unreported button", { hasText: "P" }).click();
  await page.locator("#points button", { hasText: "use W" }).click();
  await until(page, () => document.getElementById("source").value.includes('"P": {"unit": "W"}'));
  await until(page, () => /0\.2511/.test((document.querySelector("#headline .value") || {}).innerText || ""));
  // there and back: what was typed is kept
  for (const way of ["readings", "data sheet", "U and k", "± limits"]) {
    await field(page, "How R is known").selectOption({ label: way });
    await until(page, way => document.querySelector('[aria-label="How R is known"]').selectedOptions[0].label === way, way);
  }
  assert.deepEqual([await field(page, "mean of R").inputValue(), await field(page, "half-width of R").inputValue()], ["100", "0.1 %"]);
  await shot(page, "ways");
  await field(page, "How R is known").selectOption({ label: "data sheet" });
  await field(page, "half-width of R").fill("0.02 % rdg + 2 counts");
  await field(page, "resolution of R").fill("0.01");
  await until(page, () => document.querySelectorAll("#mistakes li").length === 0 && /0\.25/.test(document.getElementById("headline").innerText));
}, EMPTY);

await test("readings of a table, and another file's result, are picked from lists", async (page, folder) => {
  await writeFile(join(folder, "day.csv"), "t;V [V]\n1;5,011\n2;5,013\n3;5,012\n4;5,010\n");
  const saved = execFileSync(process.env.GUMPTION, ["run", join(folder, "power.json"), "--quiet", "--brief", "--save", join(folder, "power.result.json")]);
  assert(saved.length > 0);
  await field(page, "How voltage is known").selectOption({ label: "readings" });
  await page.getByRole("button", { name: "From a table" }).first().click();
  await page.locator("#dialog .entry", { hasText: "day.csv" }).click();
  await page.locator("#dialog .entry", { hasText: "V [V]" }).click();
  await until(page, () => /"file": "day.csv", "column": "V \[V\]"/.test(document.getElementById("source").value));
  await until(page, () => document.querySelectorAll("#mistakes li").length === 0);
  await page.fill("#equations", "power = voltage^2/resistance\ny = p/2");
  await page.locator("#missing").getByText("p", { exact: true }).click();
  await field(page, "How p is known").selectOption({ label: "result of another file" });
  await page.getByRole("button", { name: "Choose" }).click();
  await page.locator("#dialog .entry", { hasText: "power.result.json" }).click();
  await page.locator("#dialog .entry", { hasText: "power" }).click();
  await until(page, () => document.querySelector('[aria-label="Unit of p"]').value === "mW");
  await until(page, () => document.querySelectorAll("#mistakes li").length === 0);
  // each value of a certificate is an entry of its own
  await field(page, "How p is known").selectOption({ label: "certificate (DCC)" });
  await page.getByRole("button", { name: "Choose" }).click();
  await page.locator("#dialog .entry", { hasText: "ref.xml" }).click();
  await page.locator("#dialog .entry", { hasText: "Measured value 422" }).first().click();
  await until(page, () => /"distribution": "dcc"[^}]*"file": "ref.xml"[^}]*"index": [1-9]/.test(document.getElementById("source").value));
}, { open: "power.json", files: [...POWER.files, ["reports/certificate.dcc.xml", "ref.xml"]] });

await test("sixty inputs: three screens, the answer in sight, and what is old is grey", async page => {
  await until(page, () => document.querySelector("#headline .value"));
  const tall = await page.evaluate(() => document.querySelector("table.inputs").offsetHeight);
  assert(tall <= 3 * 1000, `the inputs are ${tall} px`);
  await page.evaluate(() => scrollTo(0, 1500));
  await until(page, () => !document.getElementById("bar").hidden);
  assert.equal(await text(page, "#bar-value .value"), await value(page));
  // what sticks below the head is not under it
  const [head, slider] = await page.evaluate(() => [".bar", ".slider"].map(of => document.querySelector(of).getBoundingClientRect()).map((of, place) => place ? of.top : of.bottom));
  assert(slider >= head - 1, `${slider} under ${head}`);
  await field(page, "mean of x40").fill("5 q");
  await until(page, () => document.getElementById("bar").classList.contains("stale"));
  assert.match(await text(page, "#stale"), /does not belong to the present input/);
  assert.match(await text(page, "#mistakes button"), /mean of x40/);
  await shot(page, "sixty");
}, { open: "sixty.json", files: [["tests/data/page-sixty.json", "sixty.json"]] });

await test("a printed sheet says what it is of", async page => {
  await refined(page);
  await page.pdf({ format: "A4" });
  const printed = await page.evaluate(() => document.getElementById("print").innerText || document.getElementById("print").textContent);
  for (const said of ["Power in a resistor", "power.json", "power = voltage^2/resistance", "voltmeter's certificate", "seed: 1"]) {
    assert(printed.includes(said), `${said} is not in ${printed}`);
  }
}, POWER);

await test("no English sentence is left on the German page", async page => {
  for (const name of ["end gauge", "thermometer eleven readings", "thermistor thermometer"]) {
    await page.click("#new");
    await page.fill("#gallery-search", name);
    await page.locator("#gallery .entry:visible").first().click();
    await shown(page);
    await refined(page);
    await until(page, () => document.querySelector("#part-audit table") !== null || document.getElementById("box-audit").hidden === false);
    if (!await page.locator("#more").getAttribute("open")) await page.evaluate(() => { document.getElementById("more").open = true; });
    assert.deepEqual(await english(page), [], name);
  }
  // a value without a name of a distribution
  assert.equal(await page.inputValue('[aria-label="Wie t bekannt ist"]'), "constant");
  await shot(page, "german", { fullPage: true });
  await page.selectOption("#language", "en");
  await until(page, () => /Subtotals|Sensitivity/.test(document.getElementById("part-budget").innerText));
}, { lang: "de" });

/** A response over frequency that falls off as a low-pass does, as a spreadsheet copies it: with decimal commas. */
function response(rows, corner) {
  let state = 7;
  const noise = () => { state = (state * 16807) % 2147483647; return (state / 2147483647 - 0.5) * 0.01; };
  const row = n => {
    const f = 10 ** (0.2 + n * 2.3 / rows);
    return [f.toFixed(2), (1 / Math.hypot(1, f / corner) + noise()).toFixed(4), "0.003", "1", "ok"];
  };
  const lines = [["f [Hz]", "measured gain", "u", "model", "remark"], ...Array.from({ length: rows }, (_, n) => row(n))];
  return lines.map(line => line.join("\t").replaceAll(".", ",")).join("\r\n");
}

/** An empty case, into which a table is pasted and whose columns are said. */
async function caseOf(page, table) {
  await page.click("#begin-case");
  await until(page, () => !document.getElementById("case-form").hidden && /Paste|paste|einfügen/.test(document.getElementById("case-lacks").innerText));
  assert.equal(await page.locator("#mistakes li").count(), 0, "an empty case has no mistakes");
  await page.fill("#case-paste", table);
  await page.locator("#case-paste").blur();
  await until(page, () => document.querySelectorAll(".case-column").length === 4);
}

async function columnsSaid(page, de = false) {
  const of = name => page.getByLabel(de ? `Bedeutung der Spalte ${name}` : `Meaning of the column ${name}`, { exact: true });
  await of("f").selectOption("condition");
  await until(page, () => /"Hz"/.test(document.getElementById("source").value));
  await of("measured_gain").selectOption("new");
  await page.locator("#dialog input").first().fill("gain");
  await page.locator("#dialog-actions button").first().click();
  await of("u").locator('option[value="standard_uncertainty:gain"]').waitFor({ state: "attached" });
  await of("u").selectOption("standard_uncertainty:gain");
  await until(page, () => /"standard_uncertainty": "u"/.test(document.getElementById("source").value));
  await of("model").selectOption("sim:gain");
}

const verdict = (page, what) => page.waitForFunction(what => !document.getElementById("case-verdict").hidden && new RegExp(what).test(document.getElementById("case-verdict").textContent) && document.getElementById("case-stop").hidden && document.getElementById("case-old").hidden, what, { timeout: 60000 });

await test("a case from a pasted table: low-pass is found, and what is proposed becomes a candidate", async (page, folder) => {
  await caseOf(page, response(20, 30));
  assert.match(await text(page, "#case-said"), /20 rows.*remark was left out/);
  await columnsSaid(page);
  // without a candidate the diagnosis composes one
  await verdict(page, "none of the candidates");
  const add = page.locator(".proposals button", { hasText: "Add as candidate" }).first();
  const name = await page.locator(".proposals b").first().innerText();
  await add.click();
  await until(page, name => Boolean(JSON.parse(document.getElementById("source").value).effects[name]), name);
  await verdict(page, name);
  await page.getByLabel(`Remove ${name}`, { exact: true }).click();
  for (const effect of ["offset", "scale-factor"]) {
    await page.fill("#case-search", effect);
    await page.locator("#case-catalogue label", { has: page.locator("b", { hasText: new RegExp(`^${effect}$`) }) }).locator("input").check();
    await until(page, effect => (JSON.parse(document.getElementById("source").value).catalogue || []).includes(effect), effect);
  }
  await page.fill("#case-search", "low-pass");
  await page.locator("#case-catalogue label", { has: page.locator("b", { hasText: /^low-pass$/ }) }).locator("input").check();
  await verdict(page, "low-pass explains");
  assert.match(await page.frameLocator("#report").locator("body").innerText(), /low-pass explains it/);
  await shot(page, "case-low-pass", { fullPage: true });
  // an own effect
  await page.click("#case-add-effect");
  await field(page, "Formula of gain in effect").fill("gain*(1 + d)");
  await field(page, "standard uncertainty u of d").fill("0.02");
  await verdict(page, "low-pass explains");
  assert.deepEqual(JSON.parse(await source(page)).effects.effect.overrides, { gain: "gain*(1 + d)" });
  await page.keyboard.press("Control+s");
  await page.locator("#dialog input").fill("low.json");
  await page.locator("#dialog-actions button").first().click();
  await until(page, () => document.getElementById("state").textContent === "saved");
  const told = JSON.parse(execFileSync(process.env.GUMPTION, ["gap", join(folder, "low.json"), "--format", "json", "--quiet"], { stdio: ["ignore", "pipe", "ignore"] }));
  assert.deepEqual(told.verdict.effects, ["low-pass"]);
});

await test("a diagnosis tells its share and is stopped", async page => {
  await until(page, () => document.getElementById("case-progress").value > 0 && !document.getElementById("case-stop").hidden);
  await page.click("#case-stop");
  await until(page, () => !document.getElementById("case-diagnose").hidden && /Stopped/.test(document.getElementById("case-state").textContent));
  // a change does not begin it again
  await answered(page, () => page.fill("#title", "Stopped"));
  assert.equal(await page.locator("#case-progress").isHidden(), true);
  await page.click("#case-diagnose");
  await until(page, () => document.getElementById("case-progress").value > 0);
  await page.click("#case-stop");
}, { open: "case.json", files: [["models/gap/lateral_motion/case.json", "case.json"], ["models/gap/lateral_motion/data.csv", "data.csv"]] });

await test("a ready-made effect that would explain the data is added by its button", async page => {
  await until(page, () => document.querySelectorAll(".case-column").length === 5);
  assert.equal(await page.locator("#case-file").inputValue(), "data.csv");
  assert.equal(await page.getByLabel("Meaning of the column phi", { exact: true }).inputValue(), "value:phi");
  const { catalogue } = JSON.parse(await source(page));
  for (const name of catalogue.filter(name => !["phase-offset", "scale-factor"].includes(name))) {
    await page.locator("#case-catalogue label", { has: page.locator("b", { hasText: new RegExp(`^${name}$`) }) }).locator("input").uncheck();
    await until(page, name => !JSON.parse(document.getElementById("source").value).catalogue.includes(name), name);
  }
  const add = field(page, "Add low-pass as a candidate");
  await add.waitFor({ timeout: 60000 });
  await add.click();
  await verdict(page, "low-pass explains");
  assert.deepEqual(JSON.parse(await source(page)).catalogue, [...catalogue.filter(name => ["phase-offset", "scale-factor"].includes(name)), "low-pass"]);
}, { open: "case.json", files: [["models/gap/mems_low_pass/case.json", "case.json"], ["models/gap/mems_low_pass/data.csv", "data.csv"]] });

await test("a case on a phone, dark, in German", async page => {
  await caseOf(page, response(20, 30));
  await columnsSaid(page, true);
  await page.locator("#case-all").check();
  await verdict(page, "erklärt sie");
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - innerWidth);
  assert(wide <= 0, `sideways by ${wide}`);
  const found = (await english(page)).filter(said => !/^low-pass/.test(said));
  assert.deepEqual(found, []);
  await page.evaluate(await readFile(axe, "utf8") + ";window.axe = axe;0");
  const told = await page.evaluate(() => window.axe.run({ exclude: ["iframe"] }, { runOnly: ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"] }));
  assert.deepEqual(told.violations.map(of => `${of.id}: ${of.nodes.slice(0, 3).map(node => node.html.slice(0, 160)).join("\n    ")}`), []);
  await shot(page, "case-phone", { fullPage: true });
}, { lang: "de", viewport: { width: 390, height: 844 }, colorScheme: "dark" });
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

/** The words of the page in a language. */
const words = async lang => (await import(`data:text/javascript,${encodeURIComponent(await readFile(join(root, `crates/live/page/words.${lang}.js`), "utf8"))}`)).default;

// a first user: a blank page, U and k, a quantity as people write it, sixty inputs, a certificate, a case
for (const [how, lang, width, height] of [["by mouse", "en", 1400, 1000], ["by keyboard", "en", 1400, 1000], ["on a phone, in German", "de", 390, 844]]) {
  await test(`a first user, ${how}`, async (page, folder) => {
    const w = await words(lang);
    // nobody reaches a button that is not shown
    const press = how === "by keyboard" ? async of => { await of.waitFor(); await of.focus(); await page.keyboard.press("Enter"); } : of => of.click();
    const choose = how === "by keyboard" ? async (of, label) => { await of.focus(); await of.selectOption({ label }); } : (of, label) => of.selectOption({ label });
    const type = async (of, typed) => { await of.focus(); await page.keyboard.type(typed); };
    const input = (key, name) => field(page, w.of(w.key[key], name));
    const look = async state => {
      assert.deepEqual(await violations(page), [], state);
      assert(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `${state} scrolls sideways`);
      await shot(page, `first-${lang}-${width}-${state}`, { fullPage: true });
    };
    const isRight = () => page.waitForFunction(() => document.querySelectorAll("#mistakes li").length === 0 && document.getElementById("points").hidden && !document.getElementById("results").hidden);
    await press(page.locator("#begin-empty"));
    await page.locator("#equations").waitFor();
    await type(page.locator("#equations"), "P = V^2/R");
    await press(page.locator("#missing button").last());
    await input("mean", "V").waitFor();
    assert.equal(await red(page), 0);
    await choose(field(page, w.how_of("R")), w.ways.expanded);
    await input("expanded", "R").waitFor();
    await type(input("mean", "R"), "100.02 ohm");
    await type(input("expanded", "R"), lang === "de" ? "0,04" : "0.04");
    await type(input("mean", "V"), lang === "de" ? "5,0112(23) V" : "5.0112(23) V");
    await press(page.locator("#unreported button").first());
    await page.locator("#points button", { hasText: "W" }).last().waitFor();
    await press(page.locator("#points button", { hasText: w.use_unit("W") }));
    await isRight();
    assert.match(await text(page, "#headline .value"), lang === "de" ? /0,25107/ : /0\.25107/);
    await look("result");
    await page.keyboard.press("Control+s");
    await page.locator("#dialog input").fill("power.json");
    await page.keyboard.press("Enter");
    await until(page, said => document.getElementById("state").textContent === said, w.saved);
    const told = JSON.parse(execFileSync(process.env.GUMPTION, ["run", join(folder, "power.json"), "--format", "json", "--quiet"])).outputs.P;
    // by hand: u_V/V = 0.0023/5.0112, u_R/R = 0.02/100.02
    const power = 5.0112 ** 2 / 100.02, u = power * Math.hypot(2 * 0.0023 / 5.0112, 0.02 / 100.02);
    assert(Math.abs(told.gum.standard_uncertainty - u) < 1e-9 * u && Math.abs(told.gum.estimate - power) < 1e-12, JSON.stringify(told.gum));
    const written = await source(page);
    // sixty, as a list of names in an equation gives them
    const names = Array.from({ length: 58 }, (_, n) => `d${n}`);
    await page.locator("#equations").focus();
    await page.keyboard.press("Control+End");
    await page.keyboard.type(`\nQ = P*(1 + ${names.join(" + ")})`);
    await press(page.locator("#missing button").last());
    await input("mean", "d57").waitFor({ timeout: 30000 });
    await type(input("mean", "d57"), "0.0000(1)");
    await until(page, label => document.querySelector(`[aria-label="${label}"]`).value !== "", w.of(w.key.std, "d57"));
    const tall = await page.evaluate(() => document.querySelector("table.inputs").offsetHeight);
    assert(tall <= (width < 1000 ? 60 * 90 : 3000), `sixty inputs are ${tall} px`);
    await shot(page, `first-${lang}-${width}-sixty`);
    await page.keyboard.press("Escape");
    for (let step = 0; step < 100 && await source(page) !== written; step++) await page.keyboard.press("Control+z");
    assert.equal(await source(page), written);
    await isRight();
    // a certificate of it
    await press(page.locator("#certify"));
    await page.locator("#certificate-form details").first().waitFor();
    const said = w.certificate;
    await type(field(page, said.number), "2026-017");
    const frame = page.frameLocator("#report");
    await frame.getByText("2026-017").first().waitFor();
    await look("certificate");
    await page.keyboard.press("Control+s");
    await page.locator("#dialog input").fill("certificate.json");
    await page.keyboard.press("Enter");
    await until(page, said => document.getElementById("state").textContent === said, w.saved);
    execFileSync(process.env.GUMPTION, ["certificate", join(folder, "certificate.json"), "--quiet"]);
    // a case from pasted data
    await press(page.locator("#new"));
    await press(page.locator("#begin-case"));
    await page.locator("#case-paste").waitFor();
    await page.fill("#case-paste", response(20, 30));
    await page.locator("#case-paste").blur();
    await until(page, () => document.querySelectorAll(".case-column").length === 4);
    await columnsSaid(page, lang === "de");
    await page.fill("#case-search", "low-pass");
    await page.locator("#case-catalogue label", { has: page.locator("b", { hasText: /^low-pass$/ }) }).locator("input").check();
    await verdict(page, "low-pass");
    await look("case");
  }, { lang, viewport: { width, height } });
}

await test("speed with 20 inputs", async page => {
  const inputs = {}, terms = [];
  for (let number = 1; number <= 20; number++) {
    const shape = ["normal", "rectangular", "triangular", "arcsine"][number % 4];
    inputs[`x${number}`] = { unit: "1", distribution: shape, mean: number, [shape === "normal" ? "std" : "half_width"]: 0.01 * number };
    terms.push(number % 3 ? `x${number}` : `sin(x${number})*x${number}`);
  }
  const model = { format: 1, title: "Twenty inputs", inputs, equations: { y: terms.join(" + ") }, outputs: { y: { unit: "1" } } };
  await page.click("#begin-empty");
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
    said: document.getElementById("stale").textContent,
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
