// Files that were dropped on the page, and those that leave it.
'use strict';

const crcTable = Uint32Array.from({ length: 256 }, (_, n) => {
  let c = n;
  for (let k = 0; k < 8; ++k) c = c & 1 ? 0xedb88320 ^ (c >>> 1) : c >>> 1;
  return c >>> 0;
});

function crcOf(bytes) {
  let c = 0xffffffff;
  for (const byte of bytes) c = crcTable[(c ^ byte) & 255] ^ (c >>> 8);
  return (c ^ 0xffffffff) >>> 0;
}

/** A zip file of files as they are, name -> bytes. */
function zipOf(files) {
  const utf8 = new TextEncoder();
  const parts = [];
  const entries = [];
  let offset = 0;
  for (const [name, bytes] of Object.entries(files)) {
    const title = utf8.encode(name);
    const head = new DataView(new ArrayBuffer(26));  // all but the signature
    head.setUint16(0, 20, true);
    head.setUint16(2, 0x0800, true);  // names in UTF-8
    head.setUint16(8, 0x21, true);    // 1980-01-01: no clock in a result
    head.setUint32(10, crcOf(bytes), true);
    head.setUint32(14, bytes.length, true);
    head.setUint32(18, bytes.length, true);
    head.setUint16(22, title.length, true);
    const common = new Uint8Array(head.buffer);
    parts.push(Uint8Array.of(0x50, 0x4b, 3, 4), common, title, bytes);
    const tail = new DataView(new ArrayBuffer(14));
    tail.setUint32(10, offset, true);
    entries.push(Uint8Array.of(0x50, 0x4b, 1, 2, 20, 0), common, new Uint8Array(tail.buffer), title);
    offset += 4 + common.length + title.length + bytes.length;
  }
  const size = entries.reduce((sum, part) => sum + part.length, 0);
  const end = new DataView(new ArrayBuffer(22));
  end.setUint32(0, 0x06054b50, true);
  const count = Object.keys(files).length;
  end.setUint16(8, count, true);
  end.setUint16(10, count, true);
  end.setUint32(12, size, true);
  end.setUint32(16, offset, true);
  return new Blob([...parts, ...entries, new Uint8Array(end.buffer)], { type: 'application/zip' });
}

function saveAs(blob, name) {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000);
}

async function inflated(base64) {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** What was typed, for the next time the page is opened; silent where nothing can be kept. */
const kept = {
  read() {
    try {
      return JSON.parse(localStorage.getItem('trochoid') ?? 'null');
    } catch {
      return null;
    }
  },
  write(state) {
    try {
      localStorage.setItem('trochoid', JSON.stringify(state));
    } catch { /* a private window, or a full store */ }
  },
};

if (typeof module !== 'undefined') module.exports = { zipOf, crcOf };
