// The pages of write_samples.cpp in headless Chromium, as a reader opens them from a file.
import assert from 'node:assert/strict';
import path from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { closeBrowser, colorOf, drawn, has, open, openBrowser, painted, pictures, samples,
  shown } from './pages.mjs';

before(openBrowser);
after(closeBrowser);

const curveColors = ['--measured', '--s1', '--s2', '--s3', '--s4', '--s5', '--s6'];

async function check(name, options, plots) {
  const { page, seen, url, close } = await open(name, options);
  assert.deepEqual(seen.complaints, []);
  assert.deepEqual(seen.requests.filter((request) => request !== url &&
    !request.startsWith('data:')), [], 'the page requests something');
  assert.equal(await page.locator('.uplot').count(), plots);
  const canvases = await drawn(page);
  assert.equal(canvases.length, plots);
  const colors = await Promise.all(curveColors.map((color) => colorOf(page, color)));
  canvases.forEach((canvas, i) => assert.ok(colors.some((color) => has(canvas, color)),
    `plot ${i + 1} has no curve`));
  const overflow = await page.evaluate(() =>
    document.documentElement.scrollWidth - window.innerWidth);
  assert.ok(overflow <= 0, `the page is ${overflow} px too wide`);
  return { page, canvases, close };
}

const plotsOf = { identify: 8, doubtful: 8, worn: 10, simulate: 7, compared: 1, failed: 0, other: 2,
  surface: 7, marks: 6, pulse: 5, calibrate: 4, teeth: 4, one_height: 0, stability: 2, tool_point: 4,
  modes: 6, shared_modes: 16, actuator: 2, dynamics: 8, chatter: 7, correct: 8, plan: 3,
  wall_plan: 6, program: 2 };
const drawingsOf = { surface: 3, marks: 3, pulse: 3, calibrate: 3, teeth: 3, wall_plan: 1,
  program: 2, stability: 2, dynamics: 3, chatter: 2, correct: 1, simulate: 1 };
for (const [name, plots] of Object.entries(plotsOf)) {
  for (const width of [1200, 480]) {
    test(`${name} is drawn, alone and without complaint, ${width} px wide`, async () => {
      const { page, close } = await check(name, { width }, plots);
      const drawings = drawingsOf[name] || 0;
      if (drawings) await paintedDrawings(page, drawings, name !== 'dynamics');
      await close();
    });
  }
}

async function paintedDrawings(page, count, mapIsFirst) {
  const all = await painted(page);
  assert.equal(all.length, count);
  for (const { points } of all) assert.ok(points > 500, `${points} points`);
  if (count === 3 && mapIsFirst) {
    assert.ok(all[0].colors > 100, `the map has ${all[0].colors} colours`);
    assert.ok(all[0].points > 40000, `the map has ${all[0].points} points`);
  }
}

test('groups stand side by side, and a change that intervals allow is no change', async () => {
  const { page, close } = await open('worn');
  const rows = await page.locator('#groups tbody tr').allInnerTexts();
  assert.match(rows[0], /no sure change.*no sure change/s);
  assert.match(rows[1], /13\.5.*\+90 %.*19\.9.*\+180 %/s);
  assert.match(rows[2], /–.*–.*–/s);
  assert.match(await page.locator('#groups thead').innerText(), /without a group.*20 min <b>/s);
  assert.match(await page.locator('#figures').innerText(), /Of records without a group\..*29\.20 µm.*130°/s);
  await close();
});

test('a plan names the cut, what it brings, and draws all cuts over what they cost', async () => {
  const { page, close } = await open('plan');
  assert.match(await page.locator('#answer').innerText(), /± 8\s*%\s*so far ± 17 %.*0\.\d+\s*µm/s);
  assert.match(await page.locator('#best tbody').innerText(), /^so far.*?slot\s+0\.01 mm\s+3 mm\s+8 mm/s);
  const before = JSON.stringify(await drawn(page));
  await page.getByRole('button', { name: 'feed per tooth' }).click();
  await shown(page);
  assert.notEqual(JSON.stringify(await drawn(page)), before);
  assert.match(await page.locator('#basis').innerText(), /left out: above max_force_N = 450 N\s+38/);
  await close();
});

