// The page of `plan` of a wall: how to measure it, and which cut keeps an error.

const wallPlanKnown = ['of', 'chosen', 'so_far', 'readings_so_far', 'files', 'designs', 'ten_more_readings',
  'changes', 'cutting', 'form', 'noise_um', 'noise_from', 'wanted_percent', 'wanted_um', 'runout'];

function wallPlanPage(report) {
  const { result } = report;
  const keys = Object.keys(result.chosen?.predicted || {}).filter((key) =>
    isNumber(result.chosen.predicted[key]?.value));
  const there = keys.length > 0;
  return [
    { lead: there ? wallPlanLead(result, keys) : null },
    there ? designsSection(report, keys) : null,
    errorGridSection(report),
    there ? moreSection(result, keys) : null,
    there ? changesSection(result, keys) : null,
    { part: there ? wallBasis(result) : null },
    { part: restSection(result, wallPlanKnown) },
  ];
}

const mm3 = (rate) => `${fixed(rate / 1000, 3)} cm³/min`;

function wallPlanLead(result, keys) {
  const { chosen, cutting } = result;
  const { best, thinnest_wall: thin, largest_error_um: limit } = cutting || {};
  return [tiles([
    { label: 'Readings', value: chosen.readings, note: `${chosen.readings_per_height} at each of ${
      chosen.heights} heights` },
    ...keys.map((key) => ({ label: quantityName(key),
      value: spreadText(key, chosen.predicted[key]).replace(/ [^ ]+$/, ''), unit: spreadUnit(key),
      note: result.so_far ? `so far ${spreadText(key, result.so_far[key])}` :
        `wanted ± ${inMicrometres(key) ? result.wanted_um : result.wanted_percent} ${spreadUnit(key)}` })),
    best && { label: `Best cut within ${number(limit)} µm`, value: fixed(best.removal_rate_mm3_per_min / 1000, 3),
      unit: 'cm³/min', note: `feed ${number(best.feed_per_tooth_mm, 3)} mm, radial depth ${
        number(best.radial_depth_mm, 3)} mm` },
    thin && { label: 'Thinnest wall, cut as stated', value: isNumber(thin.thickness_mm) ?
      fixed(thin.thickness_mm, 3) : 'none', unit: isNumber(thin.thickness_mm) ? 'mm' : '',
    note: isNumber(thin.thickness_mm) ? (thin.thinner_too ? 'thinner walls are possible too' :
      `now ${number(cutting.thickness_mm)} mm${isNumber(cutting.stated?.peak_error_um) && cutting.limited === 'peak' ?
        `, which leaves ${fixed(cutting.stated.peak_error_um, 3)} µm` : ''}`) : `an error of ${fixed(thin.error_um, 3)} µm stays` },
  ])];
}

function designsSection(report, keys) {
  const { result } = report;
  const chosen = (d) => ['heights', 'readings_per_height', 'spread'].every((key) => d[key] === result.chosen[key]);
  const told = result.designs.filter((d) => d.predicted);
  const spreads = [...new Set(told.map((d) => d.spread))].sort((a, b) => a - b);
  const x = told.map((d) => d.readings);
  const wanted = (key) => (inMicrometres(key) ? result.wanted_um : result.wanted_percent);
  const chart = figure({ key: 'designs', x, points: true, label: 'readings in all', unit: '' });
  const panels = keys.map((key) => ({ label: quantityName(key), unit: `± ${spreadUnit(key)}`, height: 150,
    range: (u, low, high) => [0, Math.min(high, 8 * wanted(key)) * 1.05],
    series: [...spreads.map((spread, i) => ({ name: `spread ${spread}`, line: false, points: 7,
      color: seriesColor(i), values: told.map((d) => (d.spread === spread && isNumber(half(d.predicted[key])) ?
        spreadIn(key, half(d.predicted[key]), d.predicted[key].value) : null)) })),
    { name: 'wanted', color: '--s6', width: 1.2, dash: [6, 3], values: told.map(() => wanted(key)) }],
    markers: [{ x: result.chosen.readings, text: 'chosen' }] }));
  const near = told.filter((d) => d.enough || chosen(d)).slice(0, 6);
  const rows = [...(result.so_far ? [['so far', '', '', number(result.readings_so_far),
    ...keys.map((key) => spreadText(key, result.so_far[key]))]] : []),
  ...near.map((d) => [chosen(d) ? el('b', {}, 'chosen') : d.enough ? 'enough' : 'best', number(d.heights),
    number(d.readings_per_height), number(d.readings), ...keys.map((key) => spreadText(key, d.predicted[key]))])];
  const at = result.chosen.heights_mm;
  const part = section('designs', 'How to measure', 'Measure',
    prose('Measure at ', el('b', {}, `${result.chosen.heights} heights`), ` from ${number(at[0], 3)} to ${
      number(at[at.length - 1], 3)} mm above the tip, `, el('b', {}, `${result.chosen.readings_per_height} readings`),
    ' at each height, at the same places along the feed, over whole turns. Spread is the part of the axial depth that the heights cover. ' +
      'Intervals are 95 %', result.form === 'none' ? '.' : ['. The fit also finds an unknown ', el('b', {}, result.form), ' of the readings.']),
    table(['', 'heights', 'at each', 'readings', ...keys.map(quantityName)], rows), chart.element);
  return { part, draw: () => chart.draw(panels) };
}

