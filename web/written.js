// The program that an answer of [feed] wrote, as the next case: before and after can be compared.
'use strict';

/** What belongs to the old program leaves a case: its feeds, its record, and places by its lines. */
function withoutOld(text, read) {
  let rest = withKey(withoutTable(text, 'feed'), '', 'feed', null);  // a table, or one line
  for (let i = read.measurement?.length ?? 0; i > 0; --i) rest = withoutTable(rest, `measurement[${i}]`);
  return withKey(rest, 'program', 'places', null);
}

/**
 * The case of the written program: the one that wrote it with another [program] file and without [feed].
 * @param name, text of the case that was answered, files of its answer
 * @param read  the reader of a case; null: it is no TOML
 * @returns name, text, and the file with its bytes; undefined: no program was written, or the case cannot be changed so
 */
function writtenCase({ name, text, files }, read) {
  const before = read(text);
  const bytes = files[before?.feed?.write];
  if (bytes === undefined) return undefined;
  const stem = name.replace(/\.toml$/, '');
  const named = `${baseOf(stem)}_written/${before.feed.write}`;  // beside the case, not in its folder of results: that is replaced as a whole
  let after = withKey(withoutOld(text, before), 'program', 'file', JSON.stringify(named));
  if (typeof before.title === 'string') after = withKey(after, '', 'title', JSON.stringify(`${before.title} (${before.feed.write})`));
  const taken = read(after);
  if (taken === null || taken.feed !== undefined || taken.measurement !== undefined || taken.program?.file !== named) return undefined;
  return { name: `${stem}_written.toml`, text: after, file: `${stem}_written/${before.feed.write}`, bytes };
}

/** The written program with its case becomes the case of the page, and is computed. */
async function computeWritten() {
  const { answered, written } = page.answer;
  const mine = ++page.turns;
  page.drafts[page.task] = draft();
  const left = page.drafts.program?.name === answered.name ? page.drafts.program : answered;  // it may have been edited since
  page.drafts.before = { ...left, printed: $('printed').textContent, next: written.name };
  keepFile(written.file, written.bytes);
  await comeBack('program', { ...written, example: answered.example }, mine);
  if (mine !== page.turns) return;  // something else was chosen meanwhile
  await run();
}

/** The case that wrote the program, to change its limits. */
const backToBefore = () => comeBack('program', page.drafts.before, ++page.turns);

/** What an answer offers next: its written program, or the case before where this is the answer of such a program. */
function showWritten() {
  const { answered, files } = page.answer;
  const isProgram = answered.task === 'program';
  page.answer.written = isProgram ? writtenCase({ ...answered, files }, given) : undefined;
  $('written').hidden = page.answer.written === undefined;
  const before = isProgram && page.drafts.before?.next === answered.name ? page.drafts.before : undefined;
  $('back').hidden = $('before').hidden = before === undefined;
  $('printed-before').textContent = before?.printed ?? '';
}

if (typeof module !== 'undefined') module.exports = { writtenCase };
