// The page of `identify`.

const identifyKnown = ['fits', 'chosen', 'signal'];

function identifyPage(report) {
  const { result } = report;
  const fits = Array.isArray(result.fits) ? result.fits : [];
  const best = fits.find((fit) => fit.chip_model === result.chosen) ||
    fits.find((fit) => fit.ok !== false);
  const measured = measuredOverAngle(report, fits, best);
  return [
    { lead: best ? headline(best, fits) : null },
    { part: best ? coefficientSection(best) : null },
    ...measured,
    { part: fitsSection(fits, best) },
    sweepSection(report, best),
    chipSection(report),
    { part: isEmpty(result.signal) ? null : section('signal', 'The measured signal', 'Signal',
      described(result.signal)) },
    { part: restSection(result, identifyKnown) },
  ];
}

const coefficientsOf = (fit) => Object.entries(fit?.coefficients || {});
const numbersOf = (list) => [list].flat().map((entry) => entry?.value ?? entry);

/** The reason why a quantity has no number: a text, or an object that holds one. */
function reasonOf(fit, key) {
  const entry = fit?.identifiable?.[key] ?? fit?.identifiable?.[nameAndUnit(key).name];
  if (typeof entry === 'string') return entry;
  return entry?.reason || entry?.message || (entry === false ? 'cannot be told apart' : '');
}

function headline(fit, fits) {
  const runout = runoutWords(fit.runout);
  const [key, main] = coefficientsOf(fit).find(([, entry]) => entry) || [];
  const spread = spreadOf(fit.runout);
  const phases = numbersOf(fit.phase_deg ?? []).filter(isNumber);
  return [
    tiles([
      main && { label: [symbol(nameAndUnit(key).name), ` ${meanings[nameAndUnit(key).name] || ''}`],
        value: measured(main.value, half(main)),
        unit: nameAndUnit(key).unit, note: known(main).text },
      { label: 'Runout between teeth', value: spread, unit: 'µm', digits: 3,
        note: fit.runout?.eccentricity_mm ? 'off centre' : null },
      { label: 'Residual of the fit', value: fit.rms_N, unit: 'N rms', digits: 3,
        note: comparison(fit, fits) },
      phases.length && { label: 'Phase', value: phases.map((p) => number(p)).join('°, ') + '°',
        note: 'tip of tooth 1 ahead of the recorded angle' },
    ]),
    runout ? prose('Runout: ', runout, '.') : null,
  ];
}

/** Largest difference of the radii in micrometres, or the eccentricity. */
function spreadOf(runout) {
  const r = runout?.radial_offsets_mm?.filter(isNumber) || [];
  if (r.length > 1 && r.some((x) => x !== r[0])) return 1000 * (Math.max(...r) - Math.min(...r));
  return runout?.eccentricity_mm ? 1000 * runout.eccentricity_mm : undefined;
}

/** How the chosen fit compares with the worst of the others. */
function comparison(fit, fits) {
  const others = fits.filter((other) => other !== fit && isNumber(other.rms_N));
  const worst = others.sort((a, b) => b.rms_N - a.rms_N)[0];
  if (!worst || !isNumber(fit.rms_N) || worst.rms_N <= fit.rms_N) return null;
  const less = 100 * (1 - fit.rms_N / worst.rms_N);
  return `${number(less, 2)} % less than ${modelName(worst.chip_model)}`;
}

const half = (entry) => (isNumber(entry?.high - entry?.low) ? (entry.high - entry.low) / 2 : null);

/** How well a coefficient is known: the half width of its interval against its value. */
function known(entry) {
  const width = half(entry);
  if (!isNumber(width) || !entry.value) return { text: missing, level: 0 };
  const relative = Math.abs(width / entry.value);
  const level = relative <= 0.02 ? 4 : relative <= 0.1 ? 3 : relative <= 0.5 ? 2 : 1;
  const word = ['', 'hardly', 'roughly', 'well', 'very well'][level];
  return { text: `${word}: ± ${number(100 * relative, 2)} %`, level };
}

function meter(level) {
  return el('span', { class: 'meter', 'aria-hidden': 'true' },
    [1, 2, 3, 4].map((i) => el('i', { class: i <= level ? 'on' : '' })));
}

function coefficientSection(fit) {
  const rows = coefficientsOf(fit).map(([key, entry]) => {
    const { name, unit } = nameAndUnit(key);
    const head = [symbol(name), meanings[name] ? el('small', {}, meanings[name]) : null];
    if (!isNumber(entry?.value)) {
      return [head, missing, missing, el('span', { class: 'reason' },
        reasonOf(fit, key) || 'not identifiable')];
    }
    const width = half(entry);
    const how = known(entry);
    return [head,
      [el('b', {}, measured(entry.value, width)), ` ${unit}`],
      `${measured(entry.low, width)} to ${measured(entry.high, width)}`,
      [meter(how.level), how.text]];
  });
  if (!rows.length) return null;
  return section('coefficients', 'Cutting coefficients', 'Coefficients',
    prose('From the fit with the chip model ', el('b', {}, modelName(fit.chip_model)),
      fit.lookback ? ` (looking back at ${fit.lookback === 'all' ? 'all earlier teeth' :
        'the previous tooth only'})` : '', '.'),
    table(['', 'value', '95 % interval', 'how well it is known'], rows, { class: 'coefficients' }),
    offsetTable(fit));
}

