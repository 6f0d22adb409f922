// Which case stands on the page: an example, a new one, or one that was left before.
'use strict';

/** The case of this task, to come back to. */
const draft = () => ({ text: page.text, name: page.name, example: page.example });

const openedAtFirst = ['tool', 'cut', 'measurement[1]', 'program', 'stock'];

function choose(task, text) {
  page.task = task;
  page.opened = new Set(openedAtFirst);
  document.querySelectorAll('#tasks input').forEach((input) => { input.checked = input.value === task; });
  const mine = Object.keys(page.examples).filter((name) => name.startsWith(`${task} `));
  $('example').replaceChildren(element('option', { value: '' }, 'an example …'),
    ...mine.map((name) => element('option', { value: name, selected: name === page.example }, name.slice(task.length + 1))));
  take(text);
}

/** The files of an example, and what it takes from the answers of others. */
async function filesOfExample(name) {
  const { files, first } = page.examples[name];
  const all = new Map(Object.entries(files).map(([path, base64]) => [path, Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))]));
  for (const { command, file, folder } of first ?? []) {
    say(`The example needs ${command} ${file} first. Working …`);
    const answer = await page.program.run('check', { args: [command, file, '-o', folder], files: Object.fromEntries(all), folder });
    for (const [path, bytes] of Object.entries(answer.files).filter(([one]) => one !== 'report.html')) all.set(`${folder}/${path}`, bytes);
  }
  if (first?.length > 0) say('Ready.');
  return all;
}

async function startExample(name) {
  const mine = ++page.turns;
  page.started = null;
  const files = await filesOfExample(name);
  if (mine !== page.turns) return;  // something else was chosen meanwhile
  keptFiles.forgetAll();
  Object.assign(page, { example: name, loaded: name, files, name: page.examples[name].file });
  const bytes = files.get(page.name);
  files.delete(page.name);
  showFiles();
  choose(name.split(' ')[0], utf8Text.decode(bytes));
  page.started = name;
}

/** A new case, with the tool of another text where that says one of its own. */
function fresh(task, from) {
  ++page.turns;
  page.name = 'case.toml';
  page.example = undefined;
  choose(task, from === undefined ? page.templates[task] : withToolOf(page.templates[task], from));
}

/** A case that was left, with the files of its example. @param mine the turn it is asked for in */
async function comeBack(task, left, mine) {
  if (page.examples[left.example] && left.example !== page.loaded) {
    const files = await filesOfExample(left.example);
    if (mine !== page.turns) return;
    for (const [path, bytes] of files) {
      page.files.set(path, bytes);
      keptFiles.forget(path);  // what was dropped under its name
    }
    page.loaded = left.example;
  }
  page.files.delete(left.name);
  Object.assign(page, { name: left.name, example: left.example });
  showFiles();
  choose(task, left.text);
}

/** Another task: its case as it was left, or a new one with the tool at hand. */
async function turnTo(task) {
  const mine = ++page.turns;
  const before = page.task;
  page.drafts[before] = draft();
  const left = page.drafts[task];
  if (left === undefined) fresh(task, page.text === page.templates[before] ? undefined : page.text);
  else await comeBack(task, left, mine);
}
