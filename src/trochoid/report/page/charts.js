// Curves: stacks of panels over one axis, with one cursor and one zoom.

const modelColors = { none: '--s3', feed: '--s2', radial: '--s4', trochoidal: '--s1' };
const modelColor = (model, i) => modelColors[model] || seriesColor(i);
/** Beyond the colours, dashes tell curves apart. */
const dashOf = (i) => [undefined, [6, 3], [2, 3], [8, 3, 2, 3]][
  Math.floor(i / seriesColors.length) % 4];

const degreeSteps = [1, 2, 5, 10, 15, 30, 45, 90, 180, 360, 720, 1440, 3600, 7200, 36000];

function axes(options) {
  const common = {
    stroke: () => css('--soft'), font, labelFont: font,
    grid: { stroke: () => css('--grid'), width: 1 },
    ticks: { stroke: () => css('--grid'), width: 1, size: 4 },
    // uPlot groups thousands by a comma, which reads as a decimal comma to many.
    values: (u, splits) => splits.map((v) => (v === null ? '' : number(v, 6))),
  };
  const bare = { size: 0, values: (u, splits) => splits.map(() => ''), ticks: { show: false } };
  return [
    {
      ...common, size: 30, space: 55, ...(options.showX ? {} : bare),
      ...(options.unit === '°' ? { incrs: degreeSteps } : {}),
      ...(options.whole ? { incrs: [1, 2, 5, 10, 20, 50, 100] } : {}),
    },
    { ...common, size: 62, space: 24 },  // 50 px by default, which cuts "−1400"
  ];
}

/** The legend above a panel: name and unit, and every curve with its value at the cursor. */
function legend(panel) {
  const values = panel.series.map(() => el('b', {}));
  const items = panel.series.map((series, i) => {
    const key = el('i', { class: series.line === false ? 'key dot' : 'key' });
    key.style.setProperty('--key', `var(${series.color})`);
    if (series.line !== false) key.style.height = `${Math.max(2, series.width || 1.5)}px`;
    if (series.dash) key.classList.add('dashed');
    return el('span', {}, panel.series.length > 1 || series.name ? key : null, series.name, values[i]);
  });
  if (panel.band) {
    const key = el('i', { class: 'key band' });
    items.push(el('span', {}, key, panel.band.name));
  }
  const unit = panel.unit ? ` [${panel.unit}]` : '';
  const row = el('div', { class: 'legend' },
    el('strong', {}, panel.label, unit), el('span', { class: 'items' }, items));
  const show = (u) => {
    const at = u.cursor.idx;
    panel.series.forEach((series, i) => {
      const value = at === null || at === undefined ? null : series.values[at];
      values[i].textContent = isNumber(value) ? number(value, 4) : '';
    });
  };
  return { row, show };
}

/** A vertical line with a word, for example where the best fit lies. */
function markers(list) {
  return (u) => {
    for (const { x, text, color } of list) {
      const at = u.valToPos(x, 'x', true);
      const { left, top, width, height } = u.bbox;
      if (!(at >= left && at <= left + width)) continue;
      const scale = devicePixelRatio;
      u.ctx.save();
      u.ctx.strokeStyle = u.ctx.fillStyle = css(color || '--ink');
      u.ctx.lineWidth = scale;
      u.ctx.setLineDash([4 * scale, 3 * scale]);
      u.ctx.beginPath();
      u.ctx.moveTo(at, top);
      u.ctx.lineTo(at, top + height);
      u.ctx.stroke();
      u.ctx.font = font.replace('12px', `${12 * scale}px`);
      const room = u.ctx.measureText(text).width + 12 * scale;
      const right = at + room < left + width;
      u.ctx.textAlign = right ? 'left' : 'right';
      u.ctx.fillText(text, at + (right ? 6 : -6) * scale, top + 14 * scale);
      u.ctx.restore();
    }
  };
}

function zeroLine(u) {
  const at = Math.round(u.valToPos(0, 'y', true));
  const { left, top, width, height } = u.bbox;
  if (!(at > top && at < top + height)) return;
  u.ctx.save();
  u.ctx.strokeStyle = css('--zero');
  u.ctx.lineWidth = devicePixelRatio;
  u.ctx.beginPath();
  u.ctx.moveTo(left, at);
  u.ctx.lineTo(left + width, at);
  u.ctx.stroke();
  u.ctx.restore();
}

