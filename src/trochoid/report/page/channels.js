// Channels of a sensor, means, and what is known together: parts of the page of `identify`.

/** The channels of a fit with the columns of channels.csv that are theirs. */
function channelsOf(fit) {
  return (fit?.channels || []).map((channel, i) => {
    const column = (what) => `channel${i + 1}_${what}_${channel.unit}`;
    return { ...channel, measured: column('measured'), fitted: column('fitted'),
      unit: channel.unit === 'Nm' ? 'N m' : channel.unit };
  });
}

/** Curves over the angle, one panel for each channel. */
function channelCurves(report, fit) {
  const values = tableNamed(report, 'channels.csv');
  const angle = columnNamed(values, 'angle_deg');
  if (!fit || !angle?.some(isNumber)) return [];
  const runs = [...new Set(columnNamed(values, 'run'))]
    .filter((run) => rowsOfRun(values, run)('angle_deg').some(isNumber));
  const state = { run: runs[0] };
  const chart = figure({ key: 'recorded', x: rowsOfRun(values, state.run)('angle_deg'),
    label: 'φ, recorded spindle angle', unit: '°', caption: zoomHint + thinned(values) });
  const redraw = () => {
    const of = rowsOfRun(values, state.run);
    chart.draw(channelsOf(fit).map((channel) => ({
      label: channel.axis, unit: channel.unit, height: 150,
      series: [
        { name: 'measured', values: of(channel.measured), color: '--measured', width: 2.2 },
        { name: modelName(fit.chip_model), values: of(channel.fitted), color: modelColor(fit.chip_model, 0), width: 1.6 },
      ].filter((series) => series.values),
    })), of('angle_deg'));
  };
  chart.controls.append(...[choice('Run', runs.map((r) => ({ value: r, text: number(r) })), state.run,
    (run) => { state.run = run; redraw(); })].filter(Boolean));
  return [{ part: section('measured', 'What the channels read, and the fit', 'Channels',
    prose('Grey: measured. Coloured: computed by the fit.'), chart.element), draw: redraw }];
}

/** Measured and fitted means, cut by cut. */
function channelMeans(report, fit) {
  const values = tableNamed(report, 'channels.csv');
  const angle = columnNamed(values, 'angle_deg');
  if (!fit || !angle || angle.every(isNumber)) return null;
  const channels = channelsOf(fit);
  const rows = angle.map((_, i) => i).filter((i) => !isNumber(angle[i])).map((i) => [
    number(columnNamed(values, 'run')[i]),
    ...channels.flatMap((channel) => {
      const [is, made] = [columnNamed(values, channel.measured)[i], columnNamed(values, channel.fitted)[i]];
      return [number(is, 4), [number(made, 4), el('small', {}, number(is - made, 2))]];
    })]);
  return section('means', 'Means, measured and fitted', 'Means',
    prose('One row per cut. The small number is measured minus fitted. A difference that bends over the feed means ' +
      'that some teeth do not cut at small feeds.'),
    table(['cut', ...channels.flatMap((channel) => [`${channel.axis}, ${channel.unit}`, 'fitted'])], rows));
}

/** Sums of coefficients that are known, and the prior. */
function knownTogether(fit) {
  const sums = (fit?.combination || []).map(({ weights, value, se }) => {
    const names = Object.entries(weights || {});
    const unit = nameAndUnit(names[0][0]).unit;
    const width = (fit.interval_factor || normalInterval) * se;
    return [names.flatMap(([key, weight], i) => [
      i ? ` ${weight < 0 ? '−' : '+'} ${number(Math.abs(weight), 4)} ` : null, symbol(nameAndUnit(key).name)]),
    [el('b', {}, measured(value, width)), ` ${unit}`], `± ${measured(width, width)}`];
  });
  return sums.length ? section('combination', 'What is known together', 'Together',
    prose('The single coefficients are not known. These sums of them are known:'),
    table(['sum', 'value', '95 %'], sums)) : null;
}

function priorSection(fit) {
  const rows = Object.entries(fit?.prior || {}).map(([key, { mean, sd }]) => {
    const { name, unit } = nameAndUnit(key);
    const alone = fit.data_alone?.[key];
    const answer = fit.coefficients?.[key];
    const cell = (entry) => (isNumber(entry?.value) ?
      [measured(entry.value, half(entry)), el('small', {}, `± ${measured(half(entry), half(entry))}`)] : missing);
    return [[symbol(name), el('small', {}, unit)], [number(mean, 4), el('small', {}, `± ${number(normalInterval * sd, 2)}`)],
      cell(alone), cell(answer)];
  });
  return rows.length ? section('prior', 'What was known before, and what the channels add', 'Prior',
    prose('± is half of a 95 % interval.'), table(['', 'prior', 'channels alone', 'together'], rows)) : null;
}
