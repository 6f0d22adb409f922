// The deflected shapes of cutter and wall, seen along the feed.

/** Value of a column at a height, between its rows. */
function shapeAt(heights, values) {
  return (h) => {
    const i = nearest(heights, h);
    const j = h > heights[i] ? Math.min(i + 1, heights.length - 1) : Math.max(i - 1, 0);
    const gap = heights[j] - heights[i];
    return gap ? values[i] + (values[j] - values[i]) * (h - heights[i]) / gap : values[i];
  };
}

const evenly = (from, to, n) => Array.from({ length: n + 1 }, (_, i) => from + (to - from) * i / n);

/** Outline of a body: its two sides over the heights, shifted by `shift(height)`. */
function outline(heights, left, right, shift) {
  const side = (edge) => heights.map((h) => [edge(h) + shift(h), h]);
  return [...side(left), ...side(right).reverse()];
}

function hatch(c, x, y, width, height) {
  c.save();
  c.beginPath();
  c.rect(x, y, width, height);
  c.clip();
  for (let i = -height; i < width; i += 7) {
    line(c, [[x + i, y + height], [x + i + height, y]], css('--zero'), 1);
  }
  c.restore();
}

/** What is drawn, in millimetres: the finished wall at 0, the cutter to its right. */
function bentBodies(bent, t) {
  const heights = columnNamed(t, 'height_mm');
  const bodies = [];
  if (bent.wall) {
    const { height_mm: tall, thickness_mm: thick, edge_height_mm: edge } = bent.wall;
    const moved = shapeAt(heights, columnNamed(t, 'wall_mm'));
    bodies.push({ name: 'wall', color: '--s2', heights: evenly(edge - tall, edge, 60),
      left: () => -thick, right: () => 0, moved, direction: -1, foot: edge - tall,
      at: edge, largest: Math.abs(moved(edge)), place: 'at its free edge' });
  }
  const cutter = bent.cutter;
  if (cutter) {
    const moved = shapeAt(heights, columnNamed(t, 'cutter_mm'));
    const shank = cutter.shank_diameter_mm || cutter.diameter_mm;
    const radius = (h) => (h <= cutter.flute_length_mm + 1e-9 ? cutter.diameter_mm : shank) / 2;
    const middle = cutter.diameter_mm / 2;
    const bend = Math.min(cutter.flute_length_mm, cutter.overhang_mm);
    bodies.push({ name: 'cutter', color: '--s1',
      heights: [...evenly(0, bend, 40), ...(bend < cutter.overhang_mm ?
        evenly(bend + 1e-6, cutter.overhang_mm, 40) : [])],
      left: (h) => middle - radius(h), right: (h) => middle + radius(h), moved, direction: 1,
      head: cutter.overhang_mm, at: 0, largest: Math.abs(moved(0)), place: 'at its tip' });
  }
  return bodies;
}

function bentSection(report) {
  const { bent } = report.result;
  const t = tableNamed(report, 'bent.csv');
  if (!t?.drawn || isEmpty(bent)) return null;
  const bodies = bentBodies(bent, t);
  const largest = Math.max(...bodies.map((body) => body.largest));
  if (!bodies.length || !(largest > 0)) return null;
  const paint = (c, width, height) => paintBent(c, width, height, { bodies, bent, largest });
  const chart = drawing({ label: 'Deflected shapes of cutter and wall, seen along the feed', paint, lowOnPaper: true,
    data: () => ({ head: t.columns.map(({ name }) => name),
      rows: t.columns[0].values.map((_, i) => t.columns.map(({ values }) => values[i])) }),
    height: (width) => (width > 640 ? 500 : 780) });
  const how = bodies.map((body) => `${body.name} ${number(1000 * body.largest, 3)} µm ${body.place}`);
  const part = section('bent', 'Deflected shapes of cutter and wall', 'Deflection',
    prose('Seen along the feed, at the spindle angle of the largest force across the wall: ',
      el('b', {}, `${number(bent.F_normal_N, 4)}\u00a0N at ${number(((bent.angle_deg % 360) + 360) % 360, 4)}°`),
      `. ${sentence(how.join(', '))}. The bodies are to scale, their deflection is enlarged. Broken lines: without deflection.`),
    chart.element);
  return { part, draw: () => chart.resize() };
}

