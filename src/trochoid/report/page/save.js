// Below every picture: save it, or its data; and the data as a table for who does not see it.

const dataRowsShown = 24;

/** The text of a label, of elements or of both. */
const textOf = (label) => [label].flat(9).map((part) => part?.textContent ?? part ?? '').join('').trim();

function download(name, type, content) {
  const url = URL.createObjectURL(new Blob([content], { type }));
  el('a', { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10000);
}

const csvCell = (value) => {
  if (value === null || value === undefined) return '';
  const text = String(value);
  return /[",\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};
const csvOf = ({ head, rows }) => [head, ...rows].map((row) => row.map(csvCell).join(',')).join('\n') + '\n';

/** A workbook of one sheet. Numbers are numbers and text is text, whatever language Excel speaks. */
function workbookOf(name, { head, rows }) {
  const cell = (value) => {
    if (value === null || value === undefined || value === '') return null;
    return isNumber(value) ? value : { value: String(value), type: String };
  };
  const title = (value) => ({ value: String(value), type: String, fontWeight: 'bold' });
  return writeXlsxFile([head.map(title), ...rows.map((row) => row.map(cell))], { sheet: name.slice(0, 31), stickyRowsCount: 1,
    columns: head.map((value) => ({ width: Math.max(10, String(value).length + 2) })) }).toBlob();
}

/** Least, mean and largest of every column of numbers. */
function summaryRows({ head, rows }) {
  const columns = head.map((_, k) => rows.map((row) => row[k]).filter(isNumber));
  const of = (name, what) => [name, ...columns.map((values) => (values.length ? number(what(values), 5) : missing))];
  const sum = (values) => values.reduce((a, b) => a + b, 0);
  return [of('least', (values) => values.reduce((a, b) => Math.min(a, b))), of('mean', (values) => sum(values) / values.length),
    of('largest', (values) => values.reduce((a, b) => Math.max(a, b)))];
}

/** All rows of short data; of long ones what each column holds, and the first rows. */
function dataTable(data) {
  const shown_ = data.rows.slice(0, data.rows.length > dataRowsShown ? 12 : dataRowsShown);
  const cells = shown_.map((row, i) => [String(i + 1), ...row.map((v) => (isNumber(v) ? number(v, 6) : v ?? missing))]);
  const first = table(['row', ...data.head], cells, { class: 'rows' });
  if (data.rows.length === shown_.length) return [first];
  return [table(['of all', ...data.head], summaryRows(data), { class: 'rows' }), first,
    el('p', { class: 'small' }, `The first ${shown_.length} of ${data.rows.length} rows. The CSV and Excel files contain all rows.`)];
}

/** chart: {element, size() -> [width, height], paint(c), data() -> {head, rows}, or none}. */
function tools(chart) {
  const name = () => chart.element.closest('section')?.id || 'picture';
  const button = (text, label, click) => el('button', { type: 'button', 'aria-label': label, click }, text);
  const saveSvg = () => {
    const [width, height] = chart.size();
    const surface = svgSurface(width, height);
    chart.paint(surface);
    download(`${name()}.svg`, 'image/svg+xml', surface.svg());
  };
  const savePng = () => {
    const [width, height] = chart.size();
    const ratio = devicePixelRatio;  // maps are painted in the points of the screen
    const canvas = el('canvas', { width: Math.round(width * ratio), height: Math.round(height * ratio) });
    const c = canvas.getContext('2d');
    c.scale(ratio, ratio);
    c.fillStyle = css('--paper');
    c.fillRect(0, 0, width, height);
    c.font = font;
    chart.paint(c);
    canvas.toBlob((blob) => download(`${name()}.png`, 'image/png', blob));
  };
  const saveWorkbook = async () => {
    const book = await workbookOf(name(), chart.data());
    download(`${name()}.xlsx`, book.type, book);
  };
  const row = el('div', { class: 'tools' }, el('span', {}, 'Save'), button('SVG', 'Save the picture as SVG', saveSvg),
    button('PNG', 'Save the picture as PNG', savePng),
    chart.data ? button('CSV', 'Save the data of the picture as CSV',
      () => download(`${name()}.csv`, 'text/csv', csvOf(chart.data()))) : null,
    chart.data ? button('Excel', 'Save the data of the picture as an Excel workbook', saveWorkbook) : null);
  return [row, chart.data ? behind(chart) : null].filter(Boolean);
}

/** The table behind a picture, made when somebody opens it. */
function behind(chart) {
  const place = el('div', {});
  const details = el('details', { class: 'raw data', toggle: () => {
    if (details.open) place.replaceChildren(...dataTable(chart.data()));
  } }, el('summary', {}, 'Data of this picture'), place);
  return details;
}

/** The panels of a stack of curves painted by themselves, for a file. */
function paintStack(c, width, chart) {
  let top = 4;
  chart.panels.forEach((panel, k) => {
    const last = k === chart.panels.length - 1;
    const frame = { left: 62, top: top + 24, width: width - 80, height: panel.height, xLabel: '', yLabel: '',
      x: [chart.plots[k].scales.x.min, chart.plots[k].scales.x.max],
      y: [chart.plots[k].scales.y.min, chart.plots[k].scales.y.max] };
    paintNames(c, panel, frame.left, top + 10);
    paintPanel(c, panel, frame, chart.stack.x);
    top += panel.height + (last ? 0 : 48);
  });
  write(c, stackLabel(chart.stack), 62, top + 58);
}

const stackLabel = (stack) => `${textOf(stack.label)}${stack.unit ? ` [${stack.unit}]` : ''}`;
const stackSize = (chart, width) =>
  [width, chart.panels.reduce((sum, panel) => sum + panel.height + 48, 0) + 28];

function paintNames(c, panel, left, y) {
  const title = `${textOf(panel.label)}${panel.unit ? ` [${panel.unit}]` : ''}`;
  write(c, title, left, y, { color: '--ink' });
  let x = left + c.measureText(title).width + 16;
  for (const series of panel.series.filter(({ name }) => textOf(name))) {
    line(c, [[x, y], [x + 18, y]], css(series.color), series.width || 1.5, series.dash);
    write(c, textOf(series.name), x + 23, y);
    x += 23 + c.measureText(textOf(series.name)).width + 16;
  }
}

function paintPanel(c, panel, frame, x) {
  const { px, py } = plane(c, frame);
  c.save();
  c.beginPath();
  c.rect(frame.left, frame.top, frame.width, frame.height);
  c.clip();
  const at = (values) => x.map((v, i) => (isNumber(values[i]) ? [px(v), py(values[i])] : null));
  if (panel.band) {
    filled(c, [...at(panel.band.low), ...at(panel.band.high).reverse()].filter(Boolean), css('--band'));
  }
  if (frame.y[0] < 0 && frame.y[1] > 0) {
    line(c, [[frame.left, py(0)], [frame.left + frame.width, py(0)]], css('--zero'));
  }
  for (const series of panel.series) paintSeries(c, series, at(series.values));
  for (const { x: mark, text } of panel.markers || []) {
    line(c, [[px(mark), frame.top], [px(mark), frame.top + frame.height]], css('--ink'), 1, [4, 3]);
    write(c, text, px(mark) + 6, frame.top + 10, { color: '--ink' });
  }
  c.restore();
}

/** A point by itself, as a small square. */
const dotAt = ([x, y]) => [[x - 2, y - 2], [x + 2, y - 2], [x + 2, y + 2], [x - 2, y + 2]];

/** A curve in pieces: it ends where a value is missing and where it goes on in another branch. */
function paintSeries(c, series, points) {
  let piece = [];
  const end = () => {
    if (piece.length > 1 && series.line !== false) line(c, piece, css(series.color), series.width || 1.5, series.dash);
    if (piece.length === 1 && series.jumps?.length) filled(c, dotAt(piece[0]), css(series.color));
    piece = [];
  };
  points.forEach((point, i) => {
    if (point) piece.push(point); else end();
    if (series.jumps?.includes(i)) end();
  });
  end();
  if (!series.points) return;
  c.fillStyle = css(series.color);
  for (const [x, y] of points.filter(Boolean)) {
    c.beginPath();
    c.arc(x, y, series.points / 2, 0, 2 * Math.PI);
    c.fill();
  }
}

/** What curves show as columns: x, and every curve of every panel. */
function stackData(chart) {
  const columns = chart.panels.flatMap((panel) => {
    const of = (name, values) => ({ values, head: [textOf(panel.label), name].filter(Boolean).join(' ') +
      (panel.unit ? ` [${panel.unit}]` : '') });
    return [...panel.series.map((series) => of(textOf(series.name), series.values)),
      ...(panel.band ? [of('band, lower', panel.band.low), of('band, upper', panel.band.high)] : [])];
  });
  return { head: [stackLabel(chart.stack), ...columns.map(({ head }) => head)],
    rows: chart.stack.x.map((v, i) => [v, ...columns.map(({ values }) => values[i])]) };
}

/** A panel in a sentence, for who does not see it. */
function panelWords(panel, stack) {
  const range = (values) => {
    const some = values.filter(isNumber);
    return some.length ? `${number(some.reduce((a, b) => Math.min(a, b)), 4)} to ${
      number(some.reduce((a, b) => Math.max(a, b)), 4)}` : 'no values';
  };
  const curves = panel.series.map((series) => `${textOf(series.name) || 'one curve'} ${range(series.values)}`);
  return `${textOf(panel.label) || 'Curves'}${panel.unit ? ` in ${panel.unit}` : ''} over ${stackLabel(stack)}: ${
    curves.join('; ')}`;
}
