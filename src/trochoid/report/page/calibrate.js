// The page of `calibrate`.

const calibrateKnown = ['model', 'feedback', 'coefficients', 'correlation', 'rank', 'condition', 'rms_mm',
  'offset_mm', 'datum', 'noise_mm', 'means', 'readings', 'answers', 'ten_more_readings', 'runout', 'with_runout',
  'combination', 'message', 'covariance', 'form', 'explanations', 'outliers', 'scatter'];

/** `envelope`, `entry` -> words of a heading. */
const readingName = (model, feedback) => (errorModels[model]?.name || model) +
  (feedback && feedback !== 'none' ? `, feedback ${feedback}` : '');
const readingColors = { imprint: '--s2', quasi_static: '--s2', envelope: '--s1' };

/** Every answer of the calibration in one shape; the chosen one marked. */
function readingsOf(result) {
  const pairOf = (coefficients) => Object.values(coefficients || {});
  const answers = (result.answers || []).map((answer) => ({ ...answer,
    name: readingName(answer.model, answer.feedback),
    column: `${answer.model}${answer.feedback === 'none' ? '' : `_${answer.feedback}`}_mm`,
    color: answer.feedback === 'none' ? readingColors[answer.model] : '--s3',
    pair: pairOf(answer.coefficients),
    chosen: !result.with_runout && answer.model === result.model && answer.feedback === result.feedback }));
  const { runout } = result;
  if (runout?.coefficients) {
    answers.push({ ...runout, name: 'all readings, with runout', color: '--s4',
      model: result.model, pair: pairOf(runout.coefficients), chosen: Boolean(result.with_runout) });
  }
  return answers;
}

function calibratePage(report) {
  const { result } = report;
  if (result.finish) return finishPage(report);
  const readings = readingsOf(result);
  const keys = Object.keys(result.coefficients || {});
  const fitted = readings.some(({ pair }) => pair.some((entry) => isNumber(entry?.value)));
  return [
    { lead: fitted ? calibrateLead(report, readings, keys) : null },
    { part: isEmpty(result.combination) ? null : combinationPart(result, keys) },
    measuredWall(report),
    meansSection(report, readings),
    readingResiduals(report),
    { part: answersTable(result, readings, keys) },
    fitted ? ellipseSection(readings, keys) : null,
    { part: explanationsPart(result, keys) },
    { part: runoutPart(report) },
    adviceSection(result, keys, fitted),
    { part: datumPart(result) },
    toolSection(),
    { part: restSection(result, calibrateKnown) },
  ];
}

function calibrateLead(report, readings, keys) {
  const { result } = report;
  const tile = (key) => {
    const entry = result.coefficients[key];
    const { name, unit } = nameAndUnit(key);
    const width = half(entry);
    return { label: [symbol(name), ` ${meanings[name] || ''}`], value: measured(entry?.value, width), unit,
      note: isNumber(width) ? `95 %: ± ${measured(width, width)} (${
        number(100 * Math.abs(width / entry.value), 2)} %)` : 'no interval: too few readings' };
  };
  return [
    tiles([...keys.map(tile),
      { label: 'Left by the fit', value: fixed(micro(result.rms_mm), 3), unit: 'µm rms',
        note: result.with_runout ? 'of the single readings' : `of ${result.means} means` },
      { label: 'Noise of a reading', value: isNumber(result.noise_mm) ?
        fixed(micro(result.noise_mm), 2) : null, unit: 'µm', note: 'standard deviation' },
      isNumber(result.readings?.repeatability_mm) && { label: 'Repeatability',
        value: fixed(micro(result.readings.repeatability_mm), 2), unit: 'µm',
        note: `standard deviation of ${result.readings.repeats} repeated readings` },
      isNumber(result.runout?.eccentricity_mm) && { label: 'Runout',
        value: measured(micro(result.runout.eccentricity_mm), micro(normalInterval * result.runout.eccentricity_se_mm)),
        unit: 'µm', note: `± ${number(micro(normalInterval * result.runout.eccentricity_se_mm), 2)} µm${
          report.said.runout_seen ? ', off centre' : ': no runout stands out'}` },
    ]),
    ...verdict(result, readings),
  ];
}

const changeOf = (one, other) => one.pair.map((entry, i) => entry.value / other.pair[i].value - 1);
const percent = (share) => `${number(Math.abs(100 * share), 2)} % ${share < 0 ? 'lower' : 'higher'}`;

