// The form of a case: its fields, units, ranges and help are those of the schema.
'use strict';

function element(name, attributes = {}, ...children) {
  const node = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) {
    if (key.startsWith('on')) node.addEventListener(key.slice(2), value);
    else if (value !== undefined && value !== false) node.setAttribute(key, value === true ? '' : value);
  }
  node.append(...children.filter((child) => child !== null && child !== undefined));
  return node;
}

/** The unit ends what is said of a key, before what is usual; other brackets are tables and lists. */
const unitText = /\s*\[([^[\]]+)\](?=$|; default)/;

const unitOf = (schema) => unitText.exec(schema.description ?? '')?.[1] ?? '';

const helpOf = (schema) => (schema.description ?? '').replace(unitText, '');

/** The range in words: `above 0, at most 64`. */
function rangeOf(schema) {
  const all = [];
  for (const one of formsOf(schema)) {
    if (one.minimum !== undefined) all.push(`from ${one.minimum}`);
    if (one.exclusiveMinimum !== undefined) all.push(`above ${one.exclusiveMinimum}`);
    if (one.maximum !== undefined) all.push(`at most ${one.maximum}`);
    if (one.exclusiveMaximum !== undefined) all.push(`below ${one.exclusiveMaximum}`);
  }
  return all.join(', ');
}

const isFile = (key) => key === 'file' || key === 'frf' || key === 'include' || key === 'command_file';

const shownValue = (value) =>
  value === undefined ? '' : typeof value === 'string' ? value : tomlOf(value);

/**
 * One key: label, input, unit and help.
 * @param twin    the same key in the other of mm and inches, where there is one
 * @param preview what change would do, while a person still types
 */
function field({ path, key, twin, schema, value, needed, files, change, preview }) {
  const id = `${path}.${key}`;
  const choices = formsOf(schema).length === 1 ? schema.enum : undefined;
  const inInches = twin !== undefined && /_mm(?=$|_)/.test(twin);
  const set = (entered, to) => {
    const { text, unit } = twin === undefined ? { text: entered } : withUnit(entered);
    const other = unit !== undefined && (unit === 'in') !== inInches;
    to(path, other ? twin : key, typed(text, schema), other ? key : undefined);
  };
  let input;
  if (choices) {
    input = element('select', { id, onchange: (e) => change(path, key, e.target.value === '' ? null : JSON.stringify(e.target.value)) },
      element('option', { value: '' }, schema.default === undefined ? '' : `${schema.default} (usual)`),
      ...choices.map((c) => element('option', { value: c, selected: c === value }, c)));
  } else if (schema.type === 'boolean') {
    input = element('input', { id, type: 'checkbox', checked: value === true,
                               onchange: (e) => change(path, key, String(e.target.checked)) });
  } else {
    const list = isFile(key) ? 'files-dropped' : undefined;
    const usual = schema.default === undefined ? '' : shownValue(schema.default);
    input = element('input', { id, type: 'text', list, spellcheck: 'false', value: shownValue(value),
                               inputmode: (schema.type === 'number' && !twin) || schema.type === 'integer' ? 'decimal' : undefined,
                               placeholder: usual, onchange: (e) => set(e.target.value, change),
                               oninput: (e) => set(e.target.value, preview) });
    if (isFile(key) && value !== undefined && !files.has(value)) input.classList.add('no-file');
  }
  const range = inInches ? '' : rangeOf(schema);
  const unit = inInches ? unitOf(schema).replace('mm', 'in') : unitOf(schema);
  const inches = twin === undefined ? '' : inInches ? '; "8 mm" is mm' : '; "0.5 in" is inches';
  input.setAttribute('aria-describedby', `${id}.help`);
  return element('div', { class: `field${needed ? ' needed' : ''}${value === undefined ? ' unset' : ''}`, 'data-key': id,
                          'data-unclear': unclearList(value, schema) },
    element('label', { for: id }, key),
    element('span', { class: 'input' }, input, element('span', { class: 'unit' }, unit)),
    element('p', { class: 'help', id: `${id}.help` }, helpOf(schema) + (range ? ` (${range})` : '') + inches),
    element('p', { class: 'mistake', role: 'alert', hidden: true }));
}

