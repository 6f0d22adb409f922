// The cut that moves, seen from above: tool, table and force at one moment of the last turns.

/** Everything that is drawn of a moment; displacements in um, angles in deg. */
function momentsOf(report) {
  const { flutes, engagement_deg: engagement } = report.result;
  const [moved, forces] = ['motion.csv', 'forces.csv'].map((name) => tableNamed(report, name));
  const angle = columnNamed(moved, 'angle_deg');
  const same = columnNamed(forces, 'angle_deg');
  if (!angle?.length || same?.length !== angle.length || !flutes?.length || !engagement) return null;
  const column = (t, name) => columnNamed(t, name) || angle.map(() => 0);
  const of = (body) => ['x', 'y'].map((axis) => column(moved, `${axis}_${body}_um`));
  return { angle, engagement, teeth: flutes.map((flute) => flute.enters_deg - engagement[0]),
    tool: of('tool'), table: of('table'), force: ['x', 'y'].map((axis) => column(forces, `F${axis}_N`)) };
}

const largestOf = (...pairs) => Math.max(...pairs.flatMap(([x, y]) => x.map((v, i) => Math.hypot(v, y[i]))));

/** From +y clockwise, as everywhere; on paper y goes up. */
const onCircle = (theta, radius) => [radius * Math.sin(theta * Math.PI / 180), -radius * Math.cos(theta * Math.PI / 180)];

function arrowTo(c, [x, y], [u, v], color) {
  const length = Math.hypot(u, v);
  if (length < 3) return;
  const [a, b] = [u / length, v / length];
  const head = Math.min(9, length);
  line(c, [[x, y], [x + u - a * head, y + v - b * head]], color, 2.4);
  filled(c, [[x + u, y + v], [x + u - a * head - b * 4.5, y + v - b * head + a * 4.5],
    [x + u - a * head + b * 4.5, y + v - b * head - a * 4.5]], color);
}

/** The stock ahead of the tool, between the angles at which a tip enters and leaves it. */
function paintStock(c, [x, y], radius, right, [from, to]) {
  const arc = Array.from({ length: 61 }, (_, i) => onCircle(from + (to - from) * i / 60, radius));
  filled(c, [...arc.map(([u, v]) => [x + u, y + v]), [right, y + arc[60][1]], [right, y + arc[0][1]]], css('--grid'));
  line(c, arc.map(([u, v]) => [x + u, y + v]), css('--soft'), 1.5);
}

function paintTool(c, [x, y], radius, moments, phi) {
  const [from, to] = moments.engagement;
  c.strokeStyle = css('--soft');
  c.beginPath();
  c.arc(x, y, 0.62 * radius, 0, 2 * Math.PI);
  c.stroke();
  moments.teeth.forEach((psi, j) => {
    const theta = (((phi - psi) % 360) + 360) % 360;
    const cuts = theta > from && theta < to;
    const at = (turn, part) => { const [u, v] = onCircle(theta + turn, part * radius); return [x + u, y + v]; };
    filled(c, [at(0, 1), at(-26, 0.62), at(-4, 0.55), at(10, 0.62)], css(seriesColor(j)));
    if (cuts) line(c, [at(0, 1), at(0, 1.07)], css('--ink'), 3);
    write(c, String(j + 1), ...at(-8, 0.45), { align: 'center', color: '--ink' });
  });
}

function paintMoment(c, width, height, moments, i) {
  const radius = Math.min(0.36 * height, 0.27 * width);
  const largest = largestOf(moments.tool, moments.table) || 1;
  const scale = 0.09 * radius / largest;
  const peak = largestOf(moments.force) || 1;
  const middle = [0.42 * width, 0.5 * height];
  const moved = ([x, y]) => [middle[0] + scale * x[i], middle[1] - scale * y[i]];
  const tool = moved(moments.tool);
  paintStock(c, moved(moments.table), 1.02 * radius, width, moments.engagement);
  line(c, moments.tool[0].map((x, k) => [middle[0] + scale * x, middle[1] - scale * moments.tool[1][k]]), css('--measured'), 1);
  paintTool(c, tool, radius, moments, moments.angle[i]);
  arrowTo(c, tool, moments.force.map((F, k) => (k ? -1 : 1) * 0.8 * radius * F[i] / peak), css('--s2'));
  const bar = niceStep(0.5 * largest);
  line(c, [[8, height - 14], [8 + scale * bar, height - 14]], css('--ink'), 2);
  write(c, `${number(bar)} µm, displacements much enlarged`, 14 + scale * bar, height - 14);
  write(c, 'feed: the tool goes right', width - 4, 12, { align: 'right' });
}

function momentText({ angle, tool, table, force }, i) {
  const tenth = (v) => v.toFixed(1).replace(/^-(0\.0)$/, '$1').replace('-', '−');
  const pair = ([x, y]) => `${tenth(x[i])}, ${tenth(y[i])}`;
  return `φ = ${number(((angle[i] % 360) + 360) % 360, 4)}°: force on the tool ${pair(force)} N, ` +
    `tool ${pair(tool)} µm, table ${pair(table)} µm (x, y)`;
}

/** Paused until somebody asks; a slider for every moment, by mouse or keys. */
function movingSection(report) {
  const moments = momentsOf(report);
  if (!moments) return null;
  const count = moments.angle.length;
  const sizes = moments.force[0].map((F, i) => Math.hypot(F, moments.force[1][i]));
  let at = sizes.indexOf(Math.max(...sizes));
  let started = null;
  const chart = drawing({ label: 'The cut from above at one moment: stock, tool with its teeth, and the force on it',
    lowOnPaper: 0.62, paint: (c, width, height) => paintMoment(c, width, height, moments, at),
    height: (width) => Math.round(Math.min(430, Math.max(260, 0.62 * width))) });
  const readout = el('div', { class: 'readout moment', 'aria-live': 'off' }, momentText(moments, at));
  const slider = el('input', { type: 'range', min: 0, max: count - 1, step: 1, value: at,
    'aria-label': 'moment of the last turns', input: () => show(Number(slider.value)) });
  const show = (i) => {
    at = i;
    slider.value = i;
    slider.setAttribute('aria-valuetext', `${number(moments.angle[i] - moments.angle[0], 4)} degrees`);
    readout.textContent = momentText(moments, i);
    chart.redraw();
  };
  const secondsATurn = 8;
  const perSecond = 360 / secondsATurn / ((moments.angle[count - 1] - moments.angle[0]) / (count - 1));
  const frame = (now) => {
    if (!started) return;
    show(Math.floor(started.from + perSecond * (now - started.time) / 1000) % count);
    requestAnimationFrame(frame);
  };
  const button = el('button', { type: 'button', 'aria-pressed': 'false', click: () => {
    started = started ? null : { from: at, time: performance.now() };
    button.setAttribute('aria-pressed', String(Boolean(started)));
    button.textContent = started ? 'Pause' : 'Play';
    if (started) requestAnimationFrame(frame);
  } }, 'Play');
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  chart.controls.append(el('div', { class: 'moments screen' },
    still ? null : el('div', { class: 'choice' }, el('div', {}, button)), slider));
  chart.canvas.parentElement.after(readout);
  const part = section('moving', 'The cut from above', 'From above',
    prose('Stock, tool and the force on the tool (arrow) at one moment of the last turns. A bar at the tip of a tooth means that ' +
      'the tooth can cut there. Thin line: the path of the middle of the tool. ', el('span', { class: 'screen' },
      still ? 'The slider chooses the moment.' : 'Play shows the motion slowly. The slider and the arrow keys choose a moment.')),
    chart.element);
  return { part, draw: () => chart.resize() };
}
