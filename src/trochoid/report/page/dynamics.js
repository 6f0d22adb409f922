// The page of `dynamics`.

const dynamicsKnown = ['verdict', 'periodic', 'chatter', 'settles', 'period', 'vibration', 'change_N', 'growth_per_turn', 'linear_growth_per_turn',
  'turns', 'flutes', 'difference', 'peak_xy_N', 'engagement_deg', 'surface_location',
  'process_damping'];

function verdictOfMotion({ verdict, chatter, settles }) {
  if (verdict === 'growing') return 'grows';
  if (verdict === 'bounded') return settles ? 'has not settled' : 'chatters, within bounds';
  return chatter ? 'chatters, and repeats' : 'steady state';
}

/** "with every turn", "every 2 teeth". */
function periodText({ period, flutes }) {
  if (!period) return '';
  const all = flutes.length;
  if (period.teeth === 1) return 'with every tooth';
  if (period.teeth === all) return 'with every turn';
  return period.teeth % all ? `every ${period.teeth} teeth` : `every ${period.teeth / all} turns`;
}

function dynamicsPage(report) {
  return [
    { lead: dynamicsLead(report.result) },
    { part: flutesOfMotion(report.result) },
    movingSection(report),
    motionForces(report),
    fluteForces(report),
    motionSection(report),
    onceSection(report),
    spectrumSection(report),
    { part: surfaceLocationSection(report.result) },
    toolSection(),
    { part: restSection(report.result, dynamicsKnown) },
  ];
}

function dynamicsLead(result) {
  const seen = result.growth_per_turn;
  const forces = (result.flutes || []).map((flute) => number(flute.peak_Fy_N, 3));
  return tiles([
    { label: 'The motion', value: verdictOfMotion(result),
      note: isNumber(result.change_N)
        ? `${result.period ? `it repeats ${periodText(result)}: ` : ''}the force changes by ${number(result.change_N, 2)} N in the last of ${result.turns} turns`
        : `${result.turns} turns. The amplitudes still change, so none are given` },
    isNumber(result.linear_growth_per_turn) && { label: 'Floquet multiplier of a turn', value: `× ${number(result.linear_growth_per_turn, 4)}`,
      note: `of the linearised cut. Below 1 a small vibration fades${
        isNumber(seen) ? `. In the last turns of the motion: ×\u00a0${number(seen, 2)}` : ''}` },
    result.vibration && { label: 'It stays within', value: [result.vibration.x_um, result.vibration.y_um]
      .filter((v) => v > 0).map((v) => `± ${number(v, 3)}`).join(' · '), unit: 'µm',
      note: `along ${[['x', result.vibration.x_um], ['y', result.vibration.y_um]].filter(([, v]) => v > 0)
        .map(([axis]) => axis).join(' and ')}, about its middle, in the last ${result.vibration.turns} turns` },
    isNumber(result.vibration?.chatter_frequency_Hz) && { label: 'Chatter frequency',
      value: number(result.vibration.chatter_frequency_Hz, 5), unit: 'Hz',
      note: 'the strongest line that is not a harmonic of the spindle' },
    forces.length && { label: forces.length > 1 ? 'Peak |Fy| of each flute' : 'Peak |Fy|',
      value: forces.slice(0, 4).join(' · ') + (forces.length > 4 ? ' …' : ''), unit: 'N',
      note: forces.length > 1 && `they differ by ${(100 * result.difference).toFixed(2)} % of the largest` },
    { label: 'Peak force in the plane of the table', value: fixed(result.peak_xy_N, 3), unit: 'N' },
    result.process_damping && { label: 'Wear land of the flanks', value: result.process_damping.wear_land_um, unit: 'µm',
      note: 'the model has its process damping, which is correct for small vibrations' },
  ].filter(Boolean));
}

