// The page: a task, its files, its case, the answer.
'use strict';

const toml = smolToml;
const tasks = {
  identify: ['Identify', 'coefficients and runout from measured forces'],
  simulate: ['Predict', 'chip, forces and torque of a cut'],
  program: ['NC program', 'forces line by line, and the feeds that keep your limits'],
  calibrate: ['Wall: calibrate', 'coefficients from a measured thin wall'],
  surface: ['Wall: predict', 'the error a cut leaves on a wall'],
  modes: ['Modes', 'of a tool from a measured response'],
  stability: ['Stability', 'does it chatter, and how deep may it cut'],
  dynamics: ['Vibration', 'the cut in the time domain'],
  correct: ['Runout correction', 'the motion of a table that undoes runout'],
  actuator: ['Actuator', 'its transfer function from a step'],
  plan: ['Plan', 'the cut to measure next'],
  sweep: ['Sweep', 'one case over many values of its keys'],
};
const sweepTemplate = `
[sweep]                           # one case over many values
command = "simulate"              # what answers each row
take = ["result.peak_xy_N"]       # what is taken from each answer
[sweep.over]
"cut.spindle_rpm" = { from = 500, to = 1500, count = 21 }
`;

const $ = (id) => document.getElementById(id);
const utf8 = new TextEncoder();
const utf8Text = new TextDecoder();
const page = {
  task: 'identify', text: '', name: 'case.toml', files: new Map(), opened: null, drafts: {},
  turns: 0, program: null, schema: null, examples: {}, templates: {}, answer: null, checks: 0,
};
const tool = toolView();
window.trochoidPage = page;  // for tests, and for who looks into it

function given(text = page.text) {
  try {
    return toml.parse(text);
  } catch {
    return null;  // the program says where
  }
}

function keep() {
  kept.write({ task: page.task, ...draft(), drafts: page.drafts, loaded: page.loaded, options: $('options').value });
}

/** The command that the case is checked for. */
function commandOfTask() {
  if (page.task !== 'sweep') return page.task;
  const wanted = given()?.sweep?.command;
  return tasks[wanted] && wanted !== 'sweep' ? wanted : 'simulate';
}

/** All files as the program meets them. */
function allFiles() {
  return { ...Object.fromEntries(page.files), [page.name]: utf8.encode(page.text) };
}

function tablesOfTask() {
  return [...new Set(tablesOf(page.templates[page.task] ?? '').map((t) => t.name).filter((n) => n !== ''))];
}

/** @param instead the key whose place it takes, if any */
function changed(path, key, value, instead) {
  const text = instead === undefined ? page.text : withKey(page.text, path, instead, null);
  return withKey(text, path, key, value);
}

/** What a text would draw if it were the case. What goes leaves its room, or the field would move under who types. */
function preview(text) {
  const read = given(text);
  if (read === null) return;
  const place = $('drawing');
  place.style.minHeight = `${place.getBoundingClientRect().height}px`;
  showDrawings(read);
}

/** A swept key under its name, which may be a new one. */
function sweep(before, key, values) {
  let text = page.text;
  if (before !== '' && before !== key) text = withSwept(text, given(), before, null);
  take(withSwept(text, toml.parse(text), key, values));
}

/** The case is this text now. */
function take(text) {
  page.text = text;
  if ($('text').value !== text) $('text').value = text;
  keep();
  showForm();
  check();
}

/** The form of another case from its beginning; that of the same case where it changed. */
function placeForm(form) {
  const old = $('form').firstElementChild;
  rememberFields(form);
  if (page.opened !== null || old === null) $('form').replaceChildren(form);
  else renew(old, form);
}

