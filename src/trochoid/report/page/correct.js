// The page of `correct`: the flutes before and after, the command, its limits.

const correctKnown = ['runout', 'before', 'after', 'reduction', 'command', 'allowed_difference',
  'max_rpm', 'max_rpm_cut', 'spindle_speed', 'axes', 'controller'];

const strategyNames = { sine_plain: 'sine, plain', sine_lead: 'sine, phase lead',
  sine_inverse: 'sine, plant inversion', square_lead: 'square, phase lead',
  quintic_chosen: 'quintic, width and harmonics chosen', spindle_sine: 'spindle speed, a sine',
  this_case: 'this case' };

function correctPage(report) {
  return [
    { lead: correctLead(report.result) },
    flutesSection(report.result),
    correctForcesSection(report),
    commandSection(report),
    controllerSection(report),
    speedsSection(report),
    spindleSection(report),
    { part: limitsSection(report.result.command, report.said) },
    { part: wallsSection(report.result) },
    { part: correctRunoutSection(report.result) },
    { part: restSection(report.result, correctKnown) },
  ];
}

/** Two decimals, whatever the size: shares of about the same kind stand side by side. */
const inPercent = (x) => (isNumber(x) ? (100 * x).toFixed(2) : null);

function correctLead({ before, after, command, reduction, controller }) {
  if (!after) return null;
  const rpm = command.spindle_rpm;
  return [tiles([
    { label: 'Difference of the flutes, before', value: inPercent(before.difference), unit: '%',
      note: 'of the larger peak of |Fy|' },
    { label: 'With the command', value: inPercent(after.difference), unit: '%',
      note: isNumber(reduction) && `${(100 * reduction).toFixed(1)} % less` },
    { label: 'Command, peak to peak', value: number(command.peak_to_peak_um, 4), unit: 'µm',
      note: [isNumber(command.stroke_margin_um) && `${number(command.stroke_margin_um, 3)} µm of the stroke to spare`,
        isNumber(rpm) && `at ${number(rpm)} rpm`].filter(Boolean).join('; ') },
    controller && { label: 'Under the controller', value: inPercent(controller.difference_running),
      unit: '%', note: controller.fault ? `fault: ${controller.fault}` :
        isNumber(controller.turns_to_3_percent) &&
        `below 3 % after ${controller.turns_to_3_percent} running turns` },
  ])];
}

/** The bars of one quantity with an axis at their left; returns where each is, and its value in words. */
function paintFlutes(c, kind, sides, { left, top, width }) {
  const values = sides.map((side) => side.flutes.map(kind.of));
  const most = Math.max(...values.flat()) || 1;
  const [start, floor, tall] = [left + 44, top + 198, 172];
  write(c, kind.name, left + 4, top + 10, { color: '--ink' });
  for (const v of ticksBetween(0, most, 4)) {
    const at = Math.round(floor - tall * v / most) + 0.5;
    line(c, [[start - 4, at], [left + width - 10, at]], css('--grid'));
    write(c, number(v, 4), start - 7, at, { align: 'right' });
  }
  const slot = (width - 54) / values[0].length;
  return values[0].flatMap((_, j) => {
    write(c, `flute ${sides[0].flutes[j].tooth}`, start + (j + 0.48) * slot, top + 210, { align: 'center' });
    return [['--s2', 0.08, 'before'], ['--s1', 0.5, 'after']].map(([color, shift, when], k) => {
      const [x0, high] = [start + (j + shift) * slot, tall * values[k][j] / most];
      filled(c, [[x0, floor], [x0, floor - high], [x0 + 0.38 * slot, floor - high], [x0 + 0.38 * slot, floor]], css(color));
      return { x: [x0, x0 + 0.38 * slot], y: [top + 20, floor],
        text: `flute ${sides[0].flutes[j].tooth}, ${when}: ${kind.name} ${number(values[k][j], 5)}` };
    });
  });
}