/** What each flute does in the last turn, with bars to compare. */
function flutesOfMotion(result) {
  const { flutes } = result;
  if (!flutes?.length) return null;
  const most = (key) => Math.max(...flutes.map((flute) => flute[key])) || 1;
  const cell = (flute, key, text) => {
    const fill = el('span', { class: 'fill' });
    fill.style.width = `${(100 * flute[key] / most(key)).toFixed(2)}%`;
    fill.style.background = `var(${seriesColor(flute.tooth - 1)})`;
    return [text, el('span', { class: 'underbar' }, fill)];
  };
  const rows = flutes.map((flute) => [`tooth ${flute.tooth}`,
    cell(flute, 'peak_Fx_N', fixed(flute.peak_Fx_N, 4)),
    cell(flute, 'peak_Fy_N', fixed(flute.peak_Fy_N, 4)),
    cell(flute, 'chip_area_mm_rad', fixed(flute.chip_area_mm_rad, 4)),
    cell(flute, 'peak_chip_mm', fixed(1000 * flute.peak_chip_mm, 4))]);
  return section('flutes', 'What each flute does', 'Flutes',
    prose(`${result.vibration ? `Peaks of the last ${result.vibration.turns} turns, and the mean of their chip areas` : 'In the last turn'}. The chip area is the integral of the chip thickness over the angle. Equal peaks ` +
      'of the force do not always mean equal chip loads.'),
    table(['', 'peak |Fx|, N', 'peak |Fy|, N', 'chip area, mm rad', 'thickest chip, µm'], rows,
      { class: 'fits' }));
}

/** Entries of the flutes into the stock, over the angle since the first sample. */
function entries(report, span) {
  const marks = [];
  for (const flute of report.result.flutes || []) {
    for (let x = flute.enters_deg; isNumber(x) && x < span; x += 360) {
      marks.push({ x, text: `tooth ${flute.tooth}`, color: '--soft' });
    }
  }
  return marks;
}

/** The angle from the start of what was kept: whole turns. */
const sinceFirst = (x) => x.map((angle) => angle - x[0]);

function motionForces(report) {
  const t = tableNamed(report, 'forces.csv');
  const angle = columnNamed(t, 'angle_deg');
  if (!angle?.length) return null;
  const x = sinceFirst(angle);
  const marks = entries(report, x[x.length - 1]);
  const panels = forcePanels((axis) => {
    const values = columnNamed(t, `F${axis}_N`);
    if (!values?.some((value) => value !== 0)) return [];
    return [{ name: '', values, color: seriesColor(axesOfForce.indexOf(axis)), width: 1.8 }];
  }).map((panel, i) => ({ ...panel, markers: marks.map((m) => (i ? { ...m, text: '' } : m)) }));
  if (!panels.length) return null;
  const chart = figure({ key: 'angle', x, label: 'spindle angle, last turns', unit: '°',
    caption: zoomHint + thinned(t) });
  const part = section('forces', 'Force while it moves', 'Forces',
    prose('Force on the tool in the last turns. Dashed: the tip of a tooth passes the nominal entry angle. A tooth that is shorter or deflected meets its chip later.'),
    chart.element);
  return { part, draw: () => chart.draw(panels) };
}

/** The last turn cut into the turns of the flutes and laid over each other. */
function fluteForces(report) {
  const { flutes, engagement_deg: engagement } = report.result;
  const t = tableNamed(report, 'forces.csv');
  const angle = columnNamed(t, 'angle_deg');
  if (!angle?.length || t.drawn !== t.rows || !(flutes?.length > 1) || !engagement || flutes.length > 6) return null;
  const turn = Math.round(360 / (angle[1] - angle[0]));
  if (angle.length < 2 * turn) return null;
  const step = 360 / turn;
  const pitch = Math.floor(turn / flutes.length);
  const x = Array.from({ length: pitch }, (_, i) => i * step);
  const of = (axis) => flutes.map((flute, j) => {
    const first = turn + Math.round((flute.enters_deg - engagement[0]) / step);
    const values = columnNamed(t, `F${axis}_N`);
    return { name: `tooth ${flute.tooth}`, color: seriesColor(j), width: 1.8,
      values: x.map((_, i) => values[turn + ((first + i) % turn)] ?? null) };
  });
  const chart = figure({ key: 'flute', x, label: 'θ, immersion angle of the tip of each tooth', unit: '°',
    caption: zoomHint });
  const part = section('compare', 'The flutes laid over each other', 'Compare',
    prose('The same force, one curve per tooth: from θ = 0 of its tip to the next tooth. If several ' +
      'teeth cut at once, each curve is the sum of their forces.'), chart.element);
  return { part, draw: () => chart.draw([
    { label: forceName('x'), unit: 'N', series: of('x') },
    { label: forceName('y'), unit: 'N', series: of('y') }]) };
}

