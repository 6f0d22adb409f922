// The page of `program`: the path in the colours of what loads the tool, its lines.

const programKnown = ['dialect', 'moves', 'tools', 'time_s', 'time_in_cut_s', 'removed_mm3', 'peaks', 'limits_broken', 'feed',
  'chatter', 'walls', 'record'];
const worstShown = 12;
/** Columns of steps.csv that the path can show: key, name, label. */
const pathViews = [['peak_xy_N', 'force', 'largest force across the tool [N]'],
  ['tooth', 'tooth', 'largest force of a tooth [N]'], ['torque_peak_Nm', 'torque', 'largest torque [N m]'],
  ['deflection_um', 'deflection', 'deflection of the tip [µm]'],
  ['peak_chip_mm', 'chip', 'largest uncut chip thickness [mm]'],
  ['engaged_deg', 'engaged', 'engaged angle [°]'], ['a_p_mm', 'depth', 'axial depth [mm]'],
  ['chatter_margin', 'chatter', 'limit depth over axial depth, red: chatter [1]'],
  ['wall', 'wall', 'largest error of a wall that stays, 0: none [µm]']];
const wallColumns = ['left_least', 'left_most', 'right_least', 'right_most'].map((name) => `wall_${name}_um`);

function programPage(report) {
  const { result } = report;
  return [
    { lead: result.peaks ? programLead(result) : null },
    pathSection(report),
    { part: worstLines(report) },
    overTime(report),
    result.record ? recordSection(report, result.record) : { part: null },
    { part: result.feed ? feedSection(report, result.feed) : null },
    { part: result.chatter?.lines.length ? chatterSection(result.chatter.lines) : null },
    { part: result.walls?.lines.length ? wallSection(result.walls.lines) : null },
    { part: result.limits_broken?.length ? brokenSection(result.limits_broken) : null },
    toolSection(),
    { part: restSection(result, programKnown) },
  ];
}

function programLead(result) {
  const { peaks } = result;
  const interval = ({ value, high }) => (isNumber(high) ? `± ${fixed(high - value, 2)} (95 %), ` : '');
  const tile = (label, key, unit) => peaks[key]?.line && { label, value: fixed(peaks[key].value, 3), unit,
    note: `${interval(peaks[key])}line ${peaks[key].line}, ${peaks[key].cause}` };
  return [tiles([
    tile('Largest force across', 'peak_xy_N', 'N'), tile('Of one tooth', 'peak_tooth_N', 'N'),
    tile('Largest torque', 'torque_peak_Nm', 'N m'),
    peaks.deflection_um.value > 0 && tile('Deflection of the tip', 'deflection_um', 'µm'),
    { label: 'Time in cut', value: fixed(result.time_in_cut_s, 3), unit: 's', note: `of ${fixed(result.time_s, 3)} s` },
  ])];
}

/** The steps that cut, with the largest force of any tooth. */
function stepsOf(t) {
  const values = (name) => columnNamed(t, name) || [];
  const teeth = t.columns.filter((column) => /^peak_tooth_\d+_N$/.test(column.name));
  const [x, y, z, depth] = ['x_mm', 'y_mm', 'z_mm', 'a_p_mm'].map(values);
  const keys = pathViews.map(([key]) => key).filter((key) => key !== 'tooth' && key !== 'wall');
  const walls = wallColumns.map(values);
  return depth.map((_, i) => ({ x: x[i], height: y[i], z: z[i], line: values('line')[i], cause: values('cause')[i],
    ...Object.fromEntries(['feed_direction_deg', 'entry_deg', 'exit_deg'].map((key) => [key, values(key)[i]])),
    tooth: Math.max(0, ...teeth.map((column) => column.values[i] || 0)),
    wall: Math.max(0, ...walls.map((errors) => Math.abs(errors[i] || 0))),
    ...Object.fromEntries(keys.map((key) => [key, values(key)[i]])) })).filter((_, i) => depth[i] > 0);
}

/** Both axes in one scale: the frame of a drawing, around its middle. */
function evenFrame(frame, x, y) {
  const scale = Math.max((x[1] - x[0]) / frame.width, (y[1] - y[0]) / frame.height);
  const about = ([a, b], size) => [(a + b - scale * size) / 2, (a + b + scale * size) / 2];
  return { ...frame, x: about(x, frame.width), y: about(y, frame.height) };
}

