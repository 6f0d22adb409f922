// The page of `plan`: which cut to measure next.

const planKnown = ['cuts', 'before', 'looked_at', 'left_out', 'noise_N', 'noise_from', 'turns',
  'samples_per_rev', 'files', 'group', 'channels', 'mean_sd'];
const cutKinds = ['slot', 'up milling', 'down milling'];
const bestShown = 10;

function planPage(report) {
  const { result } = report;
  if (result.of === 'wall') return wallPlanPage(report);
  if (result.of === 'finish') return finishPlanPage(report);
  const cuts = Array.isArray(result.cuts) ? result.cuts : [];
  const keys = Object.keys(result.before || {});
  return [
    { lead: cuts.length ? planLead(result, cuts[0], keys) : null },
    { part: cuts.length ? bestSection(result, cuts, keys) : null },
    allCutsSection(report, keys),
    { part: cuts.length ? basisSection(result) : null },
    toolSection(),
    { part: restSection(result, planKnown) },
  ];
}

/** `radial_offset_2_mm` -> offset of tooth 2; a coefficient as its symbol. */
function quantityName(key) {
  const { name } = nameAndUnit(key);
  const tooth = /^radial_offset_(\d+)$/.exec(name);
  return tooth ? `offset of tooth ${tooth[1]}` : symbol(name);
}

/** What may be zero is told in micrometres, all else in percent of its value. */
const inMicrometres = (key) => nameAndUnit(key).unit === 'mm';
const spreadUnit = (key) => (inMicrometres(key) ? 'µm' : '%');
const spreadIn = (key, width, value) => (inMicrometres(key) ? 1000 * width :
  100 * width / Math.abs(value));

/** Half of a 95 % interval in words, `not known` where there is none. */
function spreadText(key, entry) {
  const width = half(entry);
  if (!isNumber(width)) return 'not known';
  return `± ${number(spreadIn(key, width, entry.value), 2)} ${spreadUnit(key)}`;
}

function planLead(result, best, keys) {
  return [
    tiles([
      ...keys.slice(0, 4).map((key) => ({ label: quantityName(key),
        value: spreadText(key, best.predicted[key]).replace(/ [^ ]+$/, ''), unit: spreadUnit(key),
        note: `so far ${spreadText(key, result.before[key])}` })),
      { label: 'Peak force of that cut', value: fixed(best.peak_force_N, 3), unit: 'N',
        note: 'in the plane of the table' },
    ]),
  ];
}

const cutCells = (cut) => [cut.engagement === 'slot' ? 'slot' : `${cut.engagement} milling`,
  `${number(cut.feed_per_tooth_mm)} mm`, `${number(cut.axial_depth_mm)} mm`,
  `${number(cut.radial_depth_mm)} mm`];

function bestSection(result, cuts, keys) {
  const rows = cuts.slice(0, bestShown).map((cut) => [...cutCells(cut),
    `${fixed(cut.peak_force_N, 3)} N`,
    ...(isNumber(cut.narrows) ? [`${number(cut.narrows, 3)} ×`] : []),
    ...keys.map((key) => spreadText(key, cut.predicted[key]))]);
  const counted = isNumber(cuts[0].narrows);
  return section('best', 'The best cuts', 'Best cuts',
    prose(`The columns with ± are the 95 % intervals after ${number(result.turns)} turns of the cut, together with all that is known so far. `,
      'The first cut gives the smallest joint region of all quantities.',
      counted ? ' The column "narrower" is the geometric mean of the factors by which the standard errors shrink. Intervals from few turns shrink more.' : ''),
    table(['cut', 'feed per tooth', 'axial depth', 'radial depth', 'peak force',
      ...(counted ? ['narrower'] : []), ...keys.map(quantityName)],
    [['so far', '', '', '', '', ...(counted ? [''] : []),
      ...keys.map((key) => spreadText(key, result.before[key]))], ...rows]));
}

/** Over what the cuts may be laid out. */
const planAxes = [
  { column: 'peak_force_N', text: 'peak force', unit: 'N' },
  { column: 'feed_per_tooth_mm', text: 'feed per tooth', unit: 'mm' },
  { column: 'radial_depth_mm', text: 'radial depth', unit: 'mm' },
  { column: 'axial_depth_mm', text: 'axial depth', unit: 'mm' },
];

/** Every cut as a point: how well it would tell each quantity, over what it costs. */
function allCutsSection(report, keys) {
  const t = tableNamed(report, 'plan.csv');
  const kinds = columnNamed(t, 'engagement');
  if (!kinds?.length) return null;
  const values = report.result.cuts[0].predicted;
  const place = el('div', {});
  const panelsFor = (order, xs) => keys.map((key) => {
    const width = columnNamed(t, `half_width_${key}`);
    const shown = order.map((i) => spreadIn(key, width[i], values[key].value));
    return { label: quantityName(key), unit: `± ${spreadUnit(key)}`, height: 150, markers: [{ x: xs[0], text: 'best' }],
      series: cutKinds.map((name, kind) => ({ name, line: false, points: 7, color: seriesColors[kind],
        values: order.map((i, n) => (kinds[i] === kind ? shown[n] : null)) }))
        .filter((series) => series.values.some(isNumber)) };
  });
  const show = (axis) => {
    const x = columnNamed(t, axis.column);
    const order = x.map((_, i) => i).sort((a, b) => x[a] - x[b]);
    const chart = figure({ key: 'plan', x: order.map((i) => x[i]), points: true, label: axis.text,
      unit: axis.unit, caption: zoomHint });
    place.replaceChildren(chart.element);
    chart.draw(panelsFor(order, x));
  };
  const varied = planAxes.filter(({ column }) => new Set(columnNamed(t, column)).size > 1);
  const chosen = varied[0] || planAxes[0];
  const part = section('cuts', 'All cuts compared', 'All cuts',
    prose('Each point is the half width of the 95 % interval after a cut. A low point is a well known quantity. Over the peak ' +
      'force, a low point on the left is a good result for a small force.'),
    choice('Over', varied.map((axis) => ({ value: axis, text: axis.text })), chosen, show), place);
  return { part, draw: () => show(chosen) };
}

const meansFrom = { records: 'of the means so far', given: 'channel_sd', assumed: 'assumed: 1 % of the mean in [cut]' };
const channelUnit = (channel) => (channel === 'power' ? 'W' : /^(M|torque)/.test(channel) ? 'N m' : 'N');

function basisSection(result) {
  const from = { records: 'residual of the fit of the records', given: 'given', assumed: 'assumed: 2 % of the peak force' };
  const left = result.left_out || [];
  const files = (result.files || []).map((file) => file.split('/').pop());
  return section('basis', 'What the plan is based on', 'Basis',
    table(['', ''], [
      ['measured so far', files.length ? files.join(', ') :
        result.channels?.length && result.noise_from === 'records' ? 'means' : 'nothing'],
      ...(result.group ? [['coefficients of', result.group]] : []),
      ...(result.channels?.length ? result.channels.map((channel, k) => [`standard deviation of the mean of ${channel}`,
        `${number(result.mean_sd[k], 3)} ${channelUnit(channel)} (${meansFrom[result.noise_from] || ''})`]) : [
        ['noise of a sample', `${number(result.noise_N, 3)} N (${from[result.noise_from] || ''})`],
        ['of each cut', `${number(result.turns)} turns of ${number(result.samples_per_rev)} samples`]]),
      ['cuts looked at', number(result.looked_at)],
      ...left.map((one) => [`left out: ${one.reason}`, number(one.count)]),
    ]));
}
