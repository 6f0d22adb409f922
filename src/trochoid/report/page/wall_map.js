// A wall with what was measured on it: dots in the colours of the map below them.

/** So large that dots cover about a fifth of their place. */
const dotSize = (count, frame) =>
  Math.min(12, Math.max(2, 0.5 * Math.sqrt(frame.width * frame.height / count)));

/** Dots by height, as the rows of a map; none where they do not lie in rows. */
function rowsOfDots(dots, key) {
  const rows = new Map();
  for (const dot of dots) rows.set(dot.height, [...(rows.get(dot.height) || []), dot]);
  const list = [...rows].sort((a, b) => a[0] - b[0]).map(([height, all]) => {
    const order = all.sort((a, b) => a.x - b.x);
    return { height, x: order.map((dot) => dot.x), [key]: order.map((dot) => dot[key]) };
  });
  return list.length > 1 && list.every((row) => row.x.length > 1) ? list : [];
}

function paintDots(c, { dots, view, frame, px, py }) {
  const [low, high] = view.range;
  const size = Math.min(dotSize(dots.length, frame), view.under ? 7 : 12);
  c.strokeStyle = view.under ? '#ffffff' : css('--zero');  // nothing left over is nearly white
  for (const dot of dots) {
    const [x, y] = [px(dot.x), py(dot.height)];
    if (x < frame.left || x > frame.left + frame.width || y < frame.top || y > frame.top + frame.height) continue;
    c.fillStyle = `rgb(${colorAt(view.colors, (dot[view.key] - low) / (high - low || 1)).join()})`;
    c.beginPath();
    c.arc(x, y, size / 2, 0, 2 * Math.PI);
    c.fill();
    if (size < 4) continue;
    c.lineWidth = 1;
    c.stroke();
  }
}

/** Room around the outermost dots. */
function aroundDots(values) {
  const [low, high] = values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]);
  const margin = 0.03 * (high - low) || 0.05 * Math.abs(high) || 1;
  return [low - margin, high + margin];
}

/**
 * dots: [{x, height, ...values}]; views: [{name, label, key, colors, range, under}], under: the
 * value that the wall itself is painted with; read(dot): what is said of the nearest one.
 */
function dotMap({ dots, views, xLabel, read, hint }) {
  const x = aroundDots(dots.map((dot) => dot.x));
  const y = aroundDots(dots.map((dot) => dot.height));
  const state = { view: views[0], places: null, frame: null };
  const paint = (c, width, height) => {
    const { view } = state;
    const frame = { left: 52, top: 76, width: width - 62, height: height - 76 - 44, ...chart.view, xLabel,
      yLabel: 'height above the tip [mm]' };
    write(c, view.label, 0, 8, { color: '--ink' });
    colorBar(c, view, frame.left, frame.width);
    state.frame = frame;
    const rows = view.under ? rowsOfDots(dots, view.under) : [];
    if (rows.length) {
      const values = pictureOf(rows, { key: view.under, smooth: true }, frame.x, frame.y,
        Math.round(frame.width * devicePixelRatio), Math.round(frame.height * devicePixelRatio));
      c.putImageData(imageOf(values, { ...view, step: 0 }), Math.round(frame.left * devicePixelRatio),
        Math.round(frame.top * devicePixelRatio));
    }
    const places = plane(c, frame, { grid: !rows.length });
    state.places = places;
    paintDots(c, { dots, view, frame, ...places });
  };
  const chart = drawing({ label: 'Map of the readings over feed and height', paint, lowOnPaper: true,
    data: () => ({ head: [xLabel, 'height above the tip [mm]', 'tooth', 'measured [µm]', 'fitted [µm]', 'left [µm]'],
      rows: dots.map((dot) => [dot.x, dot.height, dot.tooth || null, dot.was, dot.fit, dot.left]) }),
    height: (width) => Math.round(Math.min(430, Math.max(330, 0.5 * width))) });
  zoomable(chart, () => state.frame, { x, y });
  readoutOf(chart, hint, (place) => {
    const far = ({ x: at, height }) => Math.hypot(state.places.px(at) - place[0], state.places.py(height) - place[1]);
    const near = dots.reduce((a, b) => (far(b) < far(a) ? b : a));
    return far(near) < 40 ? [read(near)].flat() : null;
  });
  chart.controls.append(...[choice('Show', views.map((view) => ({ value: view, text: view.name })),
    state.view, (view) => { state.view = view; chart.redraw(); })].filter(Boolean));
  return chart;
}

/** The readings of residual.csv where they were taken. */
function dotsOf(t) {
  const [x, feed, height, was, fit, left, tooth] = ['x_mm', 'feed_mm', 'height_mm', 'measured_mm', 'fitted_mm',
    'residual_mm', 'tooth'].map((name) => columnNamed(t, name));
  if (!left?.length || !height) return { dots: [] };
  const along = x && new Set(x).size > 1 ? x : feed;
  return { along: along === x ? 'x, along the wall [mm]' : 'travel along the feed [mm]',
    dots: left.map((_, i) => ({ x: along[i], height: height[i], was: micro(was[i]), fit: micro(fit[i]),
      left: micro(left[i]), tooth: tooth?.[i] || 0 })) };
}

/** The wall as the answer has it with the readings on it, and what they leave. */
function measuredWall(report) {
  const t = tableNamed(report, 'residual.csv');
  const { dots, along } = dotsOf(t);
  if (dots.length < 3 || new Set(dots.map((dot) => dot.height)).size < 2) return null;
  const all = dots.flatMap((dot) => [dot.was, dot.fit]);
  const range = [Math.min(...all), Math.max(...all)];
  const most = Math.max(...dots.map((dot) => Math.abs(dot.left))) || 1;
  const flat = rowsOfDots(dots, 'fit').length === 0;
  const views = [
    { name: 'error', label: 'error [µm], positive: material left', key: 'was', under: 'fit', colors: rising,
      range },
    { name: 'left over', label: 'measured less fitted [µm]', key: 'left', colors: aroundZero,
      range: [-most, most] },
  ];
  const chart = dotMap({ dots, views, xLabel: along, hint: 'Point at a reading for its values.',
    read: (dot) => [`${number(dot.x, 5)} mm along, height ${number(dot.height, 4)} mm: measured `,
      el('b', {}, `${number(dot.was, 4)} µm`), `, fitted ${number(dot.fit, 4)} µm, left `,
      el('b', {}, `${number(dot.left, 3)} µm`), dot.tooth > 0 ? `, tooth ${dot.tooth}` : ''] });
  const part = section('wall', 'The wall and the readings on it', 'Wall',
    prose(flat ? 'Every dot is a reading, in the colour of its error.' :
      'The wall shows the computed error. Every dot is a reading, in the colour of the measured error. Dots ' +
      'with another colour than the wall do not agree with the answer.', ' "left over" shows measured minus fitted. Only noise should ' +
      'be left, without a pattern.', thinned(t)), chart.element);
  return { part, draw: () => chart.resize() };
}
