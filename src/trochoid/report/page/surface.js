// The page of `surface`.

const surfaceKnown = ['model', 'feedback', 'mean_error_mm', 'peak_error_mm', 'min_error_mm', 'forces',
  'compliance_mm_per_N', 'turns_to_repeat', 'heights', 'bent'];

const errorModels = {
  envelope: { name: 'envelope', what: 'the profile that stays on the wall after all deflected teeth ' +
    'have cut' },
  imprint: { name: 'imprint', what: 'the mark that each tooth leaves at the moment when it passes the ' +
    'finished wall, as if no later tooth cut it away' },
  quasi_static: { name: 'quasi-static', what: 'the deflection at every spindle angle, drawn along ' +
    'the feed. It is a pulse of force and not a profile that a probe can find' },
};
const feedbackWords = {
  none: 'the model leaves out that the deflection makes the chip smaller',
  entry: 'the deflection shifts the entry angle of the teeth',
  regenerative: 'the deflection changes entry and chip, also through the earlier cuts',
  direct: 'the deflection changes entry and chip',
};
const micro = (mm) => (isNumber(mm) ? 1000 * mm : null);
/** What rounding leaves of a value that is nothing beside `scale`. */
const orNothing = (value, scale) => (Math.abs(value) < 1e-6 * Math.abs(scale) ? 0 : value);

function surfacePage(report) {
  const rows = wallRows(tableNamed(report, 'surface.csv'));
  const heights = report.result.heights || [];
  const section = { row: rows[Math.floor(rows.length / 2)], listeners: [] };
  const pick = (row) => {
    section.row = row;
    for (const listener of section.listeners) listener(row);
  };
  return [
    { lead: surfaceLead(report.result, heights) },
    mapSection(report, rows, section, pick),
    profileSection(report, rows, section, pick),
    heightSection(report, heights),
    bentSection(report),
    wallForces(report, section, rows.length),
    { part: marksTable(heights, report.result.model === 'quasi_static') },
    toolSection(),
    { part: restSection(report.result, surfaceKnown) },
  ];
}

/** surface.csv by height, ascending; errors in micrometres. */
function wallRows(t) {
  const [x, height, error, tooth] = ['x_mm', 'height_mm', 'error_mm', 'tooth']
    .map((name) => columnNamed(t, name));
  if (!x?.length || !height || !error) return [];
  const rows = new Map();
  x.forEach((v, i) => {
    if (!isNumber(error[i])) return;
    if (!rows.has(height[i])) rows.set(height[i], []);
    rows.get(height[i]).push(i);
  });
  return [...rows].sort((a, b) => a[0] - b[0]).map(([h, all]) => {
    const order = all.sort((a, b) => x[a] - x[b]);
    const errors = order.map((i) => micro(error[i]));
    const mean = errors.reduce((sum, e) => sum + e, 0) / errors.length;
    return { height: h, x: order.map((i) => x[i]), error: errors, marks: errors.map((e) => e - mean),
      tooth: tooth ? order.map((i) => tooth[i]) : order.map(() => 1) };
  });
}

/** Words where the largest error stands at the edge of what was computed. */
function atTheEnd(top, heights) {
  const all = heights.map((h) => h.height_mm);
  const ends = all.length > 2 && (top.height_mm === Math.min(...all) || top.height_mm === Math.max(...all));
  return ends && Math.min(...all) > 0 ? ', at the end of the computed heights' : '';
}

function surfaceLead(result, heights) {
  if (!heights.length) return null;
  const top = heights.reduce((a, b) => (b.max_error_mm > a.max_error_mm ? b : a));
  const rough = heights.reduce((a, b) => (b.Ra_um > a.Ra_um ? b : a));
  const least = orNothing(result.min_error_mm, result.peak_error_mm);
  const F = result.forces || {};
  const model = errorModels[result.model] || { name: result.model, what: '' };
  return [
    tiles([
      { label: 'Mean surface location error', value: fixed(micro(result.mean_error_mm), 3), unit: 'µm',
        note: `${result.mean_error_mm < 0 ? 'negative: cut too deep' : 'positive: material is left'}; mean over ${
          heights.length > 1 ? `${heights.length} heights` : 'one height'}` },
      { label: 'Largest error', value: fixed(micro(result.peak_error_mm), 3), unit: 'µm',
        note: `${number(top.height_mm, 3)} mm above the tip${atTheEnd(top, heights)}` },
      { label: 'Smallest error', value: fixed(micro(least), 3), unit: 'µm',
        note: least < 0 ? 'negative: cut too deep' : 'at these heights no point is cut too deep' },
      result.model !== 'quasi_static' && { label: 'Roughness along the feed, Ra up to',
        value: fixed(rough.Ra_um, 3), unit: 'µm', note: `Rt up to ${fixed(Math.max(
          ...heights.map((h) => h.Rt_um)), 3)} µm` },
      { label: 'Force across the wall', value: fixed(F.F_normal_max_N, 3), unit: 'N',
        note: `peak; mean ${number(F.F_normal_mean_N, 3)} N` },
    ]),
    prose('Read as ', el('b', {}, model.name), `: ${model.what}. ${sentence(
      feedbackWords[result.feedback] || '')}${result.turns_to_repeat > 1 ?
      `. Steady state after ${result.turns_to_repeat} turns` : ''}.`),
    markWords(result, heights),
  ];
}

