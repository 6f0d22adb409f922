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

/** Radius of the profile over the height above its tip. */
function profileOf(tool) {
  const R = tool.diameter_mm / 2;
  const beta = (tool.taper_deg || 0) * Math.PI / 180;
  const corner = tool.shape === 'ball' ? R : tool.corner_radius_mm || 0;
  if (tool.shape === 'apt') return null;
  const center = tool.shape === 'taper' ? R - corner * (1 - Math.sin(beta)) / Math.cos(beta) : R - corner;
  const tangent = corner * (1 - Math.sin(beta));
  return (z) => {
    if (z < tangent) return center + Math.sqrt(Math.max(z * (2 * corner - z), 0));
    return tool.shape === 'taper' ? R + z * Math.tan(beta) : R;
  };
}

/** The teeth of a tool: angle of the tip, lag and wave over the height, and what sets them apart. */
function teethOf(tool, runout, profile) {
  const all = Array.from({ length: tool.teeth }, (_, j) => j);
  const helix = (j) => (Array.isArray(tool.helix_deg) ? tool.helix_deg[j] : tool.helix_deg || 0) * Math.PI / 180;
  const diameter = tool.lag_diameter_mm || tool.diameter_mm;
  const wave = tool.serration;
  let angle = 0;
  return all.map((j) => {
    const tip = angle;
    angle += tool.pitch_deg?.[j] ?? 360 / tool.teeth;
    const shift = Array.isArray(wave?.shift_mm) ? wave.shift_mm[j] : wave ? j * wave.wavelength_mm / tool.teeth : 0;
    const depth = (z) => (wave ? wave.amplitude_mm * Math.sin(Math.PI * (z - shift) / wave.wavelength_mm) ** 2 : 0);
    const towards = (deg) => Math.cos((tip - (deg || 0)) * Math.PI / 180);
    return { number: j + 1, tip, depth,
      angleAt: (z) => tip + 2 * z * Math.tan(helix(j)) / diameter * 180 / Math.PI,
      out: (runout.radial_offsets_mm?.[j] || 0) + (runout.eccentricity_mm || 0) * towards(runout.angle_deg),
      deeper: (runout.axial_offsets_mm?.[j] || 0) +
        Math.tan((runout.tilt_deg || 0) * Math.PI / 180) * profile(0) * towards(runout.tilt_angle_deg) };
  });
}

/** The height that is drawn: the cut, and where nothing says one, the curve of the tool or half its diameter. */
function drawnHeight(tool, cut) {
  if (isNumber(cut?.axial_depth_mm)) return cut.axial_depth_mm;
  return tool.shape === 'ball' ? tool.diameter_mm / 2 : Math.max(tool.diameter_mm / 2, tool.corner_radius_mm || 0);
}

/** So many times a difference is drawn that a drawing shows it: 1, 2 or 5 times a power of ten. */
function exaggeration(values, wanted) {
  const most = Math.max(...values.map(Math.abs));
  if (!(most > 0)) return 0;
  const power = 10 ** Math.floor(Math.log10(wanted / most));
  return power * [5, 2, 1].find((step) => step * power * most <= wanted * (1 + 1e-9));
}

const ofLength = (um) => `${um > 0 ? '+' : ''}${number(um, 3)} µm`;

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
  if (runout.eccentricity_mm > 0) {
    const a = (runout.angle_deg || 0) * Math.PI / 180;
    line(c, [[x, y], [x + 0.28 * R * Math.sin(a), y - 0.28 * R * Math.cos(a)]], css('--ink'), 2);
  }
  write(c, factor ? 'from below, offsets exaggerated' : 'from below', x - R, y + R + 52);
}