/** error_map.csv as rows of a map: radial depth up, feed to the right. */
function gridRows(t) {
  const [feed, depth, peak, mean, rate] = ['feed_per_tooth_mm', 'radial_depth_mm', 'peak_error_um',
    'mean_error_um', 'removal_rate_mm3_per_min'].map((name) => columnNamed(t, name));
  if (!feed?.length) return [];
  const rows = new Map();
  depth.forEach((a, i) => rows.set(a, [...(rows.get(a) || []), i]));
  const of = (values, list) => list.map((i) => values[i]);
  return [...rows].map(([height, list]) => ({ height, x: of(feed, list), peak: of(peak, list),
    mean: of(mean, list), rate: of(rate, list) }));
}

/** Where the painted values cross the limit, in red with a white edge. */
function paintLimit(c, values, limit, frame) {
  const crossings = [];
  const [lines, columns] = [values.length, values[0].length];
  const over = (k, i) => values[k][i] > limit;
  for (let k = 0; k + 1 < lines; ++k) {
    for (let i = 0; i + 1 < columns; ++i) {
      if (over(k, i) !== over(k, i + 1) || over(k, i) !== over(k + 1, i)) {
        crossings.push([frame.left + frame.width * (i + 1) / columns, frame.top + frame.height * (k + 1) / lines]);
      }
    }
  }
  for (const [color, size] of [['#ffffff', 6], ['#c0281e', 3]]) {
    c.fillStyle = color;
    for (const [x, y] of crossings) c.fillRect(x - size / 2, y - size / 2, size, size);
  }
}

/** The cut as stated, and the best one within the limit. */
function markGrid(c, { cutting, frame, px, py, limited }) {
  const inside = ({ feed_per_tooth_mm: f, radial_depth_mm: a }) => f >= frame.x[0] && f <= frame.x[1] &&
    a >= frame.y[0] && a <= frame.y[1];
  const label = (cut, text) => {
    if (!cut || !inside(cut)) return;
    const [x, y] = [px(cut.feed_per_tooth_mm), py(cut.radial_depth_mm)];
    c.fillStyle = '#ffffff';
    c.strokeStyle = '#17212b';
    c.lineWidth = 2;
    c.beginPath();
    c.arc(x, y, 5, 0, 2 * Math.PI);
    c.fill();
    c.stroke();
    const width = c.measureText(text).width + 8;
    const left = Math.min(Math.max(x + 9, frame.left + 2), frame.left + frame.width - width - 2);
    const up = Math.min(Math.max(y, frame.top + 10), frame.top + frame.height - 10);
    c.fillStyle = 'rgba(255, 255, 255, 0.85)';
    c.fillRect(left, up - 8, width, 16);
    c.fillStyle = '#17212b';
    c.textAlign = 'left';
    c.textBaseline = 'middle';
    c.fillText(text, left + 4, up);
  };
  label(cutting.stated, 'as stated');
  if (limited) label(cutting.best, 'best');
}