/** A table of the case, or one entry of a list of them. */
function tablePart({ name, path, schema, values, open, listed, ...rest }) {
  const keys = Object.entries(schema.properties)
    .filter(([, s]) => s.type !== 'object' || (s.description && s.properties))
    .map(([key, s]) => {
      const inches = inchKeyOf(key, schema);
      const usesInches = inches !== undefined && values[inches] !== undefined;
      return usesInches ? [inches, s, key] : [key, s, inches];
    });
  const needed = new Set(schema.required ?? []);
  const isSet = ([key, , twin]) => values[key] !== undefined || needed.has(key) || needed.has(twin);
  const make = ([key, s, twin]) => field({ path, key, twin, schema: s, value: values[key], needed: needed.has(key) || needed.has(twin), ...rest });
  const others = keys.filter((k) => !isSet(k));
  return element('details', { class: 'table', open, 'data-table': path },
    element('summary', {}, element('code', {}, listed ? `[[${name}]]` : `[${name}]`), ' ',
      element('span', { class: 'about' }, schema.description ?? ''),
      listed ? element('button', { type: 'button', class: 'quiet', title: 'Leave this entry out',
                                   onclick: (e) => { e.preventDefault(); rest.remove(path); } }, 'remove') : null),
    ...keys.filter(isSet).map(make),
    name === 'sweep' ? sweptPart(rest) : null,
    others.length === 0 ? null
      : element('details', { class: 'more' }, element('summary', {}, `${others.length} more keys`), ...others.map(make)));
}

/**
 * The form of a case.
 * @param schema the JSON Schema of the case file
 * @param given  the case, as read
 * @param tables names of the tables to show although they are not there
 * @param opened paths of the tables that are open; all: null
 */
function caseForm({ schema, given, tables, opened, ...rest }) {
  const form = element('div', { class: 'form' });
  const isOpen = (path) => opened === null || opened.has(path);
  for (const [name, s] of Object.entries(schema.properties)) {
    const value = given[name];
    const list = s.type === 'array' && s.items?.properties;
    if (s.properties && (value !== undefined || tables.includes(name))) {
      form.append(tablePart({ name, path: name, schema: s, values: value ?? {}, open: isOpen(name), given, ...rest }));
    } else if (list && (value !== undefined || tables.includes(name))) {
      (Array.isArray(value) ? value : []).forEach((entry, i) => {
        const path = `${name}[${i + 1}]`;
        form.append(tablePart({ name, path, schema: { description: s.description, ...s.items }, values: entry,
                                open: isOpen(path), listed: true, ...rest }));
      });
      form.append(element('button', { type: 'button', class: 'quiet', onclick: () => rest.add(name) }, `add [[${name}]]`));
    }
  }
  return form;
}

/** Mistakes as the program says them: `file:line:col: tool.teeth = 0: why`. */
function mistakesOf(text) {
  return text.split('\n').filter((line) => line !== '').map((line) => {
    const match = /^(.*?):(\d+):(\d+): \[?([A-Za-z_][\w.[\]]*?)\]?(?= |:|$)/.exec(line);
    const path = match?.[4].replace(/\[(\d+)\]$/, '[$1]');
    return { line, path, row: match ? Number(match[2]) : undefined,
             text: match ? line.slice(line.indexOf(':', match[1].length + 1 + match[2].length) + match[3].length + 3) : line };
  });
}

/** What is wrong with a field or a table, at its place. */
function tellAt(form, place, text) {
  const said = place.querySelector('.mistake');
  said.textContent = text;
  said.hidden = false;
  place.classList.add('wrong');
  for (let up = place.parentElement; up !== form; up = up.parentElement) up.open = true;
}

/** Each mistake at its field, or at its table; unclear lists in the form's words. @returns those that have no place */
function showMistakes(form, mistakes) {
  for (const node of form.querySelectorAll('.mistake')) { node.hidden = true; node.textContent = ''; }
  form.querySelectorAll('.wrong').forEach((node) => node.classList.remove('wrong'));
  form.querySelectorAll('[data-unclear]').forEach((place) => tellAt(form, place, place.dataset.unclear));
  const placeOf = (path) => form.querySelector(`[data-key="${CSS.escape(path)}"], [data-key="${path}"]`);
  return mistakes.filter(({ path, text }) => {
    const place = path && (placeOf(path) ?? placeOf(path.replace(/_mm(?=$|_)/, '_in')));  // the program speaks of mm
    if (!place) return true;
    if (place.dataset.unclear === undefined) tellAt(form, place, text);
    return false;
  });
}

if (typeof module !== 'undefined') {
  module.exports = { mistakesOf, rangeOf, unitOf, helpOf };
}