test('the map tells values, and a click or the slider chooses the profile', async () => {
  const { page, close } = await open('surface');
  const chosen = () => page.locator('.slider output').innerText();
  const profile = async () => JSON.stringify((await drawn(page))[0]);
  assert.equal(await chosen(), '1.5 mm');
  const before = await profile();
  const map = page.locator('.drawing canvas').first();
  await map.scrollIntoViewIfNeeded();
  const box = await map.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height - 60);
  assert.match(await page.locator('.readout').innerText(),
    /x 30\.\d+ mm, height 0\.\d mm: [\d.]+ µm .* tooth [123]/);
  await page.mouse.click(box.x + box.width / 2, box.y + box.height - 50);
  assert.equal(await chosen(), '0.3 mm');
  assert.notEqual(await profile(), before);
  await page.locator('.slider input').fill('4');
  assert.equal(await chosen(), '1.5 mm');
  assert.equal(await profile(), before);
  await close();
});

test('the map shows the error, the marks and the teeth', async () => {
  const { page, seen: told, close } = await open('surface');
  const seen = new Set();
  const teeth = await Promise.all(['--s1', '--s2', '--s3'].map((name) => colorOf(page, name)));
  for (const name of ['error', 'feed marks', 'tooth']) {
    await page.getByRole('button', { name, exact: true }).click();
    const [{ text, points }] = await painted(page);
    assert.ok(points > 40000, `${name}: ${points} points`);
    seen.add(text);
  }
  assert.equal(seen.size, 3);
  const counts = await page.locator('.drawing canvas').first().evaluate((canvas, colors) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return colors.map((color) => {
      let n = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]) === color) ++n;
      }
      return n;
    });
  }, teeth);
  assert.ok(counts.every((n) => n > 1000), `pixels of each tooth: ${counts}`);
  // The browser would rather read canvases back in another way.
  assert.deepEqual(told.complaints.filter((text) => !text.startsWith('Canvas2D')), []);
  await close();
});

test('a wall says in words what it is, and what betrays runout', async () => {
  const { page, close } = await open('surface');
  const text = await page.locator('main').innerText();
  for (const part of ['the profile that stays on the wall', 'a sign of runout', 'Wall 1', 'at its free edge',
    'Mean surface location error', 'Deflected shapes', 'feedback = "regenerative"']) {
    assert.ok(text.includes(part), `missing: ${part}\n${text}`);
  }
  await close();
  const pulse = await open('pulse');
  const words = await pulse.page.locator('main').innerText();
  assert.ok(words.includes('not a profile that a probe can find'));
  assert.ok(!words.includes('Feed marks') && !words.includes('Roughness'));
  await pulse.close();
});

test('a calibration says which answer counts, and why the others differ', async () => {
  const { page, close } = await open('calibrate');
  const text = await page.locator('main').innerText();
  for (const part of ['all readings, with runout', 'the linear answer is wrong for a real profile',
    'only one combination is known well', 'Ten more readings at', 'no tooth numbers', 'µm high']) {
    assert.ok(text.includes(part), `missing: ${part}\n${text}`);
  }
  assert.equal(await page.locator('.fits .chosen').first().innerText(), 'all readings, with runout');
  await close();
});

test('the residuals of numbered teeth have their colours', async () => {
  const { page, close } = await open('teeth');
  const canvases = await drawn(page);
  for (const name of ['--s1', '--s2', '--s3']) {
    assert.ok(has(canvases[2], await colorOf(page, name)), name);
  }
  await page.getByRole('button', { name: 'the feed' }).click();
  await shown(page);
  assert.notDeepEqual((await drawn(page))[2], canvases[2]);
  await close();
});

test('readings that cannot tell give no coefficient, but what is known', async () => {
  const { page, close } = await open('one_height');
  assert.ok((await page.locator('.lead').innerText()).startsWith('No good answer'));
  const text = await page.locator('main').innerText();
  assert.ok(text.includes('one combination of them is known'), text);
  assert.equal(await page.locator('.tile').count(), 0);
  await close();
});

