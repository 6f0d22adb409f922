// What a reader does with a picture: save it, look into its data, zoom it by mouse and fingers, hear of it.
import assert from 'node:assert/strict';
import { mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { closeBrowser, module, open, openBrowser, samples, shown } from './pages.mjs';

const { strFromU8, unzipSync } = module('fflate');

before(openBrowser);
after(closeBrowser);

/** Scripts of the page as text. */
const sourceOf = (...files) => files.map((file) =>
  readFileSync(new URL(`../../../src/trochoid/report/page/${file}`, import.meta.url), 'utf8')).join('\n');

/** What a button of a section saves. */
async function saved(page, section, button) {
  const [file] = await Promise.all([page.waitForEvent('download'),
    page.locator(`#${section} .tools`).first().getByRole('button', { name: button }).click()]);
  return { name: file.suggestedFilename(), bytes: readFileSync(await file.path()) };
}

/** A workbook as rows of cells: what is in each, and whether it is text and in bold. */
async function sheetOf(page, bytes) {
  const parts = Object.fromEntries(Object.entries(unzipSync(bytes)).map(([name, part]) => [name, strFromU8(part)]));
  return page.evaluate((xml) => {
    const all = (part, names) => [...new DOMParser().parseFromString(xml[part], 'application/xml').querySelectorAll(names)];
    const texts = all('xl/sharedStrings.xml', 'si').map((one) => one.textContent);
    const fonts = all('xl/styles.xml', 'fonts > font').map((one) => one.querySelector('b') !== null);
    const styles = all('xl/styles.xml', 'cellXfs > xf').map((one) => fonts[Number(one.getAttribute('fontId'))]);
    return all('xl/worksheets/sheet1.xml', 'row').map((row) => [...row.querySelectorAll('c')].map((cell) => {
      const text = cell.getAttribute('t') === 's';
      const value = cell.querySelector('v')?.textContent;
      return { at: cell.getAttribute('r'), text, bold: styles[Number(cell.getAttribute('s') ?? 0)],
        value: text ? texts[Number(value)] : value };
    }));
  }, parts);
}

/** A sample with other data: of(text of its page) gives the page. */
function changed(name, as, of) {
  mkdirSync(path.join(samples, as), { recursive: true });
  const text = readFileSync(path.join(samples, name, 'report.html'), 'utf8');
  const other = of(text);
  assert.notEqual(other, text, 'nothing was changed');
  writeFileSync(path.join(samples, as, 'report.html'), other);
}

test('curves are saved as SVG, PNG and CSV', async () => {
  const { page, seen, close } = await open('identify');
  const svg = await saved(page, 'measured', 'SVG');
  assert.equal(svg.name, 'measured.svg');
  const text = svg.bytes.toString();
  assert.match(text, /^<svg xmlns/);
  assert.ok((text.match(/<path /g) || []).length >= 6, 'three panels of two curves');
  for (const part of ['Fx [N]', 'measured', 'φ, recorded spindle angle']) assert.ok(text.includes(part), part);
  const parsed = await page.evaluate((t) =>
    new DOMParser().parseFromString(t, 'image/svg+xml').querySelector('parsererror')?.textContent, text);
  assert.equal(parsed, undefined);
  const png = await saved(page, 'measured', 'PNG');
  assert.equal(png.name, 'measured.png');
  assert.equal(png.bytes.subarray(1, 4).toString(), 'PNG');
  const csv = await saved(page, 'measured', 'CSV');
  const rows = csv.bytes.toString().trim().split('\n');
  assert.match(rows[0], /^"?φ, recorded spindle angle \[°\]"?,Fx measured \[N\],Fx trochoidal \(exact\) \[N\],Fy/);
  assert.ok(rows.length > 1000, `${rows.length} rows`);
  assert.equal(rows[1].split(',').length, 7);
  assert.deepEqual(seen.complaints, []);
  await close();
});

test('data are saved as a workbook of numbers', async () => {
  const { page, seen, close } = await open('identify');
  const csv = (await saved(page, 'measured', 'CSV')).bytes.toString().trim().split('\n');
  const book = await saved(page, 'measured', 'Excel');
  assert.equal(book.name, 'measured.xlsx');
  const [head, ...rows] = await sheetOf(page, book.bytes);
  assert.deepEqual(head.map(({ value }) => value.replace(/^(.*,.*)$/, '"$1"')).join(','), csv[0]);
  assert.ok(head.every(({ text, bold }) => text && bold), 'the first row is text in bold');
  assert.equal(rows.length, csv.length - 1);
  assert.ok(rows.flat().every(({ text, bold }) => !text && !bold), 'the others are numbers');
  rows.forEach((row, i) => {
    const known = csv[i + 1].split(',').map((value, k) => [value, `${'ABCDEFG'[k]}${i + 2}`]).filter(([value]) => value);
    assert.deepEqual(row.filter(({ value }) => value !== undefined).map(({ value, at }) => [Number(value), at]),
      known.map(([value, at]) => [Number(value), at]));
  });
  assert.deepEqual(seen.complaints, []);
  await close();
});

test('text stays text in a workbook, also where it looks like a formula or a number', async () => {
  const workbookOf = new Function('writeXlsxFile', `${sourceOf('text.js', 'save.js')}\nreturn workbookOf;`)(module('write-excel-file/browser').default);
  const book = await workbookOf('a-name-that-is-too-long-for-a-sheet', { head: ['answer', 'F [N]'], rows: [['=1+1', 1.5], ['007', -3e-12], [null, null]] });
  const { page, close } = await open('failed');
  const rows = await sheetOf(page, new Uint8Array(await book.arrayBuffer()));
  const found = rows.map((row) => row.map(({ text, value }) => (text ? value : value && Number(value))).filter((value) => value !== undefined));
  assert.deepEqual(found, [['answer', 'F [N]'], ['=1+1', 1.5], ['007', -3e-12], []]);
  await close();
});

test('a map is saved with its image, and its data with all its points', async () => {
  const { page, close } = await open('stability');
  const svg = (await saved(page, 'lobes', 'SVG')).bytes.toString();
  assert.match(svg, /<image [^>]*href="data:image\/png;base64,/);
  assert.match(svg, /spindle speed \[rpm\]/);
  const csv = (await saved(page, 'lobes', 'CSV')).bytes.toString();
  assert.match(csv, /^spindle speed \[rpm\],axial depth \[mm\],\|μ\|\n/);
  await close();
});

test('every picture has a name, and curves have a table behind them', async () => {
  for (const name of ['identify', 'stability', 'calibrate', 'correct', 'dynamics']) {
    const { page, close } = await open(name);
    const names = await page.$$eval('[role=img]', (all) => all.map((one) => one.getAttribute('aria-label')));
    const plots = await page.locator('.uplot, .drawing canvas').count();
    assert.equal(names.length, plots, name);
    for (const label of names) assert.ok(label.length > 10, `${name}: ${label}`);
    await close();
  }
  const { page, close } = await open('identify');
  assert.match(await page.locator('#measured .plot').first().getAttribute('aria-label'),
    /^Fx in N over φ, recorded spindle angle \[°\]: measured −?[\d.]+ to [\d.]+; trochoidal/);
  // The names are read, not taken away from the page.
  assert.equal(await page.locator('#measured .legend strong').first().innerText(), 'Fx [N]');
  const details = page.locator('#measured details.data');
  assert.equal(await details.locator('table').count(), 0);
  await details.locator('summary').click();
  await details.locator('table').first().waitFor();
  assert.match(await details.innerText(), /least.*mean.*largest.*The first 12 of \d+ rows/s);
  await close();
});

test('a rectangle zooms the lobes, a double click shows all', async () => {
  const { page, close } = await open('stability');
  const map = page.locator('#lobes canvas');
  await map.scrollIntoViewIfNeeded();
  const text = () => map.evaluate((canvas) => canvas.toDataURL());
  const first = await text();
  const box = await map.boundingBox();
  const readout = page.locator('#lobes .readout');
  const atLeft = async () => {
    await page.mouse.move(box.x + 60, box.y + box.height / 2);
    return parseFloat(await readout.innerText());
  };
  const before = await atLeft();
  await page.mouse.move(box.x + 300, box.y + 120);
  await page.mouse.down();
  await page.mouse.move(box.x + 500, box.y + 240, { steps: 4 });
  await page.mouse.up();
  assert.notEqual(await text(), first);
  assert.ok(await atLeft() > before, 'the left edge is further right');
  await page.mouse.dblclick(box.x + 300, box.y + 200);
  assert.equal(await text(), first);
  await close();
});

test('two fingers zoom curves and map, two taps show all', async () => {
  const { page, close } = await open('stability', { hasTouch: true });
  const touch = async (where, moves) => {
    await where.scrollIntoViewIfNeeded();
    await where.evaluate((element, list) => {
      const box = element.getBoundingClientRect();
      for (const [type, id, x, y] of list) {
        element.dispatchEvent(new PointerEvent(`pointer${type}`, { pointerType: 'touch', pointerId: id, bubbles: true,
          clientX: box.x + x, clientY: box.y + y }));
      }
    }, moves);
    await shown(page);
  };
  const pinch = [['down', 1, 300, 80], ['down', 2, 400, 100], ['move', 1, 200, 60], ['move', 2, 500, 140],
    ['up', 1, 200, 60], ['up', 2, 500, 140]];
  const taps = [['down', 3, 300, 90], ['up', 3, 300, 90], ['down', 4, 301, 90], ['up', 4, 301, 90]];
  for (const place of ['#limit .u-over', '#lobes canvas']) {
    const picture = place.replace('.u-over', 'canvas');
    const text = () => page.locator(picture).first().evaluate((canvas) => canvas.toDataURL());
    const first = await text();
    await touch(page.locator(place).first(), pinch);
    const zoomed = await text();
    assert.notEqual(zoomed, first, place);
    await touch(page.locator(place).first(), taps);
    assert.notEqual(await text(), zoomed, `${place}: back`);
    if (place.includes('lobes')) assert.equal(await text(), first);
  }
  await close();
});

test('a finger across a plot chooses a range', async () => {
  const { page, close } = await open('identify', { hasTouch: true });
  const over = page.locator('#measured .u-over').first();
  await over.scrollIntoViewIfNeeded();
  const text = () => page.locator('#measured canvas').first().evaluate((canvas) => canvas.toDataURL());
  const first = await text();
  await over.evaluate((element) => {
    const box = element.getBoundingClientRect();
    for (const [type, x] of [['down', 100], ['move', 150], ['move', 260], ['up', 260]]) {
      element.dispatchEvent(new PointerEvent(`pointer${type}`, { pointerType: 'touch', pointerId: 1, bubbles: true,
        clientX: box.x + x, clientY: box.y + 40 }));
    }
  });
  await shown(page);
  assert.notEqual(await text(), first);
  await close();
});

test('a chatter frequency does not join its branches', async () => {
  const { page, close } = await open('tool_point');
  const svg = (await saved(page, 'limit', 'SVG')).bytes.toString();
  const green = await page.evaluate(() => getComputedStyle(document.documentElement).getPropertyValue('--s3').trim());
  const pieces = (svg.match(new RegExp(`<path [^>]*stroke="${green}"`, 'g')) || []).length;
  assert.ok(pieces > 2, `${pieces} pieces`);
  await close();
});

test('residuals of a fit to a band are drawn in the band', async () => {
  changed('identify', 'banded', (text) => text.replaceAll(/"chip_model": ?"trochoidal"/g,
    '"band_harmonics":3,$&'));
  const { page, seen, close } = await open('banded');
  assert.match(await page.locator('#residuals').innerText(), /the mean and the first 3 harmonics of a turn/);
  assert.match(await page.locator('#residuals .legend').first().innerText(), /everything\s+mean and first 3 harmonics/);
  const csv = (await saved(page, 'residuals', 'CSV')).bytes.toString().trim().split('\n').slice(1, 721)
    .map((row) => row.split(',').map(Number));
  const rms = (k) => Math.sqrt(csv.reduce((sum, row) => sum + row[k] ** 2, 0) / csv.length);
  // Noise alone: of its power 7 of 720 parts of a turn lie in the band.
  assert.ok(rms(2) < 0.3 * rms(1), `${rms(2)} N in the band, ${rms(1)} N of everything`);
  assert.deepEqual(seen.complaints, []);
  await close();
});

test('a multiplier above 1 is not said to fade, and an error of nothing is 0', async () => {
  changed('stability', 'growing', (text) => text.replace(/"absolute": ?[\d.]+/g, '"absolute": 1.0739'));
  const growing = await open('growing');
  assert.match(await growing.page.locator('.tiles').innerText(), /above 1: a small vibration grows/);
  await growing.close();
  changed('surface', 'nothing', (text) => text.replace(/"min_error_mm": ?-?[\d.e-]+/, '"min_error_mm": 5.2e-9'));
  const { page, close } = await open('nothing');
  assert.match(await page.locator('.tile', { hasText: 'Smallest error' }).innerText(), /Smallest error\s+0\s*µm/);
  await close();
});

test('a response is shown as receptance, mobility and accelerance', async () => {
  const { page, seen, close } = await open('modes');
  const units = () => page.locator('#response .legend strong').allInnerTexts();
  const first = await units();
  const values = async () => (await saved(page, 'response', 'CSV')).bytes.toString().trim().split('\n')
    .slice(1).map((row) => row.split(',').map(Number));
  await page.locator('#response').getByRole('button', { name: 'receptance' }).click();
  assert.match((await units())[0], /dB re 1 m\/N/);
  const x = await values();
  await page.locator('#response').getByRole('button', { name: 'accelerance' }).click();
  assert.match((await units())[0], /dB re 1 m\/s²\/N/);
  const a = await values();
  const k = Math.floor(x.length / 2);
  const w = 2 * Math.PI * x[k][0];
  const real = 5;  // after the frequency and two columns each of magnitude and phase
  assert.ok(Math.abs(a[k][real] + w * w * x[k][real]) < 1e-9 * w * w * Math.abs(x[k][real]) + 1e-12,
    `${a[k][real]} and ${x[k][real]} at ${x[k][0]} Hz`);
  assert.equal((await units()).length, first.length);
  assert.deepEqual(seen.complaints, []);
  await close();
});

test('forces lie over the angle or over the time', async () => {
  const { page, close } = await open('simulate');
  const heads = async () => (await saved(page, 'forces', 'CSV')).bytes.toString().split('\n')[0];
  assert.match(await heads(), /^"?φ, spindle angle \[°\]/);
  const over = page.locator('#forces').getByRole('button', { name: 'time', exact: true });
  if (await over.count()) {
    await over.click();
    assert.match(await heads(), /^time \[s\],Fx/);
    assert.match(await page.locator('#forces figcaption').innerText(), /^time \[s\]/);
  } else assert.fail('no choice');
  await close();
});

test('no word of the script stands on a page', async () => {
  for (const name of ['dynamics', 'modes', 'correct', 'calibrate']) {
    const { page, close } = await open(name);
    const text = await page.locator('body').innerText();
    assert.ok(!/\b(null|undefined|NaN|\[object)/.test(text), `${name}: ${/.{0,40}\b(null|undefined|NaN|\[object).{0,40}/.exec(text)?.[0]}`);
    await close();
  }
});

test('a frequency is drawn in its branches', () => {
  const { jumpsOf, turnsOver, sampledAt } = new Function(`${sourceOf('text.js', 'charts.js')}\nreturn { jumpsOf, turnsOver, sampledAt };`)();
  assert.deepEqual(jumpsOf([900, 905, 911, 918, 926]), []);
  assert.deepEqual(jumpsOf([900, 905, 911, 897, 902, 908]), [2], 'back to the next lobe');
  assert.deepEqual(jumpsOf([900, 905, 911, 940, 944, 949]), [2], 'up to a branch above');
  assert.deepEqual(jumpsOf([900, 905, 400, 402, 404]), [1]);
  assert.deepEqual(turnsOver([170, 178, -176, -170]), [1]);
  assert.deepEqual(sampledAt([0, 1, 2], [0, 10, 0], [0, 0.5, 1, 1.5, 3], [1]), [0, 5, 10, null, null]);
});