function pathSection(report) {
  const t = tableNamed(report, 'steps.csv');
  const dots = t?.drawn ? stepsOf(t) : [];
  if (dots.length < 2) return { part: null };
  const views = pathViews.filter(([key]) => dots.some((dot) => dot[key] > 0)).map(([key, name, label]) => ({ key, name,
    label, ...(key === 'chatter_margin' ? { colors: [...aroundZero].reverse(), range: [0, 2] }
      : { colors: rising, range: [0, Math.max(...dots.map((dot) => dot[key]))] }) }));
  const texts = new Map((columnNamed(tableNamed(report, 'lines.csv'), 'line') || []).map((line, i) =>
    [line, columnNamed(tableNamed(report, 'lines.csv'), 'text')?.[i]]));
  const chart = pathMap(dots, views, (dot, view) => [`line ${dot.line}`, texts.get(dot.line) ?
    el('code', {}, ` ${texts.get(dot.line)} `) : ' ', `at z ${number(dot.z, 4)} mm, ${dot.cause}: `,
  el('b', {}, `${number(dot[view.key], 4)}`), ` ${view.label.replace(/.*\[(.*)\]/, '$1')}`, isNumber(dot.entry_deg) ? engagedText(dot) : '',
  isNumber(dot.entry_deg) ? cutterAt(dot) : '']);
  const part = section('path', 'The path of the tool', 'Path',
    prose('Every dot is a turn of the spindle in cut, at the middle of the tool. Its colour shows the load of the tool in this turn. ' +
      'From above, lower passes hide higher ones.', thinned(t)), chart.element);
  return { part, draw: () => chart.resize() };
}

/** The cutter from above in one turn: the feed as an arrow, and the angles at which the widest layer is in cut. */
function cutterAt(dot) {
  const R = 22;
  const node = (name, attributes) => {
    const one = document.createElementNS('http://www.w3.org/2000/svg', name);
    for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
    return one;
  };
  const direction = (isNumber(dot.feed_direction_deg) ? dot.feed_direction_deg : 0) * Math.PI / 180;
  const at = (theta, r) => {  // theta from the left of the feed towards the feed
    const [along, left] = [Math.sin(theta * Math.PI / 180), Math.cos(theta * Math.PI / 180)];
    const [x, y] = [along * Math.cos(direction) - left * Math.sin(direction), along * Math.sin(direction) + left * Math.cos(direction)];
    return `${(32 + r * x).toFixed(1)} ${(32 - r * y).toFixed(1)}`;
  };
  const svg = node('svg', { viewBox: '0 0 64 64', width: 64, height: 64, class: 'cutter', role: 'img',
    'aria-label': `engaged from ${number(dot.entry_deg, 3)} to ${number(dot.exit_deg, 3)} degrees` });
  const steps = Array.from({ length: 25 }, (_, i) => dot.entry_deg + (dot.exit_deg - dot.entry_deg) * i / 24);
  svg.append(node('circle', { cx: 32, cy: 32, r: R, fill: 'none', stroke: css('--soft') }));
  svg.append(node('path', { fill: css('--wash'), stroke: css('--s2'), 'stroke-width': 2,
    d: `M ${at(steps[0], R)} ${steps.map((theta) => `L ${at(theta, R)}`).join(' ')} L 32 32 Z` }));
  if (isNumber(dot.feed_direction_deg)) {
    svg.append(node('path', { fill: 'none', stroke: css('--ink'), d: `M 32 32 L ${at(90, R + 8)} M ${at(80, R + 2)} L ${at(90, R + 8)} L ${at(100, R + 2)}` }));
  }
  return svg;
}

/** In words; a layer may be in cut in several arcs. */
function engagedText(dot) {
  const several = dot.exit_deg - dot.entry_deg > dot.engaged_deg + 1;
  return `, in cut from ${number(dot.entry_deg, 3)}° to ${number(dot.exit_deg, 3)}°${
    several ? `, ${number(dot.engaged_deg, 3)}° of it` : ''} `;
}

/** From where the path is seen: the angle about z, and how far up; none: from above. */
const looks = [{ text: 'from above' }, { text: 'from the left', turn: Math.PI / 6 }, { text: 'from the right', turn: -Math.PI / 6 }];
const lookUp = 0.6;
/** Low programs are drawn higher, up to so many times. */
const mostHigher = 10;

