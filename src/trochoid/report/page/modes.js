// The pages of `modes`, of one response or several, and `actuator`: what was measured, with the fit through it.

const modesKnown = ['kind', 'modes', 'lines', 'band_Hz', 'explained', 'description', 'orders',
  'noise', 'unresolved', 'hits'];
const actuatorKnown = ['gain', 'frequency_Hz', 'damping_ratio', 'time_constants_s', 'se',
  'identifiable', 'sum_s', 'product_s2', 'start_s', 'step_um', 'half_power_frequency_Hz',
  'low_frequency_delay_s', 'rise_time_10_90_s', 'rms_um', 'explained'];
const unitOfKind = { receptance: 'm/N', mobility: 'm/s/N', accelerance: 'm/s²/N' };
const unitOfFloor = { floor_m_per_N: 'm/N', floor_m_per_s_N: 'm/s/N', floor_m_per_s2_N: 'm/s²/N' };
const kindLabels = { receptance: 'receptance, displacement over force',
  mobility: 'mobility, velocity over force', accelerance: 'accelerance, acceleration over force' };

/** A value and half of its 95 % interval, to the digits that the interval leaves. */
const withError = (value, se) => (isNumber(value)
  ? [measured(value, normalInterval * se), isNumber(se) ? el('small', {}, ` ± ${number(normalInterval * se, 2)}`) : null]
  : missing);

function modesPage(report) {
  const { result } = report;
  if (Array.isArray(result.responses)) return sharedModesPage(report);
  const modes = Array.isArray(result.modes) ? result.modes : [];
  const rms = Object.entries(result).find(([key]) => key.startsWith('rms_'));
  return [
    { part: null, lead: tiles([
      ...modes.slice(0, 4).map((mode, i) => ({ label: `Mode ${i + 1}`,
        value: mode.frequency_Hz, unit: 'Hz',
        note: [halfWords(mode.se?.frequency_Hz, 'Hz'), `damping ratio ${number(mode.damping_ratio, 3)}`,
          halfWords(mode.se?.damping_ratio)].filter(Boolean).join('; ').replace(/; (?=±[^;]*$)/, ' ') })),
      isNumber(result.explained) && { label: 'Explained by the fit',
        value: `${number(100 * result.explained, 4)}`, unit: '%',
        note: rms && `it leaves ${number(rms[1], 3)} ${unitOfKind[result.kind]} (rms)` },
    ]) },
    { part: modesTable(result) },
    responseSection(report),
    tapSection(report),
    { part: ordersSection(result) },
    stabilisationSection(report),
    { part: restSection(result, [...modesKnown, rms?.[0]]) },
  ];
}

/** Half of a 95 % interval in words; empty where there is none. */
const halfWords = (se, unit = '') => (se > 0 ? `±\u00a0${number(normalInterval * se, 2)}${unit && ` ${unit}`}` : '');

/** Numbers of each mode with their errors: of complex ones the imaginary part, else the damping. */
function modeRows(modes, imaginary = false) {
  const scale = { stiffness_N_per_m: 1e-6, imaginary_fraction: 100 };
  const keys = ['frequency_Hz', 'damping_ratio', ...(isNumber(modes[0].angle_deg) ? ['angle_deg'] : []),
    'mass_kg', 'stiffness_N_per_m', ...(imaginary ? ['imaginary_fraction'] : ['damping_Ns_per_m'])];
  return modes.map((mode, i) => [`${i + 1}`, ...keys.map((key) =>
    withError(mode[key] * (scale[key] || 1), mode.se?.[key] * (scale[key] || 1)))]);
}

function modesTable({ modes: found, noise, unresolved }) {
  const modes = Array.isArray(found) ? found : [];
  if (!modes.length) return null;
  return section('modes', 'The modes', 'Modes',
    table(['', 'natural frequency, Hz', 'damping ratio', 'modal mass, kg', 'modal stiffness, N/µm',
      'modal damping, N s/m'], modeRows(modes), { class: 'fits' }),
    prose('± is half of a 95 % confidence interval, for the noise of the response' + noiseWords(noise) +
      '. It does not include a wrong calibration of hammer or sensor.'),
    leftOut(unresolved));
}

/** Resonances that are no answers, in words; null: there are none. */
const leftOut = (unresolved) => (unresolved?.length ? prose('Terms of the fit that are not modes: ',
  unresolved.map(({ why }) => why).join('; '), '.') : null);