function offsetTable(fit) {
  const offsets = fit.runout?.radial_offsets_mm;
  if (!Array.isArray(offsets) || offsets.length < 2) return null;
  const um = offsets.map((r) => 1000 * r);
  const se = fit.runout.radial_offsets_se_mm || [];
  const largest = Math.max(...um.map(Math.abs)) || 1;
  return el('details', { class: 'offsets', open: offsets.length <= 8 ? '' : undefined },
    el('summary', {}, 'Radius of each tooth against tooth 1'),
    el('ol', { class: 'bars' }, um.map((r, i) => {
      const bar = el('span', { class: 'bar' });
      bar.style.left = `${50 + Math.min(0, 50 * r / largest)}%`;
      bar.style.width = `${Math.abs(50 * r / largest)}%`;
      return el('li', {}, el('b', {}, `Tooth ${i + 1}`), el('span', { class: 'track' }, bar),
        el('span', { class: 'text' }, `${number(r, 3)} µm`,
          isNumber(se[i]) && i > 0 ? el('small', {}, `standard error ${number(1000 * se[i], 2)} µm`) : null));
    })));
}

/** The models whose curves a table holds, in its order: `Fx_feed_N` -> feed. */
function modelsOf(t) {
  const found = (t?.columns || []).map(({ name }) => /^Fx_(.+)_N$/.exec(name)?.[1]);
  return found.filter((model) => model && model !== 'measured');
}

/** Rows of one run; without a column `run` all rows belong to the only one. */
function rowsOfRun(t, run) {
  const runs = columnNamed(t, 'run');
  const of = (values) => (runs ? values.filter((_, i) => runs[i] === run) : values);
  return (name) => {
    const values = columnNamed(t, name);
    return values && of(values);
  };
}

function measuredOverAngle(report, fits, best) {
  const fitted = tableNamed(report, 'fitted.csv');
  const residual = tableNamed(report, 'residual.csv');
  if (!fitted?.drawn) return [];
  const models = modelsOf(fitted);
  const runs = [...new Set(columnNamed(fitted, 'run') || [1])];
  const state = { run: runs[0], model: models.includes(best?.chip_model) ? best.chip_model : models[0] };
  const x = rowsOfRun(fitted, state.run)('angle_deg');
  const base = { key: 'angle', x, label: 'φ, recorded spindle angle', unit: '°' };
  const forces = figure({ ...base, caption: zoomHint + thinned(fitted) });
  const left = residual?.drawn ? figure({ ...base, caption: thinned(residual) }) : null;
  const redraw = () => {
    drawForces(forces, rowsOfRun(fitted, state.run), state.model, models);
    if (left) drawResiduals(left, rowsOfRun(residual, state.run), state.model);
  };
  const pick = (name) => (value) => { state[name] = value; redraw(); };
  const range = rangeChoice(forces, x);
  if (left) left.range = forces.range;
  forces.controls.append(...[
    choice('Chip model', models.map((m) => ({ value: m, text: modelName(m) })), state.model, pick('model')),
    choice('Run', runs.map((r) => ({ value: r, text: number(r) })), state.run, pick('run')),
    range].filter(Boolean));
  if (left) range?.addEventListener('click', () => left.zoom(forces.range));
  const parts = [{ part: section('forces', 'Measured and fitted force', 'Forces',
    prose('Force on the tool. Grey is what was measured, the coloured line what the fit computes.'),
    forces.element), draw: redraw }];
  if (left) {
    parts.push({ part: section('residuals', 'What the fit leaves unexplained', 'Residuals',
      prose('Measured minus fitted, on one scale. Only noise should be left; a pattern that repeats ' +
        'with the teeth tells of something that the model does not know.'), left.element) });
  }
  return parts;
}

function drawForces(chart, values, model, models) {
  const color = modelColor(model, models.indexOf(model));
  chart.draw(forcePanels((axis) => [
    { name: 'measured', values: values(`F${axis}_measured_N`), color: '--measured', width: 2.2 },
    { name: modelName(model), values: values(`F${axis}_${model}_N`), color, width: 1.6 },
  ].filter((series) => series.values)), values('angle_deg'));
}

