// A case file as text: keys are read by the reader of TOML, and changed in place, so that
// comments and order stay as they are.
'use strict';

const header = /^\s*\[(\[)?\s*([A-Za-z_][\w.]*)\s*\]\]?\s*(#.*)?$/;

/** Tables of a text: name, which of its name (from 1; 0 for no list), lines from..to. */
function tablesOf(text) {
  const all = text.split('\n');
  const tables = [{ name: '', entry: 0, from: 0, to: all.length, lines: all }];
  const count = {};
  all.forEach((line, i) => {
    const match = header.exec(line);
    if (!match) return;
    const list = match[1] !== undefined;
    count[match[2]] = (count[match[2]] ?? 0) + 1;
    tables.at(-1).to = i;
    tables.push({ name: match[2], entry: list ? count[match[2]] : 0, from: i, to: all.length });
  });
  return tables;
}

/** How many lines a value takes that begins in lines[i]: brackets are closed in the last. */
function linesOfValue(lines, i) {
  let depth = 0;
  for (let n = i; n < lines.length; ++n) {
    const bare = lines[n].replace(/"(\\.|[^"\\])*"|'[^']*'/g, '""').replace(/#.*/, '');
    for (const c of bare) depth += '[{'.includes(c) ? 1 : ']}'.includes(c) ? -1 : 0;
    if (depth <= 0) return n - i + 1;
  }
  return 1;
}

const literally = (text) => text.replace(/[.*+?^${}()|[\]\\]/g, '\\$&');
const keyLine = (key) => new RegExp(`^(\\s*)${literally(key)}(\\s*)=`);
const keyComment = (key) => new RegExp(`^#\\s*${literally(key)}(\\s*)=`);

/** The comment behind a value on one line, with what is before it. */
function commentOf(line) {
  const bare = line.replace(/"(\\.|[^"\\])*"|'[^']*'/g, (s) => '"'.repeat(s.length));
  const at = bare.indexOf('#');
  return at < 0 ? '' : line.slice(at);
}

function lineOf(key, value, old) {
  const comment = old === undefined ? '' : commentOf(old.replace(/^#\s*/, ''));
  const text = `${key} = ${value}`;
  return comment === '' ? text : `${text.padEnd(Math.max(33, text.length))} ${comment}`;
}

/**
 * The text with a key set.
 * @param path  of the table: 'tool', 'measurement[2]', '' for the top
 * @param value as TOML writes it; null: the key is left out
 */
function withKey(text, path, key, value) {
  const [, name, entry] = /^([\w.]*)(?:\[(\d+)\])?$/.exec(path);
  const lines = text.split('\n');
  const table = tablesOf(text).find(
    (t) => t.name === name && t.entry === (entry === undefined ? 0 : Number(entry)));
  if (table === undefined) {
    if (value === null) return text;
    const head = entry === undefined ? `[${name}]` : `[[${name}]]`;
    return `${text.replace(/\n*$/, '\n')}\n${head}\n${key} = ${value}\n`;
  }
  const within = (pattern) => {
    for (let i = table.from; i < table.to; ++i) if (pattern.test(lines[i])) return i;
    return -1;
  };
  const at = within(keyLine(key));
  if (at >= 0) {
    const count = linesOfValue(lines, at);
    const last = lines[at + count - 1];
    const fresh = value === null ? [`# ${lines[at]}`] : [lineOf(key, value, count === 1 ? last : '')];
    lines.splice(at, count, ...fresh);
    return lines.join('\n');
  }
  if (value === null) return text;
  const comment = within(keyComment(key));
  if (comment >= 0) {
    lines.splice(comment, 1, lineOf(key, value, lines[comment]));
  } else {
    let end = table.to;
    while (end > table.from + 1 && /^\s*(#.*)?$/.test(lines[end - 1])) --end;
    lines.splice(Math.max(end, table.from + (table.name === '' ? 0 : 1)), 0, `${key} = ${value}`);
  }
  return lines.join('\n');
}

/** The text without a table; an entry of a list by its number. */
function withoutTable(text, path) {
  const [, name, entry] = /^([\w.]*)(?:\[(\d+)\])?$/.exec(path);
  const table = tablesOf(text).find(
    (t) => t.name === name && t.entry === (entry === undefined ? 0 : Number(entry)));
  if (table === undefined) return text;
  const lines = text.split('\n');
  lines.splice(table.from, table.to - table.from);
  return lines.join('\n');
}

/** A text with the table [tool] of another one, where both have it. */
function withToolOf(text, other) {
  const [mine, theirs] = [text, other].map((one) => tablesOf(one).find(({ name }) => name === 'tool'));
  if (mine === undefined || theirs === undefined) return text;
  const lines = other.split('\n').slice(theirs.from, theirs.to);
  while (/^\s*(#.*)?$/.test(lines.at(-1))) lines.pop();  // words about the next table
  const all = text.split('\n');
  let end = mine.to;
  while (/^\s*(#.*)?$/.test(all[end - 1])) --end;
  all.splice(mine.from, end - mine.from, ...lines);
  return all.join('\n');
}

/** A key as TOML writes it: `teeth`, `"cut.spindle_rpm"`. */
const keyOf = (key) => (/^[\w-]+$/.test(key) ? key : JSON.stringify(key));

/** A value as TOML writes it. */
function tomlOf(value) {
  if (typeof value === 'string') return JSON.stringify(value);
  if (Array.isArray(value)) return `[${value.map(tomlOf).join(', ')}]`;
  if (value !== null && typeof value === 'object') {
    return `{ ${Object.entries(value).map(([key, of]) => `${keyOf(key)} = ${tomlOf(of)}`).join(', ')} }`;
  }
  return String(value);
}

if (typeof module !== 'undefined') {
  module.exports = { tablesOf, withKey, withoutTable, withToolOf, tomlOf, keyOf };
}