function errorGridSection(report) {
  const { cutting } = report.result;
  const rows = gridRows(tableNamed(report, 'error_map.csv'));
  if (rows.length < 2 || rows[0].x.length < 2) return null;
  const limit = cutting.largest_error_um;
  const viewOf = (key, name, text) => {
    const all = rows.flatMap((row) => row[key]).filter(isNumber);
    const range = all.length ? [Math.min(...all), Math.max(...all)] : [0, 1];
    const step = range[1] > range[0] ? niceStep((range[1] - range[0]) / 10) : 0;
    return { name, label: text, key, colors: rising, range, step, smooth: true,
      limited: isNumber(limit) && cutting.limited === key,
      // What has no steady state is as bad as the worst.
      rows: rows.map((row) => ({ ...row, [key]: row[key].map((v) => (isNumber(v) ? v : range[1])) })) };
  };
  const views = [viewOf('peak', 'largest error', 'largest error of the wall, either way [µm]'),
    viewOf('mean', 'mean error', 'mean error of the wall [µm], positive: material left')];
  if (cutting.limited === 'mean') views.reverse();
  const state = { view: views[0], frame: null };
  const x = [rows[0].x[0], rows[0].x[rows[0].x.length - 1]];
  const y = [rows[0].height, rows[rows.length - 1].height];
  const paint = (c, width, height) => {
    const { view } = state;
    const frame = { left: 52, top: 76, width: width - 62, height: height - 76 - 44, ...chart.view,
      xLabel: 'feed per tooth [mm]', yLabel: 'radial depth [mm]' };
    state.frame = frame;
    write(c, view.label, 0, 8, { color: '--ink' });
    colorBar(c, view, frame.left, frame.width);
    const values = pictureOf(view.rows, view, frame.x, frame.y, Math.round(frame.width * devicePixelRatio),
      Math.round(frame.height * devicePixelRatio));
    c.putImageData(imageOf(values, view), Math.round(frame.left * devicePixelRatio),
      Math.round(frame.top * devicePixelRatio));
    const places = plane(c, frame, { grid: false });
    if (view.limited) paintLimit(c, values, limit, frame);
    markGrid(c, { cutting, frame, ...places, limited: view.limited });
  };
  const chart = drawing({ label: 'Map of the error over feed and radial depth', paint, lowOnPaper: true,
    data: () => ({ head: ['feed per tooth [mm]', 'radial depth [mm]', 'largest error [µm]', 'mean error [µm]',
      'removal rate [mm³/min]'],
    rows: rows.flatMap((row) => row.x.map((v, i) => [v, row.height, row.peak[i], row.mean[i], row.rate[i]])) }),
    height: (width) => Math.round(Math.min(430, Math.max(330, 0.5 * width))) });
  zoomable(chart, () => state.frame, { x, y });
  readoutOf(chart, 'Point at the map for values; drag or pinch to zoom.', (place) => {
    const [f, a] = valuesAtPlace(state.frame, place);
    const row = rows[nearest(rows.map((one) => one.height), a)];
    const i = nearest(row.x, f);
    return [`feed ${number(row.x[i], 3)} mm per tooth, radial depth ${number(row.height, 3)} mm: `,
      el('b', {}, `${number(row.peak[i], 3)} µm`), ` at most, ${number(row.mean[i], 3)} µm on average; ${
        mm3(row.rate[i])}`];
  });
  chart.controls.append(...[choice('Show', views.map((view) => ({ value: view, text: view.name })), state.view,
    (view) => { state.view = view; chart.redraw(); })].filter(Boolean));
  const { best, stated } = cutting;
  const words_ = !isNumber(limit) ? ['The case has no largest error. Set ', el('code', {}, 'largest_error_um'),
    ' to see which cuts keep it.'] : best ? ['The red line is the limit of ', el('b', {}, `${number(limit)} µm`),
    `. The largest removal rate within it is ${mm3(best.removal_rate_mm3_per_min)}, at a feed of ${
      number(best.feed_per_tooth_mm, 3)} mm per tooth and a radial depth of ${number(best.radial_depth_mm, 3)} mm.`] :
    ['None of the cuts in the map keeps ', el('b', {}, `${number(limit)} µm`), '.'];
  const part = section('cuts', 'The error over feed and radial depth', 'Cuts',
    prose('Thickness and axial depth are as in the case. The cut of the case has ', isNumber(stated.peak_error_um) ?
      `a largest error of ${fixed(stated.peak_error_um, 3)} µm.` : 'no steady state.', ' ', ...words_), chart.element);
  return { part, draw: () => chart.resize() };
}

