// The tool as the case describes it: from below, from the side, and its edges unrolled.

/** A table of the case as the page shows it: numbers, texts and lists by key; null: it has none. */
function tableOfCase(name) {
  const text = document.getElementById('case')?.textContent || '';
  const found = new RegExp(`^\\[${name}\\]\\n((?:(?!\\[).*\\n?)*)`, 'm').exec(text);
  if (!found) return null;
  const values = {};
  for (const row of found[1].split('\n')) {
    const [, key, value] = /^(\w+) = (.*)$/.exec(row) || [];
    if (!key) continue;
    try {
      values[key] = JSON.parse(value.replace(/^\{(.*)\}$/, (_, inner) => `{${inner.replace(/(\w+) = /g, '"$1": ')}}`));
    } catch { /* not needed here */ }
  }
  return values;
}

/** So many times a difference is drawn that a drawing shows it: 1, 2 or 5 times a power of ten. */
function exaggeration(values, wanted) {
  const most = Math.max(...values.map(Math.abs));
  if (!(most > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(wanted / most));
  return power * [5, 2, 1].find((step) => step * power * most <= wanted * (1 + 1e-9));
}

const ofLength = (um) => `${um > 0 ? '+' : ''}${number(um, 3)} µm`;

function caption(c, x, y, seen, how) {
  write(c, how ? `${seen},` : seen, x, y);
  if (how) write(c, how, x, y + 15);
}

/** From below: the tips about the axis, tooth 2 against the rotation. */
function paintFromBelow(c, { x, y, R }, { teeth, runout }) {
  const factor = exaggeration(teeth.map((t) => t.out), 0.3 * R);
  line(c, Array.from({ length: 73 }, (_, i) => [x + R * Math.sin(i * Math.PI / 36), y - R * Math.cos(i * Math.PI / 36)]),
    css('--grid'), 1.2);
  line(c, [[x - 4, y], [x + 4, y]], css('--soft'));
  line(c, [[x, y - 4], [x, y + 4]], css('--soft'));
  for (const t of teeth) {
    const a = t.tip * Math.PI / 180;  // seen from below the teeth go round clockwise
    const r = R + factor * t.out;
    line(c, [[x + 0.3 * R * Math.sin(a), y - 0.3 * R * Math.cos(a)], [x + r * Math.sin(a), y - r * Math.cos(a)]],
      css(seriesColor(t.number - 1)), 2.4);
    if (teeth.length <= 16) {
      write(c, String(t.number), x + (r + 11) * Math.sin(a), y - (r + 11) * Math.cos(a), { color: '--ink', align: 'center' });
    }
  }
  if (isLength(runout.eccentricity_mm)) {
    const a = inRadians(runout.angle_deg);
    line(c, [[x, y], [x + 0.28 * R * Math.sin(a), y - 0.28 * R * Math.cos(a)]], css('--ink'), 2);
  }
  caption(c, x - R, y + R + 52, 'from below', factor && 'offsets exaggerated');
}

/** From the side: profile and edges in the stock, and how deep each tooth reaches. */
function paintFromSide(c, { left, top, width, height }, { tool, cut, teeth, profile, drawn }) {
  const R = tool.diameter_mm / 2;
  const stock = cut && stockOf(cut, R)?.map((y) => y * R);
  const body = width - 44;  // beside it stands the depth of cut
  const tall = profile.at(-1)[1];
  const scale = Math.min(body / 2 / Math.max(...profile.map(([r]) => r), ...(stock || []).map(Math.abs)), height / tall);
  const axis = left + body / 2;
  const bottom = top + height;
  const at = ([y, z]) => [axis - scale * y, bottom - scale * z];  // the left of the feed is on the left
  const deep = isLength(cut?.axial_depth_mm);
  if (stock && deep) filled(c, [[stock[0], 0], [stock[1], 0], [stock[1], drawn], [stock[0], drawn]].map(at), css('--line'));
  line(c, [...profile.map(at).reverse(), ...profile.map(([r, z]) => at([-r, z]))], css('--soft'), 1.6);
  line(c, [[axis, bottom + 6], [axis, bottom - scale * tall - 6]], css('--soft'), 1, [8, 3, 2, 3]);
  teeth.forEach((t, i) => edgeSeen(t, profile, tall).forEach((part) => line(c, part.map(at), css(seriesColor(i)), 2)));
  if (deep) paintDepth(c, left + body + 8, bottom, scale * drawn);
  const factor = exaggeration(teeth.map((t) => t.deeper), 11);
  if (factor) paintDepths(c, { left, level: bottom + 17, width: body, factor }, teeth);
  caption(c, left, bottom + 52, cut ? 'along the feed' : 'from the side', factor && 'depths exaggerated');
}

/** How deep each tooth reaches, below the tool. */
function paintDepths(c, { left, level, width, factor }, teeth) {
  const each = width / teeth.length;
  line(c, [[left, level], [left + width, level]], css('--zero'));
  teeth.forEach((t, i) => {
    const x = left + (i + 0.5) * each;
    const half = Math.min(8, 0.4 * each);
    line(c, [[x - half, level + factor * t.deeper], [x + half, level + factor * t.deeper]], css(seriesColor(i)), 2.4);
    if (each >= 14) write(c, String(t.number), x, level + 20, { color: '--ink', align: 'center' });
  });
}

/** The depth of the cut beside the tool. */
function paintDepth(c, x, bottom, high) {
  line(c, [[x, bottom], [x, bottom - high]], css('--ink'), 1.4);
  for (const y of [bottom, bottom - high]) line(c, [[x - 4, y], [x + 4, y]], css('--ink'), 1.4);
  write(c, 'a_p', x + 7, bottom - high / 2, { color: '--ink' });
}

/** Edges unrolled: angle behind the tip of tooth 1 over the height, waves as thickness. */
function paintEdges(c, frame, { teeth, drawn }) {
  const { px, py } = plane(c, { ...frame, x: [0, 360], y: [0, drawn],
    xLabel: 'behind the tip of tooth 1 [°]', yLabel: '' });
  write(c, 'height [mm]', frame.left - 30, frame.top - 16, { color: '--ink' });
  const deepest = Math.max(...teeth.map((t) => t.depth(0)), ...teeth.map((t) => t.depth(drawn / 3)), 0);
  const wide = (d) => (deepest > 0 ? 1 + 5 * (1 - d / deepest) : 2);
  for (const t of teeth) {
    const color = css(seriesColor(t.number - 1));
    let before = null;
    for (let i = 0; i <= 240; ++i) {
      const z = drawn * i / 240;
      const angle = ((t.angleAt(z) % 360) + 360) % 360;
      const point = [px(angle), py(z)];
      if (before && Math.abs(point[0] - before[0]) < frame.width / 2) {
        line(c, [before, point], color, Math.max(0.6, wide(t.depth(z))));
      }
      before = point;
    }
  }
}

/** In words, what sets the teeth apart; of many teeth the ends of it. */
function toldOf(teeth) {
  const differs = (mm) => Math.abs(mm) > 1e-9;  // a cosine of 90 degrees is not 0
  const differ = teeth.filter((t) => differs(t.out) || differs(t.deeper));
  if (!differ.length) return 'The case has no runout.';
  const ends = (key) => {
    const sorted = [...teeth].sort((a, b) => a[key] - b[key]);
    const at = (t) => `${ofLength(1e3 * t[key])} (tooth ${t.number})`;
    return differs(sorted[0][key]) || differs(sorted.at(-1)[key]) ? `${at(sorted[0])} to ${at(sorted.at(-1))}` : '';
  };
  const joined = (out, deeper, separator) => [out, deeper && `${deeper} deeper`].filter(Boolean).join(separator);
  const words = differ.length > 12 ? joined(ends('out'), ends('deeper'), '; ') : differ.map((t) => `tooth ${t.number} ` +
    joined(differs(t.out) && ofLength(1e3 * t.out), differs(t.deeper) && ofLength(1e3 * t.deeper), ', ')).join('; ');
  return `Compared with a tool without runout: ${words}.`;
}

/**
 * The picture of a tool, for drawing(), with what it shows in words. The tables are those of a case, runout and cut
 * may be left out; null: this tool cannot be drawn.
 */
function toolPicture({ tool, runout, cut }) {
  if (!tool || !isDrawable(tool)) return null;
  const drawn = heightOfCut(tool, cut || {});
  const profile = profileOf(tool, heightShown(tool, drawn));
  if (profile.length < 3 || profile.some(([r]) => r < -1e-9 * tool.diameter_mm)) return null;  // no such solid
  const teeth = teethOf(tool, runout || {}, radiusAt(profile, 0));
  const known = { tool, runout: runout || {}, cut, profile, teeth, drawn };
  return {
    label: 'The tool from below, from the side, and its edges unrolled',
    told: toldOf(teeth),
    height: (width) => (width < 560 ? 566 : 300),
    paint: (c, width, height) => {
      const narrow = width < 560;
      const third = narrow ? width / 2 : width / 4;
      const R = Math.min(third / 2 - 26, 90);
      paintFromBelow(c, { x: R + 26, y: 120, R }, known);
      paintFromSide(c, { left: third + 20, top: 120 - R, width: third - 20, height: 2 * R }, known);
      paintEdges(c, narrow ? { left: 40, top: 316, width: width - 60, height: 200 }
        : { left: 2 * third + 60, top: 30, width: width - 2 * third - 80, height: 180 }, known);
    },
    data: () => ({ head: ['tooth', 'tip_deg', 'stands_out_um', 'reaches_deeper_um'],
      rows: teeth.map((t) => [t.number, t.tip, 1e3 * t.out, 1e3 * t.deeper]) }),
  };
}

/** The tool of the case, drawn; null: the case has none that can be. */
function toolSection() {
  const picture = toolPicture({ tool: tableOfCase('tool'), runout: tableOfCase('runout'), cut: tableOfCase('cut') });
  if (!picture) return null;
  const chart = drawing(picture);
  return { part: section('tool', 'The tool', 'Tool', prose(picture.told), chart.element), draw: () => chart.resize() };
}
