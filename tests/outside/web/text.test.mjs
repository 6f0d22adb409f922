// What the page does to a case file, without a browser.
import assert from 'node:assert/strict';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import path from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import vm from 'node:vm';
import { parse } from 'smol-toml';
import { colorsOfReports, namesOfReports, scriptOfReports } from '../../../web/report_parts.mjs';

const root = path.resolve(path.dirname(fileURLToPath(import.meta.url)), '../../..');
const need = createRequire(import.meta.url);
const { tablesOf, withKey, withoutTable, withToolOf, tomlOf, keyOf } = need(`${root}/web/case_text.js`);
Object.assign(globalThis, { tablesOf, withKey, tomlOf, keyOf });  // the page has one scope
const { inchKeyOf, withUnit, inMm } = need(`${root}/web/lengths.js`);
const { formsOf, typed, numberTyped, numbersTyped, unclearList } = need(`${root}/web/typed.js`);
Object.assign(globalThis, { formsOf, numberTyped, numbersTyped });
const { valuesTyped, valuesShown, numbersOf, withSwept } = need(`${root}/web/swept.js`);
const { seriesColor, isDrawable, stockOf, profileOf, radiusAt, teethOf, edgeSeen, toolPicture } = vm.runInThisContext(
  `(() => { ${scriptOfReports(root)}\nreturn ${namesOfReports}; })()`);
Object.assign(globalThis, { inMm, seriesColor, isDrawable, stockOf });
const { drawCut, tablesDrawn } = need(`${root}/web/drawing.js`);
const { mistakesOf, rangeOf, unitOf, helpOf } = need(`${root}/web/form.js`);
Object.assign(globalThis, { withoutTable, baseOf: need(`${root}/web/dropped.js`).baseOf });
const { writtenCase } = need(`${root}/web/written.js`);
const { zipOf } = need(`${root}/web/files.js`);

function cases() {
  const examples = path.join(root, 'examples');
  return fs.readdirSync(examples).filter((name) => fs.statSync(path.join(examples, name)).isDirectory())
    .flatMap((name) => fs.readdirSync(path.join(examples, name), { withFileTypes: true })
    .filter((entry) => entry.name.endsWith('.toml'))
    .map((entry) => [`${name}/${entry.name}`, fs.readFileSync(path.join(examples, name, entry.name), 'utf8')]));
}

