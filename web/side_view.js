// The cutter in its cut, seen along the feed: profile, edges and depth of the cut.
'use strict';

const rad = (deg) => ((deg ?? 0) * Math.PI) / 180;

/** The seven numbers of an APT cutter, as docs/theory/geometry.md has them; lengths in mm. */
function aptOf(tool) {
  const D = tool.diameter_mm;
  const R = tool.corner_radius_mm ?? 0;
  const beta = rad(tool.taper_deg);
  switch (tool.shape) {
    case 'ball': return { D, R: D / 2, Rr: 0, Rz: D / 2, alpha: 0, beta: 0 };
    case 'bull_nose': return { D, R, Rr: D / 2 - R, Rz: R, alpha: 0, beta: 0 };
    case 'taper': return { D, R, Rr: D / 2 + R * Math.tan(beta) - R / Math.cos(beta), Rz: R, alpha: 0, beta };
    case 'apt': return { D, R, Rr: tool.corner_center_radius_mm ?? 0, Rz: tool.corner_center_height_mm ?? 0,
                         alpha: rad(tool.bottom_angle_deg), beta };
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
  points.push([u + Nz * tb, Nz], [u + height * tb, height]);
  return points.filter(([r, z]) => Number.isFinite(r) && Number.isFinite(z) && z <= height + 1e-9);
}

function radiusAt(profile, z) {
  const i = profile.findIndex(([, height]) => height > z);
  if (i <= 0) return profile.at(-1)[0];
  const [[r0, z0], [r1, z1]] = [profile[i - 1], profile[i]];
  return z1 > z0 ? r0 + ((r1 - r0) * (z - z0)) / (z1 - z0) : r1;
}

/** Edges on the side that is seen, x < 0, as lists of [y, z]: theta = -psi - lag(z), y = r cos(theta). */
function edgesSeen(tool, profile, height) {
  const pitch = tool.pitch_deg?.length === tool.teeth ? tool.pitch_deg : Array(tool.teeth).fill(360 / tool.teeth);
  const lead = (2 * Math.tan(rad(tool.helix_deg))) / (tool.lag_diameter_mm ?? tool.diameter_mm);
  const edges = [];
  let psi = 0;
  for (const step of pitch.slice(0, 24)) {
    let seen = null;
    for (let i = 0; i <= 60; ++i) {
      const z = (height * i) / 60;
      const theta = -rad(psi) - lead * z;
      if (Math.sin(theta) > 1e-9) seen = null;
      else {
        if (seen === null) edges.push(seen = []);
        seen.push([radiusAt(profile, z) * Math.cos(theta), z]);
      }
    }
    psi += step;
  }
  return edges;
}

/** @param given a case, as read @returns a picture, or null without tool or depth */
function drawSide(given) {
  const tool = inMm(given.tool ?? {});
  const cut = inMm(given.cut ?? {});
  const depth = cut.axial_depth_mm;
  if (!isDrawable(tool, cut) || !isLength(depth)) return null;
  const radius = tool.diameter_mm / 2;
  const height = Math.max(1.35 * depth, 1.3 * radius);
  const profile = profileOf(tool, height);
  if (profile.length < 3) return null;
  const widest = Math.max(1.25 * radius, ...profile.map(([r]) => r));
  const s = Math.min(100 / widest, 140 / height);
  const at = ([y, z]) => `${(-y * s).toFixed(2)} ${(72 - z * s).toFixed(2)}`;  // the left of the feed is on the left
  const svg = shape('svg', { viewBox: '-130 -92 260 184', role: 'img', class: 'cut-drawing' });
  svg.append(shape('title', {}, `Seen along the feed: ${tool.shape ?? 'cylinder'}, ${depth} mm deep`));
  const [low, high] = stockOf(cut, radius).map((y) => Math.max(-1.25, Math.min(1.25, y)) * radius);
  svg.append(shape('path', { class: 'stock', d: `M ${at([high, 0])} L ${at([high, depth])} L ${at([low, depth])} L ${at([low, 0])} Z` }));
  const side = profile.map(([r, z]) => at([r, z]));
  const other = profile.map(([r, z]) => at([-r, z])).reverse();
  svg.append(shape('path', { class: 'tool', d: `M ${[...side, ...other].join(' L ')} Z` }));
  for (const edge of edgesSeen(tool, profile, height).filter((one) => one.length > 1)) {
    svg.append(shape('path', { class: 'edge', d: `M ${edge.map(at).join(' L ')}` }));
  }
  svg.append(shape('path', { class: 'turn', d: `M 112 72 V ${(72 - depth * s).toFixed(2)} M 108 72 H 116 M 108 ${(72 - depth * s).toFixed(2)} H 116` }));
  svg.append(shape('text', { class: 'label', x: 106, y: 72 - (depth * s) / 2 + 3, 'text-anchor': 'end' }, 'a_p'));
  svg.append(shape('text', { class: 'label', x: -126, y: 86 }, 'seen along the feed'));
  return svg;
}

if (typeof module !== 'undefined') module.exports = { profileOf, radiusAt, edgesSeen, drawSide };
