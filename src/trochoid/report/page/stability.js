// The page of `stability`.

const stabilityKnown = ['multiplier', 'stable', 'verdict', 'limit_depth_mm', 'limit', 'chip_floor',
  'greatest_depth_mm', 'spindle_rpm', 'axial_depth_mm', 'modes', 'better_speed', 'measured_frf',
  'process_damping', 'judged_by'];

const bifurcations = {
  hopf: 'Hopf: a vibration with a frequency of its own',
  period_doubling: 'period doubling: a vibration that repeats after two periods',
  period_one: 'a vibration that repeats with every period',
};

function stabilityPage(report) {
  return [
    { lead: stabilityLead(report.result) },
    lobesSection(report),
    limitSection(report),
    measuredSection(report),
    { part: modesSection(report.result.modes) },
    toolSection(),
    { part: restSection(report.result, stabilityKnown) },
  ];
}

const kinds = { hopf: 'Hopf', period_doubling: 'period doubling', period_one: 'period one' };

/** How stability is lost at the limit, and the strongest frequency there. */
function limitWords(limit) {
  const [strongest] = limit?.chatter_frequencies_Hz || [];
  return [kinds[limit?.type], isNumber(strongest) && `${number(strongest, 5)} Hz`]
    .filter(Boolean).join(', ');
}

/** What damps, and how deep it would be without. */
function dampingProse({ process_damping: damping }) {
  if (!damping) return null;
  const without = damping.limit_depth_without_mm;
  return prose(`With process damping of a ${dampingWords(damping)}. `,
    ...(isNumber(without) ? ['Without it this cut would chatter from ', el('b', {}, `${number(without)} mm`), ' of axial depth on.'] : []));
}

const judges = {
  complex_modes: 'Verdict and diagram come from complex modes. Real modes do not describe this response. ',
  response: 'Verdict and limit come from the measured response. Modes do not describe it. ',
};

/** The limit by the measured response beside that of the multiplier. */
function measuredSection(report) {
  const measured = report.result.measured_frf;
  if (!measured) return null;
  const curves = [
    [report.result.judged_by === 'response' ? 'decides: the measured response' : 'Floquet multiplier',
      'limit.csv', '--s1', 1.8],
    ['zeroth order', 'zeroth_order.csv', '--s2', 1.4],
    [`multi-frequency, ${measured.multi_frequency.harmonics} harmonics`, 'multi_frequency.csv', '--s3', 1.8],
  ].map(([name, file, color, width]) => {
    const t = tableNamed(report, file);
    return { name, color, width, x: columnNamed(t, 'spindle_rpm') || [],
      depth: columnNamed(t, 'limit_depth_mm') || [], hertz: columnNamed(t, 'chatter_frequency_Hz') || [] };
  }).filter((curve) => curve.x.length > 1);
  const { result } = report;
  const shown = (solution) => (isNumber(solution?.limit_depth_mm)
    ? [`${number(solution.limit_depth_mm)} mm`, `${number(solution.chatter_frequency_Hz, 5)} Hz`]
    : ['none', '']);
  const signed = (v) => (isNumber(v) ? `${v > 0 ? '+' : ''}${number(v, 2)} %` : '');
  const rows = [
    result.multiplier && ['Floquet multiplier', isNumber(measured.multiplier_limit_depth_mm)
      ? `${number(measured.multiplier_limit_depth_mm)} mm` : 'none',
    isNumber(result.limit?.chatter_frequencies_Hz?.[0])
      ? `${number(result.limit.chatter_frequencies_Hz[0], 5)} Hz` : '', '', ''],
    ...[['zeroth order', measured.zeroth_order], ['multi-frequency', measured.multi_frequency]]
      .map(([name, s]) => [name, ...shown(s), signed(s.difference_percent),
        isNumber(s.median_difference_percent) ? `${number(s.median_difference_percent, 2)} %` : '']),
  ].filter(Boolean);
  const words = prose('The limit depth by three solutions. Two use the measured response alone, from ' +
    `${number(measured.band_Hz[0])} to ${number(measured.band_Hz[1])} Hz: with the mean force (zeroth order), and with harmonics of the force ` +
    '(multi-frequency). The third is the Floquet multiplier of the modes ' +
    (measured.modes_fitted ? 'fitted to this response. ' : 'of the case. ') +
    (judges[result.judged_by] || '') +
    'If multi-frequency and multiplier differ, the modes are not the whole response. If zeroth order ' +
    'differs from both, the teeth cut too briefly for a mean force.');
  const numbers = table(['solution', 'limit depth here', 'chatter frequency', 'difference', 'median over speeds'], rows);
  const places = [...new Set(curves.flatMap((curve) => curve.x))].sort((a, b) => a - b);
  if (places.length < 2) {
    return { part: section('measured', 'Measured response', 'Measured', words, numbers) };
  }
  const chart = figure({ key: 'measured', x: places, label: 'spindle speed', unit: 'rpm', caption: zoomHint });
  const markers = [{ x: result.spindle_rpm, text: 'the case' }];
  const series = (what) => curves.map((curve) => {
    const jumps = what === 'hertz' ? jumpsOf(curve.hertz) : [];
    const values = sampledAt(curve.x, curve[what], places, jumps);
    return { name: curve.name, color: curve.color, width: curve.width, values,
      jumps: jumps.map((i) => placeBefore(places, curve.x[i + 1])) };
  });
  const panels = [
    { label: 'limit depth', unit: 'mm', height: 220, markers, series: [...series('depth'),
      { name: 'depth of the case', values: places.map(() => result.axial_depth_mm), color: '--s4', dash: [6, 3] }] },
    { label: 'chatter frequency there', unit: 'Hz', height: 160, markers, series: series('hertz') },
  ];
  return { part: section('measured', 'Measured response', 'Measured', words, numbers, chart.element),
    draw: () => chart.draw(panels) };
}

