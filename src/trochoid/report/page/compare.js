// The page of two answers of one command beside one another (`report A B`).

function comparePage(report) {
  const { result, tables } = report;
  const names = [result.a.name, result.b.name];
  const both = tables.filter((t) => t.file.startsWith('a: ')).map((t) =>
    [t, tables.find((other) => other.file === `b: ${t.file.slice(3)}`)]).filter(([, b]) => b);
  return [
    { lead: section('both', 'What they say', 'Both', ...[result.a, result.b].map(({ name, title, message }) =>
      prose(el('strong', {}, title ? `${name}, ${title}: ` : `${name}: `), message))) },
    { part: differentInputs(result, names) },
    ...both.map(([a, b], i) => curvesOfBoth(a, b, names, i)),
    { part: differentNumbers(result, names) },
  ];
}

function differentInputs({ inputs }, names) {
  const text = inputs.length ? 'Keys whose values differ between the two cases, with every default filled in.'
    : 'The two cases are equal.';
  return section('different', 'What was asked differently', 'Inputs that differ', prose(text), inputs.length ?
    table(['', ...names], inputs.map(({ key, a, b }) => [key, a || missing, b || missing])) : null);
}

/** Those that differ first; with a standard error it decides. */
function differentNumbers({ numbers }, names) {
  const known = numbers.some((n) => isNumber(n.standard_errors));
  const row = ({ path, a, b, standard_errors: errors }) => [breakable(path), number(a, 5), number(b, 5),
    a ? `${number(100 * (b / a - 1), 3)}\u00a0%` : missing,
    ...(known ? [isNumber(errors) ? number(errors, 2) : missing] : [])];
  const head = ['', ...names, 'change', ...(known ? ['in standard errors'] : [])];
  const different = numbers.filter((n) => n.differs);
  const alike = numbers.filter((n) => !n.differs);
  return section('numbers', 'What came out differently', 'Numbers',
    prose('Numbers of the two results that differ by more than 0.1 %.', known ? ' If a number has a standard ' +
      'error, the last column is the difference divided by its standard error. Up to 2 it may be chance.' : null),
    different.length ? table(head, different.map(row)) : prose('None does.'),
    alike.length ? el('details', {}, el('summary', {}, `Show the ${alike.length} equal ones`),
      table(head, alike.map(row))) : null);
}

/** Columns of both over their first one, one panel a unit; the second dashed. */
function curvesOfBoth(a, b, names, i) {
  const [first, ...rest] = a.columns;
  const other = b.columns[0];
  if (!first || !increases(first.values) || other?.name !== first.name || !increases(other.values)) return null;
  const byUnit = new Map();
  for (const column of rest) {
    const twin = columnNamed(b, column.name);
    const same = twin && column.values.every((v, k) => v === twin[k]);
    if (!twin || same || !column.values.some(isNumber)) continue;
    const { name, unit } = nameAndUnit(column.name);
    if (!byUnit.has(unit)) byUnit.set(unit, []);
    const of = byUnit.get(unit);
    const color = seriesColor(of.length / 2);
    const [jumps, theirs] = [column.values, twin].map((values) => (name === 'chatter_frequency' ? jumpsOf(values) :
      name === 'argument' ? turnsOver(values) : []));
    of.push({ name: [symbol(name), `, ${names[0]}`], values: column.values, jumps, color },
      { name: [symbol(name), `, ${names[1]}`], values: sampledAt(other.values, twin, first.values, theirs),
        jumps: theirs.map((k) => placeBefore(first.values, other.values[k + 1])), color, dash: [6, 3] });
  }
  const file = a.file.slice(3);
  const x = nameAndUnit(first.name);
  const chart = figure({ key: first.name, x: first.values, label: words(x.name), unit: x.unit,
    caption: `Dashed: ${names[1]}, interpolated at the points of ${names[0]}. ${zoomHint}` });
  const panels = [...byUnit].map(([unit, series]) => ({ label: '', unit, height: 200, series }));
  if (!panels.length) return null;
  return { part: section(`table${i + 1}`, file, file, chart.element), draw: () => chart.draw(panels) };
}