/** Whether the ways to read the profile agree, in words. */
function verdict(result, readings) {
  const chosen = readings.find((reading) => reading.chosen);
  const others = readings.filter((reading) => reading !== chosen &&
    reading.pair.every((entry) => isNumber(entry?.value)));
  if (!chosen || !others.length) return [];
  const visible = 0.02;
  const far = others.filter((other) => changeOf(other, chosen).some((d) => Math.abs(d) > visible));
  if (!far.length) {
    return [prose(el('b', {}, 'All ways to read the profile agree'), ` within ${100 * visible} %.`)];
  }
  const names = Object.keys(result.coefficients).map((key) => nameAndUnit(key).name);
  const items = alike(far).map(({ of, names: also }) => {
    const change = changeOf(of, chosen);
    return el('li', {}, el('b', {}, sentence(also.join('; the same numbers: '))), ': ', symbol(names[0]), ` ${percent(change[0])}, `,
      symbol(names[1]), ` ${percent(change[1])}. `, whyDifferent(of, chosen, result));
  });
  return [prose('The numbers come from ', el('b', {}, chosen.name), '. Other ways to read the same profile give other ' +
    'coefficients:'), el('ul', { class: 'reasons plain' }, items)];
}

/** Answers that give the same numbers, told once. */
function alike(list) {
  const told = [];
  for (const other of list) {
    const same = told.find(({ of }) => changeOf(other, of).every((d) => Math.abs(d) < 1e-3));
    if (same) same.names.push(other.name); else told.push({ of: other, names: [other.name] });
  }
  return told;
}

function whyDifferent(other, chosen, result) {
  if (other.model === 'imprint' && chosen.model === 'envelope') {
    return 'The linear answer assumes that each point of the wall is the mark of one tooth. On a real wall the ' +
      'cutter springs back and later cuts a part of this mark away. So the linear answer is wrong for a real profile.';
  }
  if (other.model === 'envelope' && chosen.model === 'imprint') {
    return 'A machined wall is the envelope of many marks. If these readings come from a machined wall, ' +
      'set model = "envelope".';
  }
  if (other.feedback && other.feedback !== 'none' && result.feedback === 'none') {
    const counts = 'It includes that the deflection makes the cut smaller';
    if (result.with_runout) return `${counts}, but it has no runout.`;
    if (other.rms_mm > 1.5 * chosen.rms_mm) {
      return `${counts}, but it fits much worse: ${fixed(micro(other.rms_mm), 3)} against ${
        fixed(micro(chosen.rms_mm), 3)} µm rms. The readings speak against it.`;
    }
    return `${counts}. If the wall deflects by a visible fraction of the radial depth, set feedback in the case.`;
  }
  if (result.with_runout) {
    return 'It fits the means only, and runout changes the mean of a real wall.';
  }
  if (!isNumber(other.eccentricity_mm)) return '';
  const counts = 'It fits the runout together with the coefficients';
  return chosen.feedback === 'none' ? `${counts}.` :
    `${counts}, but it has no feedback. Runout changes the mean of a real wall.`;
}

function combinationPart(result, keys) {
  const { combination } = result;
  const { value, low, high } = combination.value_MPa || {};
  return section('combination', 'What is still known', 'Known',
    prose('The two coefficients cannot be determined separately, but one combination of them is known: ', el('b', {},
      `${number(combination.K_tc_weight, 3)} `, symbol(nameAndUnit(keys[0] || 'K_tc').name),
      ` + ${number(combination.K_rc_weight, 3)} `, symbol(nameAndUnit(keys[1] || 'K_rc').name),
      ` = ${number(value, 4)} MPa`), isNumber(high - low) ?
      ` (95 %: ${number(low, 4)} to ${number(high, 4)})` : '', '.'));
}

/** The first of every place, the second of every place, and so on. */
function inTurn(along, by) {
  const places = new Map();
  const order = by.map((_, i) => i).sort((a, b) => by[a] - by[b]);
  for (const i of order) places.set(along[i], [...(places.get(along[i]) || []), i]);
  const most = Math.max(...[...places.values()].map((rows) => rows.length));
  if (most > places.size) return [[1, order]];
  return Array.from({ length: most }, (_, k) => [k + 1,
    [...places.values()].map((rows) => rows[k]).filter((i) => i !== undefined)]);
}

