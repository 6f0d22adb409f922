// The page of `sweep`: what was taken from every case, over what was swept.

const sweepKnown = ['command', 'method', 'rows', 'failed', 'keys', 'draws', 'drawn', 'quantities'];
const shortPath = (path) => path.replace(/^result\./, '');

/** Name and unit of a path; the entry of a list is part of the name: `mean_N[2]`. */
function taken(path) {
  const [, whole, entry] = /^(.*?)((?:\[\d+\])?)$/.exec(shortPath(path).split('.').pop());
  const { name, unit } = nameAndUnit(whole);
  return { name: axisWords(name, entry) ?? words(name) + entry.replace(/[[\]]/g, ' ').trimEnd(), unit };
}

/** Three numbers of a force are those along x, y and z. */
function axisWords(name, entry) {
  const statistic = { mean: 'mean', min: 'smallest', max: 'largest', rms: 'rms of' }[name];
  const axis = axesOfForce[Number(entry.slice(1, -1)) - 1];
  if (name === 'peak_xy') return 'peak force in the plane of the table';
  return statistic && axis ? `${statistic} F${axis}` : undefined;
}

function sweepPage(report) {
  const { result } = report;
  const t = tableNamed(report, 'sweep.csv');
  const quantities = Array.isArray(result.quantities) ? result.quantities : [];
  const keys = result.keys || [];
  const all = [...keys, ...(result.drawn || [])];
  const bands = tableNamed(report, 'bands.csv');
  return [
    { lead: bands ? null : sweepTiles(quantities) },
    bandSection(bands, keys, quantities, result.draws),
    // Where there are bands, they say it better than a cloud of all draws.
    ...(bands && keys.length === 1 ? [] :
      keys.map((_, i) => sweptSection(t, keys, i, quantities))),
    { part: quantities.length > 0 && all.length > 1 ?
      tornadoSection(t, all, quantities, bands ? keys : []) : null },
    { part: bands ? section('bands', 'The intervals', 'Intervals',
      prose('Median, 95 % from low to high, and standard deviation (sd) over the draws.'), firstRows(bands, { most: 40, digits: 4 })) : null },
    { part: t ? section('rows', 'The table', 'Table', firstRows(t, { digits: 5 })) : null },
    { part: restSection(result, sweepKnown) },
  ];
}

function sweepTiles(quantities) {
  return tiles(quantities.slice(0, 4).filter((q) => isNumber(q.median)).map((q) => {
    const { name, unit } = taken(q.take);
    const chance = isNumber(q.low);
    return { label: sentence(name), value: fixed(q.median, 4), unit,
      note: `${chance ? '95 % of the cases' : 'all cases'}: ${
        fixed(chance ? q.low : q.min, 4)} to ${fixed(chance ? q.high : q.max, 4)}` };
  }));
}

const numeric = (values) => values?.some(isNumber);

/** Every quantity over one key, a point a case. */
function sweptSection(t, keys, i, quantities) {
  const key = keys[i];
  const x = columnNamed(t, key);
  if (!numeric(x) || new Set(x).size < 2) return null;
  const order = x.map((_, row) => row).filter((row) => isNumber(x[row]))
    .sort((a, b) => x[a] - x[b]);
  const shown = quantities.map((q) => [shortPath(q.take), columnNamed(t, shortPath(q.take))])
    .filter(([, values]) => numeric(values));
  if (!shown.length) return null;
  const { name, unit } = nameAndUnit(key.split('.').pop());
  const alone = keys.length === 1 && new Set(x).size === order.length;
  const chart = figure({ key: `sweep${i}`, x: order.map((row) => x[row]), points: true,
    label: words(name), unit, caption: zoomHint + thinned(t) });
  const panels = shown.map(([path, values], n) => ({ label: taken(path).name,
    unit: taken(path).unit, height: 170, series: [{ name: path, line: alone,
      points: 5, color: seriesColor(n), values: order.map((row) =>
        (isNumber(values[row]) ? values[row] : null)) }] }));
  return { part: section(`over${i + 1}`, `Over ${key}`, key, chart.element),
    draw: () => chart.draw(panels) };
}