/** Once a turn against once a tooth, in words; and which teeth make the wall. */
function markWords(result, heights) {
  const told = heights.filter((h) => isNumber(h.once_per_turn_um));
  if (!told.length) return null;
  const largest = (key) => Math.max(...told.map((h) => h[key]));
  const mean = (key) => told.reduce((sum, h) => sum + h[key], 0) / told.length;
  const teeth = told[0].share?.length || 1;
  const amounts = `${fixed(mean('once_per_turn_um'), 2)} µm on average (at most ${fixed(
    largest('once_per_turn_um'), 2)} µm)`;
  const other = `${fixed(mean('once_per_tooth_um'), 2)} µm`;
  const share = Array.from({ length: teeth }, (_, k) =>
    told.reduce((sum, h) => sum + h.share[k], 0) / told.length);
  const idle = share.map((s, k) => (s < 0.005 ? k + 1 : null)).filter(Boolean);
  if (teeth < 2) return prose(`Feed marks: with one tooth, the marks repeat once a turn. Their amplitude is ${amounts}.`);
  if (largest('once_per_turn_um') < 0.05 * (largest('once_per_tooth_um') || 1) ||
    largest('once_per_turn_um') < 1e-3) {
    return prose(`The feed marks repeat with every tooth (amplitude ${other}). So all teeth cut alike, and there is no sign ` +
      'of runout.');
  }
  const ratio = mean('once_per_turn_um') / mean('once_per_tooth_um');
  return prose('Feed marks: the part that repeats ', el('b', {}, 'once a turn'), ` has an amplitude of ${
    amounts}. The part that repeats once a tooth has ${other}. `, ratio > 1 ?
    'The first part is larger, which is a sign of runout: ' : 'The first part comes from runout: ',
  `tooth ${share.indexOf(Math.max(...share)) + 1} makes ${number(100 * Math.max(...share), 2)} % of the wall`,
  idle.length ? `, and ${idle.length > 1 ? `teeth ${idle.slice(0, -1).join(', ')} and` : 'tooth'} ${
    idle[idle.length - 1]} none of it.` : '.');
}

function mapSection(report, rows, section_, pick) {
  if (rows.length < 2 || rows.every((row) => row.x.length < 2)) return null;
  const { model } = report.result;
  const ends = (key) => rows.reduce(([a, b], row) => [Math.min(a, ...row[key]), Math.max(b, ...row[key])],
    [Infinity, -Infinity]);
  const [low, high] = ends('error');
  const deepest = Math.max(...ends('marks').map(Math.abs)) || 1;
  const smooth = model !== 'imprint';
  const lines = model === 'envelope';
  const teeth = [...new Set(rows.flatMap((row) => row.tooth))].sort((a, b) => a - b);
  const views = [
    { name: 'error', label: 'error [µm], positive: material left', key: 'error', colors: rising,
      range: [low, high], step: lines && high > low ? niceStep((high - low) / 10) : 0, smooth },
    model !== 'quasi_static' && { name: 'feed marks', key: 'marks', colors: aroundZero, smooth,
      label: 'error less the mean of its height [µm]', range: [-deepest, deepest] },
    teeth.length > 1 && { name: 'tooth', label: model === 'quasi_static' ?
      'tooth that entered last' : 'tooth that made each point', key: 'tooth', teeth,
    range: [0, 1], smooth: false },
  ].filter(Boolean);
  const chart = heatMap({
    rows, views, xLabel: 'x, along the feed [mm]', yLabel: 'height above the tip [mm]', pick,
    section: () => section_.row, columns: [['error [µm]', 'error'], ['tooth', 'tooth']],
    hint: 'Point at the map for values; a click chooses the height of the profile below. Drag or pinch to zoom.',
    read: (row, i) => [`x ${number(row.x[i], 6)} mm, height ${number(row.height, 4)} mm: `,
      el('b', {}, `${number(row.error[i], 4)} µm`), ` (${row.marks[i] >= 0 ? '+' : ''}${
        number(row.marks[i], 3)} µm from the mean of this height), tooth ${row.tooth[i]}`],
  });
  section_.listeners.push(() => chart.redraw());
  const part = section('map', smooth && !lines ? 'The deflection over feed and height' :
    'Surface location error of the wall', 'Map',
  prose('Error over the feed and the height. The feed goes to the right. The tip of the tool is at the ' +
      'bottom.', lines ? ' Each line joins points of equal error.' : '', smooth ? ` The error is computed at ${rows.length} heights and is straight ` +
      'between them.' : ' Each field is a mark of a tooth.'),
    chart.element);
  return { part, draw: () => chart.resize() };
}