/** The noise of a response (M-15), in brackets. */
function noiseWords(noise) {
  if (!noise) return '';
  const [floor] = Object.entries(noise).find(([key]) => key.startsWith('floor_')) || [];
  const parts = [noise[floor] > 0 && `a floor of ${number(noise[floor], 2)} ${unitOfFloor[floor] || ''}`,
    noise.magnitude_percent > 0 && `${number(noise.magnitude_percent, 2)} % of the magnitude`,
    noise.phase_deg > 0 && `${number(noise.phase_deg, 2)}° of phase`].filter(Boolean);
  return parts.length ? ` (${parts.join(', ')})` : '';
}

/** The fits that were tried: the evidence of each, as odds against the best. */
function ordersSection(result) {
  const orders = Array.isArray(result.orders) ? result.orders : [];
  if (orders.length < 2) return null;
  const shared = Array.isArray(result.responses);
  const best = [...orders].sort((a, b) => a.criterion - b.criterion).slice(0, shared ? 10 : 8);
  const rows = best.map((order) => [`${order.modes}`, ...(shared ? [order.shapes] : []),
    order.residual_terms ? 'yes' : 'no', number(order.criterion, 3),
    order.frequencies_Hz.map((f) => number(f, 4)).join(', '),
    el('span', { style: 'white-space: normal' }, order.fault ? sentence(order.fault) : '')]);
  const of = shared
    ? prose('All fits, the most probable first, by the evidence of all responses together. A difference of 10 is ' +
      'very strong evidence. Complex shapes need at least this difference.',
    isNumber(result.complex_evidence) && result.complex_evidence > 10
      ? ` Real modes do not describe these responses: the criterion of the best real fit is ${number(result.complex_evidence, 3)} higher.`
      : '')
    : prose('All fits, the most probable first. The information criterion weighs the residual ' +
      'against the number of parameters. A difference of 10 is very strong evidence.');
  return section('orders', shared ? 'Number and form of the modes' : 'Number of modes', 'Number of modes', of,
    table(['modes', ...(shared ? ['shapes'] : []), 'residual terms', 'criterion above the best',
      'frequencies of all terms, Hz', 'why it is not the answer'], rows, { class: 'fits' }));
}

/** The blows of a record in time: which are used, and how well they agree. */
function tapSection(report) {
  const { hits } = report.result;
  if (!Array.isArray(hits)) return null;
  const rows = hits.map((hit, i) => [`${i + 1}`, number(hit.time_s, 5), number(hit.peak_N, 3),
    hit.left_out ? sentence(hit.left_out) : 'used']);
  const t = tableNamed(report, 'response.csv');
  const coherence = t && columnNamed(t, 'coherence');
  const x = coherence && columnNamed(t, 'frequency_Hz');
  const chart = coherence ? figure({ key: 'coherence', x, label: 'frequency', unit: 'Hz',
    caption: zoomHint + thinned(t) }) : null;
  return { part: section('hits', 'Hammer blows', 'Blows',
    table(['', 'time, s', 'peak force, N', ''], rows, { class: 'fits' }),
    prose(coherence ? 'Coherence: the fraction of the response that the force explains in the same way in all blows. It ' +
      'falls where noise is large, for example at antiresonances.' : 'One blow has no coherence.'),
    chart?.element), draw: () => chart?.draw([{ label: 'coherence', unit: '', height: 150,
    range: () => [0, 1.03], series: [{ name: '', values: coherence, color: '--s1' }] }]) };
}

/** Poles of rising order over frequency: modes stand in columns, noise does not. */
function stabilisationSection(report) {
  const t = tableNamed(report, 'stabilisation.csv');
  const f = columnNamed(t, 'frequency_Hz');
  const order = columnNamed(t, 'order');
  const standing = columnNamed(t, 'standing');
  if (!f?.length || !order || !standing) return null;
  const at = f.map((_, i) => i).sort((a, b) => f[a] - f[b]);
  const x = at.map((i) => f[i]);
  const dots = (which, name, color, size) => ({ name, color, line: false, points: size,
    values: at.map((i) => (standing[i] === which ? order[i] : null)) });
  const marks = (report.result.modes || []).map((mode, i) => ({ x: mode.frequency_Hz,
    text: `${i + 1}`, color: '--soft' }));
  const chart = figure({ key: 'stabilisation', x, points: true, label: 'frequency', unit: 'Hz',
    caption: zoomHint });
  const panels = [{ label: 'pairs of poles', unit: '', height: 190, markers: marks,
    range: () => [0, Math.max(...order) + 0.6], series: [
      dots(2, 'frequency and damping stable', '--s1', 7),
      dots(1, 'frequency stable', '--s2', 6),
      dots(0, 'new', '--soft', 4)] }];
  return { part: section('stabilisation', 'Stabilisation', 'Stabilisation',
    prose('Poles of a rational fit with one pair, two pairs and so on. A pole is stable within 1 % of the frequency and ' +
      '5 % of the damping ratio of the fit with one pair less. Vertical lines are the modes in the answer.'),
    chart.element), draw: () => chart.draw(panels) };
}