function stabilityLead(result) {
  const mu = result.multiplier || {};
  const [strongest] = mu.chatter_frequencies_Hz || [];
  const measured = result.measured_frf?.multi_frequency;
  return [
    tiles([
      { label: 'The cut is', value: result.verdict,
        note: `${number(result.spindle_rpm, 6)} rpm, ${number(result.axial_depth_mm)} mm deep` },
      result.multiplier && { label: `Floquet multiplier of a ${mu.period}`, value: fixed(mu.absolute, 4),
        note: mu.absolute < 1 ? 'below 1: a small vibration fades' : 'above 1: a small vibration grows' },
      !result.multiplier && { label: 'Floquet multiplier', value: 'none', note: 'no modes: the measured response decides' },
      { label: 'Limit depth at this speed', value: isNumber(result.limit_depth_mm) ?
        number(result.limit_depth_mm) : 'none', unit: isNumber(result.limit_depth_mm) && 'mm',
      note: isNumber(result.limit_depth_mm) ? limitWords(result.limit)
        : `up to ${number(result.greatest_depth_mm)} mm` },
      result.multiplier
        ? { label: 'Strongest chatter frequency', value: isNumber(strongest) ? number(strongest, 5) : null,
          unit: 'Hz', note: bifurcations[mu.type] }
        : { label: 'Chatter frequency at the limit', value: isNumber(measured?.chatter_frequency_Hz)
          ? number(measured.chatter_frequency_Hz, 5) : null, unit: 'Hz' },
    ].filter(Boolean)),
    dampingProse(result),
    result.chip_floor && prose('A power law has no slope where the chip begins. With a chip floor of ',
      number(0.5 * result.chip_floor.chip_floor_um), ' and ', number(2 * result.chip_floor.chip_floor_um),
      ' µm the Floquet multiplier is ', number(result.chip_floor.multiplier_at_half, 6), ' and ',
      number(result.chip_floor.multiplier_at_twice, 6), '.'),
  ];
}

/** lobes.csv as rows of equal depth, ascending; null if it is no whole grid. */
function lobeRows(t) {
  const [speed, depth, mu] = ['spindle_rpm', 'axial_depth_mm', 'multiplier']
    .map((name) => columnNamed(t, name));
  if (!speed?.length || t.drawn !== t.rows) return null;
  const depths = depth.findIndex((d, i) => i > 0 && d <= depth[i - 1]);
  if (depths < 2 || speed.length < 2 * depths || speed.length % depths) return null;
  const x = speed.filter((_, i) => i % depths === 0);
  return Array.from({ length: depths }, (_, k) => ({
    height: depth[k], x, mu: x.map((_, i) => mu[i * depths + k]),
  }));
}