/** A curve that begins anew after the places in `jumps`; a point alone between two of them is a dot. */
function broken({ jumps, color }) {
  if (!jumps?.length) return {};
  const ends = new Set(jumps);
  const paths = (u, k, from, to) => {
    const stroke = new Path2D();
    let pen = false;
    for (let i = Math.max(0, from - 1); i <= Math.min(u.data[0].length - 1, to + 1); ++i) {
      const v = u.data[k][i];
      if (isNumber(v)) stroke[pen ? 'lineTo' : 'moveTo'](u.valToPos(u.data[0][i], 'x', true), u.valToPos(v, 'y', true));
      pen = isNumber(v) && !ends.has(i);
    }
    return { stroke, fill: null, clip: null, band: null, gaps: null, flags: 3 };
  };
  const alone = (values, i) => isNumber(values[i]) && (ends.has(i - 1) || !isNumber(values[i - 1])) &&
    (ends.has(i) || !isNumber(values[i + 1]));
  return { paths, points: { show: true, size: 4, width: 0, fill: () => css(color),
    filter: (u, k) => u.data[k].map((_, i) => i).filter((i) => alone(u.data[k], i)) } };
}

function curve(series) {
  return {
    stroke: () => css(series.color), width: series.width || 1.5, dash: series.dash,
    points: { show: Boolean(series.points), size: series.points || 6,
      fill: () => css(series.color), width: 0 },
    ...broken(series),
    ...(series.line === false ? { paths: () => null } : {}), pxAlign: 0,
  };
}

/** One plot of a stack, in its own element. */
function plotOf(stack, panel, last) {
  const { row, show } = legend(panel);
  const place = el('div', { class: 'plot', role: 'img', 'aria-label': panelWords(panel, stack) });
  const edges = panel.band ? [panel.band.low, panel.band.high] : [];
  const element = el('div', { class: 'panel' }, row, place);
  const options = {
    width: 600, height: panel.height + (last ? 30 : 0),
    padding: [8, 18, last ? 0 : 4, 0],
    legend: { show: false },
    scales: { x: { time: false, ...(stack.points ? { range: aroundPoints(stack.x) } : {}) },
      y: { range: panel.range } },
    axes: axes({ showX: last, unit: stack.unit, whole: stack.whole }),
    // The band first, so that curves lie above it.
    series: [{}, ...edges.map(() => ({ points: { show: false } })), ...panel.series.map(curve)],
    bands: edges.length ? [{ series: [2, 1], fill: () => css('--band') }] : [],
    cursor: {
      sync: { key: stack.key, setSeries: false, scales: ['x', null] },
      points: { size: 6 }, drag: { x: true, y: false, uni: 8 },
    },
    hooks: {
      setCursor: [show],
      drawClear: [zeroLine],
      draw: [markers(panel.markers || [])],
    },
  };
  const data = [stack.x, ...edges, ...panel.series.map((series) => series.values)];
  return { element, place, make: () => new uPlot(options, data, place), panel, last };
}

/** Room at both ends of all, so that the first and the last points are whole. */
const aroundPoints = (x) => (u, low, high) => {
  const [first, last] = [x[0], x[x.length - 1]];
  if (low > first || high < last) return [low, high];
  const margin = 0.025 * (last - first || 1);
  return [first - margin, last + margin];
};

/** Like uPlot's own range, but with a margin at both ends and never empty. */
function paddedRange(u, low, high) {
  if (low === null || high === null || !isNumber(low) || !isNumber(high)) return [-1, 1];
  const margin = 0.06 * (high - low || Math.abs(high) || 1);
  return [low >= 0 && low - margin < 0 ? 0 : low - margin, high + margin];
}

/**
 * Draw panels over a common axis. stack: {key, x, label, unit, panels, ranges, caption};
 * panel: {label, unit, height, series: [{name, values, color}], markers}.
 * Returns the figure; its `draw(panels)` replaces the curves and keeps the zoom.
 */
function figure(stack) {
  const place = el('div', { class: 'panels' });
  const controls = el('div', { class: 'controls' });
  const element = el('figure', { class: 'chart' }, controls, place,
    el('figcaption', {}, `${stack.label}${stack.unit ? ` [${stack.unit}]` : ''}`,
      stack.caption ? el('span', {}, stack.caption) : null));
  const chart = { element, controls, stack, plots: [], panels: [], range: null };
  element.append(...tools({ element, size: () => stackSize(chart, place.clientWidth),
    paint: (c) => paintStack(c, place.clientWidth, chart), data: () => stackData(chart) }));
  chart.zoom = (range) => {
    chart.range = range;
    for (const plot of chart.plots) plot.setScale('x', { min: range[0], max: range[1] });
  };
  chart.draw = (panels, x = stack.x) => {
    const scale = chart.plots.length && x === stack.x ? chart.plots[0].scales.x : null;
    const before = scale ? [scale.min, scale.max] : chart.range;
    for (const plot of chart.plots) plot.destroy();
    stack.x = x;
    const made = panels.map((panel, i) => plotOf(stack,
      { height: 150, range: paddedRange, ...panel }, i === panels.length - 1));
    place.replaceChildren(...made.map(({ element: panel }) => panel));
    chart.panels = made.map(({ panel }) => panel);
    chart.plots = made.map(({ make }) => make());
    for (const plot of chart.plots) fingersOnPlot(plot, chart);
    chart.sizes = made.map(({ panel, last }) => panel.height + (last ? 30 : 0));
    chart.resize();
    if (before && isNumber(before[0])) chart.zoom(before);
  };
  chart.resize = (width = place.clientWidth, tall = 1) => {
    if (width < 40) return;
    chart.plots.forEach((plot, i) => plot.setSize({ width,
      height: Math.max(60, Math.round(tall * chart.panels[i].height)) + chart.sizes[i] - chart.panels[i].height }));
  };
  chart.redraw = () => chart.plots.forEach((plot) => plot.redraw(false, true));
  charts.add(chart);
  return chart;
}