/** Where the phase is cut open: half a turn from the middle of the phases of a mode. */
const middleOfPhase = { receptance: -90, mobility: 0, accelerance: 90 };

/** Magnitude in dB and phase in degrees of one response. */
function polar(re, im, middle) {
  const turned = (angle) => middle + (((angle - middle + 180) % 360) + 360) % 360 - 180;
  return {
    magnitude: re.map((a, i) => (Math.hypot(a, im[i]) > 0
      ? 20 * Math.log10(Math.hypot(a, im[i])) : null)),
    phase: re.map((a, i) => turned(Math.atan2(im[i], a) * 180 / Math.PI)),
  };
}

const kindsInOrder = ['receptance', 'mobility', 'accelerance'];

/** A response as another kind: each is the one before times i omega. */
function asKind({ re, im }, hertz, from, to) {
  const times = kindsInOrder.indexOf(to) - kindsInOrder.indexOf(from);
  const turned = [[1, 0], [0, 1], [-1, 0], [0, -1]][((times % 4) + 4) % 4];
  const size = hertz.map((f) => (f > 0 ? (2 * Math.PI * f) ** times : times ? NaN : 1));
  return { re: re.map((a, i) => size[i] * (turned[0] * a - turned[1] * im[i])),
    im: re.map((a, i) => size[i] * (turned[0] * im[i] + turned[1] * a)) };
}

function responseSection(report) {
  const t = tableNamed(report, 'fitted.csv');
  const { kind, description } = report.result;
  const chart = responseChart(t, { kind, key: 'frequency', modes: report.result.modes });
  if (!chart) return null;
  return { part: section('response', 'Frequency response function', 'Response',
    prose(sentence(kindLabels[kind] || 'the response'), description ? `: ${description}. ` : '. ',
      chart.fitted ? 'Grey: measured. Blue: all modes together.' : 'Grey: measured.'),
    chart.element), draw: chart.draw };
}

/** Magnitude, phase, real and imaginary part of a response and of the fit through it. */
function responseChart(t, { kind, key, modes }) {
  const x = columnNamed(t, 'frequency_Hz');
  if (!x?.length) return null;
  const part = (prefix) => t.columns.find((column) => column.name.startsWith(prefix))?.values;
  const re = part('re_');
  const im = part('im_');
  const fittedRe = part('fitted_re_');
  const fittedIm = part('fitted_im_');
  const mif = columnNamed(t, 'mode_indicator');
  const both = (values, fitted) => [
    { name: 'measured', values, color: '--measured', width: 2.2 },
    fitted && { name: 'fit', values: fitted, color: '--s1', width: 1.6 },
  ].filter(Boolean);
  const marks = (modes || []).map((mode, i) => ({ x: mode.frequency_Hz,
    text: `${i + 1}`, color: '--soft' }));
  const chart = figure({ key, x, label: 'frequency', unit: 'Hz',
    caption: zoomHint + thinned(t) });
  const panelsAs = (shown_) => {
    const of = asKind({ re, im }, x, kind, shown_);
    const fit = fittedRe ? asKind({ re: fittedRe, im: fittedIm }, x, kind, shown_) : null;
    const unit = unitOfKind[shown_] || '';
    const middle = middleOfPhase[shown_] || 0;
    const [round, roundFit] = [polar(of.re, of.im, middle), fit && polar(fit.re, fit.im, middle)];
    return [
      { label: '|H|', unit: `dB re 1 ${unit}`, height: 190,
        series: both(round.magnitude, roundFit?.magnitude), markers: marks },
      { label: 'phase', unit: '°', height: 120, series: both(round.phase, roundFit?.phase) },
      { label: 'real part', unit, height: 130, series: both(of.re, fit?.re) },
      { label: 'imaginary part', unit, height: 130, series: both(of.im, fit?.im) },
      mif && { label: 'mode indicator', unit: '', height: 90,
        series: [{ name: '', values: mif, color: '--measured', width: 1.2 }] },
    ].filter(Boolean);
  };
  if (kindsInOrder.includes(kind)) {
    chart.controls.append(choice('Show as', kindsInOrder.map((value) => ({ value, text: value })), kind,
      (value) => chart.draw(panelsAs(value))));
  }
  return { element: chart.element, fitted: Boolean(fittedRe), draw: () => chart.draw(panelsAs(kind)) };
}