function lobesSection(report) {
  const rows = lobeRows(tableNamed(report, 'lobes.csv'));
  if (!rows) return null;
  const { result } = report;
  const limit = tableNamed(report, 'limit.csv');
  const speeds = columnNamed(limit, 'spindle_rpm') || [];
  const limits = columnNamed(limit, 'limit_depth_mm') || [];
  const x = [rows[0].x[0], rows[0].x[rows[0].x.length - 1]];
  const heights = [rows[0].height, rows[rows.length - 1].height];
  const view = { label: '|μ|: blue is stable, red is not; line: limit depth',
    key: 'mu', colors: aroundZero, range: [0.5, 1.5], step: 0, smooth: true };
  let frame = null;
  const paint = (c, width, height) => {
    frame = { left: 52, top: 76, width: width - 72, height: height - 76 - 44, ...chart.view,
      xLabel: 'spindle speed [rpm]', yLabel: 'axial depth [mm]' };
    write(c, view.label, 0, 8, { color: '--ink' });
    colorBar(c, view, frame.left, frame.width);
    const values = pictureOf(rows, view, frame.x, frame.y, Math.round(frame.width * devicePixelRatio),
      Math.round(frame.height * devicePixelRatio));
    c.putImageData(imageOf(values, view), Math.round(frame.left * devicePixelRatio),
      Math.round(frame.top * devicePixelRatio));
    const { px, py } = plane(c, frame, { grid: false });
    c.save();
    c.beginPath();
    c.rect(frame.left, frame.top, frame.width, frame.height);
    c.clip();
    line(c, speeds.map((v, i) => [px(v), py(limits[i])]), '#17212b', 1.8);
    const at = [px(result.spindle_rpm), py(result.axial_depth_mm)];
    const inside = at[0] >= frame.left - 1 && at[0] <= frame.left + frame.width + 1;
    c.restore();
    if (!inside || at[1] < frame.top - 1 || at[1] > frame.top + frame.height + 1) return;
    for (const [color, wide] of [['#ffffff', 5], ['#17212b', 2.2]]) {
      line(c, [[at[0] - 8, at[1]], [at[0] + 8, at[1]]], color, wide);
      line(c, [[at[0], at[1] - 8], [at[0], at[1] + 8]], color, wide);
    }
  };
  const chart = drawing({ label: 'Stability lobe diagram: Floquet multiplier over spindle speed and axial depth', paint, lowOnPaper: true,
    data: () => ({ head: ['spindle speed [rpm]', 'axial depth [mm]', '|μ|'],
      rows: rows[0].x.flatMap((v, i) => rows.map((row) => [v, row.height, row.mu[i]])) }),
    height: (width) => Math.round(Math.min(480, Math.max(330, 0.5 * width))) });
  zoomable(chart, () => frame, { x, y: heights });
  readoutOf(chart, 'Point at the map for values; drag or pinch to zoom. The cross is the case.', (place) => {
    const [n, d] = valuesAtPlace(frame, place);
    const row = rows[nearest(rows.map((one) => one.height), d)];
    const i = nearest(row.x, n);
    return [`${number(row.x[i], 6)} rpm, ${number(row.height)} mm: |μ| = `, el('b', {}, number(row.mu[i], 5))];
  });
  const part = section('lobes', 'Stability lobe diagram', 'Lobes',
    prose('The Floquet multiplier |μ| is the factor by which a small vibration grows in a period of the cut. The map has it for every ' +
      'spindle speed and axial depth. Everything else is as in the case' +
      `${result.process_damping ? `, with process damping of a ${dampingWords(result.process_damping)}` : ''}.`),
    chart.element);
  return { part, draw: () => chart.resize() };
}

function limitSection(report) {
  const t = tableNamed(report, 'limit.csv');
  const x = columnNamed(t, 'spindle_rpm');
  if (!x || x.length < 2) return null;
  const { result } = report;
  const depths = columnNamed(t, 'limit_depth_mm');
  const doubled = columnNamed(t, 'argument_deg').map((a, i) =>
    (Math.abs(Math.abs(a) - 180) < 1e-3 ? depths[i] : null));
  const markers = [{ x: result.spindle_rpm, text: 'the case' }];
  const hertz = columnNamed(t, 'chatter_frequency_Hz');
  const chart = figure({ key: 'limit', x, label: 'spindle speed', unit: 'rpm',
    caption: zoomHint + thinned(t) });
  const panels = [
    { label: 'limit depth: from here on unstable', unit: 'mm', height: 200, markers, series: [
      { name: 'limit depth', values: depths, color: '--s1', width: 1.8 },
      doubled.some(isNumber) && { name: 'period doubling there', values: doubled, color: '--s4', width: 3.2 },
      { name: 'depth of the case', values: x.map(() => result.axial_depth_mm), color: '--s2',
        dash: [6, 3] }].filter(Boolean) },
    { label: 'chatter frequency there', unit: 'Hz', height: 150, markers, series: [
      { name: '', values: hertz, jumps: jumpsOf(hertz), color: '--s3' }] },
  ];
  const part = section('limit', 'Limit depth and chatter frequency', 'Limit',
    prose('Above the line the cut is unstable. Only the map shows stable islands above it. ' +
      'The frequency is the strongest one of the chatter at the limit. Where it jumps, another branch ' +
      'is the first to chatter. Chatter has a frequency of its own (Hopf), or repeats after two periods (period doubling, flip), ' +
      'or, with runout, after each period.' +
      (result.process_damping ? ` Process damping of a ${dampingWords(result.process_damping)} raises the limit depth at low spindle speeds.` : '')),
    chart.element);
  return { part, draw: () => chart.draw(panels) };
}

/** Along an axis, or by how much it is turned from x towards y. */
function directionWords([x, y]) {
  if (x && y) return `${number(Math.atan2(y, x) * 180 / Math.PI, 3)}° from x to y`;
  return x ? (x < 0 ? '−x' : 'x') : (y < 0 ? '−y' : 'y');
}

function modesSection(modes) {
  if (!modes?.length) return null;
  const rows = modes.map((mode) => [
    directionWords(mode.direction), number(mode.frequency_Hz, 6), number(100 * mode.damping_ratio, 4),
    number(mode.mass_kg, 5), number(1e-6 * mode.stiffness_N_per_m, 5)]);
  return section('modes', 'Modes: what vibrates', 'Modes',
    prose('The direction is the motion of the tool relative to the work. In a mode of the table, the table itself moves the opposite way.'),
    table(['direction', 'natural frequency, Hz', 'damping ratio, %', 'modal mass, kg',
      'modal stiffness, N/µm'], rows));
}
