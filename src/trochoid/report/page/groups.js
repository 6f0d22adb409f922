// Coefficients over the groups of records: what wear makes of them.

const groupName = (entry) => entry.group ?? 'records without a group';

/** The coefficients that every group has a number for. */
const keysOfAll = (groups) => Object.keys(groups[0].coefficients)
  .filter((key) => groups.every((entry) => isNumber(entry.coefficients[key]?.value)));

/** By how much a coefficient differs from that of the first group, where the intervals say so. */
function changeSince(first, entry) {
  if (!isNumber(first?.value) || !isNumber(entry?.value) || !first.value) return null;
  const apart = entry.low > first.high || entry.high < first.low;
  const part = 100 * (entry.value / first.value - 1);
  return apart ? `${part > 0 ? '+' : ''}${number(part, 2)} %` : 'no sure change';
}

function groupRows(groups) {
  return Object.keys(groups[0].coefficients).map((key) => {
    const { name, unit } = nameAndUnit(key);
    const first = groups[0].coefficients[key];
    return [[symbol(name), el('small', {}, unit)], ...groups.map((one, i) => {
      const entry = one.coefficients[key];
      if (!isNumber(entry?.value)) return missing;
      const width = half(entry);
      return [measured(entry.value, width), el('small', {}, `± ${measured(width, width)}`),
        i > 0 ? el('small', {}, changeSince(first, entry)) : null];
    })];
  });
}

function groupsSection(groups) {
  if (!Array.isArray(groups) || groups.length < 2) return null;
  const x = groups.map((_, i) => i + 1);
  const keys = keysOfAll(groups);
  const chart = keys.length ? figure({ key: 'group', x, points: true, whole: true,
    label: `group: ${groups.map((one, i) => `${i + 1} ${groupName(one)}`).join(', ')}` }) : null;
  const part = section('groups', 'The coefficients over the groups', 'Groups',
    prose('The records of a group have the same coefficients. All records have the same runout. Flank wear usually ' +
      'raises the edge coefficients most. A change is named where the 95 % intervals do not overlap.'),
    table(['± 95 %', ...groups.map((one) => [groupName(one),
      el('small', {}, one.files.map((file) => file.split('/').pop()).join(', '))])], groupRows(groups), { class: 'fits' }),
    chart?.element);
  const panels = keys.map((key) => {
    const { name, unit } = nameAndUnit(key);
    const of = (what) => groups.map((one) => one.coefficients[key][what]);
    return { label: symbol(name), unit, height: 110,
      band: { name: '95 % interval', low: of('low'), high: of('high') },
      series: [{ name: '', values: of('value'), color: '--s1', width: 2, points: 7 }] };
  });
  return { part, draw: () => chart?.draw(panels) };
}
