// The page of `calibrate` where roughness traces were measured.

const finishKnown = ['finish'];
const traceLine = (t) => (isNumber(t.floor_y_mm) ? `floor, y = ${number(t.floor_y_mm, 4)} mm` :
  `wall, ${number(t.height_mm, 4)} mm above the tip`);
const toothName = (t, tooth) => (t.numbered ? `tooth ${tooth.tooth}` : `${tooth.tooth}`);

function finishPage(report) {
  const fitted = report.result.finish.filter((t) => t.teeth);
  return [
    { lead: fitted.length ? finishLead(fitted[0]) : null },
    ...report.result.finish.map((t, i) => traceSection(report, t, i)),
    ...fitted.map((t) => ({ part: teethPart(t, fitted.length > 1) })),
    toolSection(),
    { part: restSection(report.result, finishKnown) },
  ];
}

function finishLead(t) {
  const writing = t.teeth.filter((tooth) => tooth.writes);
  const shortest = writing.reduce((a, b) => (b.offset_mm.value < a.offset_mm.value ? b : a));
  const width = micro(half(shortest.offset_mm));
  return [tiles([
    { label: 'Teeth that write differ by', value: measured(micro(-shortest.offset_mm.value), width), unit: 'µm',
      note: writing.length > 1 ? `95 %: ± ${measured(width, width)} µm` : 'only one tooth writes' },
    { label: 'Teeth that write nothing', value: `${t.teeth.length - writing.length}`, unit: `of ${t.teeth.length}` },
    { label: 'Roughness Ra of the marks', value: fixed(t.Ra_um, 3), unit: 'µm',
      note: `with all teeth at one depth ${fixed(t.Ra_alike_um, 3)} µm` },
    { label: 'Left by the fit', value: fixed(t.rms_um, 2), unit: 'µm rms',
      note: `Ra of the trace itself: ${fixed(t.Ra_measured_um, 3)} µm` },
    { label: 'Feed of a turn', value: measured(t.feed_mm.value, half(t.feed_mm)), unit: 'mm', note: 'found in the trace' },
  ])];
}

/** Measured and fitted along the feed, less the line through them. */
function traceSection(report, trace, index) {
  const all = tableNamed(report, 'trace.csv');
  const rows = (columnNamed(all, 'measurement') || []).map((m, i) => (m === index + 1 ? i : -1)).filter((i) => i >= 0);
  if (rows.length < 2) return null;
  const pick = (name) => rows.map((i) => columnNamed(all, name)[i]);
  const [x, was, fit, left] = ['x_mm', 'measured_mm', 'fitted_mm', 'residual_mm'].map(pick);
  const slope = slopeOf(x, fit);
  const flat = (values) => values.map((z, i) => micro(z - slope.at(x[i])));
  const chart = figure({ key: `trace${index}`, points: false, x: [x[0], x[x.length - 1]], unit: 'mm', label: 'along the feed',
    caption: zoomHint + thinned(all) });
  const part = section(`trace${index}`, `The trace: ${traceLine(trace)}`, 'Trace',
    prose(`${trace.file}, minus a straight line. Each tooth leaves the same mark in every turn. Its offset moves all of ` +
      'these marks up or down. Only noise should be left, without anything that repeats.'), chart.element);
  const draw = () => chart.draw([
    { label: 'height of the surface', unit: 'µm', height: 260, series: [
      { name: 'measured', color: '--s6', values: flat(was) },
      { name: 'fitted', color: '--s1', values: flat(fit) }] },
    { label: 'measured less fitted', unit: 'µm', height: 120, series: [
      { name: 'left', color: '--s6', values: left.map(micro) }] }], x);
  return { part, draw };
}

/** The line through a curve. */
function slopeOf(x, z) {
  const n = x.length;
  const [mx, mz] = [x, z].map((v) => v.reduce((a, b) => a + b, 0) / n);
  const xx = x.reduce((sum, v) => sum + (v - mx) ** 2, 0);
  const xz = x.reduce((sum, v, i) => sum + (v - mx) * (z[i] - mz), 0);
  return { at: (v) => mz + (xx > 0 ? xz / xx : 0) * (v - mx) };
}

function teethPart(t, several) {
  const rows = t.teeth.map((tooth) => {
    const width = tooth.writes ? micro(half(tooth.offset_mm)) : 0;
    return [toothName(t, tooth),
      tooth.writes ? `${measured(micro(tooth.offset_mm.value), width)}${width > 0 ? ` ± ${measured(width, width)}` : ''}` :
        `below ${number(micro(tooth.at_most_mm), 3)}: writes nothing`,
      `${fixed(100 * tooth.share, 2)} %`];
  });
  const waves = (t.waves || []).map((w) => [`${w.per_turn} per turn`,
    `${measured(micro(w.amplitude_mm.value), micro(half(w.amplitude_mm)))} ± ${
      measured(micro(half(w.amplitude_mm)), micro(half(w.amplitude_mm)))}`,
    `${number(w.phase_deg.value, 3)}`]);
  return section(`teeth${several ? t.file : ''}`, `How far the teeth reach: ${traceLine(t)}`, 'Teeth',
    prose(t.numbered ? 'The unequal pitch tells which tooth is which.' : 'The teeth are in their order of passage, from the deepest ' +
      'one on. With equal pitch the trace cannot tell the number of this tooth.'),
    table([t.numbered ? 'tooth' : 'in order of passage', 'offset [µm], 95 %', 'share of the trace'], rows),
    t.feeds?.length ? table(['feed per tooth [mm]', 'Ra [µm]', 'Ra with all teeth at one depth [µm]'],
      t.feeds.map((f) => [number(f.feed_per_tooth_mm, 4), fixed(f.Ra_um, 3), fixed(f.Ra_alike_um, 3)])) : null,
    waves.length ? table(['wave of the offsets', 'amplitude [µm], 95 %', 'crest [deg]'], waves) : null);
}