test('drawings follow the paper', async () => {
  const { page, close } = await open('surface', { colorScheme: 'dark' });
  const dark = await painted(page);
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  const paper = await painted(page);
  paper.forEach((one, i) => {
    assert.equal(one.width, 680);
    assert.notEqual(one.text, dark[i].text);
  });
  await page.evaluate(() => dispatchEvent(new Event('afterprint')));
  assert.deepEqual((await painted(page)).map(({ text }) => text), dark.map(({ text }) => text));
  const pdf = await page.pdf({ format: 'A4', preferCSSPageSize: true,
    path: path.join(pictures, 'surface.pdf') });
  assert.ok(pdf.length > 50000);
  await close();
});

test('dark pages draw the same', async () => {
  const { page, canvases, close } = await check('identify', { colorScheme: 'dark' }, 8);
  assert.ok(has(canvases[0], await colorOf(page, '--s1')));
  await close();
});

test('measured and fitted force lie in one panel, and the chip model can be chosen', async () => {
  const { page, close } = await open('identify');
  const [measured, exact, none] = await Promise.all(
    ['--measured', '--s1', '--s3'].map((name) => colorOf(page, name)));
  let canvases = await drawn(page);
  for (const canvas of canvases.slice(0, 3)) {
    assert.ok(has(canvas, measured), 'measured');
    assert.ok(has(canvas, exact), 'trochoidal, the chosen one');
    assert.ok(!has(canvas, none));
  }
  await page.getByRole('button', { name: 'no runout' }).click();
  await shown(page);
  canvases = await drawn(page);
  for (const canvas of canvases.slice(0, 3)) {
    assert.ok(has(canvas, measured) && has(canvas, none) && !has(canvas, exact));
  }
  assert.deepEqual(await page.locator('.uplot').count(), 8, 'old curves stay behind');
  await close();
});

test('dragging zooms all panels over the angle together, a double click shows all', async () => {
  const { page, close } = await open('identify');
  const blank = async () => (await drawn(page)).map((canvas) => JSON.stringify(canvas));
  const before = await blank();
  await page.locator('.u-over').first().evaluate((over) =>
    over.scrollIntoView({ block: 'center', behavior: 'instant' }));
  const box = await page.locator('.u-over').first().boundingBox();
  await page.mouse.move(box.x + 200, box.y + 50);
  await page.mouse.down();
  await page.mouse.move(box.x + 300, box.y + 55, { steps: 5 });
  const values = await page.locator('.legend b').evaluateAll((all) =>
    all.slice(0, 6).map((b) => b.textContent));
  assert.ok(values.every((text) => /^−?[\d.]+$/.test(text)), `values at the cursor: ${values}`);
  await page.mouse.up();
  await shown(page);
  const zoomed = await blank();
  for (let i = 0; i < 6; ++i) assert.notEqual(zoomed[i], before[i], `panel ${i + 1} stays`);
  assert.equal(zoomed[6], before[6], 'the sweep has another axis');
  await page.mouse.dblclick(box.x + 250, box.y + 50);
  await page.mouse.move(5, 5);
  await shown(page);
  assert.deepEqual(await blank(), before);
  await close();
});

test('numbers too large for the usual margin are not cut', async () => {
  const { page, close } = await open('simulate');
  const left = await page.$$eval('.u-over', (all) => all.map((over) => over.offsetLeft));
  assert.ok(left.every((x) => x >= 60), `margins: ${left}`);
  await close();
});

test('two answers lie in one picture, and what they say stands side by side', async () => {
  const { page, close } = await open('compared', {});
  assert.match(await page.locator('#both').textContent(), /slow,.*fast, faster:/s);
  assert.match(await page.locator('#different').textContent(), /The two cases are equal/);
  const legend = await page.locator('#table1').textContent();
  for (const word of ['slow', 'fast', 'Dashed: fast']) assert.ok(legend.includes(word), legend);
  await close();
});

