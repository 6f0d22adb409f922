// Measured force against computed force: of fits, and of simulations.

/** The models whose curves a table holds, in its order: `Fx_feed_N` -> feed. */
function modelsOf(t) {
  const found = (t?.columns || []).map(({ name }) => /^F[xyz]_(.+)_N$/.exec(name)?.[1]);
  return [...new Set(found)].filter((model) => model && model !== 'measured');
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

/**
 * words: {heading, short, text, model, bandOf}; model: the one that is shown first; bandOf(model):
 * how many harmonics its fit counts, 0: all.
 */
function measuredOverAngle(report, words) {
  const fitted = tableNamed(report, 'fitted.csv');
  const residual = tableNamed(report, 'residual.csv');
  if (!fitted?.drawn) return [];
  const models = modelsOf(fitted);
  const runs = [...new Set(columnNamed(fitted, 'run') || [1])];
  const bandOf = words.bandOf || (() => 0);
  const state = { run: runs[0], model: models.includes(words.model) ? words.model : models[0] };
  const x = rowsOfRun(fitted, state.run)('angle_deg');
  const base = { key: 'recorded', x, label: 'φ, recorded spindle angle', unit: '°' };
  const forces = figure({ ...base, caption: zoomHint + thinned(fitted) });
  const left = residual?.drawn ? figure({ ...base, caption: thinned(residual) }) : null;
  const redraw = () => {
    drawForces(forces, rowsOfRun(fitted, state.run), state.model, models);
    if (left) drawResiduals(left, rowsOfRun(residual, state.run), state.model, bandOf(state.model));
  };
  const pick = (name) => (value) => { state[name] = value; redraw(); };
  const both = [forces, left].filter(Boolean);
  forces.controls.append(...[
    choice('Chip model', models.map((m) => ({ value: m, text: modelName(m) })), state.model, pick('model')),
    choice('Run', runs.map((r) => ({ value: r, text: number(r) })), state.run, pick('run')),
    rangeChoice(both, x)].filter(Boolean));
  const parts = [{ part: section('measured', words.heading, words.short,
    prose(words.text), forces.element), draw: redraw }];
  if (left) {
    parts.push({ part: section('residuals', 'Residuals: what stays unexplained', 'Residuals',
      prose('Measured minus computed, all on the same scale. Only noise should be left. A pattern that ' +
        'repeats with the teeth is a sign of something that the model does not contain.', bandWords(bandOf(state.model))),
      left.element) });
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

/** What grey and coloured lines of the residuals are where the fit counts a band only. */
const bandWords = (band) => (band ? ` The fit uses the mean and the first ${band} harmonics of a turn. The coloured ` +
  'line is their residual. Grey is the residual of everything.' : '');

function drawResiduals(chart, values, model, band) {
  const angle = values('angle_deg');
  const panels = forcePanels((axis) => {
    const whole = values(`F${axis}_${model}_N`);
    const counted = whole && band ? inBand(angle, whole, band) : null;
    return counted ? [
      { name: 'everything', values: whole, color: '--measured', width: 1 },
      { name: `mean and first ${band} harmonics`, values: counted, color: '--s6', width: 1.8 },
    ] : [{ name: '', values: whole, color: '--s6', width: 1 }].filter((series) => series.values);
  });
  const all = panels.flatMap(({ series }) => series[0].values.filter(isNumber));
  const [low, high] = paddedRange(null, all.reduce((a, b) => Math.min(a, b), 0),
    all.reduce((a, b) => Math.max(a, b), 0));
  chart.draw(panels.map((panel) => ({ ...panel, height: 100, range: () => [low, high] })), angle);
}

/** The whole records as they came, and which part of each was used. */
function overviewSection(report) {
  const overview = tableNamed(report, 'overview.csv');
  if (!overview?.drawn) return null;
  const runs = [...new Set(columnNamed(overview, 'run') || [1])];
  const timed = Boolean(columnNamed(overview, 'time_s'));
  const at = (run) => rowsOfRun(overview, run)(timed ? 'time_s' : 'turn');
  const panelsOf = (run) => {
    const values = rowsOfRun(overview, run);
    const used = values('used');
    const first = used.indexOf(1);
    const last = used.lastIndexOf(1);
    const marks = first > 0 || last < used.length - 1 ?
      [{ x: at(run)[first], text: 'used from here' }, { x: at(run)[last], text: 'to here' }] : [];
    return [1, 2, 3].map((c) => ({ low: values(`channel${c}_low_N`), high: values(`channel${c}_high_N`), c }))
      .filter(({ low }) => low).map(({ low, high, c }, i) => ({
        label: `channel ${c}`, unit: 'N', height: 100, color: seriesColor(c - 1),
        series: [{ name: 'largest', values: high, color: seriesColor(c - 1), width: 1 }],
        band: { low, high, name: 'smallest to largest reading' },
        markers: marks.map((m) => (i ? { ...m, text: '' } : m)),
      }));
  };
  const chart = figure({ key: 'record', x: at(runs[0]), label: timed ? 'time' : 'turn of the spindle, as stated',
    unit: timed ? 's' : '', caption: zoomHint });
  const draw = (run) => chart.draw(panelsOf(run), at(run));
  chart.controls.append(...[choice('Run', runs.map((r) => ({ value: r, text: number(r) })),
    runs[0], draw)].filter(Boolean));
  const part = section('overview', 'The whole record and its used part', 'Record',
    prose('These are the channels of the file. The fit uses the part between the dashed lines. Without dashed lines it uses the whole record.'),
    chart.element);
  return { part, draw: () => draw(runs[0]) };
}

/** "5 revolutions laid over each other. " */
function turnWords(turns, runs) {
  const counts = [turns ?? []].flat();
  if (counts.length !== runs.length) return 'All revolutions are laid over each other. ';
  const of = counts.length > 1 ? ` of run ${runs.join(', ')}` : '';
  return [el('b', {}, `${counts.join(', ')} revolutions`), `${of} are laid over each other. `];
}

/** One revolution: the mean of all, and how far single ones scatter around it. */
function foldedSection(report) {
  const folded = tableNamed(report, 'folded.csv');
  if (!folded?.drawn) return null;
  const runs = [...new Set(columnNamed(folded, 'run') || [1])];
  const panelsOf = (run) => {
    const values = rowsOfRun(folded, run);
    return forcePanels((axis) => [
      { name: 'mean', values: values(`F${axis}_mean_N`), axis, color: '--s1', width: 1.6 },
    ].filter((series) => series.values)).map((panel) => {
      const mean = panel.series[0].values;
      const sd = values(`F${panel.series[0].axis}_sd_N`) || mean.map(() => 0);
      return { ...panel, height: 110, band: {
        low: mean.map((f, k) => f - sd[k]), high: mean.map((f, k) => f + sd[k]),
        name: 'mean ± standard deviation' } };
    });
  };
  const angle = (run) => rowsOfRun(folded, run)('angle_deg');
  const chart = figure({ key: 'turn', x: angle(runs[0]), label: 'φ, recorded spindle angle',
    unit: '°', caption: zoomHint });
  const draw = (run) => chart.draw(panelsOf(run), angle(run));
  chart.controls.append(...[choice('Run', runs.map((r) => ({ value: r, text: number(r) })),
    runs[0], draw)].filter(Boolean));
  const part = section('folded', 'How well revolutions repeat', 'Revolutions',
    prose(turnWords(report.result.signal?.revolutions, runs), 'A wide band is a sign of noise, of chatter or of a spindle ' +
      'speed that drifts.'), chart.element);
  return { part, draw: () => draw(runs[0]) };
}