function showForm() {
  const read = given();
  $('form').classList.toggle('stale', read === null);
  if (read === null) return;
  const open = new Set([...document.querySelectorAll('#form details[open][data-table]')].map((d) => d.dataset.table));
  const focused = document.activeElement?.id;
  placeForm(caseForm({
    schema: page.schema, given: read, tables: tablesOfTask(), opened: page.opened ?? open, files: page.files, sweep,
    change: (...all) => take(changed(...all)), preview: (...all) => preview(changed(...all)),
    add: (name) => take(`${page.text.replace(/\n*$/, '\n')}\n[[${name}]]\n`),
    remove: (path) => take(withoutTable(page.text, path)),
  }));
  page.opened = null;
  $('drawing').style.minHeight = '';
  showDrawings(read);
  if (focused && document.activeElement.id !== focused) $(focused)?.focus();
}

function showDrawings(read) {
  const cut = drawCut(read);
  tool.element.hidden = !tool.show(read);
  $('drawing').replaceChildren(...[cut, tool.element].filter(Boolean));
}

function showFiles() {
  const names = [...page.files.keys()].filter((n) => n !== page.name).sort();
  $('files').replaceChildren(...names.map((name) => element('li', {}, name, ' ',
    element('button', { type: 'button', class: 'quiet', title: `Forget ${name}`,
                        onclick: () => { forgetFile(name); showFiles(); check(); } }, '×'))));
  $('files-dropped').replaceChildren(...names.map((value) => element('option', { value })));
}

/** What the program says of the case, at its fields. */
async function check() {
  const mine = ++page.checks;
  await new Promise((done) => setTimeout(done, 300));
  if (mine !== page.checks || page.program === null) return;
  let answer;
  try {
    answer = await page.program.run('check', {
      args: ['check', page.name, '--for', commandOfTask()], files: allFiles(), folder: 'none' });
  } catch (error) {
    $('state').textContent = `The program failed while it checked the case: ${error.message}`;
    return;
  }
  if (mine !== page.checks) return;
  const rest = showMistakes($('form'), answer.code === 0 ? [] : mistakesOf(answer.err));
  $('mistakes').replaceChildren(...rest.map(({ line }) => element('li', {}, line)));
  const isSound = answer.code === 0 && $('form').querySelector('[data-unclear]') === null;  // [sweep] is checked when it runs
  $('checked').textContent = isSound ? answer.out : '';
  $('state').textContent = isSound ? 'No mistakes found.'
    : `There are mistakes. ${rest.length === 0 ? 'Each one is shown at its field.' : 'Those without a field are listed here.'}`;
}

function say(text, kind = '') {
  $('said').textContent = text;
  $('said').className = kind;
}

async function run() {
  const answered = { task: page.task, ...draft() };
  const folder = `${page.name.replace(/\.toml$/, '')}.${page.task}`;
  const args = [page.task, page.name, '-o', folder,
                ...($('options').value.trim() === '' ? [] : $('options').value.trim().split(/\s+/))];
  $('run').disabled = $('written').disabled = true;
  $('stop').disabled = false;
  const begun = performance.now();
  const ticks = setInterval(() => { $('time').textContent = `${((performance.now() - begun) / 1000).toFixed(0)} s`; }, 500);
  say('Working …');
  try {
    const answer = await page.program.run('work', { args, files: allFiles(), folder }, (line) => say(line));
    show(answer, answered, folder, (performance.now() - begun) / 1000);
  } catch (error) {
    say(error.message === 'stopped' ? 'Stopped.' : `The program failed: ${error.message}`, 'bad');
  } finally {
    clearInterval(ticks);
    $('time').textContent = '';
    $('run').disabled = $('written').disabled = false;
    $('stop').disabled = true;
  }
}

