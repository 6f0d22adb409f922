// Where two coefficients lie together: the joint 95 % region of each answer.

/** 97.5 % quantile of Student's t with nu degrees of freedom, by its expansion; from 3 on. */
function studentQuantile(nu) {
  const z = 1.959964;
  return z + (z ** 3 + z) / (4 * nu) + (5 * z ** 5 + 16 * z ** 3 + 3 * z) / (96 * nu ** 2) +
    (3 * z ** 7 + 19 * z ** 5 + 17 * z ** 3 - 15 * z) / (384 * nu ** 3);
}

/** Degrees of freedom that an interval was made with: half its width in standard errors. */
function freedomOf(entry) {
  const wanted = (entry.high - entry.low) / 2 / entry.se;
  let low = 1;
  let high = 1e6;
  for (let i = 0; i < 60; ++i) {
    const middle = Math.sqrt(low * high);
    if (studentQuantile(middle) > wanted) low = middle; else high = middle;
  }
  return high;
}

/** dK' C^-1 dK <= 2 F: the 95 % quantile of F with 2 and nu degrees of freedom is exact. */
const regionSize = (nu) => Math.sqrt(nu * (0.05 ** (-2 / nu) - 1));

/** Points of the ellipse of two estimates with their correlation. */
function ellipseOf([a, b], correlation) {
  const size = regionSize(Math.min(freedomOf(a), freedomOf(b)));
  return Array.from({ length: 121 }, (_, i) => {
    const t = 2 * Math.PI * i / 120;
    const across = correlation * Math.cos(t) + Math.sqrt(Math.max(0, 1 - correlation ** 2)) * Math.sin(t);
    return [a.value + size * a.se * Math.cos(t), b.value + size * b.se * across];
  });
}

/** K with its subscript and unit. */
function writeSymbol(c, { name, unit }, x, y) {
  const [letter, index] = name.split('_');
  c.save();
  c.font = `italic ${font}`;
  write(c, letter, x, y, { color: '--ink' });
  let at = x + c.measureText(letter).width + 1;
  c.font = font.replace('12px', '9px');
  write(c, index || '', at, y + 4, { color: '--ink' });
  at += c.measureText(index || '').width + 5;
  c.font = font;
  write(c, `[${unit}]`, at, y);
  c.restore();
}

/** The axes around all regions and intervals. */
function aroundRegions(answers) {
  const regions = answers.flatMap((answer) => ellipseOf(answer.pair, answer.correlation));
  const range = (k) => {
    const all = [...regions.map((point) => point[k]), ...answers.flatMap(({ pair }) => [pair[k].low, pair[k].high])];
    const [low, high] = [Math.min(...all), Math.max(...all)];
    return [low - 0.06 * (high - low), high + 0.06 * (high - low)];
  };
  return { x: range(0), y: range(1) };
}

/** answers: [{name, color, pair: [K, K], correlation, chosen}]; returns the frame. */
function paintEllipses(c, width, height, { answers, labels, view }) {
  const regions = answers.map((answer) => ellipseOf(answer.pair, answer.correlation));
  const frame = { left: 56, top: 24, width: width - 72, height: height - 24 - 44, ...view, xLabel: '', yLabel: '' };
  const { px, py } = plane(c, frame);
  writeSymbol(c, labels[1], 0, 10);
  writeSymbol(c, labels[0], width - 80, height - 10);
  c.save();
  c.beginPath();
  c.rect(frame.left, frame.top, frame.width, frame.height);
  c.clip();
  answers.forEach(({ pair: [a, b], color, chosen }, i) => {
    const points = regions[i].map(([x, y]) => [px(x), py(y)]);
    c.globalAlpha = chosen ? 0.25 : 0.1;
    filled(c, points, css(color));
    c.globalAlpha = 1;
    line(c, points, css(color), chosen ? 2.2 : 1.4, chosen ? [] : [5, 3]);
    if (chosen) {
      line(c, [[px(a.low), py(b.value)], [px(a.high), py(b.value)]], css(color), 1);
      line(c, [[px(a.value), py(b.low)], [px(a.value), py(b.high)]], css(color), 1);
    }
    c.fillStyle = css(color);
    c.beginPath();
    c.arc(px(a.value), py(b.value), chosen ? 4 : 3, 0, 2 * Math.PI);
    c.fill();
  });
  c.restore();
  return frame;
}

/** Names and colours above a drawing. */
function keysOf(answers) {
  return el('div', { class: 'legend keys' }, el('span', { class: 'items' },
    answers.map(({ name, color, chosen }) => {
      const key = el('i', { class: `key${chosen ? '' : ' dashed'}` });
      key.style.setProperty('--key', `var(${color})`);
      key.style.height = '3px';
      return el('span', {}, key, chosen ? el('strong', {}, name) : name);
    })));
}

function ellipseSection(answers, keys) {
  const known_ = answers.filter(({ pair, correlation }) => isNumber(correlation) &&
    pair?.every((entry) => isNumber(entry?.se) && entry.se > 0));
  const main = known_.find(({ chosen }) => chosen) || known_[0];
  if (!main) return null;
  const names = keys.map((key) => nameAndUnit(key));
  const state = { shown: known_, frame: null };
  const chart = drawing({ label: 'Joint 95 % regions of the two coefficients', height: () => 400, lowOnPaper: true,
    data: () => ({ head: ['answer', ...keys.flatMap((key) => [key, `${key}, low`, `${key}, high`]), 'correlation'],
      rows: known_.map(({ name, pair, correlation }) => [name, ...pair.flatMap((k) => [k.value, k.low, k.high]), correlation]) }),
    paint: (c, width, height) => {
      state.frame = paintEllipses(c, width, height, { answers: state.shown, labels: names, view: chart.view });
    } });
  zoomable(chart, () => state.frame, aroundRegions(known_));
  readoutOf(chart, 'Point for values; drag or pinch to zoom, double-click to see all.', (place) => {
    const [u, v] = valuesAtPlace(state.frame, place);
    return [symbol(names[0].name), ` ${number(u)} ${names[0].unit}, `, symbol(names[1].name), ` ${number(v)} ${names[1].unit}`];
  });
  chart.controls.append(...[keysOf(known_), choice('Show', known_.length > 1 ? [{ value: known_, text: 'all' },
    { value: [main], text: main.chosen ? 'the chosen one' : main.name }] : [], known_,
  (shown) => { state.shown = shown; chart.view = aroundRegions(shown); chart.redraw(); })].filter(Boolean));
  const [a, b] = main.pair;
  const slope = main.correlation * b.se / a.se;
  const part = section('together', 'How well both are known together', 'Together',
    prose('Each region contains both coefficients with a probability of 95 %. The cross marks the interval of each one alone. The ' +
      'correlation is ', el('b', {}, fixed(main.correlation, 3)), Math.abs(main.correlation) > 0.8 ? [
      ': only one combination is known well. If ', symbol(names[0].name), ` is 10 ${names[0].unit} higher, `,
      symbol(names[1].name), ` is ${number(Math.abs(10 * slope), 2)} ${names[1].unit} ${
        slope < 0 ? 'lower' : 'higher'}. Always use both together.`] : '.'), chart.element);
  return { part, draw: () => chart.resize() };
}
