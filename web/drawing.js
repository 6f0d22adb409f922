// The cutter in its cut, seen from above: turns with the numbers.
'use strict';

const svgSpace = 'http://www.w3.org/2000/svg';

function shape(name, attributes, text) {
  const node = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

/** Where the stock lies across the feed, from and to, in radii; y points to the left of the feed. */
function stockOf(cut, radius) {
  const ae = cut.radial_depth_mm ?? radius;
  if (cut.engagement === 'up') return [1 - ae / radius, 1];
  if (cut.engagement === 'down') return [-1, -1 + ae / radius];
  if (cut.engagement === 'band' && cut.stock_y_mm?.length === 2) return cut.stock_y_mm.map((y) => y / radius);
  return [-1, 1];
}

/** Whether a value is a length that can be drawn: what the case's rules refuse is not. */
function isLength(value, most = 1e4) {
  return typeof value === 'number' && Number.isFinite(value) && value > 0 && value <= most;
}

function areNumbers(values) {
  return Array.isArray(values) && values.every((v) => typeof v === 'number' && Number.isFinite(v));
}

/** Whether tool and cut are what the case's rules take, as far as the drawing needs them. */
function isDrawable(tool, cut) {
  const whole = Number.isInteger(tool.teeth) && tool.teeth >= 1 && tool.teeth <= 64;
  const depth = cut.radial_depth_mm;
  return whole && isLength(tool.diameter_mm) && (depth === undefined || isLength(depth)) &&
         (tool.pitch_deg === undefined || areNumbers(tool.pitch_deg)) &&
         (cut.stock_y_mm === undefined || areNumbers(cut.stock_y_mm));
}

/** @param given a case, as read @returns a picture, or null without a tool or of one that cannot be */
function drawCut(given) {
  const tool = inMm(given.tool ?? {});
  const cut = inMm(given.cut ?? {});
  if (!isDrawable(tool, cut) || cut.engagement === 'arcs') return null;
  const radius = tool.diameter_mm / 2;
  const R = 62;
  const [low, high] = stockOf(cut, radius).map((y) => Math.max(-1.25, Math.min(1.25, y)));
  const svg = shape('svg', { viewBox: '-130 -92 260 184', role: 'img', class: 'cut-drawing' });
  svg.append(shape('title', {}, `${tool.teeth} teeth, ${tool.diameter_mm} mm, ${cut.engagement ?? 'no cut'}`));
  const y = (value) => -value * R;
  const x = (value) => (Math.abs(value) < 1 ? R * Math.sqrt(1 - value * value) : 0);
  svg.append(shape('path', {
    class: 'stock',
    d: `M 128 ${y(high)} H ${x(high)} A ${R} ${R} 0 0 1 ${x(low)} ${y(low)} H 128 Z`,
  }));
  svg.append(shape('circle', { class: 'tool', r: R }));
  const pitch = tool.pitch_deg?.length === tool.teeth ? tool.pitch_deg : Array(tool.teeth).fill(360 / tool.teeth);
  let angle = 0;
  for (let j = 0; j < tool.teeth; ++j) {
    const a = (-angle * Math.PI) / 180;  // tooth 2 follows tooth 1: against the rotation
    svg.append(shape('line', { class: 'tooth', x1: 0.35 * R * Math.sin(a), y1: -0.35 * R * Math.cos(a),
                               x2: R * Math.sin(a), y2: -R * Math.cos(a) }));
    if (tool.teeth <= 8) {
      svg.append(shape('text', { class: 'label', x: 0.82 * R * Math.sin(a) + 5,
                                 y: -0.82 * R * Math.cos(a) + 4 }, String(j + 1)));
    }
    angle += pitch[j];
  }
  svg.append(shape('path', { class: 'turn', d: 'M -14 -20 A 24 24 0 0 1 20 -14 l -7 -1 m 7 1 l 1 -7' }));
  svg.append(shape('path', { class: 'feed', d: 'M 74 0 H 116 l -8 -5 m 8 5 l -8 5' }));
  svg.append(shape('text', { class: 'label', x: 80, y: -8 }, 'x, feed'));
  svg.append(shape('text', { class: 'label', x: -126, y: 86 }, caption(tool, cut)));
  return svg;
}

function caption(tool, cut) {
  const parts = [`⌀ ${tool.diameter_mm} mm`];
  if (cut.axial_depth_mm !== undefined) parts.push(`a_p ${cut.axial_depth_mm} mm`);
  if (cut.feed_per_tooth_mm !== undefined) parts.push(`f_z ${cut.feed_per_tooth_mm} mm`);
  if (cut.spindle_rpm !== undefined) parts.push(`${cut.spindle_rpm} rpm`);
  return parts.join(', ');
}

if (typeof module !== 'undefined') module.exports = { stockOf, shape, isLength, isDrawable, drawCut };