function paintBent(c, width, height, { bodies, bent, largest }) {
  const wide = width > 640;
  const low = Math.min(...bodies.map((body) => body.heights[0]));
  const high = Math.max(...bodies.map((body) => body.heights[body.heights.length - 1]));
  const bottom = wide ? height : 0.58 * height;
  const tall = bottom - 84;
  const perMm = tall / (high - low || 1);
  // A deflection of about a twentieth of the height, in a round number of times.
  const factor = niceStep(tall / 20 / perMm / largest);
  const scene = { bodies, bent, factor, perMm, right: wide ? 0.55 * width : width - 14, bottom,
    toX: (mm) => Math.round(width * (wide ? 0.22 : 0.36)) + mm * perMm,
    toY: (h) => 34 + tall * (high - h) / (high - low || 1) };
  for (const body of bodies) paintBody(c, body, scene);
  labelBent(c, scene);
  pushes(c, scene);
  scales(c, scene);
  const left = wide ? 0.63 * width : 46;
  const top = wide ? 34 : bottom + 40;
  const frame = { left, top, width: width - left - 14, height: height - top - 46, x: [0, 1.08 * 1000 * largest],
    y: [low, high], xLabel: 'deflection of each away from the other [µm]', yLabel: '' };
  deflectionLines(c, frame, bodies);
}

function paintBody(c, body, { factor, toX, toY }) {
  const shape = (times) => outline(body.heights, body.left, body.right,
    (h) => times * body.direction * body.moved(h)).map(([x, h]) => [toX(x), toY(h)]);
  const ends = [toX(body.left(body.at)), toX(body.right(body.at))];
  if (body.foot !== undefined) hatch(c, ends[0] - 34, toY(body.foot), ends[1] - ends[0] + 68, 16);
  if (body.head !== undefined) hatch(c, ends[0] - 26, toY(body.head) - 18, ends[1] - ends[0] + 52, 18);
  c.globalAlpha = 0.22;
  filled(c, shape(factor), css(body.color));
  c.globalAlpha = 1;
  line(c, [...shape(factor), shape(factor)[0]], css(body.color), 1.8);
  line(c, [...shape(0), shape(0)[0]], css('--soft'), 1, [4, 3]);
}

/** Names and values beside the bodies. */
function labelBent(c, { bodies, factor, toX, toY }) {
  for (const body of bodies) {
    const wall = body.direction < 0;
    const shift = factor * body.direction * body.moved(body.at);
    const x = toX((wall ? body.left(body.at) : body.right(body.at)) + shift) + 12 * body.direction;
    const y = toY(body.at) - (wall ? 10 : 0);
    const align = wall ? 'right' : 'left';
    write(c, body.name, x, y - 16, { color: '--ink', align });
    write(c, `${number(1000 * body.moved(body.at), 3)} µm`, x, y, { align });
  }
}

/** The force on each body, at the middle of the cut. */
function pushes(c, { bodies, bent, factor, toX, toY }) {
  const edge = bodies.find((body) => body.direction < 0)?.at ?? 0;
  for (const body of bodies) {
    const side = body.direction < 0 ? body.left(body.at) : body.right(0);
    const near = toX(side + factor * body.direction * body.moved(edge / 2)) +
      body.direction * (body.direction < 0 ? 12 : 70);
    const far = near + 46 * body.direction;
    const y = toY(edge / 2);
    if (bent.F_normal_N >= 0) arrow(c, near, far, y, css('--ink')); else arrow(c, far, near, y, css('--ink'));
    if (body.direction > 0) write(c, `${number(Math.abs(bent.F_normal_N), 3)} N`, far + 6, y, { color: '--ink' });
  }
}

function scales(c, { factor, perMm, right, bottom }) {
  const scale = (mm, times, text, at) => {
    const size = mm * perMm * times;
    line(c, [[right - size, at - 4], [right - size, at], [right, at], [right, at - 4]], css('--ink'), 1.3);
    write(c, text, right - size - 8, at - 2, { align: 'right' });
  };
  const rule = niceStep(30 / perMm);
  const bar = niceStep(25 / perMm / factor);
  scale(rule, 1, `bodies: ${number(rule)} mm`, bottom - 34);
  scale(bar, factor, `deflection, ${number(factor)} times: ${number(1000 * bar)} µm`, bottom - 12);
}

/** The deflection of both at every height, to be read off. */
function deflectionLines(c, frame, bodies) {
  const { px, py } = plane(c, frame);
  write(c, 'height above the tip [mm]', frame.left - 40, frame.top - 18, { color: '--ink' });
  for (const body of bodies) {
    const points = body.heights.map((h) => [px(1000 * Math.abs(body.moved(h))), py(h)]);
    line(c, points, css(body.color), 2.2);
    // Beside the curve: the cutter's lies above that of the wall.
    const [x, y] = points[Math.floor(points.length * (body.direction < 0 ? 0.55 : 0.4))];
    write(c, body.name, x + 8, y + (body.direction < 0 ? 12 : -8), { color: body.color });
  }
}
