// A quantity over the feed and the height, in colours.

// From dark to bright, in even steps of lightness, so that it survives a grey printer.
const rising = [[68, 1, 84], [72, 40, 120], [62, 74, 137], [49, 104, 142], [38, 130, 142],
  [31, 158, 137], [53, 183, 121], [110, 206, 88], [181, 222, 43], [253, 231, 37]];
// Two hues around nothing.
const aroundZero = [[5, 48, 97], [33, 102, 172], [103, 169, 207], [209, 229, 240], [247, 247, 247],
  [253, 219, 199], [239, 138, 98], [178, 24, 43], [103, 0, 31]];

function colorAt(colors, share) {
  const at = Math.min(1, Math.max(0, share)) * (colors.length - 1);
  const i = Math.min(colors.length - 2, Math.floor(at));
  return colors[i].map((v, k) => Math.round(v + (at - i) * (colors[i + 1][k] - v)));
}

const rgbOf = (color) => [1, 3, 5].map((i) => parseInt(css(color).slice(i, i + 2), 16));

/** Index of the entry nearest to v in ascending values. */
function nearest(values, v) {
  let low = 0;
  let high = values.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (values[middle] <= v) low = middle; else high = middle;
  }
  return v - values[low] <= values[high] - v ? low : high;
}

/** Value of a row at x: between its samples, or that of the nearest. */
function valueAt(row, values, x, smooth) {
  const i = nearest(row.x, x);
  if (!smooth) return values[i];
  const j = x > row.x[i] ? Math.min(i + 1, row.x.length - 1) : Math.max(i - 1, 0);
  const gap = row.x[j] - row.x[i];
  return gap ? values[i] + (values[j] - values[i]) * (x - row.x[i]) / gap : values[i];
}

/**
 * The picture of one quantity. rows: [{height, x, [key]}] by ascending height; view: {key,
 * colors, range, step (of the contour lines), smooth}.
 */
function pictureOf(rows, view, x, heights, columns, lines) {
  const place = (i, n, [from, to]) => from + (to - from) * (i + 0.5) / n;
  const xs = Array.from({ length: columns }, (_, i) => place(i, columns, x));
  const sampled = rows.map((row) => xs.map((at) => valueAt(row, row[view.key], at, view.smooth)));
  const tall = rows.map((row) => row.height);
  const between = (h) => {
    const i = nearest(tall, h);
    const j = view.smooth ? Math.min(rows.length - 1, Math.max(0, h > tall[i] ? i + 1 : i - 1)) : i;
    return { i, j, share: i === j ? 0 : (h - tall[i]) / (tall[j] - tall[i]) };
  };
  return Array.from({ length: lines }, (_, k) => {
    const { i, j, share } = between(place(lines - 1 - k, lines, heights));
    return sampled[i].map((v, n) => v + share * (sampled[j][n] - v));
  });
}

function imageOf(values, view) {
  const lines = values.length;
  const columns = values[0].length;
  const image = new ImageData(columns, lines);
  const [low, high] = view.range;
  const level = (v) => Math.floor(v / view.step);
  const shade = view.teeth ? view.teeth.map((tooth) => rgbOf(seriesColor(tooth - 1))) :
    Array.from({ length: 1025 }, (_, i) => colorAt(view.colors, i / 1024));
  values.forEach((row, k) => row.forEach((v, i) => {
    const share = (v - low) / (high - low || 1);
    let color = view.teeth ? shade[view.teeth.indexOf(v)] :
      shade[Math.round(1024 * Math.min(1, Math.max(0, share)))];
    const edge = view.step && ((i + 1 < columns && level(row[i + 1]) !== level(v)) ||
      (k + 1 < lines && level(values[k + 1][i]) !== level(v)));
    if (edge) color = color.map((part) => (share > 0.55 ? 0.6 * part : 0.45 * part + 140));
    image.data.set([...color, 255], 4 * (k * columns + i));
  }));
  return image;
}

/** The colours and what they mean, above the map. */
function colorBar(c, view, left, width) {
  const [low, high] = view.range;
  for (let i = 0; i < width; ++i) {
    c.fillStyle = `rgb(${colorAt(view.colors, i / (width - 1)).join()})`;
    c.fillRect(left + i, 18, 1.5, 12);
  }
  for (const v of ticksBetween(low, high, Math.min(8, width / 55))) {
    const at = left + width * (v - low) / (high - low || 1);
    line(c, [[at, 30], [at, 34]], css('--soft'));
    write(c, number(v, 4), at, 36, { align: 'center', baseline: 'top' });
  }
}

