// Walls in headless Chromium: readings on a wall, and the plan of one.
import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import { closeBrowser, open, openBrowser, shown } from './pages.mjs';

before(openBrowser);
after(closeBrowser);

test('a plan of a wall says how to measure it, and draws the error with its limit', async () => {
  const { page, close } = await open('wall_plan');
  const answer = await page.locator('#answer').innerText();
  assert.match(answer, /Readings\s*\d+\s*\d+ at each of \d+ heights/);
  assert.match(answer, /Best cut within 40 µm.*Thinnest wall/s);
  assert.match(await page.locator('#designs tbody').innerText(), /chosen|best/);
  const limit = await page.locator('#cuts canvas').evaluate((canvas) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    let n = 0;
    for (let i = 0; i < data.length; i += 4) n += data[i] === 0xc0 && data[i + 1] === 0x28 && data[i + 2] === 0x1e;
    return n;
  });
  assert.ok(limit > 200, `${limit} points of the limit`);
  const map = page.locator('#cuts canvas');
  await map.scrollIntoViewIfNeeded();
  const box = await map.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height - 100);
  assert.match(await page.locator('#cuts .readout').innerText(),
    /feed 0\.\d+ mm per tooth, radial depth [\d.]+ mm: [\d.]+ µm at most, .* cm³\/min/);
  const changes = async () => page.locator('#changes canvas').first().evaluate((c) => c.toDataURL());
  const before = await changes();
  await page.getByRole('button', { name: 'thickness of the wall' }).click();
  await shown(page);
  assert.notEqual(await changes(), before);
  await close();
});

test('readings lie on the wall, and what they leave tells its value', async () => {
  const { page, close } = await open('calibrate');
  const map = page.locator('#wall canvas');
  await map.scrollIntoViewIfNeeded();
  const before = await map.evaluate((canvas) => canvas.toDataURL());
  const box = await map.boundingBox();
  // Across the lowest readings until one is near.
  let text = '';
  for (let x = 60; x < 400 && !/measured/.test(text); x += 7) {
    await page.mouse.move(box.x + x, box.y + box.height - 55);
    text = await page.locator('#wall .readout').innerText();
  }
  assert.match(text, /height 0\.3 mm: measured [\d.−]+ µm, fitted [\d.−]+ µm, left [\d.−]+ µm/);
  await page.locator('#wall').getByRole('button', { name: 'left over' }).click();
  assert.notEqual(await map.evaluate((canvas) => canvas.toDataURL()), before);
  const first = await page.locator('#means .legend').first().innerText();
  assert.match(first, /measured mean\s*all readings, with runout\s*imprint/);
  await close();
});
