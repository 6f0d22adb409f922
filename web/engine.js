// In a worker: one command of the program, from its files to those it writes.
// Before this file stand the glue of Emscripten, which makes createTrochoid, and nothing else.
'use strict';

const place = '/work';

/** What is printed, byte by byte, as whole lines to `tell`. */
function lines(tell) {
  let bytes = [];
  const decoder = new TextDecoder();
  const line = () => {
    tell(decoder.decode(new Uint8Array(bytes)));
    bytes = [];
  };
  const end = () => { if (bytes.length > 0) line(); };
  const put = (code) => {
    if (code === 10) line();
    else if (code === null || code === 13) end();
    else bytes.push(code < 0 ? code + 256 : code);
  };
  return { put, end };
}

function makeFolders(fs, path) {
  const parts = path.split('/').slice(0, -1);
  parts.forEach((_, i) => {
    const folder = parts.slice(0, i + 1).join('/');
    if (folder !== '' && !fs.analyzePath(folder).exists) fs.mkdir(folder);
  });
}

/** All files below a folder, name -> bytes. */
function filesOf(fs, folder, prefix = '') {
  const found = {};
  if (!fs.analyzePath(folder).exists) return found;
  for (const name of fs.readdir(folder)) {
    if (name === '.' || name === '..') continue;
    const path = `${folder}/${name}`;
    if (fs.isDir(fs.stat(path).mode)) Object.assign(found, filesOf(fs, path, `${prefix}${name}/`));
    else found[prefix + name] = fs.readFile(path);
  }
  return found;
}

/** @param wasm the compiled program */
async function runCommand({ wasm, args, files, folder }, progress) {
  const said = { out: [], err: [] };
  const out = lines((line) => said.out.push(line));
  const err = lines((line) => { said.err.push(line); progress(line); });
  const program = await createTrochoid({
    noInitialRun: true,
    thisProgram: 'trochoid',
    instantiateWasm(imports, done) {
      WebAssembly.instantiate(wasm, imports).then((instance) => done(instance, wasm));
      return {};
    },
    preRun: [(m) => m.FS.init(() => null, out.put, err.put)],
  });
  const fs = program.FS;
  fs.mkdir(place);
  for (const [name, bytes] of Object.entries(files)) {
    makeFolders(fs, `${place}/${name}`);
    fs.writeFile(`${place}/${name}`, bytes);
  }
  fs.chdir(place);
  let code = 3;
  try {
    code = program.callMain(args) ?? 0;
  } catch (error) {
    if (error?.name === 'ExitStatus') code = error.status;
    else said.err.push(`trochoid: ${error?.message ?? error}`);
  }
  out.end();
  err.end();
  return { code, out: said.out.join('\n'), err: said.err.join('\n'),
           files: filesOf(fs, `${place}/${folder}`) };
}

if (typeof self !== 'undefined' && typeof WorkerGlobalScope !== 'undefined') {
  self.onmessage = async ({ data }) => {
    const progress = (line) => self.postMessage({ id: data.id, progress: line });
    try {
      self.postMessage({ id: data.id, answer: await runCommand(data, progress) });
    } catch (error) {
      self.postMessage({ id: data.id, failure: String(error?.message ?? error) });
    }
  };
}
