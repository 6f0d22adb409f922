// The page of `identify`.

const identifyKnown = ['fits', 'chosen', 'groups', 'clocking', 'signal', 'do_not_use', 'verdict',
  'with_care', 'runout_form', 'views', 'curves', 'covariance'];

function identifyPage(report) {
  const { result } = report;
  const fits = Array.isArray(result.fits) ? result.fits : [];
  const best = fits.find((fit) => fit.chip_model === result.chosen) ||
    fits.find((fit) => fit.ok !== false);
  const trust = trustIn(report);
  const curves = measuredOverAngle(report, {
    heading: 'Measured and fitted force', short: 'Forces', model: best?.chip_model,
    bandOf: (model) => fits.find((fit) => fit.chip_model === model)?.band_harmonics || 0,
    text: 'Force on the tool. Grey: measured. Coloured: computed by the fit.' +
      (result.curves === 'mean turn' ? ' The records are long, so the curves are the mean of all turns. ' +
        'identify --curves keeps every sample.' : ''),
  });
  return [
    { lead: best ? headline(best, fits, trust) : null },
    { part: best ? coefficientSection(best, trust, result.groups?.[0]) : null },
    { part: result.clocking && trust ? clockingSection(result.clocking) : null },
    groupsSection(result.groups),
    { part: knownTogether(best) },
    { part: priorSection(best) },
    ...curves,
    ...channelCurves(report, best),
    { part: channelMeans(report, best) },
    overviewSection(report),
    foldedSection(report),
    { part: fitsSection(fits, best) },
    { part: formSection(result.runout_form) },
    { part: viewsSection(result.views, best) },
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
  return entry?.reason || entry?.message || (entry === false ? 'cannot be determined separately' : '');
}

/** How much of the force stays unexplained, else what is left in newtons. */
function residualTile(fit, fits) {
  const share = fit.unexplained_in_band;
  const rms = isNumber(fit.rms_N) ? fixed(fit.rms_N, 3) : null;
  if (!isNumber(share)) return { label: 'Residual of the fit', value: rms, unit: 'N rms', note: comparison(fit, fits) };
  return { label: fit.band_harmonics ? `Unexplained, mean and ${fit.band_harmonics} harmonics` : 'Unexplained of the force',
    value: number(100 * share, 2), unit: '% rms', note: [rms && `${rms} N`, comparison(fit, fits)].filter(Boolean).join('; ') };
}

function headline(fit, fits, trust) {
  const runout = runoutWords(fit.runout, fit.interval_factor);
  const [key, main] = coefficientsOf(fit).find(([, entry]) => entry) || [];
  const spread = spreadOf(fit.runout);
  const phases = numbersOf(fit.phase_deg ?? []).filter(isNumber);
  return [
    tiles([
      main && { label: [symbol(nameAndUnit(key).name), ` ${meanings[nameAndUnit(key).name] || ''}`],
        value: measured(main.value, half(main)),
        unit: nameAndUnit(key).unit, note: known(main, trust).text },
      { label: 'Runout between teeth', value: spread && fixed(spread, 3), unit: 'µm',
        note: spread && !trust ? 'do not use' : [fit.runout?.eccentricity_mm && 'off centre', runoutWidth(fit)].filter(Boolean).join('; ') },
      residualTile(fit, fits),
      phases.length && { label: 'Phase', value: phases.map((p) => number(p)).join('°, ') + '°',
        note: 'tip of tooth 1 ahead of the recorded angle' },
    ]),
    trust && runout ? prose('Runout: ', runout, '.') : null,
  ];
}

/** The interval of a runout of two teeth or of an eccentricity alone, in words. */
function runoutWidth({ runout, interval_factor: factor = normalInterval }) {
  const offsets = runout?.radial_offsets_mm || [];
  const se = offsets.some((r) => r !== offsets[0]) ? offsets.length === 2 && runout.radial_offsets_se_mm?.[1] : runout?.eccentricity_se_mm;
  return isNumber(se) && se > 0 ? `± ${number(1000 * factor * se, 2)} µm` : '';
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

/** The best that may be said of a coefficient: nothing, `roughly` of a poor fit, anything. */
function trustIn(report) {
  if (!isEmpty(report.result.do_not_use)) return 0;
  const poor = (report.warnings || []).some((warning) => warning.code === 'poor_fit');
  return poor ? 2 : 4;
}

/** How well a coefficient is known: half of its interval against its value. */
function known(entry, trust) {
  if (!trust) return { text: 'do not use', level: 0 };
  const width = half(entry);
  if (!isNumber(width) || !entry.value) return { text: missing, level: 0 };
  const relative = Math.abs(width / entry.value);
  if (relative >= 1) return { text: 'it may be zero', level: 0 };
  const level = Math.min(trust, relative <= 0.02 ? 4 : relative <= 0.1 ? 3 : relative <= 0.5 ? 2 : 1);
  const word = ['', 'hardly', 'roughly', 'well', 'very well'][level];
  return { text: `${word}: ± ${number(100 * relative, 2)} %`, level };
}

function meter(level) {
  return el('span', { class: 'meter', 'aria-hidden': 'true' },
    [1, 2, 3, 4].map((i) => el('i', { class: i <= level ? 'on' : '' })));
}

function coefficientSection(fit, trust, group) {
  const rows = coefficientsOf(fit).map(([key, entry]) => {
    const { name, unit } = nameAndUnit(key);
    const head = [symbol(name), meanings[name] ? el('small', {}, meanings[name]) : null];
    if (!isNumber(entry?.value)) {
      return [head, missing, missing, el('span', { class: 'reason' },
        reasonOf(fit, key) || 'not identifiable')];
    }
    const width = half(entry);
    const how = known(entry, trust);
    return [head,
      [el('b', {}, measured(entry.value, width)), ` ${unit}`],
      `${measured(entry.low, width)} to ${measured(entry.high, width)}`,
      [meter(how.level), how.text]];
  });
  if (!rows.length) return null;
  return section('coefficients', 'Cutting coefficients', 'Coefficients',
    prose(group ? ['Of ', el('b', {}, groupName(group)), '. '] : null,
      'From the fit with the chip model ', el('b', {}, modelName(fit.chip_model)),
      fit.lookback ? ` (looking back at ${fit.lookback === 'all' ? 'all earlier teeth' :
        'the previous tooth only'})` : '', '. ',
      fit.interval_widening > 1.2 ? `The intervals are ${number(fit.interval_widening, 2)} times as wide as for white noise, ` +
        'because the residual is more than white noise.' : null),
    table(['', 'value', '95 % interval', 'how well it is known, 95 %'], rows, { class: 'coefficients' }),
    offsetTable(fit));
}

function offsetTable(fit) {
  const offsets = fit.runout?.radial_offsets_mm;
  if (!Array.isArray(offsets) || offsets.length < 2 || offsets.every((r) => r === 0)) return null;
  const um = offsets.map((r) => 1000 * r);
  const se = fit.runout.radial_offsets_se_mm || [];
  const factor = fit.interval_factor || normalInterval;
  const largest = Math.max(...um.map(Math.abs)) || 1;
  return el('details', { class: 'offsets', open: offsets.length <= 8 ? '' : undefined },
    el('summary', {}, 'Radius of each tooth against tooth 1'),
    el('ol', { class: 'bars' }, um.map((r, i) => {
      const bar = el('span', { class: 'bar' });
      bar.style.left = `${50 + Math.min(0, 50 * r / largest)}%`;
      bar.style.width = `${Math.abs(50 * r / largest)}%`;
      return el('li', {}, el('b', {}, `Tooth ${i + 1}`), el('span', { class: 'track' }, bar),
        el('span', { class: 'text' }, isNumber(offsets[i]) ? `${i ? measured(r, 1000 * factor * se[i]) : '0'} µm` : 'not known',
          isNumber(se[i]) && i > 0 ? el('small', {}, `95 %: ± ${number(1000 * factor * se[i], 2)} µm`) : null));
    })));
}

/** What the eccentricity means for dial gauge and holder. */
function clockingSection(clocking) {
  const amount = (entry, factor, unit) => [
    el('b', {}, measured(factor * entry.value, factor * half(entry))), ` ${unit}`,
    el('small', {}, `± ${measured(factor * half(entry), factor * half(entry))}`)];
  const rows = [['total indicator reading', amount(clocking.total_indicator_reading_um, 1, 'µm'), ''],
    ['longest tooth', String(clocking.longest_tooth), `${number(clocking.height_mm)} mm above the tip`]];
  for (const [key, name] of [['tool', 'of the tool itself'], ['holder', 'of holder and spindle']]) {
    const part = clocking[key];
    if (part) {
      rows.push([name, amount(part.eccentricity_mm, 1000, 'µm'),
        `at ${number(part.angle_deg, 3)}° from tooth 1${key === 'holder' ? ' in its old position' : ''}`]);
    }
  }
  const advice = isNumber(clocking.best_turn_deg) ? prose('To get the least runout, turn the tool in its holder by ',
    el('b', {}, `${number(clocking.best_turn_deg, 3)}°`), ' from its position now (positive from tooth 1 ' +
    `towards tooth 2). Then ${number(1000 * clocking.least_eccentricity_mm, 2)} µm remain.`) : null;
  return section('clocking', 'At the machine', 'Dial gauge',
    prose('These are the readings of a dial gauge on a smooth shank at the height of the cut.'),
    table(['', '', ''], rows), advice);
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
  if (!fits[0].rms_axis_N) (fits[0].channels || []).forEach((channel, i) => row(['residual ', channel.axis], `${channel.unit} rms`,
    (fit) => fixed(fit.channels?.[i]?.rms, 3)));
  row('unexplained', 'of the force, rms', (fit) => (isNumber(fit.unexplained_in_band) ?
    `${number(100 * fit.unexplained_in_band, 2)} %` : null));
  row('condition number', '', (fit) => fixed(fit.condition, 3));
  const answered = fits.some((fit) => isNumber(fit.rms_N) || fit.channels?.length);
  const noted = fits.filter((fit) => (fit.ok === false && fit.message) ||
    Object.keys(fit.identifiable || {}).some((key) => reasonOf(fit, key)));
  return section('fits', 'The chip models side by side', 'Fits',
    prose('Each column is a fit of the same record with another chip model. If the tool has runout, a simple model puts ' +
      'the effect of the runout into the coefficients.'),
    answered ? table(['± 95 %', ...fits.map((fit) => modelName(fit.chip_model))], rows,
      { class: 'fits', chosen: best ? 1 + fits.indexOf(best) : undefined }) : null,
    noted.length ? el('ul', { class: 'reasons' }, noted.map(reasonsOf)) : null,
    answered ? el('p', { class: 'small' }, '± is the half width of the 95 % confidence interval. Residual: ' +
      'square root of the mean of |ΔF|², where ΔF is a vector', fits.some((fit) => fit.band_harmonics > 0) ?
      ', over the fitted harmonics. Unexplained: the residual as a fraction of the same harmonics of the force.' : ', over all samples.') : null);
}

/** Why a fit has no answer, and which quantities it could not tell apart, by reason. */
function reasonsOf(fit) {
  const byReason = new Map();
  for (const key of Object.keys(fit.identifiable || {})) {
    const reason = reasonOf(fit, key);
    if (!reason || reason === fit.message) continue;
    byReason.set(reason, [...(byReason.get(reason) || []), symbol(nameAndUnit(key).name)]);
  }
  const items = [...byReason].map(([reason, names]) => el('li', {},
    names.flatMap((name, i) => (i ? [', ', name] : [name])), ': ', reason));
  return el('li', {}, el('b', {}, `${sentence(modelName(fit.chip_model))}: `),
    fit.ok === false ? fit.message : null,
    items.length ? el('ul', {}, items) : null);
}

const formNames = { none: 'no runout', fixed: 'as given', offsets: 'radial offsets of the teeth',
  eccentricity: 'an eccentricity', both: 'an eccentricity and radial offsets' };

/** Which form of the runout, and how the others fared. */
function formSection(form) {
  if (!form?.why) return null;
  const tried = [form.tried ?? []].flat().filter((one) => isNumber(one.rms_N));
  const by = form.decided_by === 'record' ? 'The record decided: ' : 'The case asks for this form. ';
  return section('form', 'Which form of runout', 'Runout form',
    prose(by, form.decided_by === 'record' ? form.why : sentence(form.why), '.'),
    tried.length > 1 ? table(['form', 'residual, N rms', 'evidence against it'],
      tried.map((one) => [formNames[one.form] || one.form, fixed(one.rms_N, 4),
        one.form === form.better ? 'none' : number(one.excess, 3)]), { class: 'forms' }) : null,
    tried.length > 1 ? el('p', { class: 'small' }, 'Evidence: how much worse this form predicts further turns. ' +
      'The unit is what one more unknown explains by chance. Below 4 there is no evidence.') : null);
}

/** How the answer depends on which harmonics are fitted, and on the dynamometer. */
function viewsSection(views, best) {
  if (!Array.isArray(views) || views.length < 2) return null;
  const key = Object.keys(views[0]).find((name) => /^K_/.test(name));
  const found = Object.entries(best?.resonances || {}).filter(([, one]) => isNumber(one?.frequency_Hz))
    .map(([axis, one]) => `${number(one.frequency_Hz, 3)} Hz in ${axis} (damping ratio ${number(one.damping_ratio, 2)})`);
  return section('views', 'How far the answer depends on the dynamometer', 'Dynamometer',
    prose(found.length ?
      `The dynamometer rings at ${found.join(', ')}. The model of the first row contains this resonance, and the first row counts.` :
      'The residual repeats every turn, and no resonance explains it. So the fit uses every harmonic, and its intervals take the repetition into account.'),
    table(['harmonics', symbol(nameAndUnit(key).name), '95 % interval', 'unexplained of all'],
      views.map((view) => {
        const width = half(view[key]);
        return [`${view.band_harmonics ? `mean and first ${view.band_harmonics}` : 'all'}${
          view.resonance ? ', with the resonances' : ''}`,
        measured(view[key]?.value, width), isNumber(width) ?
          `${measured(view[key].low, width)} to ${measured(view[key].high, width)}` : missing,
        `${number(100 * view.unexplained, 2)} %`];
      }), { class: 'views', chosen: undefined }),
    el('p', { class: 'small' }, 'A band of few harmonics may have a narrow interval and a wrong value: ' +
      'below a resonance the dynamometer amplifies the force, and the coefficients contain this error.'));
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
  const part = section('sweep', 'How well the record determines the runout', 'Sweep',
    prose('The curve is the residual of a fit with a fixed radius of tooth 2. The coefficients are fitted again for each ' +
      'value. A deep, narrow valley means that the runout is well known.'), chart.element);
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
