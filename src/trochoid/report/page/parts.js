// What the pages of several commands show.

const axesOfForce = ['x', 'y', 'z'];
const forceName = (axis) => [el('i', {}, 'F'), el('sub', {}, axis)];

const tableNamed = (report, file) => report.tables.find((t) => t.file === file);
const columnNamed = (t, name) => t?.columns.find((column) => column.name === name)?.values;
const isEmpty = (value) => value === null || value === undefined ||
  (typeof value === 'object' && Object.keys(value).length === 0);

/** How much of a table is drawn, where that is not all of it. */
function thinned(t) {
  if (!t || t.drawn >= t.rows) return '';
  return ` The picture shows ${t.drawn} of ${t.rows} rows, with the first ones and all extremes. ${t.file} has all rows.`;
}

/** The few numbers that matter most. list: {label, value, unit, note} */
function tiles(list) {
  const shown = list.filter((tile) => tile && tile.value !== undefined && tile.value !== null);
  if (!shown.length) return null;
  return el('div', { class: 'tiles' }, shown.map((tile) => el('div', { class: 'tile' },
    el('span', { class: 'label' }, tile.label),
    el('span', { class: 'value' }, isNumber(tile.value) ?
      number(tile.value) : tile.value, tile.unit ? el('small', {}, ` ${tile.unit}`) : null),
    tile.note ? el('span', { class: 'note' }, tile.note) : null)));
}

/** A value of summary.json in words. */
function shown(value, unit, digits = 6) {
  if (value === null || value === undefined) return missing;
  if (typeof value === 'boolean') return value ? 'yes' : 'no';
  if (typeof value === 'number') return valueWithUnit(value, unit, digits);
  if (typeof value === 'string') return value;
  if (Array.isArray(value)) {
    if (value.every((entry) => typeof entry !== 'object' || entry === null)) {
      const list = value.map((entry) => shown(entry, '', digits)).join(', ');
      return unit && value.length ? `${list} ${unit}` : list || 'none';
    }
    return el('ol', {}, value.map((entry) => el('li', {}, shown(entry, unit, digits))));
  }
  return described(value, unit);
}

/** Any object of summary.json as a list of names and values; `outer`: the unit around it. */
function described(object, outer = '') {
  return el('dl', {}, Object.entries(object).map(([key, value]) => {
    const { name, unit } = nameAndUnit(key);
    return el('div', {}, el('dt', {}, sentence(words(name))),
      el('dd', {}, shown(value, unit || outer, key.includes('_se') ? 2 : 6)));
  }));
}

/** Three panels of forces. curves(axis) gives the series of one axis. */
const forcePanels = (curves) => axesOfForce.map((axis) => ({
  label: forceName(axis), unit: 'N', series: curves(axis),
})).filter((panel) => panel.series.length);

const zoomHint = 'Drag or pinch to zoom; double-click or double-tap to see all.';

const placeOf = (height) => (height > 0 ? `${number(height)} mm above the tip` : 'at the tip');

/** h over theta, one curve a tooth; from chip_curve.csv, else from chip.csv. */
function chipSection(report, note) {
  const drawn = chipCurves(report);
  if (!drawn) return null;
  const um = drawn.curves.map((curve) => curve.values.map((h) => (isNumber(h) ? 1000 * h : null)));
  const chart = figure({
    key: 'theta', x: drawn.x, label: 'θ, immersion angle', unit: '°',
    caption: zoomHint + thinned(drawn.table),
  });
  const part = section('chip', 'Uncut chip thickness of each tooth', 'Chip',
    prose('The thickness ', el('i', {}, 'h'), ` ${placeOf(report.result.teeth_height_mm)}, over the immersion angle `,
      el('i', {}, 'θ'), ' of the tooth. Runout makes the chip loads of the teeth unequal.', note),
    chart.element);
  const series = drawn.curves.map((curve, i) => ({
    name: `tooth ${curve.tooth}`, values: um[i], color: seriesColor(i), dash: dashOf(i),
    width: 2,
  }));
  return { part, draw: () => chart.draw([{ label: el('i', {}, 'h'), unit: 'µm', height: 230, series }]) };
}

function chipCurves(report) {
  const direct = tableNamed(report, 'chip_curve.csv');
  if (direct?.drawn) {
    const [angle, ...rest] = direct.columns;
    const curves = rest.map((column, i) => ({
      tooth: /tooth_?(\d+)/.exec(column.name)?.[1] || i + 1, values: column.values,
    }));
    return { table: direct, x: angle.values, curves };
  }
  const chip = tableNamed(report, 'chip.csv');
  if (!chip?.drawn) return null;
  const [tooth, angle, height, h] = ['tooth', 'edge_angle_deg', 'height_mm', 'h_mm']
    .map((name) => columnNamed(chip, name));
  if (!tooth || !angle || !h) return null;
  const x = [...new Set(angle)].sort((a, b) => a - b);
  if (x.length < 3) return null;
  const curves = [...new Set(tooth)].map((k) => {
    const at = new Map();
    tooth.forEach((t, i) => {
      if (t === k && (!height || height[i] === height[0])) at.set(angle[i], h[i]);
    });
    return { tooth: k, values: x.map((theta) => at.get(theta) ?? null) };
  });
  return { table: chip, x, curves };
}

