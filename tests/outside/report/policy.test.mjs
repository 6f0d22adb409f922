// What a browser lets a page do, whatever would ever stand in it.
import assert from 'node:assert/strict';
import { existsSync, mkdirSync, readdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { closeBrowser, open, openBrowser, samples } from './pages.mjs';

test('every report contains the licences of the libraries in it', () => {
  for (const name of readdirSync(samples)) {
    const file = path.join(samples, name, 'report.html');
    if (!existsSync(file)) continue;
    const text = readFileSync(file, 'utf8');
    assert.match(text, /Copyright \(c\) 2022 Leon Sorokin[^]*AS IS[^]*uPlot=function/, file);
    assert.match(text, /\(c\) 2018 gitlab.com\/catamphetamine[^]*AS IS[^]*\(c\) 2026 Arjun Barrett[^]*AS IS[^]*writeXlsxFile=/, file);
  }
});

before(openBrowser);
after(closeBrowser);

test('a script that is not the page\'s own does not run, and nothing is fetched', async () => {
  const { page: sound, url, close: closeSound } = await open('simulate');
  const plots = await sound.locator('.uplot').count();
  assert.ok(plots > 0);
  await closeSound();
  const folder = path.join(samples, 'intruded');
  mkdirSync(folder, { recursive: true });
  const text = readFileSync(fileURLToPath(url), 'utf8');
  const intruders = '<script>window.intruder = 1</script><base href="https://example.org/">' +
    '<img src="x" onerror="window.intruder = 2"><iframe src="https://example.org/"></iframe>' +
    '<link rel="stylesheet" href="https://example.org/a.css"><img src="https://example.org/a.png">';
  writeFileSync(path.join(folder, 'report.html'), text.replace('<main>', `${intruders}<main>`));
  const { page, seen, url: intruded, close } = await open('intruded');
  assert.equal(await page.evaluate(() => window.intruder), undefined);
  assert.equal(await page.evaluate(() => fetch('https://example.org/').then(() => 'fetched', () => 'refused')),
    'refused');
  assert.equal(await page.evaluate(() => document.baseURI), intruded);
  assert.ok(seen.complaints.some((text) => text.includes('Content Security Policy')));
  assert.equal(await page.locator('.uplot').count(), plots);
  await close();
});
