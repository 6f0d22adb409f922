// Drawings of their own: maps, shapes and regions, which are no curves over an axis. What curves are drawn with too stands
// here, so that the form for browsers needs no curves for its drawing.

const css = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const font = '12px system-ui, -apple-system, "Segoe UI", Roboto, sans-serif';
const seriesColors = ['--s1', '--s2', '--s3', '--s4', '--s5', '--s6'];
const seriesColor = (i) => seriesColors[i % seriesColors.length];
const charts = new Set();  // all that are on the page, for a new width or colour scheme

/**
 * A canvas that follows its width, the colours and the paper, like a figure. options:
 * {label, height (of the width), paint(c, width, height), caption, data() -> {head, rows},
 * lowOnPaper, bare}; paint works in CSS pixels, data are what a table of it holds, lowOnPaper: any height will do, so much
 * of it (true: 0.78), bare: nothing below it saves it.
 */
function drawing(options) {
  const canvas = el('canvas', { role: 'img', 'aria-label': options.label });
  const place = el('div', { class: 'drawing' }, canvas);  // what marks a zoom lies over it
  const controls = el('div', { class: 'controls' });
  const element = el('figure', { class: 'chart' }, controls, place,
    options.caption ? el('figcaption', {}, el('span', {}, options.caption)) : null);
  const chart = { element, controls, canvas, width: 0, height: 0, zoom: () => {} };
  chart.redraw = () => {
    if (!chart.width) return;
    canvas.width = Math.round(chart.width * devicePixelRatio);
    canvas.height = Math.round(chart.height * devicePixelRatio);
    canvas.style.height = `${chart.height}px`;
    const c = canvas.getContext('2d');
    c.scale(devicePixelRatio, devicePixelRatio);
    c.font = font;
    options.paint(c, chart.width, chart.height);
  };
  chart.resize = (width = place.clientWidth, tall = 1) => {
    if (width < 40) return;
    chart.width = width;
    chart.height = Math.round(options.height(width) * (tall < 1 && options.lowOnPaper ? (options.lowOnPaper === true ? 0.78 : options.lowOnPaper) : 1));
    canvas.style.width = `${width}px`;
    chart.redraw();
  };
  if (!options.bare) {
    element.append(...tools({ element, size: () => [chart.width, chart.height],
      paint: (c) => options.paint(c, chart.width, chart.height), data: options.data }));
  }
  charts.add(chart);
  return chart;
}

/** A line below a drawing: a hint, or what lies under the pointer. read([x, y] in pixels): text or nothing. */
function readoutOf(chart, hint, read) {
  const readout = el('div', { class: 'readout', 'aria-live': 'off' }, hint);
  chart.canvas.addEventListener('pointermove', (event) => {
    const box = chart.canvas.getBoundingClientRect();
    const told = read([event.clientX - box.left, event.clientY - box.top]);
    readout.replaceChildren(...[told ?? hint].flat());
  });
  chart.canvas.addEventListener('pointerleave', () => readout.replaceChildren(hint));
  chart.canvas.parentElement.after(readout);
  return readout;
}

/** 1, 2 or 5 times a power of ten, at least `size`. */
function niceStep(size) {
  const power = 10 ** Math.floor(Math.log10(size));
  return power * [1, 2, 5, 10].find((step) => step * power >= size * (1 - 1e-9));
}

function ticksBetween(low, high, count) {
  const step = niceStep((high - low) / Math.max(1, count) || 1);
  const ticks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i) {
    ticks.push(i * step);
  }
  return ticks;
}

function line(c, points, color, width = 1, dash = []) {
  c.save();
  c.strokeStyle = color;
  c.lineWidth = width;
  c.lineJoin = 'round';
  c.setLineDash(dash);
  c.beginPath();
  points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
  c.stroke();
  c.restore();
}

function filled(c, points, color) {
  c.fillStyle = color;
  c.beginPath();
  points.forEach(([x, y], i) => (i ? c.lineTo(x, y) : c.moveTo(x, y)));
  c.closePath();
  c.fill();
}

function write(c, text, x, y, { color = '--soft', align = 'left', baseline = 'middle' } = {}) {
  c.save();
  c.fillStyle = css(color);
  c.textAlign = align;
  c.textBaseline = baseline;
  c.fillText(text, x, y);
  c.restore();
}

/** An arrow whose head is at (x, y). */
function arrow(c, fromX, x, y, color) {
  const back = x > fromX ? -7 : 7;
  line(c, [[fromX, y], [x + back / 2, y]], color, 2.2);
  filled(c, [[x, y], [x + back, y - 4.5], [x + back, y + 4.5]], color);
}

/**
 * Axes around a rectangle. frame: {left, top, width, height, x: [from, to], y: [from, to],
 * xLabel, yLabel}; returns the places of values, in pixels.
 */
function plane(c, frame, { grid = true } = {}) {
  const { left, top, width, height } = frame;
  const px = (v) => left + width * (v - frame.x[0]) / (frame.x[1] - frame.x[0] || 1);
  const py = (v) => top + height * (1 - (v - frame.y[0]) / (frame.y[1] - frame.y[0] || 1));
  for (const v of ticksBetween(...frame.x, width / 75)) {
    const at = Math.round(px(v)) + 0.5;
    line(c, grid ? [[at, top], [at, top + height + 4]] : [[at, top + height], [at, top + height + 4]],
      css('--grid'));
    write(c, number(v, 6), at, top + height + 7, { align: 'center', baseline: 'top' });
  }
  for (const v of ticksBetween(...frame.y, height / 45)) {
    const at = Math.round(py(v)) + 0.5;
    line(c, grid ? [[left - 4, at], [left + width, at]] : [[left - 4, at], [left, at]], css('--grid'));
    write(c, number(v, 6), left - 8, at, { align: 'right' });
  }
  write(c, frame.xLabel, left + width, top + height + 24, { align: 'right', baseline: 'top' });
  write(c, frame.yLabel, 0, top - 14, { color: '--ink' });
  return { px, py };
}