/** A slider over the heights; the map moves it too. */
function heightSlider(rows, section_, pick) {
  if (rows.length < 2) return null;
  const text = el('output', {});
  const input = el('input', { type: 'range', min: '0', max: String(rows.length - 1), step: '1',
    'aria-label': 'Height above the tip', input: () => pick(rows[Number(input.value)]) });
  const show = () => {
    input.value = String(rows.indexOf(section_.row));
    text.textContent = `${number(section_.row.height, 4)} mm`;
  };
  section_.listeners.push(show);
  show();
  return el('label', { class: 'slider' }, el('span', {}, 'Height above the tip'), input, text);
}

/** One curve for every tooth; each begins at the last point of the one before, save marks. */
function byTooth(row, marks) {
  const teeth = [...new Set(row.tooth)].sort((a, b) => a - b);
  return teeth.map((tooth) => ({
    name: `tooth ${tooth}`, color: seriesColor(tooth - 1), dash: dashOf(tooth - 1), width: 2.2,
    points: row.x.length < 60 ? 5 : false,
    values: row.error.map((e, i) => (row.tooth[i] === tooth || (!marks && row.tooth[i + 1] === tooth) ? e : null)),
  }));
}

function profileSection(report, rows, section_, pick) {
  if (!rows.length) return null;
  const all = rows.every((row) => row.x.length > 1);
  if (!all) return null;
  const chart = figure({ key: 'along', points: report.result.model === 'imprint', x: section_.row.x, label: 'x, along the feed', unit: 'mm',
    caption: zoomHint + thinned(tableNamed(report, 'surface.csv')) });
  const words_ = el('p', { class: 'small' });
  const draw = () => {
    const { row } = section_;
    const { error } = row;
    const mean = error.reduce((sum, e) => sum + e, 0) / error.length;
    const marked = report.result.model === 'imprint';
    const series = marked ? [{ name: 'in order', color: '--measured', width: 1.5, values: error },
      ...byTooth(row, true).map((one) => ({ ...one, line: false, points: 9 }))] : byTooth(row);
    chart.draw([{ label: 'error', unit: 'µm', height: 230, series }], row.x);
    words_.textContent = `At ${number(row.height, 4)} mm: mean ${number(mean, 4)} µm, from ${
      number(Math.min(...error), 4)} to ${number(Math.max(...error), 4)} µm.`;
  };
  section_.listeners.push(draw);
  chart.controls.append(...[heightSlider(rows, section_, pick)].filter(Boolean));
  const part = section('profile', 'Profile along the feed', 'Profile',
    prose(rows.length > 1 ? 'The profile at one height. The colour shows which tooth ' : 'The colour shows which tooth ', report.result.model === 'quasi_static' ?
      'entered last.' : 'made each point.'), words_, chart.element);
  return { part, draw };
}

const fromZero = (u, low, high) => [0, 1.08 * high || 1];

/** Mean and range, roughness and marks over the height. */
function heightSection(report, heights) {
  if (heights.length < 2) return null;
  const sorted = [...heights].sort((a, b) => a.height_mm - b.height_mm);
  const of = (key, factor = 1) => sorted.map((h) => (isNumber(h[key]) ? factor * h[key] : null));
  const chart = figure({ key: 'height', x: of('height_mm'), label: 'height above the tip', unit: 'mm',
    caption: zoomHint });
  const [low, high] = [of('min_error_mm', 1000), of('max_error_mm', 1000)];
  const panels = [
    { label: 'error', unit: 'µm', height: 210, band: { low, high, name: 'smallest to largest' },
      series: [{ name: 'mean', values: of('mean_error_mm', 1000), color: '--s1', width: 2 }] },
    report.result.model !== 'quasi_static' && { label: 'roughness', unit: 'µm', height: 120, range: fromZero, series: [
      { name: 'Ra', values: of('Ra_um'), color: '--s2', width: 1.8 },
      { name: 'Rt', values: of('Rt_um'), color: '--s4', width: 1.8, dash: [6, 3] }] },
    sorted.some((h) => isNumber(h.once_per_turn_um)) && { label: 'amplitude of marks', unit: 'µm',
      height: 120, range: fromZero, series: [
        { name: 'once a turn', values: of('once_per_turn_um'), color: '--s2', width: 1.8 },
        { name: 'once a tooth', values: of('once_per_tooth_um'), color: '--s3', width: 1.8, dash: [6, 3] }] },
  ].filter(Boolean);
  const part = section('heights', 'Over the height', 'Height',
    prose('Mean error of each height, with its smallest and largest value along the feed.',
      report.result.model === 'quasi_static' ? '' : ' The roughness is taken along the feed: Ra is the mean ' +
      'distance from the mean, Rt is the distance from the lowest to the highest point.'), chart.element);
  return { part, draw: () => chart.draw(panels) };
}