function show(answer, answered, folder, seconds) {
  page.answer = { answered, folder, files: answer.files };
  showWritten();
  const names = Object.keys(answer.files).sort();
  const told = (answer.code === 2 || names.length === 0 ? answer.err || answer.out : answer.out).trim();
  say(`${answer.code === 0 ? 'Answered' : answer.code === 1 ? 'No good answer' : 'The input is wrong'} after ${seconds.toFixed(1)} s.`,
      answer.code === 0 ? 'good' : 'bad');
  $('printed').textContent = told;
  $('downloads').replaceChildren(...names.map((name) => element('li', {},
    element('a', { href: '#', onclick: (e) => { e.preventDefault(); saveAs(new Blob([answer.files[name]]), name); } }, name))));
  for (const id of ['all', 'use']) $(id).hidden = names.length === 0;
  const report = answer.files['report.html'];
  $('report').hidden = report === undefined;
  if (report) $('report').srcdoc = utf8Text.decode(report);
  $('answer').hidden = false;
  $('answer').scrollIntoView({ behavior: 'smooth', block: 'start' });
}

/** What the next command may take from an answer, among the files: numbers, not pictures. */
function useAnswer() {
  for (const [name, bytes] of Object.entries(page.answer.files).filter(([one]) => /\.(toml|json)$/.test(one))) {
    keepFile(`${page.answer.folder}/${name}`, bytes);
  }
  showFiles();
  check();
}

async function begin() {
  const missing = whatIsMissing();
  if (missing !== '') {
    say(missing, 'bad');
    return;
  }
  page.schema = JSON.parse($('schema').textContent);
  const [wasm, examples] = await Promise.all(['wasm', 'examples'].map((id) => inflated($(id).textContent.trim())));
  page.examples = JSON.parse(utf8Text.decode(examples));
  page.program = new Program(`${$('glue').textContent}\n${$('engine').textContent}`, await WebAssembly.compile(wasm));
  for (const task of Object.keys(tasks).filter((one) => one !== 'sweep')) {
    page.templates[task] = (await page.program.run('check', { args: ['new', task], files: {}, folder: 'none' })).out;
  }
  page.templates.sweep = page.templates.simulate + sweepTemplate;
  const before = kept.read();
  const dropped = await keptFiles.read();
  const loaded = before?.loaded ?? before?.example;
  if (page.examples[loaded]) await startExample(loaded);
  page.drafts = before?.drafts ?? {};
  for (const [name, bytes] of dropped) {
    page.files.set(name, bytes);
    keptFiles.put(name, bytes);  // the example forgot it
  }
  $('options').value = before?.options ?? '';
  showFiles();
  if (before?.text && tasks[before.task]) {
    page.name = before.name ?? 'case.toml';
    page.example = before.example;
    choose(before.task, before.text);
  } else {
    fresh('identify');
  }
  document.body.classList.add('ready');
  say('Ready. Nothing leaves this computer.');
}

$('tasks').replaceChildren(...Object.entries(tasks).map(([task, [title, about]]) => element('label', { class: 'task' },
  element('input', { type: 'radio', name: 'task', value: task, onchange: () => turnTo(task) }),
  element('strong', {}, title), element('span', {}, about))));
$('anew').addEventListener('click', () => fresh(page.task));
$('text').addEventListener('change', () => take($('text').value));
$('text').addEventListener('input', () => preview($('text').value));
$('example').addEventListener('change', (e) => { if (e.target.value !== '') startExample(e.target.value); });
$('run').addEventListener('click', run);
$('stop').addEventListener('click', () => page.program.stop('work'));
$('pick').addEventListener('change', (e) => dropped(e.target.files));
$('all').addEventListener('click', () => saveAs(zipOf(page.answer.files), `${page.answer.folder}.zip`));
$('use').addEventListener('click', useAnswer);
$('written').addEventListener('click', computeWritten);
$('back').addEventListener('click', backToBefore);
$('options').addEventListener('change', keep);
addEventListener('pagehide', () => document.activeElement?.blur());  // what is typed is taken when it is left
$('save-case').addEventListener('click', () => saveAs(new Blob([page.text], { type: 'application/toml' }), page.name));
for (const name of ['dragover', 'drop']) {
  document.addEventListener(name, (e) => {
    e.preventDefault();
    if (name === 'drop') dropped(e.dataTransfer.files);
  });
}
begin().catch((error) => say(`The page could not start: ${error.message}`, 'bad'));
