// Pictures of pages, and what axe-core says of them: pages.mjs FOLDER PAGE...
// Every page at 1400 and 390 pixels and dark, and its first printed sheet; the report is axe.txt.
import { readFileSync, writeFileSync } from 'node:fs';
import { execFileSync } from 'node:child_process';
import { basename, join } from 'node:path';
import { createRequire } from 'node:module';

const require = createRequire(join(process.cwd(), 'pages.mjs'));
const puppeteer = require('puppeteer-core');
const axe = readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');
const [folder, ...pages] = process.argv.slice(2);

const looks = [
  ['1400', { width: 1400, height: 1000 }, 'light'],
  ['390', { width: 390, height: 844 }, 'light'],
  ['dark', { width: 1000, height: 1000 }, 'dark'],
];
const browser = await puppeteer.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--disable-gpu', '--hide-scrollbars'],
});
const report = [];
let violations = 0;
for (const file of pages) {
  const name = basename(file, '.html');
  for (const [look, viewport, scheme] of looks) {
    const page = await browser.newPage();
    // the pages' own policy lets nothing run, axe-core neither
    await page.setBypassCSP(true);
    await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: scheme }]);
    await page.setViewport(viewport);
    await page.goto(`file://${file}`);
    await page.screenshot({ path: join(folder, `${name}-${look}.png`) });
    await page.evaluate(axe);
    const found = await page.evaluate(() => axe.run());
    violations += found.violations.length;
    const count = `${found.violations.length} violations, ${found.passes.length} passes`;
    report.push(`${name} ${look}: ${count}`);
    for (const of of found.violations) {
      report.push(`  ${of.id} (${of.impact}): ${of.help}: ${of.nodes[0].html.slice(0, 120)}`);
    }
    if (look === '1400') {
      const sheet = join(folder, `${name}-a4`);
      await page.emulateMediaFeatures([{ name: 'prefers-color-scheme', value: 'light' }]);
      await page.pdf({ path: `${sheet}.pdf`, preferCSSPageSize: true, printBackground: true });
      execFileSync('pdftoppm', ['-r', '60', '-png', '-singlefile', `${sheet}.pdf`, sheet]);
      execFileSync('rm', [`${sheet}.pdf`]);
    }
    await page.close();
  }
}
await browser.close();
writeFileSync(join(folder, 'axe.txt'), report.join('\n') + '\n');
console.log(report.join('\n'));
process.exit(violations === 0 ? 0 : 1);
