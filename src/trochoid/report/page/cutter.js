// What a cutter looks like by the tables of its case: profile, teeth and edges, in mm. The form for browsers
// asks it while a person types, so every table may hold anything.

/** Whether a value is a length that can be drawn: what the rules of a case refuse is not. */
const isLength = (value) => isNumber(value) && value > 0 && value <= 1e4;
const areNumbers = (values) => Array.isArray(values) && values.every(isNumber);
const numberOr = (value, usual) => (isNumber(value) ? value : usual);
const inRadians = (deg) => numberOr(deg, 0) * Math.PI / 180;

/** Whether tooth and profile can be drawn at all. */
function isDrawable(tool) {
  return Number.isInteger(tool.teeth) && tool.teeth >= 1 && tool.teeth <= 64 && isLength(tool.diameter_mm) &&
    (tool.pitch_deg === undefined || areNumbers(tool.pitch_deg));
}

/** Where the stock lies across the feed, from and to, in radii; y points to the left of the feed. null: not known. */
function stockOf(cut, radius) {
  const depth = cut.radial_depth_mm ?? radius;
  const stock = cut.stock_y_mm ?? [-radius, radius];
  if (cut.engagement === 'arcs' || !isLength(depth) || !areNumbers(stock) || stock.length !== 2) return null;
  const seen = (y) => Math.max(-1.25, Math.min(1.25, y / radius));
  if (cut.engagement === 'up') return [seen(radius - depth), 1];
  if (cut.engagement === 'down') return [-1, seen(depth - radius)];
  return cut.engagement === 'band' ? stock.map(seen) : [-1, 1];
}

/** The seven numbers of an APT cutter, as docs/theory/geometry.md has them. */
function aptOf(tool) {
  const D = tool.diameter_mm;
  const R = numberOr(tool.corner_radius_mm, 0);
  const beta = inRadians(tool.taper_deg);
  switch (tool.shape) {
    case 'ball': return { D, R: D / 2, Rr: 0, Rz: D / 2, alpha: 0, beta: 0 };
    case 'bull_nose': return { D, R, Rr: D / 2 - R, Rz: R, alpha: 0, beta: 0 };
    case 'taper': return { D, R, Rr: D / 2 + R * Math.tan(beta) - R / Math.cos(beta), Rz: R, alpha: 0, beta };
    case 'apt': return { D, R, Rr: numberOr(tool.corner_center_radius_mm, 0), Rz: numberOr(tool.corner_center_height_mm, 0),
      alpha: inRadians(tool.bottom_angle_deg), beta };
    default: return { D, R: 0, Rr: D / 2, Rz: 0, alpha: 0, beta: 0 };
  }
}

/** The profile as points [r, z], from the axis up to a height: bottom, corner, flank. */
function profileOf(tool, height) {
  const { D, R, Rr, Rz, alpha, beta } = aptOf(tool);
  const [ta, tb] = [Math.tan(alpha), Math.tan(beta)];
  const u = (D / 2) * (1 - ta * tb);
  const root = (x) => Math.sqrt(Math.max(0, x));
  const Mr = (Rz * ta + Rr + root((R * R - Rr * Rr) * ta * ta + 2 * Rr * Rz * ta + R * R - Rz * Rz)) / (1 + ta * ta);
  const Nz = ((Rr - u) * tb + Rz - root((R * R - Rz * Rz) * tb * tb + 2 * Rz * (Rr - u) * tb - (Rr - u) ** 2 + R * R)) / (1 + tb * tb);
  const points = [[0, 0], [Mr, Mr * ta]];
  if (R > 0) {
    const from = Math.atan2(Mr * ta - Rz, Mr - Rr);
    const to = Math.atan2(Nz - Rz, u + Nz * tb - Rr);
    for (let i = 1; i < 24; ++i) {
      const at = from + ((to - from) * i) / 24;
      points.push([Rr + R * Math.cos(at), Rz + R * Math.sin(at)]);
    }
  }
  points.push([u + Nz * tb, Nz]);
  points.push([Nz > height ? Rr + root(R * R - (height - Rz) ** 2) : Math.max(0, u + height * tb), height]);
  return points.filter(([r, z]) => isNumber(r) && isNumber(z) && z <= height + 1e-9);
}