/** Dots as a look sees them, the far ones first, and how many times higher they are drawn. */
function seenFrom(dots, { turn }) {
  if (turn === undefined) return { dots, higher: 1 };
  const span = (key) => dots.reduce(([a, b], dot) => [Math.min(a, dot[key]), Math.max(b, dot[key])], [Infinity, -Infinity]);
  const size = (key) => span(key)[1] - span(key)[0];
  const higher = Math.max(1, Math.min(mostHigher, Math.round(0.25 * Math.max(size('x'), size('height')) / (size('z') || 1e9))));
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const seen = dots.map((dot) => {
    const away = dot.x * s + dot.height * c;
    return { ...dot, x: dot.x * c - dot.height * s, height: lookUp * away + Math.sqrt(1 - lookUp ** 2) * higher * dot.z, away };
  });
  return { dots: seen.sort((a, b) => b.away - a.away), higher };
}

/** The axes of the program in a corner of a picture at an angle. */
function axesIn(c, frame, { turn }) {
  const [x, y] = [frame.left + 30, frame.top + frame.height - 24];
  const ends = [['x', Math.cos(turn), lookUp * Math.sin(turn)], ['y', -Math.sin(turn), lookUp * Math.cos(turn)], ['z', 0, 0.8]];
  for (const [name, right, up] of ends) {
    line(c, [[x, y], [x + 26 * right, y - 26 * up]], css('--ink'));
    write(c, name, x + 36 * right, y - 36 * up, { align: 'center', color: '--ink' });
  }
}

function pathMap(dots, views, read) {
  const state = { view: views[0], look: looks[0], seen: seenFrom(dots, looks[0]), places: null, frame: null };
  const around = () => ({ x: aroundDots(state.seen.dots.map((dot) => dot.x)), y: aroundDots(state.seen.dots.map((dot) => dot.height)) });
  const all = around();
  const paint = (c, width, height) => {
    const { view, look, seen } = state;
    const frame = { ...evenFrame({ left: 52, top: 76, width: width - 62, height: height - 76 - 44 }, chart.view.x, chart.view.y),
      xLabel: 'x [mm]', yLabel: 'y [mm]' };
    write(c, view.label + (seen.higher > 1 ? `; heights ${seen.higher} times` : ''), 0, 8, { color: '--ink' });
    colorBar(c, view, frame.left, frame.width);
    state.frame = frame;
    if (look.turn === undefined) {
      state.places = plane(c, frame, { grid: true });
    } else {
      state.places = { px: (v) => frame.left + frame.width * (v - frame.x[0]) / (frame.x[1] - frame.x[0] || 1),
        py: (v) => frame.top + frame.height * (1 - (v - frame.y[0]) / (frame.y[1] - frame.y[0] || 1)) };
      axesIn(c, frame, look);
    }
    paintDots(c, { dots: seen.dots, view, frame, ...state.places });
  };
  const chart = drawing({ label: 'Path of the tool', paint, lowOnPaper: true,
    data: () => ({ head: ['line', 'x [mm]', 'y [mm]', 'z [mm]', ...views.map((view) => view.label)],
      rows: dots.map((dot) => [dot.line, dot.x, dot.height, dot.z, ...views.map((view) => dot[view.key])]) }),
    height: (width) => Math.round(Math.min(560, Math.max(340, 0.62 * width))) });
  zoomable(chart, () => state.frame, all);
  const readout = readoutOf(chart, 'Point at a turn for its line, its numbers and its cut.', (place) => {
    const far = (dot) => Math.hypot(state.places.px(dot.x) - place[0], state.places.py(dot.height) - place[1]);
    const near = state.seen.dots.reduce((a, b) => (far(b) <= far(a) ? b : a));
    return far(near) < 30 ? read(near, state.view) : null;
  });
  readout.classList.add('with-cutter');
  const lookFrom = (look) => {
    Object.assign(state, { look, seen: seenFrom(dots, look) });
    Object.assign(all, around());
    chart.view = { ...all };
    chart.redraw();
  };
  chart.controls.append(...[
    choice('Show', views.map((view) => ({ value: view, text: view.name })), state.view,
      (view) => { state.view = view; chart.redraw(); }),
    choice('Seen', looks.map((look) => ({ value: look, text: look.text })), state.look, lookFrom),
  ].filter(Boolean));
  return chart;
}