function motionSection(report) {
  const t = tableNamed(report, 'motion.csv');
  const angle = columnNamed(t, 'angle_deg');
  if (!angle?.length) return null;
  const x = sinceFirst(angle);
  const marks = entries(report, x[x.length - 1]).map((m) => ({ ...m, text: '' }));
  const series = (list) => list.map(([column, name, color, dash]) => {
    const values = columnNamed(t, column);
    return values?.some((value) => value !== 0) ? { name, values, color, dash, width: 1.7 } : null;
  }).filter(Boolean);
  const panels = [
    { label: 'tool', unit: 'µm', height: 180, markers: marks, series: series([
      ['x_tool_um', 'x', '--s1'], ['y_tool_um', 'y', '--s2']]) },
    { label: 'table', unit: 'µm', height: 180, markers: marks, series: series([
      ['command_um', 'command', '--soft', [6, 3]], ['x_actuator_um', 'actuator', '--s5'],
      ['x_table_um', 'x', '--s3'], ['y_table_um', 'y', '--s4']]) },
  ].filter((panel) => panel.series.length);
  if (!panels.length) return null;
  const told = columnNamed(t, 'command_um')?.some((value) => value !== 0);
  const chart = figure({ key: 'angle', x, label: 'spindle angle, last turns', unit: '°',
    caption: zoomHint + thinned(t) });
  const part = section('motion', 'How tool and table move', 'Motion',
    prose('Displacements from the position without forces', told ? ' and without a command' : '', ', along x (the feed) and y. The ' +
      'table is compliant: under the cutting force its position differs from the position of its actuator.', told ? ' The command is shown without its mean.' : ''),
    chart.element);
  return { part, draw: () => chart.draw(panels) };
}

/** Tool minus work once per turn (Poincaré section): a steady state stands still here. */
function onceSection(report) {
  const t = tableNamed(report, 'once_per_turn.csv');
  const [turn, x, y] = ['turn', 'x_um', 'y_um'].map((name) => columnNamed(t, name));
  if (!turn || turn.length < 3) return null;
  const moves = (values) => values.some((value) => value !== 0);
  const inPlane = moves(x) && moves(y);
  const dots = (name, values, color) => ({ name, values, color, points: 5, width: 1 });
  const chart = figure({ key: 'turn', x: turn, label: 'turn', unit: '', points: true,
    caption: zoomHint + thinned(t) });
  const scatter = inPlane ? scatterOf(turn, x, y) : null;
  const part = section('once', 'Once per turn: the Poincaré section', 'Once per turn',
    prose('Tool minus work at the moment the tip of tooth 1 passes θ = 0. ' +
      (report.result.periodic
        ? `After the transient of the start, a motion that repeats with every turn stays at one point here.${report.result.period?.turns > 1 ? ` This one visits ${number(report.result.period.turns, 3)} points in turn.` : ''}`
        : 'A motion in steady state stays at one point here. This one does not.')),
    chart.element, scatter?.element);
  const panels = [{ label: 'x', unit: 'µm', height: 120, series: [dots('', x, '--s1')] },
    { label: 'y', unit: 'µm', height: 120, series: [dots('', y, '--s2')] }]
    .filter(({ series: [{ values }] }) => moves(values));
  return panels.length ? { part, draw: () => {
    chart.draw(panels);
    scatter?.resize();
  } } : null;
}

