// What the case looks like: the cutter in its cut, seen from above, and the tool as the reports draw it. Turns with the numbers.
'use strict';

const svgSpace = 'http://www.w3.org/2000/svg';

function shape(name, attributes, text) {
  const node = document.createElementNS(svgSpace, name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (text !== undefined) node.textContent = text;
  return node;
}

/** @param given a case, as read @returns a picture, or null without a tool and a cut or of those that cannot be */
function drawCut(given) {
  if (given.cut === undefined) return null;
  const tool = inMm(given.tool ?? {});
  const cut = inMm(given.cut);
  const stock = isDrawable(tool) ? stockOf(cut, tool.diameter_mm / 2) : null;
  if (stock === null) return null;
  const [low, high] = stock;
  const R = 62;
  const svg = shape('svg', { viewBox: '-130 -92 260 184', role: 'img', class: 'cut-drawing' });
  svg.append(shape('title', {}, `${tool.teeth} teeth, ${tool.diameter_mm} mm, ${cut.engagement ?? 'slot'}`));
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
    svg.append(shape('line', { class: 'tooth', style: `stroke: var(${seriesColor(j)})`, x1: 0.35 * R * Math.sin(a), y1: -0.35 * R * Math.cos(a),
                               x2: R * Math.sin(a), y2: -R * Math.cos(a) }));
    if (tool.teeth <= 8) {  // beside its tooth
      svg.append(shape('text', { class: 'label', x: 0.8 * R * Math.sin(a + 0.18), y: 3.5 - 0.8 * R * Math.cos(a + 0.18),
                                 'text-anchor': 'middle' }, String(j + 1)));
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

/** The tables of a case that the drawing of a tool takes, in mm. */
function tablesDrawn(given) {
  const [tool, runout, cut] = ['tool', 'runout', 'cut'].map((name) => given[name] && inMm(given[name]));
  if (tool?.serration !== undefined) tool.serration = inMm(tool.serration);
  return { tool, runout, cut };
}

/** The tool by itself, as the reports draw it. @returns its element, and show(given): whether it can be drawn */
function toolView() {
  let picture = null;
  const told = element('figcaption', {});
  const chart = drawing({ label: 'The tool', bare: true, height: (width) => picture.height(width),
                          paint: (...all) => picture.paint(...all) });
  chart.element.append(told);
  const draw = () => { if (picture !== null) chart.resize(); };
  new ResizeObserver(draw).observe(chart.canvas.parentElement);
  matchMedia('(prefers-color-scheme: dark)').addEventListener('change', draw);
  return { element: chart.element, show: (given) => {
    picture = toolPicture(tablesDrawn(given));
    told.textContent = picture?.told ?? '';
    chart.canvas.setAttribute('aria-label', picture?.label ?? '');
    draw();
    return picture !== null;
  } };
}

if (typeof module !== 'undefined') module.exports = { shape, drawCut, tablesDrawn, toolView };