test('the answer stands in words and numbers', async () => {
  const { page, close } = await open('identify');
  const text = await page.locator('main').innerText();
  for (const part of ['2618 MPa', '2577 to 2660', 'tooth 2 is 8.03 µm shorter than tooth 1',
    'Neighbouring residuals are alike', 'cannot be told from the drift', '874.92 rpm']) {
    assert.ok(text.includes(part), `missing: ${part}\n${text}`);
  }
  assert.equal(await page.locator('.fits .chosen').first().innerText(), 'trochoidal (exact)');
  await close();
});

test('an idle tooth is named and hostile text stays text', async () => {
  const { page, close } = await open('simulate');
  const text = await page.locator('body').innerText();
  assert.ok(text.includes('idle: cuts nothing'));
  assert.ok(text.includes('</script><b>&'));
  assert.ok((await page.title()).startsWith('Up milling with runout <b> & "quotes" µ – 刀'));
  assert.equal(await page.locator('h1 b, .warnings b').count(), 0);
  await close();
});

test('numbers that must not be used are called so, and nothing is well known', async () => {
  const { page, close } = await open('doubtful');
  const lead = page.locator('.lead');
  assert.ok((await lead.innerText()).startsWith('Do not use these numbers'));
  const usual = await open('identify');
  const background = (where) => where.evaluate((e) => getComputedStyle(e).backgroundColor);
  assert.notEqual(await background(lead), await background(usual.page.locator('.lead')));
  await usual.close();
  const text = await page.locator('main').innerText();
  assert.ok(!/(well|roughly|hardly): ±/.test(text), text);
  assert.equal(await page.locator('.coefficients td:last-child', { hasText: 'do not use' }).count(), 5);
  assert.equal(await page.locator('.meter .on').count(), 0);
  await close();
});

test('a unit stands behind its number, before the full stop', async () => {
  const { page, close } = await open('doubtful');
  const text = await page.locator('.warnings').innerText();
  assert.match(text.replace(/\s/g, ' '), /= 1885 MPa and K\s?rc\s?= 812\.5 MPa\. Check it/);
  await close();
});

test('how well a coefficient is known is not clipped on a narrow page', async () => {
  for (const name of ['identify', 'doubtful']) {
    const { page, close } = await open(name, { width: 480 });
    const clipped = await page.$$eval('.scroll:has(.coefficients)', (all) =>
      all.map((scroll) => scroll.scrollWidth - scroll.clientWidth));
    assert.deepEqual(clipped, [0], name);
    const right = await page.$$eval('.coefficients td:last-child', (cells) =>
      Math.max(...cells.map((cell) => cell.getBoundingClientRect().right)));
    assert.ok(right <= 480, `${name}: ends at ${right}`);
    await close();
  }
});

test('intervals are 95 % everywhere, by the factor of the fit', async () => {
  const { page, close } = await open('identify');
  const text = await page.locator('main').innerText();
  assert.ok(!text.includes('standard error'), text);
  assert.ok(text.includes('95 %: ± 0.5 µm') || text.includes('95 %: ± 0.49 µm'), text);
  await close();
});

test('a failed answer says so first', async () => {
  const { page, close } = await open('failed');
  const lead = await page.locator('.lead').innerText();
  assert.ok(lead.startsWith('No good answer'));
  assert.ok(lead.includes('rank 3'));
  const main = await page.locator('main').innerText();
  assert.ok(main.includes('parallel to K'), main);
  assert.ok(!/\d+ MPa/.test(main), 'a failed fit must show no number that looks valid');
  await close();
});

test('a long table is thinned for drawing, says so, and keeps its peak', async () => {
  const { page, close } = await open('other');
  const text = await page.locator('figcaption').innerText();
  assert.match(text, /The picture shows \d+ of 240000 rows/);
  const values = await page.evaluate(() =>
    JSON.parse(document.getElementById('data').textContent).tables[0].columns[1].values);
  assert.ok(Math.max(...values) > 28);
  await close();
});