/**
 * Buttons that show some revolutions or everything; needed where nobody can drag. x: angles; places(): what
 * the curves are over now, the time or the angles.
 */
function rangeChoice(figures, x, places = () => x) {
  const turns = (x[x.length - 1] - x[0]) / 360;
  const options = [1, 2, 5].filter((n) => n < turns - 0.01)
    .map((n) => ({ value: n, text: n === 1 ? '1 revolution' : `${n} revolutions` }));
  options.push({ value: 0, text: 'all' });
  const rangeOf = (n) => {
    const now = places();
    const [first, last] = [now[0], now[now.length - 1]];
    return [first, n ? first + (last - first) * n / turns : last];
  };
  const show = (n) => figures.forEach((chart) => chart.zoom(rangeOf(n)));
  const start = turns > 5 ? 2 : 0;
  if (start) figures.forEach((chart) => { chart.range = rangeOf(start); });
  return choice('Show', options, start, show);
}

const onPaper = 0.68;  // of the height of curves, so that a page holds two stacks of them

function watchPage() {
  const each = (action) => () => charts.forEach((chart) => action(chart));
  let width = window.innerWidth;
  window.addEventListener('resize', () => {
    if (window.innerWidth !== width) each((chart) => chart.resize())();
    width = window.innerWidth;
  });
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change',
    each((chart) => chart.redraw()));
  // Canvases do not follow the paper by themselves: 680 px are an A4 page less margins.
  let opened = [];
  window.addEventListener('beforeprint', () => {
    document.documentElement.classList.add('print');
    opened = [...document.querySelectorAll('details:not(.raw):not([open])')];
    for (const details of opened) details.open = true;
    charts.forEach((chart) => { chart.resize(680, onPaper); chart.redraw(); });
  });
  window.addEventListener('afterprint', () => {
    document.documentElement.classList.remove('print');
    for (const details of opened) details.open = false;
    charts.forEach((chart) => { chart.resize(); chart.redraw(); });
  });
}

/**
 * Places after which a frequency goes on in another branch: the step there is far above the usual ones, or above
 * those before and after it, the more so where it goes the same way.
 */
function jumpsOf(values) {
  const steps = values.slice(1).map((v, i) => (v - values[i]) / Math.abs(values[i] || 1));
  const usual = steps.map(Math.abs).sort((a, b) => a - b)[Math.floor(steps.length / 2)] || 0;
  const against = (step, other) => other === undefined || Math.abs(other) < Math.abs(step) / (other * step < 0 ? 1 : 3);
  return steps.map((step, i) => (Math.abs(step) > Math.max(0.04, 6 * usual) ||
    (Math.abs(step) > 0.002 && against(step, steps[i - 1]) && against(step, steps[i + 1])) ? i : -1)).filter((i) => i >= 0);
}

/** Places after which an angle goes on at the other end of its turn. */
const turnsOver = (degrees) => degrees.slice(1).map((v, i) => (Math.abs(v - degrees[i]) > 90 ? i : -1)).filter((i) => i >= 0);

/** Values over x at other places of it, which increase; null outside, and between two branches. */
function sampledAt(x, values, places, jumps = []) {
  let i = 0;
  return places.map((at) => {
    while (i + 2 < x.length && x[i + 1] < at) ++i;
    const t = (at - x[i]) / (x[i + 1] - x[i]);
    if (Math.abs(t) < 1e-9) return values[i] ?? null;
    if (Math.abs(t - 1) < 1e-9) return values[i + 1] ?? null;
    const known = t > 0 && t < 1 && !jumps.includes(i) && isNumber(values[i]) && isNumber(values[i + 1]);
    return known ? values[i] + t * (values[i + 1] - values[i]) : null;
  });
}

/** Index of the last place before x. */
const placeBefore = (places, x) => Math.max(0, places.findIndex((p) => p >= x) - 1);