function worstLines(report) {
  const t = tableNamed(report, 'lines.csv');
  if (!t?.drawn) return null;
  const at = (name) => columnNamed(t, name) || [];
  const order = at('peak_xy_N').map((_, i) => i).filter((i) => at('peak_xy_N')[i] > 0)
    .sort((a, b) => at('peak_xy_N')[b] - at('peak_xy_N')[a]).slice(0, worstShown);
  if (!order.length) return null;
  return section('lines', 'The lines that load the tool most', 'Lines',
    prose('The cause is the most frequent one among the turns within 1 % of the largest force of the line. lines.csv has all lines.'),
    table(['line', 'text', 'force', 'tooth', 'torque', 'deflection', 'cause', 'beyond'], order.map((i) => [
      number(at('line')[i]), el('code', {}, at('text')[i]), `${fixed(at('peak_xy_N')[i], 3)} N`,
      `${fixed(at('peak_tooth_N')[i], 3)} N`, `${fixed(at('torque_peak_Nm')[i], 3)} N m`,
      `${fixed(at('deflection_um')[i], 3)} µm`, at('cause')[i], at('broken')[i] || ''])));
}

function overTime(report) {
  const t = tableNamed(report, 'steps.csv');
  const time = columnNamed(t, 'time_s');
  if (!t?.drawn || !(time?.length > 2)) return { part: null };
  const chart = figure({ key: 'time', x: time, label: 'time', unit: 's', caption: zoomHint + thinned(t) });
  const part = section('time', 'Force over the time of the program', 'Time', chart.element);
  const panel = (label, name, unit, color) => ({ label, unit, height: 180,
    series: [{ name: label, values: columnNamed(t, name), color: seriesColor(color) }] });
  return { part, draw: () => chart.draw([panel('largest force across', 'peak_xy_N', 'N', 0),
    panel('largest torque', 'torque_peak_Nm', 'N m', 1)]) };
}

/** The record over what was computed, and the coefficients and the runout that it gives. */
function recordSection(report, record) {
  const t = tableNamed(report, 'measured_steps.csv');
  const time = columnNamed(t, 'time_s');
  const drawn = t?.drawn && time?.length > 2;
  const chart = drawn ? figure({ key: 'record', x: time, label: 'time of the program', unit: 's',
    caption: zoomHint + thinned(t) }) : null;
  const forces = record.reads === 'forces';
  const rows = record.coefficients.map((one) => [el('code', {}, one.key), number(one.stated, 4),
    isNumber(one.found) ? number(one.found, 4) : 'not found',
    isNumber(one.found) ? `± ${fixed(one.high - one.found, 2)}` : '']);
  const what = forces ? `mean force is ${fixed(record.mean_ratio, 3)} of the computed one, the largest force ${fixed(record.peak_ratio, 3)}`
    : `${record.reads} is ${fixed(record.mean_ratio, 3)} of the computed one`;
  const part = section('record', 'The record over the program', 'Record',
    prose(`The program starts at ${number(record.start_s, 4)} s of the record. Over ${number(record.steps)} turns in cut the measured ${what}.`),
    chart?.element, rows.length ? prose(`Coefficients from the means of ${number(record.fitted_steps)} steady turns. ` +
      'Intervals are 95 %.') : null,
    rows.length ? table(['coefficient', 'stated', 'found', 'interval'], rows) : null,
    record.fit?.ok ? fitOfCuts(record) : null);
  const panel = (label, name, unit) => ({ label, unit, height: 180, series: [
    { name: 'measured', values: columnNamed(t, name), color: seriesColor(1), points: forces ? 0 : 4 },
    { name: 'computed', values: columnNamed(t, `computed_${name}`), color: seriesColor(0) }] });
  const panels = { power: [panel('power', 'power_W', 'W')], torque: [panel('torque', 'torque_Nm', 'N m')],
    forces: [panel('largest force across', 'peak_xy_N', 'N'), panel('mean force in x', 'Fx_mean_N', 'N'),
      panel('mean force in y', 'Fy_mean_N', 'N')] };
  return { part, draw: () => chart?.draw(panels[record.reads]) };
}

