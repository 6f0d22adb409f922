// Builds the page from the data that are embedded in it; `pages` is made by report.cpp
// from the list of commands.

function build() {
  const data = JSON.parse(document.getElementById('data').textContent);
  const { summary, words: said, tables } = data;
  const report = { ...summary, result: summary.result || {}, said, tables };
  const page = pages[report.command] || anyPage;
  const parts = page(report).filter(Boolean);
  const figures = document.getElementById('figures');
  for (const { lead, part } of parts) {
    if (lead) document.getElementById('answer').append(...[lead].flat(9).filter(Boolean));
    if (part) figures.append(part);
  }
  // Plots need the width of their place, so they are drawn when all stands on the page.
  for (const { draw } of parts) draw?.();
  for (const sentence_ of document.querySelectorAll('.lead p, .warnings li')) typeset(sentence_);
  const title = document.querySelector('h1');
  title.textContent = inPrint(title.textContent);
  contents();
  watchPage();
}

/** Numbers as they are printed: a true minus and ±, units that stay beside them. */
const inPrint = (text) => text.replace(/\b(K_[a-z][a-z0-9])_MPa = (\d+(?:\.\d+)?)(?! MPa|\.?\d)/g, '$1 = $2 MPa')
  .replace(/\b(K_[a-z][a-z0-9])_(?:MPa|N_per_mm)\b/g, '$1').replaceAll(' +- ', '\u00a0±\u00a0').replace(/(\d) um\b/g, '$1 µm').replace(/(\d) um\//g, '$1 µm/')
  .replace(/mm3\/min\b/g, 'mm³/min').replace(/(^|[\s(])-(?=\d)/g, '$1−')
  .replace(/(\d) (?=(?:MPa|µm|N|mm|rpm|Hz|%|s|ms)(?![\w]))/g, '$1\u00a0');

/** What the program writes in plain letters: `K_tc`, `+-`, `um`. */
function typeset(element) {
  const text = inPrint(element.textContent);
  element.replaceChildren(...text.split(/\b(K_[a-z0-9]+)(?![\w.])/).map((part, i) => (i % 2 ? symbol(part) : part)));
}

function contents() {
  const links = [...document.querySelectorAll('main section[id] > h2')].map((heading) =>
    el('a', { href: `#${heading.parentElement.id}` },
      heading.parentElement.dataset.short || heading.textContent));
  document.getElementById('contents').append(...links);
}

build();
