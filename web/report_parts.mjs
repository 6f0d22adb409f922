// What the page takes from the reports: their colours, and the drawing of a tool.
import fs from 'node:fs';
import path from 'node:path';

const text = (root, file) => fs.readFileSync(path.join(root, 'src/trochoid/report/page', file), 'utf8');
export const namesOfReports = '{ seriesColor, drawing, isDrawable, stockOf, profileOf, radiusAt, teethOf, edgeSeen, toolPicture }';

/** A script that makes these names, all others of its files stay within. */
export const scriptOfReports = (root) => `const ${namesOfReports} = (() => {\n${
  ['text.js', 'drawing.js', 'cutter.js', 'tool.js'].map((file) => text(root, file)).join('\n')}\nreturn ${namesOfReports};\n})();`;

/** The colours of the reports: their style sheet up to the first rule for elements. */
export const colorsOfReports = (root) => /^[^]*?(?=^\* \{)/m.exec(text(root, 'page.css'))[0];