/** Coefficients and runout from the forces over the angle in steady cuts of the program. */
function fitOfCuts(record) {
  const { fit } = record;
  const half = (value) => (isNumber(value) ? `± ${fixed(value, 2)}` : '');
  const rows = Object.entries(fit.coefficients).filter(([, one]) => one)
    .map(([key, one]) => [el('code', {}, key), number(one.value, 4), half(one.high - one.value)]);
  const length = (label, value, se) => {  // without an error it was given, or is not known
    if (isNumber(se)) rows.push([label, number(1000 * value, 3), half(1000 * fit.interval_factor * se)]);
  };
  const runout = fit.runout || {};
  (runout.radial_offsets_mm || []).forEach((offset, j) => {
    if (j > 0) length(`tooth ${j + 1} stands out by, µm`, offset, runout.radial_offsets_se_mm?.[j]);
  });
  length('eccentricity, µm', runout.eccentricity_mm, runout.eccentricity_se_mm);
  const lines = [...new Set(record.cuts.map((cut) => cut.line))].join(', ');
  return el('div', {}, prose(`Coefficients and runout from the force over the angle in ${record.cuts.length} steady cuts (lines ${lines}). ` +
    `${fixed(100 * fit.unexplained, 2)} % of the force is not explained. `, el('code', {}, 'material.toml'),
  ' has these numbers: include it in the next case.'), table(['', 'found', 'interval'], rows));
}

/** What the new feeds change, and what holds them for most of the time. */
function feedSection(report, feed) {
  const row = (label, key, unit) => [label, ...['before', 'after'].map((when) => `${fixed(feed[when][key], 3)} ${unit}`)];
  const t = tableNamed(report, 'feeds.csv');
  const at = (name) => columnNamed(t, name) || [];
  const seconds = new Map();
  at('held_by').forEach((name, i) => {
    const time = 60 * (at('to_mm')[i] - at('from_mm')[i]) / at('feed_mm_per_min')[i];
    seconds.set(name, (seconds.get(name) || 0) + time);
  });
  const held = [...seconds].sort((a, b) => b[1] - a[1]).map(([name, time]) => [el('code', {}, name), `${fixed(time, 3)} s`]);
  const some = (lines) => lines.slice(0, 20).join(', ') + (lines.length > 20 ? ' ...' : '');
  return section('feed', 'The program with new feeds', 'Feed',
    feed.file ? prose('The new program is ', el('code', {}, feed.file), ' in the folder of this page. It was read again and its forces were computed again.')
      : prose('No new program was written. To write one, set write in [feed].'),
    table(['', 'as it is', 'with new feeds'], [row('time', 'time_s', 's'), row('in cut', 'time_in_cut_s', 's'),
      row('largest force across', 'peak_xy_N', 'N'), row('of one tooth', 'peak_tooth_N', 'N')]),
    held.length ? table(['limit of the feed', 'for'], held) : null,
    feed.not_reachable.length ? prose(`Even the lowest feed breaks a limit in lines ${some(feed.not_reachable)}.`) : null);
}

function chatterSection(lines) {
  const worst = [...lines].sort((a, b) => a.margin - b.margin).slice(0, worstShown);
  return section('chatter', 'Lines that chatter', 'Chatter',
    prose('The worst line is first. Each row is the cut of the line that is farthest beyond its limit depth. At the better speed this cut is stable ' +
      'with the same feed per tooth.'),
    table(['line', 'limit depth', 'over axial depth', 'chatter', 'speed', 'better speed'], worst.map((one) => [number(one.line),
      `${fixed(one.limit_depth_mm, 3)} mm`, fixed(one.margin, 2), `${number(one.frequency_Hz, 4)} Hz`,
      `${number(one.spindle_rpm, 4)} rpm`, one.better_spindle_rpm ? `${number(one.better_spindle_rpm, 4)} rpm` : 'none within 30 %'])));
}

function wallSection(lines) {
  const worst = [...lines].sort((a, b) => Math.max(b.most_um, -b.least_um) - Math.max(a.most_um, -a.least_um)).slice(0, worstShown);
  return section('walls', 'Walls that stay', 'Walls',
    prose('Errors from the runout and the deflection of the cutter, over the height and along the feed. Positive: material is left. ' +
      'Walls that a later pass cuts away are left out.'),
    table(['line', 'side of the feed', 'least', 'mean', 'most'], worst.map((one) => [number(one.line), one.side,
      ...['least_um', 'mean_um', 'most_um'].map((key) => `${fixed(one[key], 3)} µm`)])));
}

function brokenSection(broken) {
  const some = (lines) => lines.slice(0, 20).join(', ') + (lines.length > 20 ? ' ...' : '');
  return section('limits', 'Limits that lines go beyond', 'Limits', table(['limit', 'allowed', 'most', 'lines'],
    broken.map((one) => [el('code', {}, one.limit), number(one.allowed), number(one.worst, 4), some(one.lines)])));
}
