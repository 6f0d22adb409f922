// Numbers, names with units, and elements.

const missing = '–';
const isNumber = (x) => typeof x === 'number' && Number.isFinite(x);

/** A number for people: some significant digits, a true minus sign, no needless zeros. */
function number(x, digits = 4) {
  if (!isNumber(x)) return missing;
  if (x === 0) return '0';
  const size = Math.abs(x);
  let text;
  if (size >= 1e7 || size < 1e-4) {
    const [mantissa, exponent] = x.toExponential(digits - 1).split('e');
    text = `${trimmed(mantissa)} × 10${superscript(Number(exponent))}`;
  } else {
    const places = Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
    text = trimmed(x.toFixed(Math.min(places, 12)));
  }
  return text.replace('-', '−');
}

/** As many significant digits as asked for, zeros included: for columns of a table. */
function fixed(x, digits) {
  if (!isNumber(x) || Math.abs(x) >= 10 ** digits || Math.abs(x) < 1e-4) return number(x, digits);
  return x.toPrecision(digits).replace('-', '−');
}

const trimmed = (text) => (text.includes('.') ? text.replace(/\.?0+$/, '') : text);

function superscript(n) {
  return [...String(n)].map((c) => (c === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[c])).join('');
}

/** A measured value with the decimals that its interval justifies: two digits of the half. */
function measured(x, halfWidth) {
  if (!isNumber(x)) return missing;
  if (!isNumber(halfWidth) || halfWidth <= 0 || Math.abs(x) >= 1e7) return number(x);
  const places = 1 - Math.floor(Math.log10(halfWidth));
  return x.toFixed(Math.min(12, Math.max(0, places))).replace('-', '−');
}

const units = {
  N: 'N', mm: 'mm', um: 'µm', deg: '°', s: 's', Nm: 'N m', Nmm: 'N mm', W: 'W', MPa: 'MPa',
  GPa: 'GPa', rpm: 'rpm', Hz: 'Hz', kg: 'kg', mm2: 'mm²', mm3: 'mm³', percent: '%',
  N_per_mm: 'N/mm', N_per_m: 'N/m', Ns_per_m: 'N s/m', mm_per_min: 'mm/min', um_per_s: 'µm/s',
  per_kg: '1/kg', m_per_N: 'm/N', m_per_s_N: 'm/s/N', m_per_s2_N: 'm/s²/N',
  mm_rad: 'mm rad', mm3_per_rev: 'mm³/rev', mm2_per_rev: 'mm²/rev', N_per_s: 'N/s',
};

/** `K_te_N_per_mm` -> {name: 'K_te', unit: 'N/mm'}: the unit is the end of every name. */
function nameAndUnit(key) {
  if (key.endsWith('_se')) {
    const of = nameAndUnit(key.slice(0, -3));
    return { ...of, name: `${of.name}_se` };
  }
  const parts = key.split('_');
  for (let i = 1; i < parts.length; ++i) {
    const unit = units[parts.slice(i).join('_')];
    if (unit) return { name: parts.slice(0, i).join('_'), unit };
  }
  return { name: key, unit: '' };
}

const meanings = {
  K_tc: 'tangential, cutting', K_rc: 'radial, cutting', K_ac: 'axial, cutting',
  K_te: 'tangential, edge', K_re: 'radial, edge', K_ae: 'axial, edge',
  K_t1: 'tangential', K_r1: 'radial', K_a1: 'axial',
};

const chipModels = {
  none: 'no runout', feed: 'feed (simple)', radial: 'radial', trochoidal: 'trochoidal (exact)',
};
const modelName = (model) => chipModels[model] || model;

/** `K_tc` -> K with the subscript tc; `Fx` -> F with the subscript x. */
function symbol(name) {
  const found = /^([A-Za-z])_([A-Za-z0-9]+)$/.exec(name) || /^([FM])([xyz]{1,2})$/.exec(name);
  if (!found) return words(name);
  return el('span', { class: 'symbol' }, el('i', {}, found[1]), el('sub', {}, found[2]));
}

const labels = {
  spindle: 'spindle speed', stated: 'spindle speed, stated', files: 'measurements',
  removed: 'chips of all teeth', feed_times_width: 'feed × width of cut',
};
const words = (name) => (name.endsWith('_se') ? `${words(name.slice(0, -3))}, standard error` :
  labels[name] || name.replaceAll('_', ' '));
const sentence = (text) => text.charAt(0).toUpperCase() + text.slice(1);

function valueWithUnit(value, unit, digits) {
  if (!isNumber(value)) return missing;
  if (!unit) return number(value, digits);
  return number(value, digits) + (unit === '°' || unit === '%' ? '' : ' ') + unit;
}

/** An element with its attributes and children; functions among the attributes listen. */
function el(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [key, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(key, value);
    else if (value !== undefined && value !== false) element.setAttribute(key, value);
  }
  element.append(...children.flat(9).filter((child) => child !== null && child !== undefined));
  return element;
}

/** A section with a heading, an anchor and some prose; `short` names it in the contents. */
function section(id, heading, short, ...children) {
  return el('section', { id, 'data-short': short }, el('h2', {}, heading), ...children);
}

const prose = (...children) => el('p', {}, ...children);

/** Choice of one of several, as a row of buttons; nothing for a single one. */
function choice(label, options, chosen, onChange) {
  if (options.length < 2) return null;
  const buttons = options.map(({ value, text }) => el('button', {
    type: 'button',
    'aria-pressed': String(value === chosen),
    click: (event) => {
      for (const button of buttons) button.setAttribute('aria-pressed', 'false');
      event.currentTarget.setAttribute('aria-pressed', 'true');
      onChange(value);
    },
  }, text));
  return el('div', { class: 'choice', role: 'group', 'aria-label': label },
    el('span', {}, label), el('div', {}, buttons));
}

const manyColumns = 6;

/**
 * rows: arrays of cells; the first cell of a row is its head. On a narrow page a table with many columns
 * becomes a list: each cell says the name of its column.
 */
function table(head, rows, options = {}) {
  const many = head.length > manyColumns;
  const names = head.map((content) => textOf(content));
  const cell = (tag, content, i) => {
    const chosen = options.chosen === i ? 'chosen' : undefined;
    const scope = tag === 'th' ? (i === 0 ? 'row' : 'col') : undefined;
    return el(tag, { class: chosen, scope, 'data-label': many ? names[i] || undefined : undefined }, content);
  };
  const kinds = [options.class, many ? 'many' : null].filter(Boolean).join(' ');
  return el('div', { class: 'scroll' }, el('table', { class: kinds || undefined },
    names.some((name) => name !== '') ? el('thead', {}, el('tr', {}, head.map((content, i) => cell('th', content, i)))) : null,
    el('tbody', {}, rows.map((row) => el('tr', {},
      row.map((content, i) => cell(i === 0 ? 'th' : 'td', content, i)))))));
}
