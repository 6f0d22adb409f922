// Puts the page, the program and the examples into one file:
//   node bundle.mjs ENGINE_FOLDER OUTPUT.html
import fs from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';
import { gzipSync } from 'node:zlib';
import { colorsOfReports, scriptOfReports } from './report_parts.mjs';

const here = path.dirname(fileURLToPath(import.meta.url));
const root = path.dirname(here);
const [engine, output] = process.argv.slice(2);
const text = (...parts) => fs.readFileSync(path.join(...parts), 'utf8');
const packed = (bytes) => gzipSync(bytes, { level: 9 }).toString('base64');

/** Files of an example, those below its folder. */
function filesOf(folder, prefix = '') {
  return Object.fromEntries(fs.readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const file = path.join(folder, entry.name);
    if (entry.isDirectory()) return /\.\w+$/.test(entry.name) ? [] : Object.entries(filesOf(file, `${prefix}${entry.name}/`));
    return /(^README\.md|\.py)$/.test(entry.name) ? [] : [[prefix + entry.name, fs.readFileSync(file).toString('base64')]];
  }));
}

/** Files of an example, those of others that its cases include, and the materials among them. */
function filesOfExample(folder) {
  const files = filesOf(folder);
  for (const name of Object.keys(files).filter((one) => one.endsWith('.toml'))) {
    for (const [, other, included] of text(folder, name).matchAll(/^include = "\.\.\/(\w+)\/(.*\.toml)"/gm)) {
      const all = filesOf(path.join(root, 'examples', other), `../${other}/`);
      const wanted = `../${other}/${included}`;
      Object.assign(files, other === 'materials' ? { [wanted]: all[wanted] } : all);
    }
  }
  return files;
}

/** The commands whose answers a case includes: `include = "tip.modes/modes.toml"  # written by: trochoid modes tip.toml`. */
function needed(text) {
  return [...text.matchAll(/^include = "(.*)\/\w+\.toml" +# written by: trochoid (\w+) (\S+)$/gm)]
    .map(([, folder, command, file]) => ({ command, file, folder }));
}

/** What the pages of the examples run, `command folder/file` -> its files. */
function examples() {
  const all = {};
  const commands = 'simulate|identify|surface|calibrate|stability|modes|actuator|dynamics|correct|plan|program|sweep';
  for (const name of fs.readdirSync(path.join(root, 'examples'))) {
    const folder = path.join(root, 'examples', name);
    if (!fs.existsSync(path.join(folder, 'README.md'))) continue;
    const runs = text(folder, 'README.md').matchAll(new RegExp(`(?:trochoid|run) (${commands}) (?:examples/${name}/)?(\\S+\\.toml)`, 'g'));
    for (const [, command, file] of runs) {
      if (!fs.existsSync(path.join(folder, file))) continue;
      all[`${command} ${name}/${file}`] = { file, files: filesOfExample(folder), first: needed(text(folder, file)) };
    }
  }
  return all;
}

const scripts = ['files.js', 'kept_files.js', 'case_text.js', 'lengths.js', 'drawing.js', 'typed.js', 'swept.js', 'form.js', 'renewed.js', 'dropped.js', 'program.js', 'cases.js', 'written.js', 'app.js'].map((file) => text(here, file));
const smol = `/*!\n${text(root, 'node_modules/smol-toml/LICENSE')}*/\nconst smolToml = (() => { const module = { exports: {} };\n${text(root, 'node_modules/smol-toml/dist/index.cjs')}\nreturn module.exports; })();`;
const inScript = (script) => script.replaceAll('</script', '<\\/script');
/** Licences of all that is in the page: of the scripts, and of what was compiled into the program. */
function licences() {
  const scripts = ['smol-toml', 'uplot', 'write-excel-file', 'fflate'].map((name) => [name, path.join(root, 'node_modules', name, 'LICENSE')]);
  const compiled = ['libeigen3-dev', 'libfmt-dev', 'nlohmann-json3-dev', 'libtomlplusplus-dev', 'libcli11-dev', 'libboost-dev', 'libhwy-dev', 'emscripten']
    .map((name) => [name, `/usr/share/doc/${name}/copyright`]);
  const all = [['Trochoid', path.join(root, 'LICENSE')], ...scripts, ...compiled].filter(([, file]) => fs.existsSync(file));
  const escaped = (words) => words.replaceAll('&', '&amp;').replaceAll('<', '&lt;');
  return all.map(([name, file]) => `== ${name} ==\n\n${escaped(text(file))}`).join('\n\n');
}

const parts = {
  licences: licences(),
  style: colorsOfReports(root) + text(here, 'style.css'),
  schema: inScript(JSON.stringify(JSON.parse(text(root, 'docs/formats/case.schema.json')))),
  wasm: packed(fs.readFileSync(path.join(engine, 'trochoid.wasm'))),
  examples: packed(JSON.stringify(examples())),
  glue: inScript(text(engine, 'trochoid.js')),
  engine: inScript(text(here, 'engine.js')),
  scripts: inScript([smol, scriptOfReports(root), ...scripts.map((s) => s.replace("'use strict';", ''))].join('\n')),
};
const html = text(here, 'page.html').replace(/@(\w+)@/g, (_, name) => parts[name]);
fs.mkdirSync(path.dirname(output), { recursive: true });
fs.writeFileSync(output, html);
console.log(`${output}: ${(html.length / 1e6).toFixed(2)} MB, ${(gzipSync(html).length / 1e6).toFixed(2)} MB compressed`);