/** Rows in groups along the axis that tells more: means over the height, or over the feed. */
function meansLayout(t) {
  const feed = columnNamed(t, 'feed_mm');
  const height = columnNamed(t, 'height_mm');
  const count = (values) => new Set(values).size;
  const tall = count(height) >= count(feed) || count(height) > 8;
  const [along, by] = tall ? [height, feed] : [feed, height];
  const groups = new Map();
  by.forEach((v, i) => groups.set(v, [...(groups.get(v) || []), i]));
  const useful = groups.size <= t.drawn / 3;
  const lists = useful ? [...groups].sort((a, b) => a[0] - b[0]) : inTurn(along, by);
  return { tall, along, numbered: !useful, groups: lists.map(([value, rows]) =>
    ({ value, rows: rows.sort((a, b) => along[a] - along[b]) })) };
}

/** The fit to single readings as means of fitted.csv; nothing where their readings are not told apart. */
function jointMeans(report, reading, means) {
  const t = tableNamed(report, 'residual.csv');
  if (!isNumber(reading.eccentricity_mm) || !t || t.drawn < t.rows) return null;
  const [height, fitted, was, x] = ['height_mm', 'fitted_mm', 'measured_mm', report.result.model === 'quasi_static' ?
    'feed_mm' : 'x_mm'].map((name) => columnNamed(t, name));
  const [heights, count, mean, from] = ['height_mm', 'readings', 'mean_mm', 'feed_mm'].map((name) =>
    columnNamed(means, name));
  const out = heights.map(() => null);
  let off = 0;
  for (const h of new Set(heights)) {
    const order = height.map((_, i) => i).filter((i) => height[i] === h).sort((a, b) => x[a] - x[b]);
    const rows = heights.map((_, i) => i).filter((i) => heights[i] === h).sort((a, b) => from[a] - from[b]);
    for (const row of rows) {
      const own = order.splice(0, count[row]);
      const average = (values) => own.reduce((sum, i) => sum + values[i], 0) / own.length;
      out[row] = average(fitted);
      off = Math.max(off, Math.abs(average(was) - mean[row]));
    }
  }
  return off < 1e-5 ? out : null;  // mm; else these are not the readings of each mean
}

function meansSection(report, readings) {
  const t = tableNamed(report, 'fitted.csv');
  const mean = columnNamed(t, 'mean_mm');
  if (!mean?.length) return null;
  const { tall, along, groups, numbered } = meansLayout(t);
  const of = (values, rows) => rows.map((i) => micro(values[i]));
  const xOf = (group) => group.rows.map((i) => along[i]);
  const fits = readings.map((reading) => ({ ...reading, values: columnNamed(t, reading.column) ||
    jointMeans(report, reading, t) })).filter((reading) => reading.values)
    .sort((a, b) => Number(b.chosen) - Number(a.chosen));
  const chart = figure({ key: 'means', points: true, x: xOf(groups[0]), unit: 'mm', caption: zoomHint + thinned(t),
    label: tall ? 'height above the tip' : 'travel along the feed' });
  const state = { group: groups[0] };
  const draw = (group = state.group) => {
    state.group = group;
    const few = group.rows.length < 80;
    // Answers often lie on one another: the later ones are thinner and broken.
    const curves = fits.map((fit, i) => ({ name: fit.name, color: fit.color, width: [3.4, 2.2, 1.6, 1.4][Math.min(i, 3)],
      dash: [undefined, [9, 5], [3, 4], [1, 5]][Math.min(i, 3)], values: of(fit.values, group.rows) }));
    chart.draw([
      { label: 'error', unit: 'µm', height: 250, series: [
        { name: 'measured mean', color: '--ink', line: false, points: few ? 7 : 4,
          values: of(mean, group.rows) }, ...curves] },
      { label: 'measured less fitted', unit: 'µm', height: 130, series: curves.map((curve) => ({ ...curve,
        points: few ? 5 : 3, width: 1,
        values: curve.values.map((v, k) => micro(mean[group.rows[k]]) - v) })) },
    ], xOf(group));
  };
  const text = `${tall ? 'The points are means over whole turns of the feed at each height.' : 'The points are measured means along the feed.'} ` +
    `Each curve is one way to read the profile.${fits.some((fit) => fit.chosen) ? ' The first curve is the answer that counts.' : ''}`;
  const place = numbered ? 'Mean' : tall ? 'Travel [mm]' : 'Height [mm]';
  chart.controls.append(...[choice(place, groups.map((group) => ({ value: group,
    text: number(group.value, 5) })), state.group, draw)].filter(Boolean));
  const part = section('means', 'Measured and fitted', 'Fit', prose(text, !report.result.with_runout ? null :
    fits.some((fit) => fit.chosen) ? ' The answer that counts has runout and is a fit to single readings. Its curve shows their ' +
      'means. The residuals of the single readings are below.' :
      ' The answer that counts has runout and is a fit to single readings. It is not drawn here. Its residuals are below.'),
  chart.element);
  return { part, draw: () => draw() };
}

