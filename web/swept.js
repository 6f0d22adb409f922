// The keys of [sweep.over] in the form: values as a person writes them.
'use strict';

const numberText = '([-+]?(?:\\d+(?:[.,]\\d+)?|[.,]\\d+)(?:e[-+]?\\d+)?)';
const evenText = new RegExp(`^${numberText}\\s*(?:\\.\\.+|…|to)\\s*${numberText}(?:(?:\\s+in\\s+|\\s*[x×]\\s*|[,;]\\s+|\\s*;\\s*)(\\d+))?$`, 'i');
const normalText = new RegExp(`^${numberText}\\s*(?:±|\\+-|\\+/-)\\s*${numberText}$`, 'i');
const point = (text) => text.replace(',', '.');

/** `5000 .. 15000, 21`, `1, 2, 5`, `922 ± 9` as TOML writes them; other TOML as it is; null: nothing. */
function valuesTyped(text) {
  const value = text.trim();
  if (value === '') return null;
  if (value.startsWith('{')) return value;
  if (value.startsWith('[')) return `{ values = ${value} }`;
  const even = evenText.exec(value);
  if (even) {
    const [, from, to, count] = even;
    return `{ from = ${point(from)}, to = ${point(to)}${count === undefined ? '' : `, count = ${count}`} }`;
  }
  const normal = normalText.exec(value);
  if (normal) return `{ mean = ${point(normal[1])}, sd = ${point(normal[2])} }`;
  const { numbers, unclear } = numbersTyped(value);
  if (numbers !== undefined) return `{ values = [${numbers.join(', ')}] }`;
  if (unclear !== undefined) return `{ values = ${JSON.stringify(value)} }`;  // no list: the program refuses it
  const parts = value.split(value.includes(';') ? ';' : ',').map((one) => one.trim());
  const toml = (one) => (/^(true|false|["'].*)$/.test(one) ? one : numberTyped(one) ?? JSON.stringify(one));
  return `{ values = [${parts.filter((one) => one !== '').map(toml).join(', ')}] }`;
}

/** The same, as the form shows it. */
function valuesShown(value) {
  if (value?.from !== undefined && value.to !== undefined) {
    return `${value.from} .. ${value.to}${value.count === undefined ? '' : `, ${value.count}`}`;
  }
  if (Array.isArray(value?.values)) return value.values.map((one) => (typeof one === 'string' && /[,;'"]/.test(one) ? JSON.stringify(one) : String(one))).join(', ');
  if (typeof value?.values === 'string') return value.values;
  if (value?.mean !== undefined && value.sd !== undefined) return `${value.mean} ± ${value.sd}`;
  return value === undefined ? '' : tomlOf(value);
}

/** Keys of a case that hold one number: `cut.spindle_rpm`, `mode[1].frequency_Hz`. */
function numbersOf(given) {
  const within = (table, path) => Object.entries(table)
    .filter(([, value]) => typeof value === 'number').map(([key]) => `${path}.${key}`);
  return Object.entries(given).filter(([name]) => name !== 'sweep').flatMap(([name, value]) => {
    if (Array.isArray(value)) return value.flatMap((entry, i) => (typeof entry === 'object' ? within(entry, `${name}[${i + 1}]`) : []));
    return value !== null && typeof value === 'object' ? within(value, name) : [];
  });
}

/** The text of a case with the values of a swept key; null: the key is left out. */
function withSwept(text, given, key, values) {
  const inline = given?.sweep?.over !== undefined && !tablesOf(text).some(({ name }) => name === 'sweep.over');
  if (!inline) return withKey(text, 'sweep.over', keyOf(key), values);
  const rest = Object.entries(given.sweep.over).map(([one, old]) => [one, one === key ? values : tomlOf(old)]);
  if (!(key in given.sweep.over)) rest.push([key, values]);
  const kept = rest.filter(([, value]) => value !== null).map(([one, value]) => `${keyOf(one)} = ${value}`);
  return withKey(text, 'sweep', 'over', kept.length === 0 ? null : `{ ${kept.join(', ')} }`);
}

/** What is swept: a line for each key, and one to add another. */
function sweptPart({ given, sweep }) {
  const over = given.sweep?.over ?? {};
  const line = (key, i) => {
    const name = element('input', { id: `swept[${i}].key`, type: 'text', list: 'numbers-of-case', spellcheck: 'false', value: key,
                                    'aria-label': `Swept key ${i}`, placeholder: 'cut.spindle_rpm' });
    const values = element('input', { id: `swept[${i}].values`, type: 'text', spellcheck: 'false', 'aria-label': `Values of ${key || 'it'}`,
                                      value: valuesShown(over[key]), placeholder: '500 .. 1500, 21' });
    const set = () => {
      if (name.value.trim() !== '' && values.value.trim() !== '') sweep(key, name.value.trim(), valuesTyped(values.value));
      else if (key !== '') sweep(key, key, null);
    };
    name.addEventListener('change', set);
    values.addEventListener('change', set);
    const unclear = typeof over[key]?.values === 'string' ? numbersTyped(over[key].values).unclear : undefined;
    return element('div', { class: 'swept', 'data-key': `sweep.over.${key}`, 'data-unclear': unclear }, name, values, element('p', { class: 'mistake', role: 'alert', hidden: true }));
  };
  return element('div', { class: 'over' },
    element('p', { class: 'help' }, 'Keys and their values: 500 .. 1500, 21 (from, to, how many); 1, 2, 5 (these; with decimal commas 0,1; 0,2); '
      + '922 ± 9 (mean and standard deviation, for random and latin_hypercube).'),
    ...[...Object.keys(over), ''].map((key, i) => line(key, i + 1)),
    element('datalist', { id: 'numbers-of-case' }, ...numbersOf(given).map((value) => element('option', { value }))));
}

if (typeof module !== 'undefined') module.exports = { valuesTyped, valuesShown, numbersOf, withSwept };
