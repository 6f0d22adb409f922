// A drawing surface like that of a canvas whose strokes become an SVG: what is painted on the page is
// saved by the same functions.

const escapedXml = (text) => String(text).replaceAll('&', '&amp;').replaceAll('<', '&lt;').replaceAll('"', '&quot;');
const rounded = (v) => String(Math.round(100 * v) / 100);

/** An image of the map as PNG inside the SVG. */
function imageUrl(image) {
  const canvas = el('canvas', { width: image.width, height: image.height });
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas.toDataURL('image/png');
}

const startState = () => ({ strokeStyle: '#000', fillStyle: '#000', lineWidth: 1, lineJoin: 'miter', globalAlpha: 1,
  font, textAlign: 'left', textBaseline: 'alphabetic', dash: [], clipped: '' });

/** A stroke as points: what lines, arcs and rectangles add to it. */
function pathMethods(path) {
  const add = (letter, x, y) => path.parts.push(`${letter}${rounded(x)} ${rounded(y)}`);
  return {
    beginPath: () => { path.parts = []; },
    moveTo: (x, y) => add('M', x, y),
    lineTo: (x, y) => add(path.parts.length ? 'L' : 'M', x, y),
    closePath: () => path.parts.push('Z'),
    rect: (x, y, w, h) => path.parts.push(`M${rounded(x)} ${rounded(y)}h${rounded(w)}v${rounded(h)}h${rounded(-w)}Z`),
    arc: (x, y, r, from, to) => {
      const n = Math.max(2, Math.ceil(Math.abs(to - from) / 0.2));
      for (let i = 0; i <= n; ++i) {
        const t = from + (to - from) * i / n;
        add(path.parts.length ? 'L' : 'M', x + r * Math.cos(t), y + r * Math.sin(t));
      }
    },
  };
}

const baselines = { top: '0.8em', middle: '0.35em', alphabetic: '0', bottom: '-0.2em' };
const anchors = { left: 'start', center: 'middle', right: 'end' };

/** Everything of a canvas that the pages use. `svg()` gives the file. */
function svgSurface(width, height) {
  const out = [];
  const saved = [];
  const path = { parts: [] };
  const ruler = el('canvas', {}).getContext('2d');
  let clips = 0;
  const c = startState();
  const put = (shape) => out.push(`<${shape}${c.clipped}${c.globalAlpha < 1 ? ` opacity="${c.globalAlpha}"` : ''}/>`);
  const stateOf = () => Object.fromEntries(Object.keys(startState()).map((key) => [key, c[key]]));
  return Object.assign(c, pathMethods(path), {
    save: () => saved.push(stateOf()),
    restore: () => Object.assign(c, saved.pop()),
    setLineDash: (dash) => { c.dash = dash; },
    measureText: (text) => { ruler.font = c.font; return ruler.measureText(text); },
    stroke: () => put(`path d="${path.parts.join('')}" fill="none" stroke="${c.strokeStyle}" stroke-width="${c.lineWidth}"${
      c.dash.length ? ` stroke-dasharray="${c.dash.join(' ')}"` : ''} stroke-linejoin="${c.lineJoin}"`),
    fill: () => put(`path d="${path.parts.join('')}" fill="${c.fillStyle}"`),
    fillRect: (x, y, w, h) => put(`rect x="${rounded(x)}" y="${rounded(y)}" width="${rounded(w)}" height="${
      rounded(h)}" fill="${c.fillStyle}"`),
    clip: () => {
      out.push(`<clipPath id="clip${++clips}"><path d="${path.parts.join('')}"/></clipPath>`);
      c.clipped = ` clip-path="url(#clip${clips})"`;
    },
    fillText: (text, x, y) => out.push(`<text x="${rounded(x)}" y="${rounded(y)}" dy="${baselines[c.textBaseline]}" style="font: ${
      escapedXml(c.font)}" text-anchor="${anchors[c.textAlign]}" fill="${c.fillStyle}"${c.clipped}>${
      escapedXml(text)}</text>`),
    // Maps come in the points of the screen.
    putImageData: (image, x, y) => put(`image x="${rounded(x / devicePixelRatio)}" y="${rounded(y / devicePixelRatio)
    }" width="${rounded(image.width / devicePixelRatio)}" height="${rounded(image.height / devicePixelRatio)
    }" preserveAspectRatio="none" href="${imageUrl(image)}"`),
    svg: () => `<svg xmlns="http://www.w3.org/2000/svg" width="${width}" height="${height}" viewBox="0 0 ${width} ${height
    }">\n<rect width="${width}" height="${height}" fill="${css('--paper')}"/>\n${out.join('\n')}\n</svg>\n`,
  });
}
