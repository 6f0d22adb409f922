#!/usr/bin/env node
// The pictures of docs/gallery.md, made by the examples: runs them with the program of
// build/release and photographs their pages. Needs Chromium, which ./test installs, and ImageMagick.
//   node tools/gallery.mjs [NAME ...]    only these
//   node tools/gallery.mjs --check       whether the page is as this would write it, and its pictures are there
import { execFileSync } from 'node:child_process';
import fs from 'node:fs';
import { createRequire } from 'node:module';
import os from 'node:os';
import path from 'node:path';
import { fileURLToPath, pathToFileURL } from 'node:url';

const root = path.dirname(path.dirname(fileURLToPath(import.meta.url)));
const pictures = path.join(root, 'docs/pictures/gallery');
const program = path.join(root, 'build/release/src/trochoid/cli/trochoid');
const width = 1040;

// name: [command, file of an example, what is asked, from which part of the page the picture is,
// its height]; without a part it is the first screen.
const shown = {
  identify: ['identify', 'st52_slot/case.toml', 'Which coefficients and which runout does a force record tell, and how well?', '', 1060],
  identify_ringing: ['identify', 'ringing_dynamometer/case.toml', 'What if the dynamometer rings?', '#overview', 650],
  simulate: ['simulate', 'ball/case.toml', 'Which forces does a cut make?', '', 1060],
  chip: ['simulate', 'up_milling_runout/case.toml', 'What does runout do to the chip of each tooth?', '#chip', 740],
  plan: ['plan', 'plan_next_cut/case.toml', 'Which cut tells most next?', '', 980],
  surface: ['surface', 'thin_wall_2mm_4mm/case.toml', 'Which error does a cut leave on a thin wall?', '#map', 700],
  bent: ['surface', 'thin_wall_2mm_4mm/case.toml', 'How do cutter and wall bend?', '#bent', 690],
  calibrate: ['calibrate', 'thin_wall_calibrate/case.toml', 'Which coefficients does a measured wall tell?', '', 1000],
  modes: ['modes', 'tap_test/hammer.csv', 'Which modes does a tap test show?', '', 1060],
  stability: ['stability', 'stability_922Hz/case.toml', 'How deep may it cut, and at which speed deeper?', '', 1280],
  dynamics: ['dynamics', 'runout_table_8mm/sine.toml', 'What does a cut with runout do to tool and table?', '', 1240],
  correct: ['correct', 'runout_correction/case.toml', 'How does a table take the runout away?', '#flutes', 620],
  correct_speeds: ['correct', 'runout_correction/case.toml', 'Up to which speed?', '#speeds', 850],
  sweep: ['sweep', 'uncertain_stability/case.toml', 'What is the limit depth with what is not known of the tool?', '', 800],
};
const before = { sweep: ['modes', 'uncertain_stability/tip.toml'] };
const browserPage = 'The same without installing anything: the page for browsers';

function page() {
  const part = ([name, [command, file, question]]) => `## ${question}

\`./run ${command} examples/${file}\` ([its page](../examples/${file.split('/')[0]}/README.md))

![${question}](pictures/gallery/${name}.png)
`;
  return `# Gallery

Pages that the examples make, by \`tools/gallery.mjs\`. Each is one file that can be sent on: pictures zoom, are saved as SVG,
PNG, CSV or Excel, and tell their values.

${Object.entries(shown).map(part).join('\n')}
## ${browserPage}

\`./run web\` ([how](guide/browser.md))

![${browserPage}](pictures/gallery/browser.png)
`;
}

async function photograph(browser, url, to, { part, height, ready }) {
  const context = await browser.newContext({ viewport: { width, height: 900 } });
  const tab = await context.newPage();
  await tab.goto(url);
  await ready?.(tab);
  await tab.waitForTimeout(500);  // plots are drawn in the frames that follow
  const top = part ? await tab.$eval(part, (section) => section.getBoundingClientRect().top + scrollY - 24) : 0;
  const whole = await tab.evaluate(() => document.documentElement.scrollHeight);
  await tab.screenshot({ path: to, fullPage: true, clip: { x: 0, y: top, width, height: Math.min(height, whole - top) } });
  await context.close();
  execFileSync('mogrify', ['-dither', 'None', '-colors', '96', to]);  // a third of the size
}

async function make(names) {
  const { chromium } = createRequire(path.join(root, 'package.json'))('playwright-core');
  const browser = await chromium.launch({ executablePath: process.env.CHROMIUM || '/usr/bin/chromium-headless-shell',
                                          args: ['--no-sandbox', '--disable-dev-shm-usage'] });
  const place = fs.mkdtempSync(path.join(os.tmpdir(), 'gallery-'));
  fs.cpSync(path.join(root, 'examples'), place, { recursive: true, filter: (one) => !/\.(identify|modes|sweep)$/.test(one) });
  fs.mkdirSync(pictures, { recursive: true });
  const run = (...all) => execFileSync(program, all, { cwd: place, stdio: ['ignore', 'ignore', 'inherit'] });
  for (const name of names.filter((one) => one !== 'browser')) {
    const [command, file, , part, height] = shown[name];
    if (before[name]) run(...before[name], '-q');
    run(command, file, '-q', '-o', name);
    const url = pathToFileURL(path.join(place, name, 'report.html')).href;
    await photograph(browser, url, path.join(pictures, `${name}.png`), { part, height });
    if (name === 'identify') await photograph(browser, url, path.join(root, 'docs/pictures/report.png'), { height: 1830 });
  }
  const app = path.join(root, 'build/web/trochoid/index.html');
  if (names.includes('browser') && fs.existsSync(app)) {
    await photograph(browser, pathToFileURL(app).href, path.join(pictures, 'browser.png'),
                     { height: 1330, ready: async (tab) => {
                       await tab.waitForSelector('body.ready');
                       await tab.selectOption('#example', 'identify st52_slot/case.toml');
                       await tab.waitForFunction(() => window.trochoidPage.started);
                     } });
  }
  await browser.close();
  fs.rmSync(place, { recursive: true });
}

const asked = process.argv.slice(2);
const file = path.join(root, 'docs/gallery.md');
if (asked[0] === '--check') {
  const missing = [...Object.keys(shown), 'browser'].filter((name) => !fs.existsSync(path.join(pictures, `${name}.png`)));
  if (missing.length > 0) console.log(`docs/pictures/gallery lacks ${missing.join(', ')}: tools/gallery.mjs makes them`);
  const same = fs.readFileSync(file, 'utf8') === page();
  if (!same) console.log('docs/gallery.md is not what tools/gallery.mjs writes');
  process.exit(missing.length > 0 || !same ? 1 : 0);
}
fs.writeFileSync(file, page());
await make(asked.length > 0 ? asked : [...Object.keys(shown), 'browser']);