function moreSection(result, keys) {
  const more = [...result.ten_more_readings].filter((m) => m.predicted);
  const now = result.so_far || result.chosen.predicted;
  if (more.length < 3 || !now) return null;
  const best = more[0];
  const sorted = more.sort((a, b) => a.height_mm - b.height_mm);
  const gain = (entry, key) => 100 * (1 - half(entry.predicted[key]) / half(now[key]));
  const chart = figure({ key: 'more', points: true, x: sorted.map((m) => m.height_mm), unit: 'mm',
    label: 'height above the tip', caption: zoomHint });
  const series = keys.map((key, k) => ({ name: quantityName(key), color: seriesColor(k), width: 1.8, points: 5,
    dash: dashOf(6 * k), values: sorted.map((m) => gain(m, key)) }));
  const part = section('more', 'Where ten more readings help', 'More readings',
    prose('Ten more readings at ', el('b', {}, `${number(best.height_mm, 3)} mm`), ' above the tip help most: ',
      keys.map((key, k) => [k ? ', ' : '', quantityName(key), ` ${spreadText(key, best.predicted[key])}`]), '.'),
    chart.element);
  return { part, draw: () => chart.draw([{ label: 'interval narrower by', unit: '%', height: 180, series }]) };
}

const changeWords = { axial_depth_mm: 'axial depth', radial_depth_mm: 'radial depth', thickness_mm: 'thickness of the wall',
  position_mm: 'place along the wall' };

function changesSection(result, keys) {
  const kinds = [...new Set(result.changes.map((c) => c.key))];
  if (!kinds.length) return null;
  const place = el('div', {});
  const show = (kind) => {
    const some = result.changes.filter((c) => c.key === kind && c.predicted);
    const chart = figure({ key: 'changes', points: true, x: some.map((c) => c.value_mm), unit: 'mm',
      label: changeWords[kind] || kind });
    place.replaceChildren(chart.element);
    const seriesOf = (list) => list.map((key, k) => ({ name: quantityName(key), color: seriesColor(keys.indexOf(key)),
      width: 1.8, points: 6, dash: k ? [6, 3] : undefined, values: some.map((c) => (c.predicted[key] ?
        spreadIn(key, half(c.predicted[key]), c.predicted[key].value) : null)) }));
    const [lengths, others] = [keys.filter(inMicrometres), keys.filter((key) => !inMicrometres(key))];
    chart.draw([{ label: 'coefficients', unit: '± %', height: 170, range: fromZero, series: seriesOf(others) },
      lengths.length && { label: 'eccentricity', unit: '± µm', height: 120, range: fromZero,
        series: seriesOf(lengths) }].filter(Boolean));
  };
  const part = section('changes', 'Other cuts and walls', 'Other cuts',
    prose('The same readings on another cut or wall. It differs from the case in one thing. The heights are in proportion ' +
      'to the axial depth.'),
    choice('Over', kinds.map((kind) => ({ value: kind, text: changeWords[kind] || kind })), kinds[0], show), place);
  return { part, draw: () => show(kinds[0]) };
}

function wallBasis(result) {
  const from = { readings: 'residual of the fit of the readings', given: 'given', assumed: 'assumed' };
  const files = (result.files || []).map((file) => file.split('/').pop());
  return section('basis', 'What the plan is based on', 'Basis', table(['', ''], [
    ['measured so far', files.length ? `${files.join(', ')} (${result.readings_so_far} readings)` : 'nothing'],
    ['noise of a reading', `${number(result.noise_um, 3)} µm (${from[result.noise_from] || ''})`],
    ['unknown form of the readings', result.form],
    ['wanted', `± ${number(result.wanted_percent)} % of the coefficients, ± ${number(result.wanted_um)} µm of ` +
      'the eccentricity'],
    ['expected', Object.entries(result.chosen.predicted).filter(([, entry]) => isNumber(entry?.value))
      .map(([key, entry]) => `${nameAndUnit(key).name.replace(/^(?!K_)(.*)$/, (name) => name.replaceAll('_', ' '))} ${number(inMicrometres(key) ?
        1000 * entry.value : entry.value)} ${inMicrometres(key) ? 'µm' : nameAndUnit(key).unit}`).join(', ')],
  ]));
}