/** Bars of one quantity, a pair for each flute: before and after. */
function flutesSection({ before, after }) {
  if (!before?.flutes || !after?.flutes) return null;
  const kinds = [
    { name: 'peak of |Fy|, N', of: (f) => f.peak_Fy_N },
    { name: 'chip area, mm rad', of: (f) => f.chip_area_mm_rad },
    before.flutes.length > 2 && isNumber(before.flutes[0].own_peak_Fy_N)
      ? { name: 'its own |Fy|, N', of: (f) => f.own_peak_Fy_N, alone: true }
      : { name: 'thickest chip, µm', of: (f) => 1000 * f.peak_chip_mm },
  ];
  const inRow = (width) => (width < 520 ? 1 : kinds.length);
  const rows = before.flutes.map((f, i) => [`${f.tooth}`,
    ...kinds.flatMap(({ of }) => [number(of(f), 4), number(of(after.flutes[i]), 4)])]);
  let bars = [];
  const paint = (c, width) => {
    bars = [];
    const columns = inRow(width);
    kinds.forEach((kind, index) => bars.push(...paintFlutes(c, kind, [before, after],
      { left: (index % columns) * width / columns, top: 220 * Math.floor(index / columns), width: width / columns })));
  };
  const chart = drawing({ label: 'Bars of every flute before and after the command', paint,
    data: () => ({ head: ['flute', ...kinds.flatMap(({ name }) => [`${name}, before`, `${name}, after`])],
      rows: before.flutes.map((f, i) => [f.tooth, ...kinds.flatMap(({ of }) => [of(f), of(after.flutes[i])])]) }),
    height: (width) => 220 * Math.ceil(kinds.length / inRow(width)) });
  readoutOf(chart, 'Point at a bar for its value.', ([x, y]) => bars.find((bar) =>
    x >= bar.x[0] && x <= bar.x[1] && y >= bar.y[0] && y <= bar.y[1])?.text);
  const part = section('flutes', 'Flutes before and after', 'Flutes',
    prose('Left bar: without the command. Right bar: with it. A peak is the largest total force on the tool ' +
      'while the flute cuts. The chip area is the material that the flute cuts at its tip. ' +
      'Equal peaks are not equal chip loads.' + (kinds.some(({ alone }) => alone) ? ' "Its own |Fy|" is the force of ' +
      'this flute alone. A dynamometer cannot show it while several flutes cut at once.' : '')),
    chart.element,
    table(['flute', ...kinds.flatMap(({ name }, k) => [k === 0 ? '|Fy| before, N' :
      name.replace(/,(?=[^,]*$)/, ' before,'), 'after'])], rows), ownForces(after, before));
  return { part, draw: () => chart.resize() };
}

/** What a dynamometer does not show. */
function ownForces(after, before) {
  return isNumber(after.own_difference) && after.flutes.length > 2 ? prose(
    `The peaks of the flutes' own |Fy| differ by ${inPercent(before.own_difference)} % before and ` +
    `${inPercent(after.own_difference)} % after.`) : null;
}

function correctForcesSection(report) {
  const t = tableNamed(report, 'forces.csv');
  const x = columnNamed(t, 'angle_deg');
  if (!x || x.length < 3) return null;
  const chart = figure({ key: 'phi', x, label: 'φ, spindle angle', unit: '°',
    caption: zoomHint + thinned(t) });
  const panels = axesOfForce.map((axis) => ({ label: forceName(axis), unit: 'N', height: 170,
    series: [['before', '--s2', [6, 3]], ['after', '--s1']].map(([when, color, dash]) => ({
      name: when, values: columnNamed(t, `F${axis}_${when}_N`), color, dash, width: 1.8 })) }))
    .filter((panel) => panel.series.some((s) => s.values?.some((v) => v)));
  const part = section('forces', 'Forces over a turn', 'Forces',
    prose('Force on the tool in the last computed turn, with tool, table and actuator in motion. ' +
      'Before: without the command. After: with the command.'), chart.element);
  return { part, draw: () => chart.draw(panels) };
}

function commandSection(report) {
  const t = tableNamed(report, 'command.csv');
  const x = columnNamed(t, 'angle_deg');
  if (!x || x.length < 3) return null;
  const forces = tableNamed(report, 'forces.csv');
  const at = columnNamed(forces, 'angle_deg');
  const moved = columnNamed(forces, 'table_after_um');
  const { offset_um: middle = 0 } = report.result.command || {};
  const there = at && moved && x.map((phi) => moved[nearest(at, phi)] + middle);
  const chart = figure({ key: 'phi', x, label: 'φ, spindle angle', unit: '°',
    caption: zoomHint + thinned(t) });
  const panels = [{ label: 'position', unit: 'µm', height: 260, series: [
    { name: 'command', values: columnNamed(t, 'command_um'), color: '--s1', width: 2 },
    { name: 'table wanted', values: columnNamed(t, 'table_wanted_um'), color: '--s3',
      dash: [6, 3] },
    there && { name: 'table', values: there, color: '--s2' }].filter(Boolean) }];
  const { table_deviation_um: deviation, spindle_rpm: rpm } = report.result.command;
  const shift = report.result.runout?.angle_offset_deg;
  const part = section('command', 'Command and table over a turn', 'Command',
    prose('The command to the actuator (feedforward), the motion that the table should make, and the motion that it makes under the cutting force. ',
      isNumber(deviation) ? `The table is at most ${number(deviation, 2)} µm off. ` : '',
      'command.csv and command.h contain the command.', isNumber(rpm) ? ` It is made for ${number(rpm)} rpm. At another speed it is wrong.` : '',
      isNumber(shift) && shift !== 0 ? [' A recorded angle plus ', el('b', {}, `${number(shift, 3)}°`),
        ' is φ. In command.h this number is trochoid_command_offset_deg.'] : null), chart.element);
  return { part, draw: () => chart.draw(panels) };
}