/** Residuals of single readings, one colour a tooth. */
function readingResiduals(report) {
  const t = tableNamed(report, 'residual.csv');
  const residual = columnNamed(t, 'residual_mm');
  if (!residual?.length) return null;
  const tooth = columnNamed(t, 'tooth') || residual.map(() => 0);
  const teeth = [...new Set(tooth)].sort((a, b) => a - b);
  const chart = figure({ key: 'readings', points: true, x: [0, 1], unit: 'mm', label: 'height, or travel along the feed',
    caption: zoomHint + thinned(t) });
  const draw = (column) => {
    const along = columnNamed(t, column);
    const order = along.map((_, i) => i).sort((a, b) => along[a] - along[b]);
    const size = residual.length > 2000 ? 2.5 : residual.length > 300 ? 4 : 6;
    const series = teeth.map((k) => ({ name: k > 0 ? `tooth ${k}` : 'tooth not known',
      color: k > 0 ? seriesColor(k - 1) : '--s6', line: false, points: size,
      values: order.map((i) => (tooth[i] === k ? micro(residual[i]) : null)) }));
    chart.draw([{ label: 'measured less fitted', unit: 'µm', height: 220, series }],
      order.map((i) => along[i]));
    chart.element.querySelector('figcaption').firstChild.textContent =
      column === 'height_mm' ? 'height above the tip [mm]' : 'travel along the feed [mm]';
  };
  const options = [['height_mm', 'the height'], ['feed_mm', 'the feed']]
    .filter(([name]) => new Set(columnNamed(t, name)).size > 1);
  const start = options[0]?.[0] || 'height_mm';
  chart.controls.append(...[choice('Over', options.map(([value, text]) => ({ value, text })), start, draw)]
    .filter(Boolean));
  const joint = isNumber(report.result.runout?.eccentricity_mm);
  const part = section('residuals', 'Residuals: what stays unexplained', 'Residuals',
    prose('Every reading minus the value of the ', joint ? 'fit with runout' : 'chosen answer', ' there. ' +
      'Only noise should be left. A slope or a bow over the height is a sign of a wrong datum or a wrong stiffness. ' +
      'Teeth that lie apart are a sign of runout', joint ? ' that is not an eccentricity.' : '.'),
    chart.element);
  return { part, draw: () => draw(start) };
}

function answersTable(result, readings, keys) {
  if (!readings.length) return null;
  const rows = keys.map((key, k) => {
    const { name, unit } = nameAndUnit(key);
    return [[symbol(name), el('small', {}, unit)], ...readings.map(({ pair }) => {
      if (!isNumber(pair[k]?.value)) return missing;
      const width = half(pair[k]);
      return [measured(pair[k].value, width), isNumber(width) ?
        el('small', {}, `± ${measured(width, width)}`) : null];
    })];
  });
  const row = (name, unit, value) => {
    const cells = readings.map((reading) => value(reading) ?? missing);
    if (cells.some((cell) => cell !== missing)) {
      rows.push([[name, unit ? el('small', {}, unit) : null], ...cells]);
    }
  };
  const answered = readings.filter(({ pair }) => pair.some((entry) => isNumber(entry?.value)));
  row('correlation', '', ({ correlation }) => fixed(correlation, 3));
  row('condition number', '', ({ condition }) => (isNumber(condition) ? number(condition, 3) : null));
  row('rank', '', ({ rank }) => (isNumber(rank) ? number(rank) : null));
  const left = (rms) => (isNumber(rms) ? fixed(micro(rms), 3) : null);
  row('left, means', 'µm rms', ({ rms_mm: rms, rank }) => (isNumber(rank) ? left(rms) : null));
  row('left, all readings', 'µm rms', ({ rms_mm: rms, rank }) => (isNumber(rank) ? null : left(rms)));
  const noted = readings.filter(({ message }) => message);
  const best = readings.findIndex(({ chosen }) => chosen);
  return section('answers', 'The answers side by side', 'Answers',
    prose('One column for each way to read the same readings.', best >= 0 && answered.length ?
      [' The shaded column counts: ', el('b', {}, readings[best].name), '.'] : null),
    table(['± 95 %', ...readings.map(({ name }) => name)], rows,
      { class: 'fits', chosen: best >= 0 && answered.length ? 1 + best : undefined }),
    noted.length ? el('ul', { class: 'reasons' }, noted.map(({ name, message }) =>
      el('li', {}, el('b', {}, `${sentence(name)}: `), message))) : null);
}
