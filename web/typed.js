// What is typed into a field, as TOML writes it.
'use strict';

/** The alternatives that a key of the schema has. */
const formsOf = (schema) => schema.anyOf ?? schema.oneOf ?? [schema];

const typeOf = (schema) => schema.type ?? typeof (schema.const ?? schema.enum?.[0]);

const isPlain = (value) => /^([-+]?\.?\d|\[|\{|(true|false)$|["'])/.test(value);

const oneNumber = /^[-+]?(?:\d+(?:[.,]\d*)?|[.,]\d+)(?:[eE][-+]?\d+)?$/;

/** A number, perhaps with a decimal comma, as TOML writes it; undefined: it is none. */
function numberTyped(text) {
  if (!oneNumber.test(text)) return undefined;
  return text.replace(',', '.').replace(/^([-+]?)\./, '$10.').replace(/\.(?!\d)/, '').replace(/^([-+]?)0+(?=\d)/, '$1');
}

function allNumbers(parts) {
  const numbers = parts.map(numberTyped);
  return numbers.includes(undefined) ? undefined : numbers;
}

/** The parts of a text in which only some commas separate numbers; undefined: it has no such reading. */
function decimalParts(text) {
  if (/,\s|\s,/.test(text)) return text.split(/\s*,\s+|\s+,\s*/);
  const digits = text.split(',');
  if (digits.length % 2 === 1) return undefined;
  return Array.from({ length: digits.length / 2 }, (_, i) => digits.slice(2 * i, 2 * i + 2).join(','));
}

/** Why a text of numbers and commas is not taken, with the ways to write what it may say. */
function unclearCommas(text) {
  const parts = decimalParts(text);
  const numbers = parts && allNumbers(parts);
  if (!numbers) return 'The commas can be read in two ways. Write a semicolon between numbers.';
  const separate = text.split(/[,\s]+/).join(', ');
  return `The commas can be read in two ways. Write ${separate} or ${numbers.length === 1 ? numbers[0] : parts.join('; ')}.`;
}

/**
 * A list of numbers with semicolons, commas or blanks between them.
 * @returns numbers as TOML writes them; unclear: why it may be two different lists; neither: it is no such list
 */
function numbersTyped(text) {
  const value = text.trim().replace(/\s*[;,]$/, '');
  if (text.includes(';')) return { numbers: allNumbers(value.split(';').map((one) => one.trim())) };
  if (!/^[-+\d.,eE\s]*$/.test(value)) return {};
  const [touching, apart] = [/\d,\d/, /,\s|\s,/].map((commas) => commas.test(value));
  if (!touching || (value.includes('.') && !/\s/.test(value))) {
    return { numbers: allNumbers(value.split(value.includes(',') ? /\s*,\s*/ : /\s+/)) };
  }
  const isClear = !apart && !value.includes('.') && /\s/.test(value);  // blanks separate, commas are decimal
  const numbers = isClear ? allNumbers(value.split(/\s+/)) : undefined;
  return numbers === undefined ? { unclear: unclearCommas(value) } : { numbers };
}

const isNumberList = (form) => form.type === 'array' && (form.items?.type === 'number' || form.items?.type === 'integer');

const isWritten = (value) => /^[["'{]/.test(value);  // as TOML

/** Why a text that stands for a list of numbers was not taken as one; undefined: it was, or is no such text. */
function unclearList(value, schema) {
  return typeof value === 'string' && !isWritten(value) && formsOf(schema).some(isNumberList) ? numbersTyped(value).unclear : undefined;
}

/** What was typed, as TOML writes it; null: nothing. Quotes and brackets may be left out. */
function typed(text, schema) {
  const value = text.trim();
  if (value === '') return null;
  const types = formsOf(schema).map(typeOf);
  if (types.every((t) => t === 'string')) return /^["']/.test(value) ? value : JSON.stringify(value);
  if (formsOf(schema).some(isNumberList) && !isWritten(value)) {
    const { numbers } = numbersTyped(value);
    if (numbers === undefined) return JSON.stringify(value);  // the program says what it must be
    return numbers.length === 1 && types.includes('number') ? numbers[0] : `[${numbers.join(', ')}]`;
  }
  if (types.includes('array') && value.includes(',') && !value.startsWith('[')) {
    return `[${value.split(',').map((one) => (isPlain(one.trim()) ? one.trim() : JSON.stringify(one.trim()))).join(', ')}]`;
  }
  if (types.includes('string') && !isPlain(value)) return JSON.stringify(value);
  return numberTyped(value) ?? value;
}

if (typeof module !== 'undefined') module.exports = { formsOf, typed, numberTyped, numbersTyped, unclearList };