function controllerSection(report) {
  const { controller } = report.result;
  if (!controller?.turns?.length) return null;
  const x = controller.turns.map((turn) => turn.turn);
  const peaks = controller.turns[0].peaks_Fy_N.map((_, j) => ({ name: `flute ${j + 1}`,
    values: controller.turns.map((turn) => turn.peaks_Fy_N[j]), color: seriesColor(j),
    width: 1.8 }));
  const t = tableNamed(report, 'controller.csv');
  const time = columnNamed(t, 'time_s');
  const state = (name) => controller.turns.findIndex((turn) => turn.state === name);
  const markers = ['fading in', 'running', 'fault'].map((name) => [state(name), name])
    .filter(([i]) => i >= 0).map(([i, text]) => ({ x: x[i], text }));
  const turns = figure({ key: 'turn', x, label: 'turn of the spindle', unit: '',
    caption: zoomHint });
  const samples = time && figure({ key: 'time', x: time, label: 'time', unit: 's',
    caption: zoomHint + thinned(t) });
  const part = section('controller', 'The controller in the loop', 'Controller',
    prose('The real-time core runs step by step on the model of the cut. The curves are the peak of |Fy| of each flute ' +
      'in every turn, the difference of the flutes, and the command.'),
    turns.element, samples ? samples.element : null, toolEvents(controller));
  return { part, draw: () => {
    turns.draw([{ label: 'peak of |Fy|', unit: 'N', height: 190, markers, series: peaks },
      { label: 'difference', unit: '%', height: 130, markers, series: [{ name: '',
        values: controller.turns.map((turn) => 100 * turn.difference), color: '--s3',
        width: 2 }] }]);
    samples?.draw([{ label: 'command', unit: 'µm', height: 170, series: [
      { name: '', values: columnNamed(t, 'command_um'), color: '--s1', width: 1.6 }] }]);
  } };
}

/** What the estimator recognised of the tool. */
function toolEvents({ turns }) {
  const told = turns.filter((turn) => turn.tool && turn.tool !== 'unchanged');
  return told.length ? prose(told.map((turn) => `Turn ${turn.turn}: ${turn.tool}.`).join(' '))
    : null;
}

function speedsSection(report) {
  const t = tableNamed(report, 'speeds.csv');
  const x = columnNamed(t, 'spindle_rpm');
  if (!x || x.length < 2) return null;
  const { max_rpm: highest = {}, allowed_difference: allowed } = report.result;
  const names = Object.keys(strategyNames).filter((name) => columnNamed(t, `${name}_difference`));
  const curves = (ending, factor) => names.map((name, i) => ({ name: strategyNames[name],
    values: columnNamed(t, `${name}_${ending}`).map((v) => (isNumber(v) ? factor * v : null)),
    color: seriesColor(i), dash: dashOf(i), width: name === 'this_case' ? 2.4 : 1.6 }));
  const chart = figure({ key: 'rpm', x, label: 'spindle speed', unit: 'rpm',
    caption: zoomHint + thinned(t) });
  const limit = { name: 'allowed', values: x.map(() => 100 * allowed), color: '--soft',
    dash: [2, 4] };
  const part = section('speeds', 'Other speeds and other ways', 'Speeds',
    prose('The remaining difference of the peaks at other spindle speeds, ' +
      (report.result.max_rpm_cut === 'moving' ? 'simulated with tool, table and actuator'
        : 'for a rigid tool') + '. Each motion has the size ' +
      'that makes the peaks equal if the table follows it exactly. The lower picture shows the command that this needs. ' +
      'Beyond the stroke the command is cut off, and the difference includes this.'), chart.element,
    table(['strategy', `highest speed for ${number(100 * allowed, 3)} %, rpm`],
      names.map((name) => [strategyNames[name], !(highest[name] > 0) ? 'none' :
        highest[name] >= x[x.length - 1] ? `${number(x[x.length - 1])} or more` : number(highest[name], 3)])));
  const { limits = [] } = report.result.command;
  const stroke = limits.find((limit_) => limit_.what === 'stroke_um')?.limit;
  return { part, draw: () => chart.draw([
    { label: 'difference of the peaks', unit: '%', height: 230,
      series: [...curves('difference', 100), limit] },
    { label: 'command, peak to peak', unit: 'µm', height: 190, series: [...curves('command_um', 1),
      isNumber(stroke) && { name: 'stroke', values: x.map(() => stroke), color: '--soft', dash: [2, 4] }].filter(Boolean) }]) };
}

