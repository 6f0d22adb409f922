// One formula a line in, as JSON; its HTML, or what is wrong with it, a line out.
const katex = require(process.argv[2]);
const lines = require('readline').createInterface({ input: process.stdin });
lines.on('line', (line) => {
  const { tex, display } = JSON.parse(line);
  let answer;
  try {
    const html = katex.renderToString(tex, { displayMode: display, strict: 'error' });
    answer = { html };
  } catch (error) {
    answer = { error: error.message };
  }
  process.stdout.write(JSON.stringify(answer) + '\n');
});
