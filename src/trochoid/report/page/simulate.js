// The page of `simulate`.

const simulateKnown = ['mean_N', 'min_N', 'max_N', 'rms_N', 'peak_xy_N', 'torque_mean_Nm',
  'torque_peak_Nm', 'power_W', 'teeth', 'volume_check', 'comparison',
  'teeth_height_mm', 'gauge_length_mm', 'bending_peak_Nm'];
const isBending = (key) => key.startsWith('bending');

function simulatePage(report) {
  const { result } = report;
  const bending = Object.entries(result).find(([key, value]) => isBending(key) && isNumber(value));
  const parts = [
    { part: null, lead: tiles([
      { label: 'Peak force across the tool', value: result.peak_xy_N, unit: 'N' },
      { label: 'Mean torque', value: result.torque_mean_Nm, unit: 'N m',
        note: isNumber(result.torque_peak_Nm) && `peak ${number(result.torque_peak_Nm)} N m` },
      { label: 'Power', value: result.power_W, unit: 'W' },
      bending && { label: sentence(words(nameAndUnit(bending[0]).name)), value: bending[1],
        unit: nameAndUnit(bending[0]).unit, note: isNumber(result.gauge_length_mm) &&
          `${number(result.gauge_length_mm)} mm above the tip` },
    ]) },
    ...comparisonParts(report),
    forcesOverAngle(report),
    { part: statistics(result) },
    chipSection(report),
    { part: engagementSection(result.teeth, result.teeth_height_mm) },
    { part: volumeSection(result.volume_check) },
    toolSection(),
    channelsOverAngle(report),
    { part: restSection(result, simulateKnown) },
  ];
  return parts;
}

/** Where the case names measurements: the computed force against them. */
function comparisonParts(report) {
  const list = report.result.comparison;
  const parts = measuredOverAngle(report, {
    heading: 'Measured and computed force', short: 'Comparison',
    text: 'Force on the tool. Grey: measured. Coloured: computed from the case. ' +
      'No coefficient is fitted.',
  });
  if (!Array.isArray(list) || !list.length) return parts;
  const rows = list.map((run) => [run.file || '', number(run.rms_N, 3), number(run.measured_rms_N, 3),
    number(run.phase_deg)]);
  parts.push({ part: section('comparison', 'The comparison in numbers', 'Difference',
    table(['record', 'difference, N rms', 'measured, N rms', 'phase of the record, °'], rows, { class: 'fits' })) });
  return parts;
}

function forcesOverAngle(report) {
  const forces = tableNamed(report, 'forces.csv');
  const x = columnNamed(forces, 'angle_deg');
  if (!x?.length) return null;
  const panels = forcePanels((axis) => {
    const values = columnNamed(forces, `F${axis}_N`);
    const measured = columnNamed(forces, `F${axis}_measured_N`);
    const color = seriesColor(axesOfForce.indexOf(axis));
    return [
      measured && { name: 'measured', values: measured, color: '--measured', width: 2.2 },
      values && { name: measured ? 'computed' : '', values, color, width: 1.8 },
    ].filter(Boolean);
  });
  const chart = figure({
    key: 'angle', x, label: 'φ, spindle angle', unit: '°', caption: zoomHint + thinned(forces),
  });
  const time = columnNamed(forces, 'time_s');
  const state = { x };
  const over = (name) => {
    state.x = name === 'time' ? time : x;
    Object.assign(chart.stack, name === 'time' ? { key: 'time', label: 'time', unit: 's' }
      : { key: 'angle', label: 'φ, spindle angle', unit: '°' });
    chart.element.querySelector('figcaption').firstChild.textContent = stackLabel(chart.stack);
    chart.draw(panels, state.x);
    chart.zoom([state.x[0], state.x[state.x.length - 1]]);
  };
  chart.controls.append(...[rangeChoice([chart], x, () => state.x), time && choice('Over', [
    { value: 'angle', text: 'angle' }, { value: 'time', text: 'time' }], 'angle', over)].filter(Boolean));
  const part = section('forces', 'Cutting force over the spindle angle', 'Forces',
    prose('Force on the tool in the workpiece frame: x is the direction of feed, z points up.'),
    chart.element);
  return { part, draw: () => chart.draw(panels) };
}

function channelsOverAngle(report) {
  const forces = tableNamed(report, 'forces.csv');
  const x = columnNamed(forces, 'angle_deg');
  const channels = (forces?.columns || []).filter((column) => /^channel\d+_/.test(column.name));
  if (!x?.length || !channels.length) return null;
  const chart = figure({
    key: 'angle', x, label: 'φ, spindle angle', unit: '°', caption: zoomHint + thinned(forces),
  });
  const panels = channels.map((column, i) => ({
    label: words(nameAndUnit(column.name).name).replace(/(\d)/, ' $1'),
    unit: nameAndUnit(column.name).unit, height: 120,
    series: [{ name: '', values: column.values, color: seriesColor(i) }],
  }));
  const part = section('channels', 'What the dynamometer reads', 'Channels',
    prose('The same force in the channels of the dynamometer.'), chart.element);
  return { part, draw: () => chart.draw(panels) };
}

function statistics(result) {
  const rows = [['mean_N', 'mean'], ['min_N', 'smallest'], ['max_N', 'largest'], ['rms_N', 'rms']]
    .filter(([key]) => Array.isArray(result[key]))
    .map(([key, name]) => [name, ...result[key].map((value) => number(value))]);
  if (!rows.length) return null;
  return section('numbers', 'The force in numbers', 'Numbers',
    table(['N', ...axesOfForce.map(forceName)], rows));
}

function volumeSection(check) {
  if (isEmpty(check)) return null;
  return section('volume', 'Self-check: material removed', 'Self-check',
    prose('The chips of all teeth together must be as large as the material that the feed brings into the cut. ' +
      'They are equal if the model looks at all earlier teeth. A model that looks at the previous tooth only counts ' +
      'more material than exists.'),
    typeof check === 'object' ? described(check) : prose(shown(check)));
}