// Modes that several responses share.

const sharedModesKnown = ['shapes', 'modes', 'real_modes', 'responses', 'reciprocity', 'complex_evidence',
  'orders', 'unresolved', 'terms_outside_Hz'];

function sharedModesPage(report) {
  const { result } = report;
  const modes = Array.isArray(result.modes) ? result.modes : [];
  return [
    { part: null, lead: tiles([
      ...modes.slice(0, 4).map((mode, i) => ({ label: `Mode ${i + 1}`, value: mode.frequency_Hz, unit: 'Hz',
        note: `damping ratio ${number(mode.damping_ratio, 3)}` +
          (isNumber(mode.angle_deg) ? `, at ${number(mode.angle_deg, 3)}°` : '') })),
      ...(result.reciprocity || []).map(({ response, over, gain, se }) => ({ label: `${response} over ${over}`,
        value: gain, note: `± ${number(normalInterval * se, 2)}; reciprocity: 1` })),
    ]) },
    { part: sharedModesTable(result) },
    { part: shapesTable(result) },
    ...result.responses.map((response) => sharedResponse(report, response)),
    { part: ordersSection(result) },
    { part: restSection(result, sharedModesKnown) },
  ];
}

function sharedModesTable({ modes, real_modes: real, shapes, unresolved }) {
  if (!Array.isArray(modes) || !modes.length) return null;
  const complex = shapes === 'complex';
  const heads = (last) => ['', 'frequency, Hz', 'damping ratio',
    ...(isNumber(modes[0].angle_deg) ? ['direction, °'] : []), 'mass, kg', 'stiffness, N/µm', last];
  const damping = 'damping, N s/m';
  return section('modes', 'The modes', 'Modes',
    table(heads(complex ? 'imaginary, %' : damping), modeRows(modes, complex), { class: 'fits' }),
    prose('Frequency and damping ratio are common to all responses. Mass, stiffness and damping are for motion ' +
      'along the shape. Its direction is an angle from +x towards +y. ± is half of a 95 % confidence interval, for the ' +
      'noise of each response.'),
    complex ? prose('The real modes that fit all responses best. modes.toml contains them:') : null,
    complex ? table(heads(damping), modeRows(real, false), { class: 'fits' }) : null,
    leftOut(unresolved));
}

/** Real and imaginary part of a number with their errors. */
const partsOf = (re, reError, im, imError) => (isNumber(im)
  ? [withError(re, reError), ' + i (', withError(im, imError), ')'].flat() : withError(re, reError));

function shapesTable({ modes, responses }) {
  if (!Array.isArray(modes) || !modes.length) return null;
  const shapes = modes.map(({ shape }, i) => [`${i + 1}`, ...shape.map((one) =>
    partsOf(one.re_per_sqrt_kg, one.re_se, one.im_per_sqrt_kg, one.im_se))]);
  const residues = responses.map((response) => [response.name, ...response.residues.map((one) =>
    partsOf(one.re_per_kg, one.re_se, one.im_per_kg, one.im_se))]);
  return section('shapes', 'Shapes and residues', 'Shapes',
    table(['', ...modes[0].shape.map(({ axis }) => `φ ${axis}, 1/√kg`)], shapes, { class: 'fits' }),
    prose('The shapes are scaled to a modal mass of 1. The largest component has a real part above 0.'),
    table(['', ...modes.map((_, i) => `mode ${i + 1}, 1/kg`)], residues, { class: 'fits' }),
    prose('A residue is the part of a mode in a response: the product of two components of the shape. The name of the response is ' +
      'the direction of motion, then of force.'));
}

