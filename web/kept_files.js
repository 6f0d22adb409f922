// Files that were dropped, for the next time the page is opened: in the browser's own
// database, and nowhere where there is none (a private window).
'use strict';

const keptFiles = {
  /** @returns what `ask` asks of the store, answered; undefined where nothing can be kept */
  async with(mode, ask) {
    try {
      const base = await new Promise((resolve, reject) => {
        const opening = indexedDB.open('trochoid', 1);
        opening.onupgradeneeded = () => opening.result.createObjectStore('files');
        opening.onsuccess = () => resolve(opening.result);
        opening.onerror = () => reject(opening.error);
      });
      try {
        return await new Promise((resolve, reject) => {
          const work = base.transaction('files', mode);
          const answer = ask(work.objectStore('files'));
          work.oncomplete = () => resolve(answer);
          work.onerror = () => reject(work.error);
          work.onabort = () => reject(work.error);  // no room
        });
      } finally {
        base.close();
      }
    } catch {
      return undefined;
    }
  },
  put(name, bytes) { return this.with('readwrite', (files) => files.put(bytes, name)); },
  forget(name) { return this.with('readwrite', (files) => files.delete(name)); },
  forgetAll() { return this.with('readwrite', (files) => files.clear()); },

  /** @returns name -> bytes */
  async read() {
    const asked = await this.with('readonly', (files) => [files.getAllKeys(), files.getAll()]);
    if (asked === undefined) return new Map();
    const [names, contents] = asked.map((one) => one.result);
    return new Map(names.map((name, i) => [name, contents[i]]));
  },
};