function radiusAt(profile, z) {
  const i = profile.findIndex(([, height]) => height > z);
  if (i <= 0) return profile.at(-1)[0];
  const [[r0, z0], [r1, z1]] = [profile[i - 1], profile[i]];
  return r0 + ((r1 - r0) * (z - z0)) / (z1 - z0);
}

/** The teeth of a tool: angle of the tip, lag and wave over the height, and what sets them apart. */
function teethOf(tool, runout, tipRadius) {
  const ofTooth = (values, j) => (Array.isArray(values) ? values[j] : values);
  const offset = (values, j) => (Array.isArray(values) ? numberOr(values[j], 0) : 0);
  const lead = 2 / (isLength(tool.lag_diameter_mm) ? tool.lag_diameter_mm : tool.diameter_mm);
  const wave = isLength(tool.serration?.wavelength_mm) && isLength(tool.serration.amplitude_mm) ? tool.serration : null;
  let angle = 0;
  return Array.from({ length: tool.teeth }, (_, j) => {
    const tip = angle;
    angle += tool.pitch_deg?.[j] ?? 360 / tool.teeth;
    const slope = Math.tan(inRadians(ofTooth(tool.helix_deg, j)));
    const shift = Array.isArray(wave?.shift_mm) ? offset(wave.shift_mm, j) : wave ? j * wave.wavelength_mm / tool.teeth : 0;
    const towards = (deg) => Math.cos(inRadians(tip - numberOr(deg, 0)));
    return { number: j + 1, tip,
      depth: (z) => (wave ? wave.amplitude_mm * Math.sin(Math.PI * (z - shift) / wave.wavelength_mm) ** 2 : 0),
      angleAt: (z) => tip + lead * z * slope * 180 / Math.PI,
      out: offset(runout.radial_offsets_mm, j) + numberOr(runout.eccentricity_mm, 0) * towards(runout.angle_deg),
      deeper: offset(runout.axial_offsets_mm, j) +
        Math.tan(inRadians(runout.tilt_deg)) * tipRadius * towards(runout.tilt_angle_deg) };
  });
}

/** What of an edge is seen along the feed, on the rear of the tool: lists of points [y, z]. */
function edgeSeen(tooth, profile, height) {
  const parts = [];
  let seen = null;
  for (let i = 0; i <= 240; ++i) {
    const z = height * i / 240;
    const behind = inRadians(tooth.angleAt(z));  // G-1: theta = -behind, x < 0
    if (Math.sin(behind) < -1e-9) seen = null;
    else {
      if (seen === null) parts.push(seen = []);
      seen.push([(radiusAt(profile, z) - tooth.depth(z)) * Math.cos(behind), z]);
    }
  }
  return parts.filter((part) => part.length > 1);
}

/** The height of the cut, and where nothing says one, the curve of the tool or half its diameter. */
function heightOfCut(tool, cut) {
  if (isLength(cut.axial_depth_mm)) return cut.axial_depth_mm;
  const curved = tool.shape === 'bull_nose' || tool.shape === 'taper' ? numberOr(tool.corner_radius_mm, 0) : 0;
  return Math.max(tool.diameter_mm / 2, Math.min(curved, 1e4));
}

/** So much of the tool is shown above a cut of a height that its shape is seen; of a wide cone less. */
function heightShown(tool, cut) {
  const R = tool.diameter_mm / 2;
  const { beta } = aptOf(tool);
  return Math.max(1.35 * cut, Math.min(1.3 * R, beta > 0 ? 0.3 * R / Math.tan(beta) : Infinity));
}
