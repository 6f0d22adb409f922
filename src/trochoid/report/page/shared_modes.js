// The page of `modes` that several responses of one structure share.

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
    { part: sharedOrders(result) },
    { part: restSection(result, sharedModesKnown) },
  ];
}

function modeRows(modes, imaginary) {
  const scale = { stiffness_N_per_m: 1e-6, imaginary_fraction: 100 };
  const keys = ['frequency_Hz', 'damping_ratio', ...(isNumber(modes[0].angle_deg) ? ['angle_deg'] : []),
    'mass_kg', 'stiffness_N_per_m', ...(imaginary ? ['imaginary_fraction'] : ['damping_Ns_per_m'])];
  return modes.map((mode, i) => [`${i + 1}`, ...keys.map((key) =>
    withError(mode[key] * (scale[key] || 1), mode.se?.[key] * (scale[key] || 1)))]);
}

function sharedModesTable({ modes, real_modes: real, shapes, unresolved }) {
  if (!Array.isArray(modes) || !modes.length) return null;
  const complex = shapes === 'complex';
  const heads = (last) => ['', 'frequency, Hz', 'damping ratio',
    ...(isNumber(modes[0].angle_deg) ? ['direction, °'] : []), 'mass, kg', 'stiffness, N/µm', last];
  const damping = 'damping, N s/m';
  return section('modes', 'The modes', 'Modes',
    table(heads(complex ? 'imaginary, %' : damping), modeRows(modes, complex), { class: 'fits' }),
    prose('Frequency and damping ratio are common to all responses; mass, stiffness and damping are those of motion ' +
      'along the shape, whose direction is told from +x towards +y. ± half of a 95 % confidence interval, under the ' +
      'noise that each response shows.'),
    complex ? prose('The real modes that fit all responses best, which modes.toml holds:') : null,
    complex ? table(heads(damping), modeRows(real, false), { class: 'fits' }) : null,
    unresolved?.length ? prose('In the fit, and not among the modes: ',
      unresolved.map(({ why }) => why).join('; '), '.') : null);
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
    prose('Shapes, scaled to a modal mass of 1; the largest component has a real part above 0.'),
    table(['', ...modes.map((_, i) => `mode ${i + 1}, 1/kg`)], residues, { class: 'fits' }),
    prose('Residues: what each mode gives to each response, motion named before force: the product of both components ' +
      'of the shape.'));
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
      direct ? '' : 'A cross response may turn either way: its phase tells on which side of the axes modes lie.'),
    chart.element), draw: chart.draw };
}

/** The fits that were tried, with real shapes and with complex ones. */
function sharedOrders(result) {
  const orders = Array.isArray(result.orders) ? result.orders : [];
  if (orders.length < 2) return null;
  const best = [...orders].sort((a, b) => a.criterion - b.criterion).slice(0, 10);
  const rows = best.map((order) => [`${order.modes}`, order.shapes, order.residual_terms ? 'yes' : 'no',
    number(order.criterion, 3), order.frequencies_Hz.map((f) => number(f, 4)).join(', '),
    el('span', { style: 'white-space: normal' }, order.fault ? sentence(order.fault) : '')]);
  return section('orders', 'Number and form of the modes', 'Number of modes',
    prose('The fits that were tried, likeliest first, by the evidence of all responses together. A difference of 10 is ' +
      'very strong evidence; complex shapes are taken from there on only.',
    isNumber(result.complex_evidence) && result.complex_evidence > 10
      ? ` Real modes do not describe these responses: the best of them is ${number(result.complex_evidence, 3)} above.`
      : ''),
    table(['modes', 'shapes', 'residual terms', 'criterion above the best', 'frequencies of all terms, Hz',
      'why it is not the answer'], rows, { class: 'fits' }));
}