/** From the side: the profile, and how deep each tooth reaches. */
function paintFromSide(c, { left, top, width, height }, { teeth, profile, drawn, tool }) {
  const widest = Math.max(profile(drawn), profile(0), tool.diameter_mm / 2);
  const scale = Math.min(width / (2 * widest), height / drawn);
  const axis = left + width / 2;
  const bottom = top + height;
  const heights = Array.from({ length: 81 }, (_, i) => drawn * (i / 80) ** 2);
  const side = (sign) => heights.map((z) => [axis + sign * scale * profile(z), bottom - scale * z]);
  filled(c, [...side(-1).reverse(), ...side(1)], css('--wash'));
  line(c, side(1), css('--soft'), 1.6);
  line(c, side(-1), css('--soft'), 1.6);
  line(c, [[axis, bottom + 6], [axis, top - 6]], css('--soft'), 1, [8, 3, 2, 3]);
  const factor = exaggeration(teeth.map((t) => t.deeper), 26);
  if (factor) {
    teeth.forEach((t, i) => {
      const at = left + (i + 0.5) * width / teeth.length;
      line(c, [[at - 8, bottom + factor * t.deeper], [at + 8, bottom + factor * t.deeper]], css(seriesColor(i)), 2.4);
      write(c, String(t.number), at, bottom + factor * t.deeper + 11, { color: '--ink', align: 'center' });
    });
  }
  write(c, factor ? 'from the side, depths exaggerated' : 'from the side', left, bottom + 52);
}

/** Edges unrolled: angle behind the tip of tooth 1 over the height, waves as thickness. */
function paintEdges(c, frame, { teeth, drawn }) {
  const { px, py } = plane(c, { ...frame, x: [0, 360], y: [0, drawn],
    xLabel: 'behind the tip of tooth 1 [°]', yLabel: '' });
  write(c, 'height [mm]', frame.left - 30, frame.top - 16, { color: '--ink' });
  const deepest = Math.max(...teeth.map((t) => t.depth(0)), ...teeth.map((t) => t.depth(drawn / 3)), 0);
  const wide = (d) => (deepest > 0 ? 1 + 5 * (1 - d / deepest) : 2);
  for (const t of teeth) {
    let before = null;
    for (let i = 0; i <= 240; ++i) {
      const z = drawn * i / 240;
      const angle = ((t.angleAt(z) % 360) + 360) % 360;
      const point = [px(angle), py(z)];
      if (before && Math.abs(point[0] - before[0]) < frame.width / 2) {
        line(c, [before, point], css(seriesColor(t.number - 1)), Math.max(0.6, wide(t.depth(z))));
      }
      before = point;
    }
  }
}

/** The tool, drawn; null: the case has none that can be. */
function toolSection() {
  const tool = tableOfCase('tool');
  if (!tool || !isNumber(tool.diameter_mm) || !(tool.teeth >= 1 && tool.teeth <= 64)) return null;
  const profile = profileOf(tool);
  if (!profile) return null;
  const runout = tableOfCase('runout') || {};
  const numbers = (list) => (Array.isArray(list) && list.every(isNumber) ? list : undefined);
  const known = { ...runout, radial_offsets_mm: numbers(runout.radial_offsets_mm), axial_offsets_mm: numbers(runout.axial_offsets_mm) };
  const teeth = teethOf(tool, known, profile);
  const drawn = drawnHeight(tool, tableOfCase('cut'));
  const told = { tool, runout: known, profile, teeth, drawn };
  const chart = drawing({
    label: 'The tool from below, from the side, and its edges unrolled',
    height: (width) => (width < 560 ? 620 : 300),
    paint: (c, width, height) => {
      c.clearRect(0, 0, width, height);
      const narrow = width < 560;
      const third = narrow ? width / 2 : width / 4;
      const R = Math.min(third / 2 - 26, 90);
      paintFromBelow(c, { x: R + 26, y: 120, R }, told);
      paintFromSide(c, { left: third + 20, top: 30, width: third - 40, height: 180 }, told);
      paintEdges(c, narrow ? { left: 40, top: 340, width: width - 60, height: 200 }
        : { left: 2 * third + 60, top: 30, width: width - 2 * third - 80, height: 180 }, told);
    },
    data: () => ({ head: ['tooth', 'tip_deg', 'stands_out_um', 'reaches_deeper_um'],
      rows: teeth.map((t) => [t.number, t.tip, 1e3 * t.out, 1e3 * t.deeper]) }),
  });
  const differ = teeth.filter((t) => t.out !== 0 || t.deeper !== 0)
    .map((t) => `tooth ${t.number} ${ofLength(1e3 * t.out)}${t.deeper ? `, ${ofLength(1e3 * t.deeper)} deeper` : ''}`);
  return { part: section('tool', 'The tool', 'Tool',
    prose(differ.length ? `Against a tool that runs true: ${differ.join('; ')}.` : 'The case has no runout.'),
    chart.element), draw: () => chart.resize() };
}