test('without JavaScript the page still tells its message', async () => {
  const { page, close } = await open('identify', { javaScriptEnabled: false });
  const text = await page.locator('body').innerText();
  assert.ok(text.includes('explains the record best'));
  assert.ok(text.includes('need JavaScript'));
  assert.ok(text.includes('K_tc  2618 MPa'));
  await close();
});

test('paper is light, and shows the inputs', async () => {
  const { page, close } = await open('identify', { colorScheme: 'dark' });
  const pdf = await page.pdf({ format: 'A4', preferCSSPageSize: true });
  assert.ok(pdf.length > 20000);
  await page.evaluate(() => dispatchEvent(new Event('beforeprint')));
  await page.emulateMedia({ media: 'print', colorScheme: 'dark' });
  assert.equal(await page.locator('#case').isVisible(), true);
  assert.equal(await colorOf(page, '--paper'), 0xffffff);
  await close();
});

test('the modes stand beside their frequency response, with the fit through it', async () => {
  const { page, canvases, close } = await check('modes', {}, 6);
  const [measured, fit] = await Promise.all(['--measured', '--s1'].map((c) => colorOf(page, c)));
  assert.ok(has(canvases[0], measured) && has(canvases[0], fit), 'magnitude');
  for (const canvas of canvases.slice(1, 4)) assert.ok(has(canvas, fit));
  assert.ok(has(canvases[4], measured), 'mode indicator');
  assert.ok(has(canvases[5], fit), 'stable poles');
  const text = await page.locator('main').innerText();
  for (const part of ['895.7', '2516', 'N/µm', '19.07', 'Stabilisation', 'mode indicator', 'of the magnitude',
    'criterion above the best', 'phase', 'real part', 'm/s²/N',
    'half of a 95 % confidence interval', 'Frequency response function', 'modal stiffness']) {
    assert.ok(text.includes(part), `missing: ${part}\n${text}`);
  }
  assert.ok(!/_per_|s2_N/.test(text), 'a unit is spelt as in the file');
  await close();
});

test('the step is drawn with its fit, and no time constants where there are none', async () => {
  const { page, canvases, close } = await check('actuator', {}, 2);
  assert.ok(has(canvases[0], await colorOf(page, '--s1')));
  const text = await page.locator('main').innerText();
  for (const part of ['0.9946', 'No single time constants', 'underdamped', '2.0399']) {
    assert.ok(text.includes(part), `missing: ${part}\n${text}`);
  }
  assert.ok(!/time constant, ms/.test(text), text);
  assert.ok(!/_per_|_se\b|10 90/.test(text), text);
  await close();
});

test('a measured tool point is told in words, in numbers and in three curves', async () => {
  const { page, close } = await open('tool_point');
  assert.match(await page.locator('.lead').innerText(),
    /^Stable to 1\.34\smm at 12000\srpm: the cut of 1\smm lies 25\s% below\..*By the measured response itself the limit is 1\.33\smm\./);
  const rows = await page.locator('#measured table tr').allInnerTexts();
  assert.equal(rows.length, 4);
  assert.match(rows[3], /^multi-frequency/);
  assert.match(await page.locator('#modes').innerText(), /20° from x to y/);
  await close();
});

test('the lobes show the case, and how stability is lost', async () => {
  const { page, close } = await open('stability');
  const text = await page.locator('main').innerText();
  for (const part of ['Stability lobe diagram', 'Floquet multiplier', 'Limit depth', 'Hopf',
    'period doubling there', 'The cross is the case', 'N/µm']) {
    assert.ok(text.includes(part), `missing: ${part}\n${text}`);
  }
  const canvases = await drawn(page);
  assert.ok(has(canvases[0], await colorOf(page, '--s4')), 'no stretch of period doubling');
  const map = page.locator('.drawing canvas').first();
  await map.scrollIntoViewIfNeeded();
  const box = await map.boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  assert.match(await page.locator('.readout').innerText(), /rpm, [\d.]+ mm: \|μ\| = \d/);
  await close();
});