/** Forces over the angle, with the deflection at the chosen height. */
function wallForces(report, section_, rows) {
  const forces = tableNamed(report, 'forces.csv');
  const x = columnNamed(forces, 'angle_deg');
  if (!x?.length || !increases(x)) return null;
  const deflection = tableNamed(report, 'deflection.csv');
  const whole = deflection?.drawn === deflection?.rows && section_.row;
  const bentAt = () => {
    const height = columnNamed(deflection, 'height_mm');
    return columnNamed(deflection, 'deflection_mm').filter((_, i) => height[i] === section_.row.height)
      .map(micro);
  };
  const chart = figure({ key: 'angle', x, label: 'φ, spindle angle', unit: '°',
    caption: zoomHint + thinned(forces) });
  chart.controls.append(...[rangeChoice([chart], x)].filter(Boolean));
  const panels = () => [
    { label: [el('i', {}, 'F'), ' across the wall'], unit: 'N', height: 150,
      series: [{ name: '', values: columnNamed(forces, 'F_normal_N'), color: '--s1', width: 1.8 }] },
    { label: [forceName('x'), ' along the feed'], unit: 'N', height: 120,
      series: [{ name: '', values: columnNamed(forces, 'Fx_N'), color: '--s2', width: 1.8 }] },
    whole && bentAt().length === x.length && { label: `deflection at ${number(section_.row.height, 4)} mm`,
      unit: 'µm', height: 120, series: [{ name: '', values: bentAt(), color: '--s3', width: 1.8 }] },
  ].filter(Boolean);
  const part = section('forces', 'Forces over the spindle angle', 'Forces',
    prose('Force on the tool. A positive force across the wall pushes cutter and wall apart and leaves material. ' +
      'The deflection is the sum of both', rows > 1 ? ', at the height chosen above.' : '.'), chart.element);
  const draw = () => chart.draw(panels());
  if (whole) section_.listeners.push(draw);
  return { part, draw };
}

const hundredths = (um) => (isNumber(um) ? um.toFixed(2).replace(/^-(0\.00)$/, '$1').replace('-', '−') : missing);

function marksTable(heights, quasiStatic) {
  if (!heights.length) return null;
  const teeth = heights[0].share?.length || 0;
  const marks = heights.some((h) => isNumber(h.once_per_turn_um));
  const rough = quasiStatic ? [] : ['Ra', 'Rt'];
  const head = ['height, mm', 'mean', 'smallest', 'largest', ...rough,
    ...(marks ? ['once a turn', 'once a tooth'] : []),
    ...(teeth > 1 ? [`teeth 1 to ${teeth}, %`] : []), 'compliance, µm/N'];
  const rows = heights.map((h) => [number(h.height_mm, 4),
    ...['mean_error_mm', 'min_error_mm', 'max_error_mm'].map((key) => hundredths(micro(h[key]))),
    ...rough.map((name) => hundredths(h[`${name}_um`])),
    ...(marks ? [hundredths(h.once_per_turn_um), hundredths(h.once_per_tooth_um)] : []),
    ...(teeth > 1 ? [h.share.map((s) => Math.round(100 * s)).join(' · ')] : []),
    fixed(micro(h.compliance_mm_per_N), 3)]);
  return section('numbers', 'Every height in numbers', 'Numbers',
    prose(quasiStatic ? 'Errors in µm.' : 'Errors and roughness in µm.', marks ? ' The amplitudes in µm are of the marks that repeat once a turn and once a tooth.' : '',
      teeth > 1 ? ' The share of each tooth is its part of the profile.' : '', ' The compliance is for cutter and wall together, per newton of the whole force.'),
    table(head, rows, { class: 'rows' }));
}