test('the page has every command of the program', () => {
  const header = fs.readFileSync(`${root}/src/trochoid/base/command.h`, 'utf8');
  const commands = [...header.split('name_of')[1].matchAll(/return "(\w+)"/g)].map(([, name]) => name);
  const app = fs.readFileSync(`${root}/web/app.js`, 'utf8');
  const tasks = [...app.split('const tasks = {')[1].split('};')[0].matchAll(/^  (\w+): \[/gm)].map(([, name]) => name);
  assert.deepEqual(tasks.filter((name) => name !== 'sweep').sort(), commands.filter((name) => name !== '').sort());
  const bundle = fs.readFileSync(`${root}/web/bundle.mjs`, 'utf8');
  for (const name of tasks) assert.ok(new RegExp(`const commands = '.*\\b${name}\\b`).test(bundle), name);
});

/** All sources of the library. */
const sources = () => fs.readdirSync(`${root}/src/trochoid`, { recursive: true }).filter((name) => /\.(cpp|h)$/.test(name))
  .map((name) => fs.readFileSync(`${root}/src/trochoid/${name}`, 'utf8'));

test('the compiler of the page gets every algorithm that the sources use', () => {
  const added = fs.readFileSync(`${root}/cmake/web/libcxx13.h`, 'utf8');
  const used = new Set(sources().flatMap((text) => [...text.matchAll(/std::ranges::(\w+)\(/g)].map(([, name]) => name)));
  const lacking = [...used].filter((name) => !new RegExp(`^(auto|bool|void) ${name}\\(`, 'm').test(added));
  assert.deepEqual(lacking, []);
});

const comments = (text) => text.split('\n').filter((line) => line.startsWith('#')).length;

test('a key set to what it is leaves the case as it was', () => {
  for (const [name, text] of cases()) {
    const before = parse(text);
    for (const { name: table, entry } of tablesOf(text)) {
      if (table.includes('.')) continue;
      const of = table === '' ? before : entry ? before[table][entry - 1] : before[table];
      for (const [key, value] of Object.entries(of)) {
        if (typeof value === 'object' && !(Array.isArray(value) && typeof value[0] !== 'object')) continue;
        const after = withKey(text, entry ? `${table}[${entry}]` : table, key, tomlOf(value));
        assert.deepEqual(parse(after), before, `${name}: ${table}.${key}`);
        assert.equal(comments(after), comments(text), name);
      }
    }
  }
});

const small = `title = "a" # of it

[tool]            # the cutter
teeth = 2         # how many
# helix_deg = 30  # the helix
pitch_deg = [ # unequal
  170,
  190,
]

[[measurement]]
file = "one.csv"
[[measurement]]
file = "two.csv"
`;

test('a key is set, uncommented, added and left out in its place', () => {
  assert.match(withKey(small, 'tool', 'teeth', '3'), /^teeth = 3 +# how many$/m);
  const helix = withKey(small, 'tool', 'helix_deg', '25');
  assert.match(helix, /^helix_deg = 25 +# the helix$/m);
  assert.equal(parse(helix).tool.helix_deg, 25);
  assert.equal(parse(withKey(small, 'tool', 'diameter_mm', '8')).tool.diameter_mm, 8);
  assert.deepEqual(parse(withKey(small, 'tool', 'pitch_deg', '[180, 180]')).tool.pitch_deg, [180, 180]);
  assert.equal(parse(withKey(small, 'tool', 'teeth', null)).tool.teeth, undefined);
  assert.equal(parse(withKey(small, 'measurement[2]', 'file', '"x.csv"')).measurement[1].file, 'x.csv');
  assert.equal(parse(withKey(small, '', 'title', '"b"')).title, 'b');
  assert.equal(parse(withKey(small, 'cut', 'spindle_rpm', '900')).cut.spindle_rpm, 900);
  assert.equal(parse(withoutTable(small, 'measurement[1]')).measurement.length, 1);
});

test('what is typed is what TOML takes', () => {
  const schema = JSON.parse(fs.readFileSync(`${root}/docs/formats/case.schema.json`, 'utf8'));
  const teeth = schema.properties.tool.properties.teeth;
  const phase = schema.properties.identify.properties.phase_deg;
  assert.equal(typed(' 3 ', teeth), '3');
  assert.equal(typed('0,04', schema.properties.cut.properties.feed_per_tooth_mm), '0.04');
  assert.equal(typed('', teeth), null);
  assert.equal(typed('free', phase), '"free"');
  assert.equal(typed('12.5', phase), '12.5');
  assert.equal(typed('a "b" c', schema.properties.title), '"a \\"b\\" c"');
  assert.equal(typed('-x, y, z', schema.properties.dynamometer.properties.axes), '["-x", "y", "z"]');
  assert.equal(typed('auto', schema.properties.dynamometer.properties.axes), '"auto"');
  assert.equal(typed('170, 190', schema.properties.tool.properties.pitch_deg), '[170, 190]');
  assert.equal(rangeOf(teeth), 'from 1, at most 64');
  assert.equal(unitOf(schema.properties.tool.properties.diameter_mm), 'mm');
});

test('lists of numbers are taken with decimal commas, but not where a comma may mean two things', () => {
  const { tool, runout, cut, program } = JSON.parse(fs.readFileSync(`${root}/docs/formats/case.schema.json`, 'utf8')).properties;
  const offsets = runout.properties.radial_offsets_mm;
  const read = (text, schema = offsets) => parse(`a = ${typed(text, schema)}`).a;
  for (const text of ['0,5; 1,5', '0,5;1,5', '0,5 1,5', '0.5, 1.5', '0.5,1.5', '.5 1.5', '0.5; 1,5;', ' 0,5   1,50 ']) assert.deepEqual(read(text), [0.5, 1.5], text);
  for (const text of ['0; -5', '0 -5', '0, -5', '0,-5']) assert.deepEqual(read(text), [0, -5], text);
  assert.deepEqual(read('1,5e-3; -,5'), [0.0015, -0.5]);
  assert.deepEqual(read('0.01'), [0.01]);
  assert.deepEqual(read('0,01;'), [0.01]);
  assert.deepEqual(read('[0.5, 1]'), [0.5, 1]);
  assert.equal(read('30', tool.properties.helix_deg), 30);
  assert.deepEqual(read('30,5; 31', tool.properties.helix_deg), [30.5, 31]);
  assert.deepEqual(read('-2,5 40', cut.properties.stock_y_mm), [-2.5, 40]);
  assert.equal(read('equal', tool.properties.serration.properties.shift_mm), 'equal');
  assert.deepEqual(read('1, 2', program.properties.ignore_tools), [1, 2]);
  const way = 'The commas can be read in two ways. Write';
  for (const [text, schema, said] of [['1,5,2,5', offsets, `${way} 1, 5, 2, 5 or 1,5; 2,5.`], ['0,5, 1,5', offsets, `${way} 0, 5, 1, 5 or 0,5; 1,5.`],
                                      ['30,5', tool.properties.helix_deg, `${way} 30, 5 or 30.5.`], ['1,5,2', offsets, `${way} a semicolon between numbers.`],
                                      ['1,5,2,5 3', offsets, `${way} a semicolon between numbers.`]]) {
    assert.equal(read(text, schema), text);  // the program refuses it
    assert.equal(unclearList(text, schema), said);
  }
  for (const text of ['1, 5 2', '1;;2', '1; x', ',', '1 2 -']) {
    assert.equal(read(text), text);
    assert.equal(unclearList(text, offsets), undefined);
  }
  assert.equal(unclearList([1, 5], offsets), undefined);
  assert.equal(unclearList('1,5', { type: 'string' }), undefined);
});

test('units are told from tables and lists in brackets', () => {
  const { program, limits, stability, tool } = JSON.parse(fs.readFileSync(`${root}/docs/formats/case.schema.json`, 'utf8')).properties;
  assert.equal(unitOf(program.properties.tool_number), '');
  assert.match(helpOf(program.properties.tool_number), /every T that \[program\] names/);
  assert.equal(unitOf(limits.properties.bending_moment_Nm), 'N m');
  assert.equal(helpOf(limits.properties.bending_moment_Nm), 'at gauge_length_mm of [tool]; default: no limit');
  assert.equal(unitOf(stability.properties.spindle_rpm), 'rpm');
  assert.equal(helpOf(tool.properties.gauge_length_mm), 'height above the tip at which the bending moment is wanted');
});

test('mistakes are told by the key they belong to', () => {
  const [wrong, missing, table, file] = mistakesOf([
    'case.toml:2:9: tool.teeth = -2: out of range; must be a whole number',
    'case.toml:1:1: tool.helix_deg is missing; must be a number',
    'case.toml:1:1: [force] is missing (the force law); simulate needs it',
    'record.csv: no such file'].join('\n'));
  assert.deepEqual([wrong.path, wrong.row], ['tool.teeth', 2]);
  assert.equal(wrong.text, 'tool.teeth = -2: out of range; must be a whole number');
  assert.equal(missing.path, 'tool.helix_deg');
  assert.equal(table.path, 'force');
  assert.equal(file.path, undefined);
});

test('a zip file is one', async () => {
  const { execFileSync } = await import('node:child_process');
  const folder = fs.mkdtempSync('/tmp/zip-');
  const bytes = new Uint8Array(await zipOf({ 'forces.csv': Buffer.from('a,b\n1,2\n'), 'ü.json': Buffer.from('{}') }).arrayBuffer());
  fs.writeFileSync(`${folder}/all.zip`, bytes);
  const code = 'import sys, zipfile; z = zipfile.ZipFile(sys.argv[1]); assert z.testzip() is None; print(z.namelist(), z.read("forces.csv"))';
  const said = execFileSync('/usr/bin/python3', ['-c', code, `${folder}/all.zip`], { encoding: 'utf8' });
  assert.equal(said.trim(), "['forces.csv', 'ü.json'] b'a,b\\n1,2\\n'");
  fs.rmSync(folder, { recursive: true });
});

test('values of a swept key are written as a person writes them', () => {
  const read = (text) => parse(`a = ${valuesTyped(text)}`).a;
  assert.deepEqual(read('500 .. 1500, 21'), { from: 500, to: 1500, count: 21 });
  assert.deepEqual(read('0,1 … 0,5'), { from: 0.1, to: 0.5 });
  assert.deepEqual(read('-2 to 3 in 6'), { from: -2, to: 3, count: 6 });
  assert.deepEqual(read('922 ± 9,5'), { mean: 922, sd: 9.5 });
  assert.deepEqual(read('1, 2.5, 1e3'), { values: [1, 2.5, 1e3] });
  for (const text of ['0,1; 0,2', '0,1 0,2', '0.1,0.2']) assert.deepEqual(read(text), { values: [0.1, 0.2] });
  assert.deepEqual(read('1, a'), { values: [1, 'a'] });
  assert.deepEqual(read('0,1,0,2'), { values: '0,1,0,2' });  // the program refuses it
  assert.deepEqual(read('up, down'), { values: ['up', 'down'] });
  assert.deepEqual(read('[1, 2]'), { values: [1, 2] });
  assert.deepEqual(read('{ file = "a.csv", column = "b" }'), { file: 'a.csv', column: 'b' });
  assert.equal(valuesTyped(' '), null);
  for (const text of ['500 .. 1500, 21', '0.1 .. 0.5', '922 ± 9', '1, 2, 3', 'up, down', '0,1,0,2']) assert.equal(valuesShown(read(text)), text);
});

test('swept keys are added, changed and left out, in either form of the table', () => {
  const as = '[cut]\nspindle_rpm = 900 # rpm\n[sweep]\ncommand = "simulate"\n';
  for (const text of [`${as}over = { "cut.spindle_rpm" = { from = 1, to = 2 } } # of it\n`,
                      `${as}[sweep.over]\n"cut.spindle_rpm" = { from = 1, to = 2 } # of it\n`, as]) {
    const set = withSwept(text, parse(text), 'cut.spindle_rpm', '{ values = [7] }');
    assert.deepEqual(parse(set).sweep.over, { 'cut.spindle_rpm': { values: [7] } });
    const two = withSwept(set, parse(set), 'mode[1].frequency_Hz', '{ mean = 9, sd = 1 }');
    assert.deepEqual(Object.keys(parse(two).sweep.over), ['cut.spindle_rpm', 'mode[1].frequency_Hz']);
    const one = withSwept(two, parse(two), 'cut.spindle_rpm', null);
    assert.deepEqual(parse(one).sweep.over, { 'mode[1].frequency_Hz': { mean: 9, sd: 1 } });
    assert.equal(parse(one).cut.spindle_rpm, 900);
  }
  assert.deepEqual(numbersOf({ title: 'a', cut: { spindle_rpm: 1, engagement: 'up' }, mode: [{ mass_kg: 2 }], sweep: { seed: 1 } }),
                   ['cut.spindle_rpm', 'mode[1].mass_kg']);
});

test('a length may be typed in inches', () => {
  const { tool, cut } = JSON.parse(fs.readFileSync(`${root}/docs/formats/case.schema.json`, 'utf8')).properties;
  assert.equal(inchKeyOf('diameter_mm', tool), 'diameter_in');
  assert.equal(inchKeyOf('feed_rate_mm_per_min', cut), 'feed_rate_in_per_min');
  assert.equal(inchKeyOf('helix_deg', tool), undefined);
  assert.deepEqual(withUnit('0.5 in'), { text: '0.5', unit: 'in' });
  assert.deepEqual(withUnit('3/8"'), { text: '0.375', unit: 'in' });
  assert.deepEqual(withUnit('1 1/4 inch'), { text: '1.25', unit: 'in' });
  assert.deepEqual(withUnit('8 mm'), { text: '8', unit: 'mm' });
  assert.deepEqual(withUnit('"free"'), { text: '"free"' });
  assert.deepEqual(inMm({ diameter_in: 0.5, stock_y_in: [-1, 1], teeth: 2 }), { diameter_mm: 12.7, stock_y_mm: [-25.4, 25.4], teeth: 2 });
});

test('a cutter has its profile, and a right-hand helix leans as the tool turns', () => {
  const near = (a, b) => assert.ok(Math.abs(a - b) < 1e-3, `${a} is not ${b}`);
  const at = (tool, z) => radiusAt(profileOf({ diameter_mm: 8, teeth: 2, ...tool }, 10), z);
  near(at({}, 0), 4);
  near(at({ shape: 'ball' }, 9), 4);
  assert.ok(Math.abs(at({ shape: 'ball' }, 2) - Math.sqrt(12)) < 0.02);
  near(at({ shape: 'bull_nose', corner_radius_mm: 1 }, 0), 3);
  near(at({ shape: 'taper', taper_deg: 10 }, 5), 4 + 5 * Math.tan(Math.PI / 18));
  near(at({ shape: 'apt', corner_radius_mm: 1, corner_center_radius_mm: 3, corner_center_height_mm: 1 }, 10), 4);
  // A barrel whose arc goes on above the part that is drawn.
  near(profileOf({ diameter_mm: 20, shape: 'apt', corner_radius_mm: 50, corner_center_radius_mm: -40, corner_center_height_mm: 30 }, 15).at(-1)[0],
       -40 + Math.sqrt(50 ** 2 - 15 ** 2));
  const tool = { diameter_mm: 8, teeth: 2, helix_deg: 30 };
  const [first, second] = teethOf(tool, {}, 4).map((tooth) => edgeSeen(tooth, profileOf(tool, 6), 6));
  near(first[0][0][0], 4);  // tip of tooth 1 at +y, the left of the picture
  near(first[0].at(-1)[0], 4 * Math.cos((2 * 6 * Math.tan(Math.PI / 6)) / 8));
  assert.deepEqual(second, []);  // it turns to the front
});

test('stock lies where the engagement says', () => {
  assert.deepEqual(stockOf({ engagement: 'slot' }, 4), [-1, 1]);
  assert.deepEqual(stockOf({ engagement: 'up', radial_depth_mm: 1 }, 4), [0.75, 1]);
  assert.deepEqual(stockOf({ engagement: 'down', radial_depth_mm: 6 }, 4), [-1, 0.5]);
  assert.deepEqual(stockOf({ engagement: 'band', stock_y_mm: [-2, 40] }, 4), [-0.5, 1.25]);
  assert.equal(stockOf({ engagement: 'arcs', arcs_deg: [[0, 90]] }, 4), null);
});

test('a new case takes the tool of another along', () => {
  const text = withToolOf('# a\n[tool]\nteeth = 2 # of it\n\n# the cut\n[cut]\nspindle_rpm = 1\n', 'title = "b"\n[tool]\nteeth = 4\npitch_deg = [80,\n100, 90, 90]\n\n# more\n[cut]\n');
  assert.equal(text, '# a\n[tool]\nteeth = 4\npitch_deg = [80,\n100, 90, 90]\n\n# the cut\n[cut]\nspindle_rpm = 1\n');
  assert.equal(withToolOf('[step]\n', '[tool]\n'), '[step]\n');
});

test('a program that [feed] wrote becomes the next case, without what belongs to the old one', () => {
  const read = (text) => { try { return parse(text); } catch { return null; } };
  const of = (text, name = 'case.toml') => writtenCase({ name, text, files: { 'new.nc': 'bytes', 'summary.json': '' } }, read);
  const pocket = of(fs.readFileSync(`${root}/examples/pocket/feed.toml`, 'utf8').replace('part_feed.nc', 'new.nc'), 'feed.toml');
  assert.deepEqual([pocket.name, pocket.file, pocket.bytes], ['feed_written.toml', 'feed_written/new.nc', 'bytes']);
  const { title, include, limits, program, feed } = parse(pocket.text);
  assert.deepEqual([title, include, limits.peak_tooth_N, program, feed],
                   ['The same pocket with new feeds: 250 N for a tooth (new.nc)', 'case.toml', 250, { file: 'feed_written/new.nc' }, undefined]);
  const whole = '[program]\nfile = "old.nc" # ours\nplaces = [[3, 0.5]]\nstep_turns = 2\n[feed]\nwrite = "new.nc"\n[[measurement]]\nfile = "a.csv"\n[tool]\nteeth = 2\n';
  assert.deepEqual(parse(of(whole).text), { program: { file: 'case_written/new.nc', step_turns: 2 }, tool: { teeth: 2 } });
  assert.match(of(whole).text, /^file = "case_written\/new\.nc" +# ours$/m);
  assert.deepEqual(parse(of('feed = { write = "new.nc" }\n[program]\nfile = "old.nc"\n').text), { program: { file: 'case_written/new.nc' } });
  const deep = of(whole, 'jobs/a.toml');
  assert.deepEqual([deep.name, deep.file, parse(deep.text).program.file], ['jobs/a_written.toml', 'jobs/a_written/new.nc', 'a_written/new.nc']);
  for (const text of [whole.replace('"new.nc"', '"other.nc"'), whole.replace('write', '# write'), '[program', 'feed.write = "new.nc"\n[program]\nfile = "old.nc"\n',
                      'program = { file = "old.nc" }\n[feed]\nwrite = "new.nc"\n']) assert.equal(of(text), undefined, text);
});

/** What is painted on a canvas: texts, and all places. */
function painted(picture, width) {
  const all = { texts: [], places: [] };
  const place = (x, y) => all.places.push([x, y]);
  const nothing = () => {};
  picture.paint({ save: nothing, restore: nothing, setLineDash: nothing, beginPath: nothing, closePath: nothing, stroke: nothing,
                  fill: nothing, moveTo: place, lineTo: place, fillText: (text, x, y) => { all.texts.push(text); place(x, y); } },
                width, picture.height(width));
  return all;
}

const noPage = () => {
  globalThis.document = { createElementNS: () => ({ setAttribute() {}, append() {}, prepend() {} }) };
  const asked = new Set();  // colours
  globalThis.getComputedStyle = () => ({ getPropertyValue: (name) => { asked.add(name); return ''; } });
  return asked;
};
const sound = { tool: { shape: 'bull_nose', teeth: 4, diameter_mm: 10, corner_radius_mm: 1, helix_deg: 30 },
                runout: { radial_offsets_mm: [0, 0.01, 0, 0] },
                cut: { engagement: 'up', radial_depth_mm: 3, axial_depth_mm: 2, feed_per_tooth_mm: 0.1, spindle_rpm: 3000 } };

test('the tool is drawn as its tables say', () => {
  const asked = noPage();
  const of = (given) => toolPicture(tablesDrawn(given));
  assert.equal(of(sound).told, 'Compared with a tool without runout: tooth 2 +10 µm.');
  assert.equal(of({ tool: sound.tool }).told, 'The case has no runout.');
  assert.equal(of({ ...sound, runout: { radial_offsets_mm: [0, 'a', -0.01] } }).told, 'Compared with a tool without runout: tooth 3 −10 µm.');
  assert.equal(of({ ...sound, runout: { axial_offsets_in: [0, 0, 0.001, 0] } }).told, 'Compared with a tool without runout: tooth 3 +25.4 µm deeper.');
  assert.deepEqual(of({ ...sound, runout: { eccentricity_mm: 0.01 } }).data().rows.map(([, , out]) => out.toFixed(1)), ['10.0', '0.0', '-10.0', '-0.0']);
  assert.equal(of({ ...sound, runout: { eccentricity_mm: 0.01 } }).told, 'Compared with a tool without runout: tooth 1 +10 µm; tooth 3 −10 µm.');
  assert.equal(of({ tool: { ...sound.tool, teeth: 16 }, runout: { eccentricity_mm: 0.01, tilt_deg: 0.01 } }).told,
               'Compared with a tool without runout: −10 µm (tooth 9) to +10 µm (tooth 1); −0.698 µm (tooth 9) to +0.698 µm (tooth 1) deeper.');
  const texts = (given) => painted(of(given), 800).texts;
  assert.ok(['1', '4', 'a_p', 'from below,', 'offsets exaggerated', 'along the feed'].every((one) => texts(sound).includes(one)));
  assert.ok(!texts(sound).includes('depths exaggerated'));
  assert.ok(texts({ ...sound, runout: { tilt_deg: 0.01 } }).includes('depths exaggerated'));
  assert.ok(texts({ tool: sound.tool }).includes('from the side') && !texts({ tool: sound.tool }).includes('a_p'));
  for (const [change, what] of [[{ diameter_mm: 12 }, 'diameter'], [{ helix_deg: 20 }, 'helix'], [{ corner_radius_mm: 2 }, 'corner'],
                                [{ serration: { amplitude_in: 0.02, wavelength_in: 0.08 } }, 'serration']]) {
    assert.notDeepEqual(painted(of({ ...sound, tool: { ...sound.tool, ...change } }), 800), painted(of(sound), 800), what);
  }
  assert.notDeepEqual(painted(of({ ...sound, cut: { ...sound.cut, axial_depth_mm: 3 } }), 800), painted(of(sound), 800));
  for (const shape of ['cylinder', 'ball', 'taper', 'apt']) {
    for (const width of [360, 800]) {
      const { places } = painted(of({ ...sound, tool: { ...sound.tool, shape, taper_deg: 10, corner_center_radius_mm: 3, corner_center_height_mm: 1,
                                                       bottom_angle_deg: 2 } }), width);
      const high = of(sound).height(width);
      assert.ok(places.every(([x, y]) => x >= 0 && x <= width && y >= 0 && y <= high), `${shape} within ${width} px`);
    }
  }
  const [light, dark] = colorsOfReports(root).split('@media');
  for (const name of asked) assert.ok(light.includes(`${name}: #`) && dark.includes(`${name}: #`), `${name} has two colours`);
  assert.ok(asked.size > 5);
});

test('what no case may hold is not drawn, and breaks nothing', () => {
  noPage();
  const draw = (given) => { const picture = toolPicture(tablesDrawn(given)); return picture && painted(picture, 800); };
  assert.ok(drawCut(sound) && draw(sound));
  assert.equal(drawCut({ ...sound, cut: undefined }), null, 'an NC program has no cut');
  for (const teeth of [7.25, 1e9, 65, 0, -3, NaN, '4', null]) {
    const given = { ...sound, tool: { ...sound.tool, teeth } };
    assert.equal(drawCut(given), null, `${teeth} teeth`);
    assert.equal(draw(given), null, `${teeth} teeth`);
  }
  assert.equal(draw({ ...sound, tool: { ...sound.tool, corner_radius_mm: 12 } }), null);  // more than the radius
  const odd = [7.25, 1e9, 1e308, -1, 0, NaN, Infinity, '', 'x', true, null, [], [1, 'a'], [1e9, -1e9], {}];
  const schema = JSON.parse(fs.readFileSync(`${root}/docs/formats/case.schema.json`, 'utf8'));
  for (const table of ['tool', 'runout', 'cut']) {
    for (const key of Object.keys(schema.properties[table].properties)) {
      for (const value of odd) {
        const given = { ...sound, [table]: { ...sound[table], [key]: value } };
        assert.doesNotThrow(() => [drawCut(given), draw(given)], `${table}.${key} = ${JSON.stringify(value)}`);
      }
    }
  }
  for (const given of [{}, { tool: 3 }, { tool: sound.tool }, { cut: [], tool: [] }, { ...sound, runout: 'x' },
                       { ...sound, tool: { ...sound.tool, diameter_mm: undefined } }]) {
    assert.doesNotThrow(() => [drawCut(given), draw(given)]);
  }
});
