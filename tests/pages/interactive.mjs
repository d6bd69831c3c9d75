// What the script of `--interactive` does, in Chromium under the page's own policy:
// interactive.mjs PLAIN INTERACTIVE [PICTURE]. Both are pages of `run` with the two methods.
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';
import { join } from 'node:path';

const require = createRequire(join(process.cwd(), 'interactive.mjs'));
const puppeteer = require('puppeteer-core');
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const [plain, interactive, picture] = process.argv.slice(2);

const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--hide-scrollbars'],
});
const opened = async (file, set = async () => {}) => {
  const page = await browser.newPage();
  const said = [];
  page.on('console', message => said.push(message.text()));
  page.on('pageerror', error => said.push(error.message));
  page.on('request', request => request.url().startsWith('file:') || said.push(`asked for ${request.url()}`));
  await set(page);
  await page.setViewport({ width: 1000, height: 900 });
  await page.goto(`file://${file}`);
  return { page, said };
};
const text = page => page.evaluate(() => document.querySelector('main').innerText.replace(/\s+/g, ' '));

// without scripts the two pages say and show the same
const before = await opened(plain);
const without = await opened(interactive, page => page.setJavaScriptEnabled(false));
const shown = await Promise.all([before, without].map(({ page }) => page.screenshot({ fullPage: true })));
assert.ok(Buffer.from(shown[0]).equals(Buffer.from(shown[1])), 'without scripts the page looks different');

const { page, said } = await opened(interactive);
const words = await text(before.page);
await page.evaluate(() => document.querySelectorAll('.tool:not(th .tool), .methods').forEach(part => { part.style.display = 'none'; }));
assert.equal(await text(page), words, 'with the script the page says something else');
await page.reload();

// a table sorts up, down, and as it was; the total stays below
const budget = () => page.evaluate(() => {
  const table = [...document.querySelectorAll('table')].find(table => table.querySelector('tr.total'));
  const place = [...table.tHead.rows[0].cells].findIndex(cell => cell.textContent.startsWith('share'));
  const rows = [...table.tBodies[0].rows];
  const share = row => row.cells[place].textContent.replace(/[^0-9.]/g, '');
  return { sort: table.tHead.rows[0].cells[place].getAttribute('aria-sort'), place, last: rows.at(-1).className, shares: rows.slice(0, -1).map(row => Number(share(row))) };
});
const press = () => page.evaluate(() => {
  const table = [...document.querySelectorAll('table')].find(table => table.querySelector('tr.total'));
  [...table.tHead.rows[0].cells].find(cell => cell.textContent.startsWith('share')).querySelector('button').click();
});
const asItWas = await budget();
assert.equal(asItWas.sort, 'none');
const ascending = [...asItWas.shares].sort((a, b) => a - b);
await press();
const up = await budget();
assert.deepEqual([up.sort, up.last, up.shares], ['ascending', 'total', ascending]);
await press();
assert.deepEqual((await budget()).shares, ascending.reverse());
await press();
assert.deepEqual((await budget()).shares, asItWas.shares);

// the value under the pointer
const point = await page.evaluate(() => {
  const circle = [...document.querySelectorAll('svg.wide circle[data-value]')].find(of => of.dataset.value.includes('trials:'));
  circle.scrollIntoView({ block: 'center' });
  const at = circle.getBoundingClientRect();
  return [at.x + at.width / 2, at.y + at.height / 2, circle.dataset.value];
});
await page.mouse.move(point[0] + 3, point[1] + 2);
assert.equal(await page.evaluate(() => document.querySelector('.value').textContent), point[2]);
if (picture) await page.screenshot({ path: picture });

// a method hides in tables and in figures, and comes back
const hidden = method => page.evaluate(method => ({
  cells: [...document.querySelectorAll('td.off')].filter(cell => cell.getClientRects().length === 0).length,
  parts: [...document.querySelectorAll(`svg.wide [data-method="${method}"]`)].map(part => part.getClientRects().length === 0),
}), method);
const toggle = method => page.evaluate(method => {
  [...document.querySelectorAll('.methods label')].find(label => label.textContent.trim() === method).querySelector('input').click();
}, method);
for (const method of ['GUM', 'Monte Carlo']) {
  await toggle(method);
  const now = await hidden(method);
  assert.ok(now.cells > 0 && now.parts.length > 0 && now.parts.every(Boolean), method);
  await toggle(method);
  const then = await hidden(method);
  assert.ok(then.cells === 0 && !then.parts.some(Boolean), method);
}

// a figure fills the window, is enlarged and closed, all by keys as well
await page.evaluate(() => document.querySelector('figcaption .tool').focus());
await page.keyboard.press('Enter');
const view = () => page.evaluate(() => document.querySelector('dialog[open] svg')?.getAttribute('viewBox').split(' ').map(Number));
const whole = await view();
await page.keyboard.press('+');
const nearer = await view();
assert.ok(nearer[2] < whole[2] && Math.abs(nearer[2] / nearer[3] - whole[2] / whole[3]) < 1e-9);
await page.keyboard.press('0');
assert.deepEqual(await view(), whole);
const { page: looked } = await opened(interactive, page => page.setBypassCSP(true));
await looked.evaluate(() => document.querySelector('figcaption .tool').click());
for (const state of ['open', 'closed']) {
  await looked.evaluate(axe);
  const found = await looked.evaluate(() => axe.run());
  assert.deepEqual(found.violations.map(of => `${of.id}: ${of.nodes[0].html}`), [], state);
  await looked.evaluate(() => document.querySelector('dialog')?.close());
}
await page.keyboard.press('Escape');
assert.equal(await view(), undefined);

assert.deepEqual(said, []);
await browser.close();
console.log('interactive: values, sorting, methods and enlarging work; nothing else changes; 0 violations');