/** Median and 95 % band of every quantity over a single key. */
function bandSection(t, keys, quantities, draws) {
  const x = t && keys.length === 1 ? columnNamed(t, keys[0]) : null;
  if (!numeric(x) || new Set(x).size < 2) return null;
  const order = x.map((_, row) => row).sort((a, b) => x[a] - x[b]);
  const column = (what, q) => columnNamed(t, `${what}_${shortPath(q.take)}`);
  const shown = quantities.filter((q) => numeric(column('median', q)));
  if (!shown.length) return null;
  const { name, unit } = nameAndUnit(keys[0].split('.').pop());
  const sorted = (values) => order.map((row) => (isNumber(values[row]) ? values[row] : null));
  const chart = figure({ key: 'bands', x: sorted(x), label: words(name), unit,
    caption: zoomHint });
  const panels = shown.map((q, n) => ({ label: taken(q.take).name, unit: taken(q.take).unit,
    height: 260, band: { name: '95 % of the draws', low: sorted(column('low', q)),
      high: sorted(column('high', q)) },
    series: [{ name: 'median', points: 5, color: seriesColor(n), width: 2, values: sorted(column('median', q)) }] }));
  return { part: section('band', `Over ${keys[0]}, with what is uncertain`, keys[0],
    prose(`Median and 95 % of ${draws} draws, with the same draws at every value. The dots are computed. The lines between them are straight.`), chart.element),
  draw: () => chart.draw(panels) };
}

/** By how much a quantity and a key go together: the correlation of their ranks. */
function rankCorrelation(a, b) {
  const both = a.map((_, i) => i).filter((i) => isNumber(a[i]) && isNumber(b[i]));
  const ranks = (values) => {
    const order = [...both].sort((i, j) => values[i] - values[j]);
    const rank = new Map();
    for (let from = 0; from < order.length;) {
      let to = from;
      while (to + 1 < order.length && values[order[to + 1]] === values[order[from]]) to += 1;
      for (let k = from; k <= to; k += 1) rank.set(order[k], (from + to) / 2);
      from = to + 1;
    }
    return both.map((i) => rank.get(i));
  };
  const [u, v] = [ranks(a), ranks(b)];
  const mean = (both.length - 1) / 2;
  const sum = (f) => u.reduce((total, _, k) => total + f(k), 0);
  const size = Math.sqrt(sum((k) => (u[k] - mean) ** 2) * sum((k) => (v[k] - mean) ** 2));
  return size > 0 ? sum((k) => (u[k] - mean) * (v[k] - mean)) / size : NaN;
}

/** The rows of each point, by the values of its keys. */
function pointsOf(t, keys) {
  const points = new Map();
  columnNamed(t, keys[0]).forEach((_, row) => {
    const name = keys.map((key) => columnNamed(t, key)[row]).join(' ');
    points.set(name, [...(points.get(name) || []), row]);
  });
  return [...points.values()];
}

/** The same within each point, without its sign: root mean square over the points. */
function correlationInPoints(points, a, b) {
  const squares = points.map((rows) => rankCorrelation(rows.map((r) => a[r]),
    rows.map((r) => b[r])) ** 2).filter(isNumber);
  return Math.sqrt(squares.reduce((sum, x) => sum + x, 0) / squares.length);
}

/** Which key matters most for which quantity; what differs between `apart` is left out. */
function tornadoSection(t, keys, quantities, apart) {
  const swept = keys.filter((key) => !apart.includes(key) && numeric(columnNamed(t, key)));
  const points = apart.length ? pointsOf(t, apart) : null;
  const rows = quantities.filter((q) => numeric(columnNamed(t, shortPath(q.take)))).map((q) => [
    shortPath(q.take), ...swept.map((key) => {
      const [a, b] = [columnNamed(t, key), columnNamed(t, shortPath(q.take))];
      const value = points ? correlationInPoints(points, a, b) : rankCorrelation(a, b);
      return isNumber(value) ? value.toFixed(2).replace(/^-(0\.00)$/, '$1').replace('-', '−') : missing;
    })]);
  if (!rows.length || !swept.length) return null;
  return section('matters', 'What matters', 'What matters',
    prose(points ? 'How much each uncertain number changes the answer: the correlation of their ranks among the draws, without its sign, as a root mean square over the points. 1: this number alone decides. 0: it does not matter.' :
      'How the answer follows each number: the correlation of their ranks. 1: it rises with the number. −1: it falls. 0: it does not follow.'),
    table(['', ...swept.map(breakable)], rows, { class: 'rows' }));
}