function toothBar(c, view, left, width) {
  const step = Math.min(100, width / view.teeth.length);
  view.teeth.forEach((tooth, i) => {
    c.fillStyle = css(seriesColor(tooth - 1));
    c.fillRect(left + i * step, 18, step > 75 ? 22 : 12, 12);
    write(c, step > 75 ? `tooth ${tooth}` : String(tooth), left + i * step + (step > 75 ? 28 : 16), 24);
  });
}

/** Words on the lines where a value is round, next to the left edge. */
function lineLabels(c, values, view, frame) {
  const lines = values.length;
  const column = Math.floor(values[0].length * 0.1);
  let last = -100;
  for (let k = 1; k < lines; ++k) {
    const above = Math.floor(values[k - 1][column] / view.step);
    const below = Math.floor(values[k][column] / view.step);
    const y = frame.top + frame.height * k / lines;
    if (above === below || y - last < 18 || y < frame.top + 8 || y > frame.top + frame.height - 8) continue;
    last = y;
    const text = number(Math.max(above, below) * view.step, 4);
    const x = frame.left + 0.1 * frame.width;
    const half = c.measureText(text).width / 2 + 3;
    c.fillStyle = 'rgba(255, 255, 255, 0.82)';
    c.fillRect(x - half, y - 8, 2 * half, 16);
    c.fillStyle = '#17212b';
    c.textAlign = 'center';
    c.textBaseline = 'middle';
    c.fillText(text, x, y);
  }
}

/**
 * A map with its colours, what lies under the cursor, and the section that is chosen. map:
 * {rows, views, xLabel, yLabel, columns: [name, key] of the table, read(row, i), pick(row), section()}.
 */
function heatMap(map) {
  const { rows } = map;
  const ends = (values) => values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)],
    [Infinity, -Infinity]);
  const x = ends(rows.flatMap((row) => [row.x[0], row.x[row.x.length - 1]]));
  const heights = ends(rows.map((row) => row.height));
  const state = { view: map.views[0], frame: null };
  const paint = (c, width, height) => {
    const { view } = state;
    const { x, y } = chart.view;
    const frame = { left: 52, top: 76, width: width - 62, height: height - 76 - 44, x, y,
      xLabel: map.xLabel, yLabel: map.yLabel };
    state.frame = frame;
    write(c, view.label, 0, 8, { color: '--ink' });
    if (view.teeth) toothBar(c, view, frame.left, frame.width);
    else colorBar(c, view, frame.left, frame.width);
    const values = pictureOf(rows, view, x, y, Math.round(frame.width * devicePixelRatio),
      Math.round(frame.height * devicePixelRatio));
    c.putImageData(imageOf(values, view), Math.round(frame.left * devicePixelRatio),
      Math.round(frame.top * devicePixelRatio));
    if (view.step) lineLabels(c, values, view, frame);
    const { py } = plane(c, frame, { grid: false });
    const at = py(map.section().height);
    if (at < frame.top - 1 || at > frame.top + frame.height + 1) return;
    line(c, [[frame.left, at], [frame.left + frame.width, at]], '#ffffff', 2.5);
    line(c, [[frame.left, at], [frame.left + frame.width, at]], '#17212b', 1.2, [6, 4]);
  };
  const chart = drawing({ label: `Map of the error over feed and height: ${map.xLabel}, ${map.yLabel}`, paint, lowOnPaper: true,
    data: () => ({ head: [map.xLabel, map.yLabel, ...map.columns.map(([name]) => name)],
      rows: rows.flatMap((row) => row.x.map((v, i) => [v, row.height, ...map.columns.map(([, key]) => row[key][i])])) }),
    height: (width) => Math.round(Math.min(430, Math.max(330, 0.5 * width))) });
  zoomable(chart, () => state.frame, { x, y: heights });
  const at = (place) => {
    const [v, h] = valuesAtPlace(state.frame, place);
    const row = rows[nearest(rows.map((one) => one.height), h)];
    return { row, i: nearest(row.x, v) };
  };
  readoutOf(chart, map.hint, (place) => {
    const { row, i } = at(place);
    return map.read(row, i);
  });
  chart.canvas.addEventListener('click', (event) => {
    const box = chart.canvas.getBoundingClientRect();
    map.pick(at([event.clientX - box.left, event.clientY - box.top]).row);
  });
  chart.controls.append(...[choice('Show', map.views.map((view) => ({ value: view, text: view.name })),
    state.view, (view) => { state.view = view; chart.redraw(); })].filter(Boolean));
  return chart;
}
