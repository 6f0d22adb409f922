// What is dropped on the page: a case, a file that a case names, or one that takes the place of a missing file.
'use strict';

const baseOf = (path) => path.split('/').at(-1);
const isToml = (name) => /\.toml$/i.test(name);
const isRecord = (name) => /\.(csv|tsv|mat|h5|hdf5|tdms|npy|npz)$/i.test(name);

/** All texts of a table, however deep. */
function textsIn(value) {
  if (typeof value === 'string') return [value];
  return value !== null && typeof value === 'object' ? Object.values(value).flatMap(textsIn) : [];
}

const textsOfCase = (bytes) => textsIn(given(utf8Text.decode(bytes)) ?? {});

/** The texts of all cases on the page: names of files are among them. */
const textsOnPage = () => [page.text, ...[...page.files].filter(([name]) => isToml(name)).map(([, bytes]) => utf8Text.decode(bytes))]
  .flatMap((text) => textsIn(given(text) ?? {}));

/** The files that cases name and that are not there. */
const missingFiles = () => textsOnPage().filter((text) => text !== page.name && !page.files.has(text));

/** Which of the files that came is the case; undefined: none. The others of its kind are files that a case names. */
function caseAmong(arrived) {
  const missing = new Set(missingFiles().map(baseOf));
  const cases = arrived.filter(([name]) => isToml(name) && !/^(material|modes|actuator|truth)/.test(name) && !missing.has(name));
  const included = (name) => arrived.some(([other, bytes]) => other !== name && isToml(other) && textsOfCase(bytes).map(baseOf).includes(name));
  return cases.filter(([name]) => !included(name)).at(-1);
}

/** The keys that may name a file of this name: [path of the table, its values]. */
function placesFor(name, read) {
  const lists = ['measurement', 'surface_measurement', 'measured_frf']
    .flatMap((table) => (read[table] ?? []).map((entry, i) => [`${table}[${i + 1}]`, entry]));
  const single = ['frf', 'step'].map((table) => [table, read[table]]);
  if (page.task !== 'program' || isRecord(name)) return [...lists.filter(([path]) => tablesOfTask().includes(path.split('[')[0])), ...single];
  const table = /\.stl$/i.test(name) ? 'stock' : 'program';
  return [[table, read[table]]];
}

/** What nothing names takes the place of a file that is not there. */
function nameFile(name) {
  const place = placesFor(name, given() ?? {}).find(([, values]) => values?.file !== undefined && !page.files.has(values.file));
  if (place !== undefined) take(withKey(page.text, place[0], 'file', JSON.stringify(name)));
}

function keepFile(name, bytes) {
  page.files.set(name, bytes);
  keptFiles.put(name, bytes);
}

function forgetFile(name) {
  page.files.delete(name);
  keptFiles.forget(name);
}

/** The files that came get the names that cases have for them: `../materials/steel.toml` for `steel.toml`. */
function nameFiles(files) {
  const missing = missingFiles();
  const named = new Set(textsOnPage());
  for (const [name, bytes] of files.filter(([one]) => !named.has(one))) {
    const places = missing.filter((text) => baseOf(text) === name);
    for (const place of places) keepFile(place, bytes);
    if (places.length === 0) nameFile(name);
    else forgetFile(name);
  }
}

async function dropped(list) {
  const arrived = await Promise.all([...list].map(async (file) => [file.name, new Uint8Array(await file.arrayBuffer())]));
  const chosen = caseAmong(arrived);
  if (chosen !== undefined) {
    Object.assign(page, { name: chosen[0], example: undefined, opened: new Set(openedAtFirst) });
    take(utf8Text.decode(chosen[1]));
  }
  const files = arrived.filter((one) => one !== chosen);
  for (const [name, bytes] of files) keepFile(name, bytes);
  nameFiles(files);
  showFiles();
  showForm();
  check();
}

if (typeof module !== 'undefined') module.exports = { baseOf };