test('a steady state shows forces, flutes, motion and the once-per-turn section', async () => {
  const { page, canvases, close } = await check('dynamics', {}, 8);
  const text = await page.locator('main').innerText();
  for (const part of ['steady state', 'it repeats', 'Surface location error', '53.2 · 51.4', 'differ by 3.35 %', 'tooth 1', '0.1287', '0.07130',
    'Once per turn', 'command', 'actuator', '× 0.6014']) {
    assert.ok(text.includes(part), `missing: ${part}\n${text}`);
  }
  const [first, second] = await Promise.all(['--s1', '--s2'].map((c) => colorOf(page, c)));
  for (const canvas of canvases.slice(2, 4)) {
    assert.ok(has(canvas, first) && has(canvas, second), 'both flutes lie over each other');
  }
  assert.deepEqual(await page.locator('#flutes tbody tr').count(), 2);
  assert.ok(!(await page.locator('#figures').innerText()).includes('linear growth'));
  await close();
});

test('a correction shows the flutes before and after, its command and the controller', async () => {
  const { page, close } = await open('correct');
  const lead = await page.locator('#answer').innerText();
  assert.match(lead, /38\.8\d\s*%/);
  assert.match(lead, /0\.0\d\s*%/);
  for (const id of ['flutes', 'forces', 'command', 'controller', 'speeds', 'limits', 'runout']) {
    assert.equal(await page.locator(`#${id}`).count(), 1, id);
  }
  assert.equal(await page.locator('#flutes tbody tr').count(), 2);
  assert.match(await page.locator('#runout').innerText(), /27\.8.*26\.2/s);
  await close();
});

test('chatter is said first, with its growth, its amplitude and its frequency', async () => {
  const { page, close } = await open('chatter');
  const lead = await page.locator('.lead').innerText();
  assert.match(lead, /the cut chatters: the motion stays bounded/);
  const answer = await page.locator('#answer').innerText();
  assert.match(answer, /chatters, within bounds/);
  assert.match(answer, /1\.153/);
  assert.match(answer, /± 72\.\d\s*µm/);
  assert.match(answer, /942\.\d+\s*Hz/);
  assert.match(await page.locator('main').innerText(), /This one does not/);
  const rows = await page.locator('#spectrum tbody tr').allInnerTexts();
  assert.match(rows[0], /^942\.\d+.*its own$/s);
  assert.ok(rows.some((row) => /2 × spindle/.test(row)), rows.join());
  assert.equal(await page.locator('#surface').count(), 0);
  await close();
});

test('the cut from above stands still until it is asked, and goes with keys and by itself', async () => {
  const { page, close } = await open('dynamics');
  const readout = page.locator('#moving .readout');
  const start = await readout.innerText();
  await shown(page);
  assert.match(start, /^φ = 82\.5°: force on the tool −24\.0, 47\.6 N/);  // where it is largest
  assert.equal(await readout.innerText(), start, 'it moves by itself');
  const before = await page.$eval('#moving canvas', (canvas) => canvas.toDataURL());
  await page.focus('#moving input');
  for (let i = 0; i < 90; ++i) await page.keyboard.press('ArrowLeft');
  assert.match(await readout.innerText(), /^φ = 37\.5°/);
  assert.notEqual(await page.$eval('#moving canvas', (canvas) => canvas.toDataURL()), before);
  await page.focus('#moving .moments button');
  await page.keyboard.press('Enter');
  await page.waitForFunction(() => !/^φ = 37\.5°/.test(document.querySelector('#moving .readout').textContent));
  assert.equal(await page.locator('#moving .moments button').innerText(), 'Pause');
  await page.keyboard.press('Enter');
  await shown(page);
  const paused = await readout.innerText();
  await shown(page);
  assert.equal(await readout.innerText(), paused);
  await close();
});

test('nothing plays where people ask for less motion', async () => {
  const { page, close } = await open('dynamics', { reducedMotion: 'reduce' });
  assert.equal(await page.locator('#moving .moments button').count(), 0);
  assert.equal(await page.locator('#moving input').count(), 1);
  await close();
});