/** Amplitudes over the frequency, of a motion that does not repeat. */
function spectrumSection(report) {
  const t = tableNamed(report, 'spectrum.csv');
  const f = columnNamed(t, 'frequency_Hz');
  const { vibration } = report.result;
  if (!f?.length || !vibration) return null;
  const top = Math.max(...vibration.lines.map((line) => line.frequency_Hz)) * 2;
  const n = f.findIndex((v) => v > top);
  const cut = (values) => (n > 0 ? values.slice(0, n) : values);
  const series = ['x', 'y'].map((axis, i) => ({ name: axis, values: cut(columnNamed(t, `${axis}_um`)),
    color: ['--s1', '--s2'][i], width: 1.5 })).filter(({ values }) => values.some((v) => v > 0));
  const chart = figure({ key: 'frequency', x: cut(f), label: 'frequency', unit: 'Hz',
    caption: zoomHint + thinned(t) });
  const rows = vibration.lines.map((line) => [number(line.frequency_Hz, 6), number(line.x_um, 4),
    number(line.y_um, 4), isNumber(line.spindle_harmonic) ? `${line.spindle_harmonic} × spindle` : 'its own']);
  const part = section('spectrum', 'With which frequencies it vibrates', 'Spectrum',
    prose(`Amplitude of tool minus work over the last ${vibration.turns} turns. The forced vibration ` +
      'has harmonics of the spindle. Chatter has frequencies of its own.'), chart.element,
    table(['frequency, Hz', 'x, µm', 'y, µm', 'what it is'], rows, { class: 'fits' }));
  return { part, draw: () => chart.draw([{ label: 'amplitude', unit: 'µm', series }]) };
}

/** y over x, a dot a turn. */
function scatterOf(turn, x, y) {
  const ends = (values) => {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const margin = 0.08 * (high - low) || 0.1;
    return [low - margin, high + margin];
  };
  let places = null;
  const chart = drawing({ label: 'Tool minus work at the start of each turn, y over x',
    height: (width) => Math.round(Math.min(420, Math.max(260, 0.6 * width))), lowOnPaper: 0.6,
    data: () => ({ head: ['turn', 'x [µm]', 'y [µm]'], rows: turn.map((n, i) => [n, x[i], y[i]]) }),
    paint: (c, width, height) => { places = paintScatter(c, width, height, { x, y, view: chart.view }); } });
  zoomable(chart, () => places.frame, { x: ends(x), y: ends(y) });
  readoutOf(chart, 'Point at a turn for its values; drag or pinch to zoom.', ([u, v]) => {
    const far = turn.map((_, i) => Math.hypot(places.px(x[i]) - u, places.py(y[i]) - v));
    const i = far.indexOf(Math.min(...far));
    return far[i] < 30 ? `turn ${number(turn[i])}: x ${number(x[i], 5)} µm, y ${number(y[i], 5)} µm` : null;
  });
  return chart;
}

function paintScatter(c, width, height, { x, y, view }) {
  const frame = { left: 62, top: 34, width: width - 74, height: height - 34 - 44, ...view,
    xLabel: 'x [µm]', yLabel: 'y [µm], every turn a dot, the last third large' };
  const { px, py } = plane(c, frame);
  c.save();
  c.beginPath();
  c.rect(frame.left, frame.top, frame.width, frame.height);
  c.clip();
  const places = x.map((v, i) => [px(v), py(y[i])]);
  line(c, places, css('--zero'), 1);
  places.forEach(([u, v], i) => {
    const late = i >= (2 * x.length) / 3;
    c.fillStyle = css(late ? '--s1' : '--measured');
    c.beginPath();
    c.arc(u, v, late ? 4 : 2.5, 0, 2 * Math.PI);
    c.fill();
  });
  c.restore();
  return { frame, px, py };
}

/** The error left on the finished walls by the motion. */
function surfaceLocationSection(result) {
  const walls = result.surface_location;
  if (!walls?.length) return null;
  const rows = walls.map((wall) => [`${wall.wall} wall`, ...wall.flutes.map((flute) =>
    hundredths(flute.surface_location_error_um)), hundredths(wall.surface_location_error_um)]);
  const teeth = walls[0].flutes.map((flute) => `tooth ${flute.tooth}`);
  return section('surface', 'Surface location error', 'Surface',
    prose('The error that each tooth leaves on the wall, in µm. It follows from the positions of tool, work and tooth at the moment when the tooth makes the wall. ' +
      'Positive: material is left. A tooth that is longer because of runout cuts deeper by this length, also without any motion. ' +
      'The tooth that reaches deepest makes the remaining wall.'),
    table(['error, µm', ...teeth, 'remains'], rows, { class: 'fits' }));
}