function sharedResponse(report, response) {
  const { name, kind, description, explained, noise } = response;
  const chart = responseChart(tableNamed(report, `fitted_${name}.csv`),
    { kind, key: 'frequency', modes: report.result.modes });
  if (!chart) return null;
  const direct = response.axis === response.force_axis;
  return { part: section(`response-${name}`,
    `Response ${name}: motion along ${response.axis}, force along ${response.force_axis}`, `Response ${name}`,
    prose(sentence(kindLabels[kind] || 'the response'), description ? `: ${description}. ` : '. ',
      isNumber(explained) ? `The modes explain ${number(100 * explained, 5)} % of it${noiseWords(noise)}. ` : '',
      direct ? '' : 'The phase of a cross response may go up or down. It shows on which side of the axes a mode lies.'),
    chart.element), draw: chart.draw };
}

function actuatorPage(report) {
  const { result } = report;
  const T = result.time_constants_s;
  return [
    { part: null, lead: tiles([
      { label: 'Gain', value: result.gain, note: halfWords(result.se?.gain) },
      { label: 'Natural frequency', value: result.frequency_Hz, unit: 'Hz', note: halfWords(result.se?.frequency_Hz, 'Hz') },
      { label: 'Damping ratio', value: result.damping_ratio,
        note: [halfWords(result.se?.damping_ratio), Array.isArray(T) && `time constants ${T.map((t) => number(1000 * t, 4)).join(' and ')} ms`]
          .filter(Boolean).join('; ') },
      { label: 'Bandwidth, −3 dB', value: result.half_power_frequency_Hz, unit: 'Hz' },
      { label: 'Explained by the fit', value: isNumber(result.explained) ?
        number(100 * result.explained, 4) : null, unit: '%',
      note: isNumber(result.rms_um) && `it leaves ${number(result.rms_um, 2)} µm (rms)` },
    ]) },
    { part: actuatorTable(result) },
    stepSection(report),
    { part: restSection(result, actuatorKnown) },
  ];
}

function actuatorTable(result) {
  if (!isNumber(result.gain)) return null;
  const se = result.se || {};
  const T = result.time_constants_s;
  const rows = [
    ['gain', withError(result.gain, se.gain)],
    ['natural frequency, Hz', withError(result.frequency_Hz, se.frequency_Hz)],
    ['damping ratio', withError(result.damping_ratio, se.damping_ratio)],
    ['sum of the time constants, ms', withError(1e3 * result.sum_s, 1e3 * se.sum_s)],
    ['product of the time constants, ms²', withError(1e6 * result.product_s2, 1e6 * se.product_s2)],
    ...(Array.isArray(T) ? T.map((t, i) => [`${i ? 'shorter' : 'longer'} time constant, ms`,
      withError(1e3 * t, 1e3 * se.time_constants_s?.[i])]) : []),
    ...[['start of the step, ms', 'start_s', se.start_s], ['rise from 10 to 90 %, ms', 'rise_time_10_90_s'],
      ['delay of slow commands, ms', 'low_frequency_delay_s']].filter(([, key]) => isNumber(result[key]))
      .map(([name, key, error]) => [name, error > 0 ? withError(1e3 * result[key], 1e3 * error)
        : number(1e3 * result[key])]),
  ];
  const why = result.identifiable?.time_constants_s;
  return section('actuator', 'The actuator', 'Actuator',
    table(['', 'value ± half of its 95 % confidence interval'], rows, { class: 'fits' }),
    why ? prose(`No single time constants: ${why.replace('+-', '±')}.`) : null);
}

function stepSection(report) {
  const t = tableNamed(report, 'fitted.csv');
  const x = columnNamed(t, 'time_s');
  const position = columnNamed(t, 'position_um');
  if (!x?.length || !position) return null;
  const fitted = columnNamed(t, 'fitted_um');
  const command = columnNamed(t, 'command_um');
  const chart = figure({ key: 'time', x, label: 'time', unit: 's',
    caption: zoomHint + thinned(t) });
  const panels = [{ label: 'position', unit: 'µm', height: 240, series: [
    command && { name: 'command', values: command, color: '--soft', dash: [6, 3] },
    { name: 'measured', values: position, color: '--measured', width: 2.2 },
    fitted && { name: 'fit', values: fitted, color: '--s1', width: 1.6 },
  ].filter(Boolean) }];
  if (fitted) {
    panels.push({ label: 'measured less fit', unit: 'µm', height: 110, series: [
      { name: '', values: position.map((y, i) => y - fitted[i]), color: '--s1' }] });
  }
  return { part: section('step', 'The step', 'Step', chart.element),
    draw: () => chart.draw(panels) };
}
