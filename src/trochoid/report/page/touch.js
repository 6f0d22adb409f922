// Zoom by fingers, and of drawings by the mouse too. One finger across a plot chooses a range, as a drag of
// the mouse does; two fingers pinch; up and down the page scrolls.

const farEnough = 8;  // pixels that make a drag of a click
const twiceWithin = 350;  // ms between the two taps of a double one

/** The range after fingers that were at `was` are at `now`; both are shares of the width, or height. */
function pinched([low, high], was, now) {
  const apart = (pair) => pair[1] - pair[0];
  if (Math.abs(apart(was)) < 0.02 || Math.abs(apart(now)) < 0.02) return [low, high];
  const scale = apart(was) / apart(now);
  const size = (high - low) * scale;
  const first = low + was[0] * (high - low) - now[0] * size;
  return [first, first + size];
}

/** A range that stays within all there is. */
function withinAll([low, high], [first, last]) {
  const size = Math.min(high - low, last - first);
  const from = Math.min(Math.max(low, first), last - size);
  return [from, from + size];
}

/**
 * Fingers on an element. on: {select(from, to), pinch(was, now), done(), reset()}, all in pixels of the
 * element: points [x, y].
 */
function watchFingers(element, on) {
  const fingers = new Map();
  let start = null;
  let tapped = { time: -1e9, at: [0, 0] };
  const place = (event) => {
    const box = element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  element.addEventListener('pointerdown', (event) => {
    if (event.pointerType !== 'touch') return;
    fingers.set(event.pointerId, place(event));
    start = { at: [...fingers.values()], pinch: fingers.size === 2 };
    if (start.pinch) on.begin?.();
  });
  element.addEventListener('pointermove', (event) => {
    if (!fingers.has(event.pointerId)) return;
    fingers.set(event.pointerId, place(event));
    const now = [...fingers.values()];
    if (now.length === 2 && start.pinch) on.pinch(start.at, now);
    else if (now.length === 1 && !start.pinch) on.select(start.at[0], now[0], false);
  });
  const up = (event) => {
    const at = fingers.get(event.pointerId);
    if (!at) return;
    fingers.delete(event.pointerId);
    if (start.pinch || event.type === 'pointercancel') {
      on.select(at, at, true);
      if (!fingers.size) start = { at: [], pinch: false };
      return;
    }
    const [from] = start.at;
    on.select(from, at, true);
    const still = Math.hypot(at[0] - from[0], at[1] - from[1]) < farEnough;
    const again = still && event.timeStamp - tapped.time < twiceWithin &&
      Math.hypot(at[0] - tapped.at[0], at[1] - tapped.at[1]) < 30;
    if (again) on.reset();
    tapped = { time: still && !again ? event.timeStamp : -1e9, at };
  };
  element.addEventListener('pointerup', up);
  element.addEventListener('pointercancel', up);
}

/** Curves that share an angle are zoomed together, as the mouse does it. */
function zoomAlike(chart, range) {
  for (const other of charts) {
    if (other === chart || (other.stack && other.stack.key === chart.stack.key)) other.zoom(range);
  }
}

/** Fingers on one plot of a stack. */
function fingersOnPlot(plot, chart) {
  const width = () => plot.over.clientWidth || 1;
  const value = (px) => plot.posToVal(px, 'x');
  const ends = () => {
    const { x, points } = chart.stack;
    return points ? aroundPoints(x)(null, x[0], x[x.length - 1]) : [x[0], x[x.length - 1]];
  };
  let before = null;
  watchFingers(plot.over, {
    begin: () => { before = [plot.scales.x.min, plot.scales.x.max]; },
    select: (from, to, done) => {
      const [left, right] = [Math.min(from[0], to[0]), Math.max(from[0], to[0])];
      const wide = right - left >= farEnough;
      if (!done) {
        plot.setCursor({ left: to[0], top: to[1] });
        plot.setSelect({ left, width: wide ? right - left : 0, top: 0, height: plot.over.clientHeight }, false);
        return;
      }
      plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
      if (wide) zoomAlike(chart, [value(left), value(right)]);
    },
    pinch: (was, now) => zoomAlike(chart, withinAll(pinched(before, was.map(([x]) => x / width()).sort((a, b) => a - b),
      now.map(([x]) => x / width()).sort((a, b) => a - b)), ends())),
    reset: () => zoomAlike(chart, ends()),
  });
}

/** The values at a place of a drawing, in its own axes. */
function valuesAtPlace({ left, top, width, height, x, y }, [px, py]) {
  const share = (v, from, size) => Math.min(1, Math.max(0, (v - from) / size));
  return [x[0] + (x[1] - x[0]) * share(px, left, width), y[1] - (y[1] - y[0]) * share(py, top, height)];
}

/**
 * Zoom of a drawing: a rectangle by mouse or finger, a pinch, a double click for all. frame(): where its axes
 * are now; all: {x, y} of everything. chart.view is what is to be painted.
 */
function zoomable(chart, frame, all) {
  chart.view = { ...all };
  const { canvas } = chart;
  const box = el('div', { class: 'rubber' });
  canvas.parentElement.append(box);
  let before = null;
  const show = (view) => { chart.view = view; chart.redraw(); };
  const mark = (from, to) => {
    const wide = Math.abs(to[0] - from[0]) >= farEnough || Math.abs(to[1] - from[1]) >= farEnough;
    Object.assign(box.style, { display: wide ? 'block' : 'none', left: `${Math.min(from[0], to[0])}px`,
      top: `${Math.min(from[1], to[1])}px`, width: `${Math.abs(to[0] - from[0])}px`, height: `${Math.abs(to[1] - from[1])}px` });
  };
  const take = (from, to) => {
    box.style.display = 'none';
    const [a, b] = [valuesAtPlace(frame(), from), valuesAtPlace(frame(), to)];
    const near = [0, 1].some((k) => Math.abs(to[k] - from[k]) < farEnough);
    if (near) return false;
    show({ x: [Math.min(a[0], b[0]), Math.max(a[0], b[0])], y: [Math.min(a[1], b[1]), Math.max(a[1], b[1])] });
    return true;
  };
  const reset = () => show({ ...all });
  const share = ({ left, top, width, height }) => (points, k) =>
    points.map((p) => (k ? 1 - (p[1] - top) / height : (p[0] - left) / width)).sort((a, b) => a - b);
  watchFingers(canvas, {
    begin: () => { before = chart.view; },
    select: (from, to, done) => (done ? take(from, to) : mark(from, to)),
    pinch: (was, now) => {
      const of = share(frame());
      show({ x: withinAll(pinched(before.x, of(was, 0), of(now, 0)), all.x),
        y: withinAll(pinched(before.y, of(was, 1), of(now, 1)), all.y) });
    },
    reset,
  });
  mouseOn(canvas, { mark, take, reset });
}

/** The mouse on a drawing: a drag chooses a rectangle, and is no click. */
function mouseOn(canvas, { mark, take, reset }) {
  let from = null;
  const place = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  canvas.addEventListener('pointerdown', (event) => {
    if (event.pointerType === 'touch' || event.button !== 0) return;
    from = place(event);
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener('pointermove', (event) => { if (from) mark(from, place(event)); });
  canvas.addEventListener('pointerup', (event) => {
    if (!from) return;
    const zoomed = take(from, place(event));
    from = null;
    if (zoomed) canvas.addEventListener('click', (click) => click.stopImmediatePropagation(), { once: true, capture: true });
  });
  canvas.addEventListener('dblclick', reset);
}
