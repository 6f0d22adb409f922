// Lengths in inches: a case may have `diameter_in` in place of `diameter_mm`.
'use strict';

const mmPerInch = 25.4;

/** The key in inches, where the table takes one: `diameter_mm` -> `diameter_in`. */
function inchKeyOf(key, table) {
  const inches = key.replace(/_mm(?=$|_)/, '_in');
  const takes = Object.keys(table.patternProperties ?? {}).some((pattern) => new RegExp(pattern).test(inches));
  return inches !== key && takes ? inches : undefined;
}

const oneLength = /^(?:(\d+)\s+)?(\d+)\s*\/\s*(\d+)$/;

/** `3/8`, `1 1/4` as a decimal number; else the text as it is. */
function fraction(text) {
  const [, whole, over, under] = oneLength.exec(text.trim()) ?? [];
  return Number(under) > 0 ? String(Number(whole ?? 0) + Number(over) / Number(under)) : text;
}

/** What was typed into a length: its text without the unit, and which unit it has, if any. */
function withUnit(text) {
  const match = /^(.*?)\s*("|''|in|inch|inches|mm)$/.exec(text.trim());
  if (!match || match[1] === '' || /["']/.test(match[1])) return { text };
  return match[2] === 'mm' ? { text: match[1], unit: 'mm' } : { text: fraction(match[1]), unit: 'in' };
}

/** A table with its lengths in mm only. */
function inMm(table) {
  return Object.fromEntries(Object.entries(table ?? {}).map(([key, value]) => {
    const mm = key.replace(/_in(?=$|_)/, '_mm');
    const times = (one) => (typeof one === 'number' ? one * mmPerInch : one);
    return mm === key ? [key, value] : [mm, Array.isArray(value) ? value.map(times) : times(value)];
  }));
}

if (typeof module !== 'undefined') module.exports = { inchKeyOf, withUnit, inMm };
