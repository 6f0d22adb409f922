// The page of a command that has none of its own: its result, its curves, its tables.

const rowsShown = 12;

function anyPage(report) {
  return [
    { part: isEmpty(report.result) ? null :
      section('result', 'Result', 'Result', described(report.result)) },
    ...report.tables.map((t, i) => anyTable(t, i)),
  ];
}

const increases = (values) => values.length > 2 &&
  values.every((v, i) => i === 0 || (isNumber(v) && v > values[i - 1]));

/** Curves over the first column if it increases, one panel a unit; else the first rows. */
function anyTable(t, i) {
  const id = `table${i + 1}`;
  if (!t.drawn || !t.columns.length) return null;
  const [first, ...rest] = t.columns;
  if (!increases(first.values)) {
    return { part: section(id, t.file, t.file, firstRows(t)) };
  }
  const byUnit = new Map();
  for (const column of rest) {
    if (column.values.some((v) => typeof v === 'string')) continue;
    const { name, unit } = nameAndUnit(column.name);
    if (!byUnit.has(unit)) byUnit.set(unit, []);
    const of = byUnit.get(unit);
    of.push({ name: symbol(name), values: column.values, color: seriesColor(of.length),
      dash: dashOf(of.length) });
  }
  const x = nameAndUnit(first.name);
  const chart = figure({ key: first.name, x: first.values, label: words(x.name), unit: x.unit,
    caption: zoomHint + thinned(t) });
  const panels = [...byUnit].map(([unit, series]) => ({ label: '', unit, height: 180, series }));
  return { part: section(id, t.file, t.file, chart.element,
    el('details', {}, el('summary', {}, 'Show rows'), firstRows(t))),
    draw: () => chart.draw(panels) };
}

/** A name of a file that may go on in the next line. */
const breakable = (name) => name.split(/(?<=[.\]_])/).flatMap((part) => [part, el('wbr')]);

/** A column in which all is well tells nothing of a row. */
const tellsRows = ({ values }) => values.some((v) => v !== '' && v !== 'ok');

function firstRows(t, { most = rowsShown, digits = 6 } = {}) {
  const count = Math.min(most, t.drawn);
  const columns = t.columns.filter(tellsRows);
  const rows = Array.from({ length: count }, (_, i) =>
    columns.map((column) => (typeof column.values[i] === 'string' ? column.values[i] :
      number(column.values[i], digits))));
  return [table(columns.map((column) => breakable(column.name)), rows, { class: 'rows' }),
    t.rows > count ? el('p', { class: 'small' },
      `The first ${count} of ${t.rows} rows. All rows are in ${t.file}.`) : null];
}