/** Where each tooth cuts, as bars over the immersion angle from -90 to 270 degrees. */
function engagementSection(teeth, height) {
  if (!Array.isArray(teeth) || !teeth.length) return null;
  const at = (angle) => `${((angle + 90) / 3.6).toFixed(3)}%`;
  const rows = teeth.map((tooth, i) => {
    const intervals = tooth.intervals_deg || [];
    const bars = intervals.map(([from, to]) => {
      const bar = el('span', { class: 'bar', title: `${number(from)}° to ${number(to)}°` });
      bar.style.left = at(from);
      bar.style.width = `${(Math.min(to, 270) - from) / 3.6}%`;
      bar.style.background = `var(${seriesColor(i)})`;
      return bar;
    });
    const text = intervals.length
      ? intervals.map(([from, to]) => `${number(from)}° to ${number(to)}°`).join(', ')
      : 'idle: cuts nothing';
    const peak = isNumber(tooth.peak_chip_mm) && intervals.length
      ? `h up to ${number(1000 * tooth.peak_chip_mm, 3)} µm` : '';
    return el('li', { class: intervals.length ? '' : 'idle' },
      el('b', {}, `Tooth ${tooth.tooth}`), el('span', { class: 'track' }, bars),
      el('span', { class: 'text' }, text, peak ? el('small', {}, peak) : null));
  });
  const ticks = [-90, 0, 90, 180, 270].map((angle) => {
    const tick = el('span', {}, `${number(angle)}°`);
    tick.style.left = at(angle);
    return tick;
  });
  return section('engagement', 'Engagement: where each tooth cuts', 'Engagement',
    prose('Each bar covers the immersion angles with a chip, from entry to exit', isNumber(height) ? ` ${placeOf(height)}` : '',
      '. 0° is +y, 90° is the direction of feed.'),
    el('ol', { class: 'engagement' }, rows,
      el('li', { class: 'ticks' }, el('b', {}), el('span', { class: 'track' }, ticks))));
}

/** Other scalars and lists of `result`, so that nothing stays hidden; a covariance is for programs. */
function restSection(result, known) {
  const rest = Object.fromEntries(Object.entries(result)
    .filter(([key, value]) => key !== 'covariance' && !known.includes(key) && !isEmpty(value)));
  if (isEmpty(rest)) return null;
  return section('more', 'More of the result', 'More', described(rest));
}

const offsetWords = (um) => (um < 0 ? 'shorter' : 'longer');

/** Runout in a sentence; everything relative to tooth 1, as only differences matter. */
function runoutWords(runout, factor = normalInterval) {
  const parts = [];
  const offsets = runout?.radial_offsets_mm?.map((r) => 1000 * r);
  const se = runout?.radial_offsets_se_mm?.map((r) => (isNumber(r) ? 1000 * r : null)) || [];
  if (offsets?.length === 2 && isNumber(offsets[1] - offsets[0]) && offsets[1] !== offsets[0]) {
    const r = offsets[1] - offsets[0];
    parts.push(`tooth 2 is ${measured(Math.abs(r), factor * se[1])} µm ${offsetWords(r)} than tooth 1` +
      (isNumber(se[1]) ? ` (95 %: ± ${number(factor * se[1], 2)} µm)` : ''));
  } else if (offsets?.length > 2 && offsets.some((r) => r !== offsets[0])) {
    const low = offsets.indexOf(Math.min(...offsets));
    const high = offsets.indexOf(Math.max(...offsets));
    parts.push(`tooth ${low + 1} is ${number(offsets[high] - offsets[low], 3)} µm shorter than ` +
      `tooth ${high + 1}`);
  }
  if (runout?.eccentricity_mm) {
    const angle = isNumber(runout.angle_deg) ? ` at ${number(runout.angle_deg)}° from tooth 1` : '';
    parts.push(`the tool turns ${number(1000 * runout.eccentricity_mm, 3)} µm off its centre` + angle);
  }
  return parts.join(', and ');
}

/** "wear land of 80 µm (30 000 N/mm³)" */
function dampingWords(damping) {
  return `wear land of ${number(damping.wear_land_um)} µm (${number(damping.indentation_N_per_mm3)} N/mm³)`;
}
