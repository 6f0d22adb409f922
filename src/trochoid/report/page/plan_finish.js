// The page of `plan` of a finish: which feed keeps Ra below a limit.

const finishPlanKnown = ['of', 'largest_Ra_um', 'inserts_within_um', 'lines', 'cutoff_mm', 'largest_feed', 'feeds'];

function finishPlanPage(report) {
  const { result } = report;
  const there = Array.isArray(result.feeds) && result.feeds.length > 0;
  return [
    { lead: there ? finishPlanLead(result) : null },
    there ? roughnessSection(report) : null,
    toolSection(),
    { part: restSection(result, finishPlanKnown) },
  ];
}

/** The sets of teeth that are compared: their keys, names and colours. */
const setsOfTeeth = (result) => [
  ['as_is_mm', 'Ra_um', 'the teeth as they are', '--s1'],
  ['within_mm', 'Ra_within_um', `a set of inserts within ${number(result.inserts_within_um)} µm`, '--s2'],
  ['alike_mm', 'Ra_alike_um', 'all teeth at one depth', '--s3'],
];

function finishPlanLead(result) {
  if (!isNumber(result.largest_Ra_um)) return null;
  const last = result.feeds.at(-1).feed_per_tooth_mm;
  return [tiles(setsOfTeeth(result).map(([key, , name]) => {
    const feed = result.largest_feed[key];
    return { label: `Largest feed, ${name}`, value: isNumber(feed) ? `${feed === last ? '≥ ' : ''}${fixed(feed, 3)}` : 'none',
      unit: isNumber(feed) ? 'mm per tooth' : '', note: `Ra within ${number(result.largest_Ra_um)} µm` };
  }))];
}

function linesInWords(lines) {
  return lines.map((l) => (isNumber(l.floor_y_mm) ? `the floor at y = ${number(l.floor_y_mm)} mm` :
    `the wall ${number(l.height_mm)} mm above the tip`)).join(', ');
}

function roughnessSection(report) {
  const { result } = report;
  const x = result.feeds.map((f) => f.feed_per_tooth_mm);
  const sets = setsOfTeeth(result);
  const chart = figure({ key: 'feeds', x, label: 'feed per tooth', unit: 'mm' });
  const series = sets.map(([, key, name, color]) => ({ name, color, values: result.feeds.map((f) => f[key]) }));
  if (isNumber(result.largest_Ra_um)) {
    series.push({ name: 'limit', color: '--s6', width: 1.2, dash: [6, 3], values: x.map(() => result.largest_Ra_um) });
  }
  const cell = (value) => (isNumber(value) ? fixed(value, 3) : '–');
  const part = section('feeds', 'Ra at each feed', 'Ra',
    prose(`The largest Ra of ${linesInWords(result.lines)}${isNumber(result.cutoff_mm) ?
      `, with a filter of ${number(result.cutoff_mm)} mm` : ', without a filter'}. 95 of 100 random sets of inserts within ${
      number(result.inserts_within_um)} µm lie below the curve of a set.`),
    chart.element,
    table(['feed per tooth [mm]', ...sets.map(([, , name]) => `Ra, ${name} [µm]`)],
      result.feeds.map((f) => [number(f.feed_per_tooth_mm, 4), ...sets.map(([, key]) => cell(f[key]))])));
  return { part, draw: () => chart.draw([{ label: 'Ra', unit: 'µm', height: 260, series }]) };
}
