// The program, in workers: one that checks while a person types, one that does the work.
'use strict';

class Program {
  /** @param source text of the worker @param wasm the compiled program */
  constructor(source, wasm) {
    this.url = URL.createObjectURL(new Blob([source], { type: 'text/javascript' }));
    this.wasm = wasm;
    this.workers = {};
    this.next = 1;
  }

  /**
   * @param role    of the worker: those of one role wait for one another
   * @param command args, files (name -> bytes), folder of the results
   * @returns code, out, err, files; rejected when it is stopped
   */
  run(role, command, progress = () => {}) {
    this.workers[role] ??= new Worker(this.url);
    const worker = this.workers[role];
    const id = this.next++;
    return new Promise((resolve, reject) => {
      const answered = ({ data }) => {
        if (data.id !== id) return;
        if (data.progress !== undefined) {
          progress(data.progress);
          return;
        }
        worker.removeEventListener('message', answered);
        if (data.answer) resolve(data.answer);
        else reject(new Error(data.failure));
      };
      worker.addEventListener('message', answered);
      worker.addEventListener('error', (e) => reject(new Error(e.message)), { once: true });
      worker.addEventListener('stopped', () => reject(new Error('stopped')), { once: true });
      worker.postMessage({ id, wasm: this.wasm, ...command });
    });
  }

  stop(role) {
    this.workers[role]?.terminate();
    this.workers[role]?.dispatchEvent(new Event('stopped'));
    delete this.workers[role];
  }
}

/** What the page cannot do without, in words; empty: all is there. */
function whatIsMissing() {
  const missing = [];
  if (typeof WebAssembly === 'undefined') missing.push('WebAssembly');
  else if (typeof WebAssembly.Tag === 'undefined') missing.push('exceptions in WebAssembly');
  if (typeof Worker === 'undefined') missing.push('workers');
  if (typeof DecompressionStream === 'undefined') missing.push('DecompressionStream');
  return missing.length === 0 ? ''
    : `This browser lacks ${missing.join(', ')}. According to their makers, Chrome or Edge 95, Firefox 113, Safari 16.4 and later ones have it.`;
}