/** The alternative without a table: a spindle speed that changes within the turn. */
function spindleSection(report) {
  const { spindle_speed: s } = report.result;
  const t = tableNamed(report, 'spindle.csv');
  const x = columnNamed(t, 'angle_deg');
  if (!s || !x || x.length < 3) return null;
  const chart = figure({ key: 'phi', x, label: 'φ, spindle angle', unit: '°',
    caption: zoomHint + thinned(t) });
  const part = section('spindle', 'A spindle speed that changes within the turn instead',
    'Spindle', prose(`With a rigid tool, a sine of the spindle speed has the same effect as a sine of the table. ` +
      `It changes the speed by up to ${inPercent(s.speed_change)} % and needs ` +
      `${number(s.torque_Nm, 3)} of ${number(s.torque_limit_Nm, 3)} N m. ` + (s.limit ?
        `Only ${inPercent(s.part)} % of the motion is possible. The limit is ${s.limit}. ` : '') +
      `The peaks then differ by ${inPercent(s.difference)} %.`), chart.element);
  return { part, draw: () => chart.draw([
    { label: 'speed', unit: 'rpm', height: 150, series: [{ name: '',
      values: columnNamed(t, 'spindle_rpm'), color: '--s1', width: 1.8 }] },
    { label: 'torque', unit: 'N m', height: 130, series: [{ name: '',
      values: columnNamed(t, 'torque_Nm'), color: '--s2', width: 1.8 }] }]) };
}

function limitsSection(command, { optimum }) {
  if (!command?.limits?.length) return null;
  const rows = command.limits.map((l) => [el('span', {}, inPrint(l.reason)),
    l.ok === null ? 'not known' : l.ok ? 'within' : el('b', {}, 'beyond')]);
  return section('limits', 'Limits of the actuator', 'Limits',
    table(['what', 'against its limit'], rows),
    optimum ? prose(`${sentence(optimum)}.`) : null,
    command.learning ? prose(`Iterative learning control: ${command.learning.iterations} iterations, ` +
      `${command.learning.converged ? 'converged' : 'not converged'}.`) : null);
}

/** What is left on the walls: a table along the feed moves the marks, not their depth. */
function wallsSection({ before, after }) {
  if (!before?.walls?.length) return null;
  const shares = (wall) => wall.share.map((s) => number(100 * s, 3)).join(', ');
  const rows = before.walls.map((wall, i) => [wall.theta_deg === 0 ? 'where the teeth enter' :
    'where the teeth leave', number(wall.peak_to_valley_um, 3),
  number(after.walls[i].peak_to_valley_um, 3), shares(wall), shares(after.walls[i])]);
  return section('walls', 'Feed marks on the walls', 'Walls',
    prose('Marks of the teeth on the walls on both sides of the cutter, for a rigid tool. A table that moves ' +
      'along the feed shifts the marks. The longest tooth decides how deep they are.'),
    table(['wall', 'marks before, µm', 'after', 'made by each flute before, %', 'after'], rows));
}

function correctRunoutSection({ runout, axes }) {
  if (!runout) return null;
  const list = (values) => values?.map((v) => number(v, 4)).join(', ');
  const nothing = (um) => (um < 1e-3 ? '0' : number(um, 3));
  const rows = [
    ['stands out by, µm (mean 0)', list(runout.radial_offsets_um)],
    ['chip of each tooth minus the feed per tooth, µm', list(runout.chip_difference_um)],
    ['the command is made for, µm', list(runout.designed_for_um)],
    runout.static_fit && ['found in the forces by a rigid model, µm',
      runout.static_fit.chip_difference_um.map((v) => measured(v.value, normalInterval * v.se)).join(', ')],
    runout.ratio_um && ['found in the ratio of the peaks, µm', list(runout.ratio_um)],
  ].filter(Boolean);
  return section('runout', 'Runout', 'Runout', table(['', ''], rows), axes ?
    prose(`The chips of the teeth differ by ${number(axes.uncorrected_um, 3)} µm (root mean square over the cut) without a command, ` +
      `by ${nothing(axes.one_axis_um)} µm with the best command of this axis, and by ${nothing(axes.two_axes_um)} µm with a second axis.`) : null);
}