function drawResiduals(chart, values, model) {
  const panels = forcePanels((axis) => [{
    name: '', values: values(`F${axis}_${model}_N`), color: '--s6', width: 1,
  }].filter((series) => series.values));
  const all = panels.flatMap(({ series }) => series[0].values.filter(isNumber));
  const [low, high] = paddedRange(null, all.reduce((a, b) => Math.min(a, b), 0),
    all.reduce((a, b) => Math.max(a, b), 0));
  chart.draw(panels.map((panel) => ({ ...panel, height: 100, range: () => [low, high] })),
    values('angle_deg'));
}

/** The fits side by side, as in Table 1 of the paper that the method is from. */
function fitsSection(fits, best) {
  if (!fits.length) return null;
  const keys = [...new Set(fits.flatMap((fit) => Object.keys(fit.coefficients || {})))];
  const rows = keys.map((key) => {
    const { name, unit } = nameAndUnit(key);
    return [[symbol(name), el('small', {}, unit)], ...fits.map((fit) => {
      const entry = fit.coefficients?.[key];
      if (!isNumber(entry?.value)) return missing;
      const width = half(entry);
      return [measured(entry.value, width),
        isNumber(width) ? el('small', {}, `± ${measured(width, width)}`) : null];
    })];
  });
  const row = (name, unit, value) => {
    const cells = fits.map((fit) => value(fit));
    if (cells.some((cell) => cell !== missing && cell !== null)) {
      rows.push([[name, unit ? el('small', {}, unit) : null], ...cells.map((cell) => cell ?? missing)]);
    }
  };
  row('runout', 'µm', (fit) => fixed(spreadOf(fit.runout), 3));
  row('phase', '°', (fit) => numbersOf(fit.phase_deg ?? []).filter(isNumber).map((p) => number(p)).join(', ') || missing);
  row('residual', 'N rms', (fit) => rmsCell(fit, fits));
  axesOfForce.forEach((axis, i) => row(['residual ', forceName(axis)], 'N rms',
    (fit) => fixed(fit.rms_axis_N?.[i], 3)));
  row('condition', '', (fit) => fixed(fit.condition, 3));
  const answered = fits.some((fit) => isNumber(fit.rms_N));
  const failed = fits.filter((fit) => fit.ok === false && fit.message);
  return section('fits', 'The chip models side by side', 'Fits',
    prose('The same record, fitted with every chip model. Where tools run out, simple models put the ' +
      'runout into the coefficients.'),
    answered ? table(['', ...fits.map((fit) => modelName(fit.chip_model))], rows,
      { class: 'fits', chosen: best ? 1 + fits.indexOf(best) : undefined }) : null,
    failed.length ? el('ul', { class: 'reasons' }, failed.map(reasonsOf)) : null,
    answered ? el('p', { class: 'small' }, '± is the half width of the 95 % interval. Residual: ' +
      'square root of the mean of |ΔF|² over all samples, ΔF taken as a vector.') : null);
}

/** Why a fit has no answer, and which quantities it could not tell apart. */
function reasonsOf(fit) {
  const each = Object.keys(fit.identifiable || {}).map((key) => [key, reasonOf(fit, key)])
    .filter(([, reason]) => reason);
  return el('li', {}, el('b', {}, `${sentence(modelName(fit.chip_model))}: `), fit.message,
    each.length ? el('ul', {}, each.map(([key, reason]) =>
      el('li', {}, symbol(nameAndUnit(key).name), ': ', reason))) : null);
}

function rmsCell(fit, fits) {
  if (!isNumber(fit.rms_N)) return missing;
  const largest = Math.max(...fits.map((other) => other.rms_N || 0));
  const bar = el('span', { class: 'fill' });
  bar.style.width = `${100 * fit.rms_N / largest}%`;
  return [el('b', {}, fixed(fit.rms_N, 3)), el('span', { class: 'underbar' }, bar)];
}

function sweepSection(report, best) {
  const sweep = tableNamed(report, 'sweep.csv');
  const x = columnNamed(sweep, 'offset_um');
  if (!x?.length) return null;
  const models = sweep.columns.map(({ name }) => /^rms_(.+)_N$/.exec(name)?.[1]).filter(Boolean);
  const chart = figure({ key: 'offset', x, label: 'offset of tooth 2', unit: 'µm', caption: zoomHint });
  const found = best?.runout?.radial_offsets_mm;
  const at = found?.length > 1 ? 1000 * (found[1] - found[0]) : null;
  const part = section('sweep', 'How sharply the record tells the runout', 'Sweep',
    prose('What the fit leaves when the radius of tooth 2 is held at each value and the coefficients are ' +
      'fitted again. A deep, narrow valley means that the runout is well known.'), chart.element);
  const panel = {
    label: 'residual', unit: 'N rms', height: 240,
    series: models.map((model, i) => ({
      name: modelName(model), values: columnNamed(sweep, `rms_${model}_N`),
      color: modelColor(model, i), width: 2,
    })),
    markers: isNumber(at) ? [{ x: at, text: `found: ${number(at, 3)} µm` }] : [],
  };
  return { part, draw: () => chart.draw([panel]) };
}
