// What of a curve lies in the band that a fit counts: its mean and first harmonics of a turn.

/** Rows from the first on that lie evenly: a thinned table keeps all rows at its beginning only. */
function evenRows(angle) {
  const step = angle[1] - angle[0];
  let n = 1;
  while (n < angle.length && angle[n] - angle[n - 1] < 1.5 * step) ++n;
  return n;
}

/** Solve a x = b, a symmetric and above zero; null where it is not. */
function solved(a, b) {
  const n = b.length;
  const m = a.map((row, i) => [...row, b[i]]);
  for (let k = 0; k < n; ++k) {
    if (!(m[k][k] > 1e-9)) return null;
    for (let i = k + 1; i < n; ++i) {
      const f = m[i][k] / m[k][k];
      for (let j = k; j <= n; ++j) m[i][j] -= f * m[k][j];
    }
  }
  const x = new Array(n).fill(0);
  for (let i = n - 1; i >= 0; --i) {
    let sum = m[i][n];
    for (let j = i + 1; j < n; ++j) sum -= m[i][j] * x[j];
    x[i] = sum / m[i][i];
  }
  return x;
}

/** 1, cos, sin, cos 2, ... of a spindle angle in degrees. */
function harmonicsAt(degrees, count) {
  const terms = [1];
  for (let n = 1; n <= count; ++n) {
    const phi = n * degrees * Math.PI / 180;
    terms.push(Math.cos(phi), Math.sin(phi));
  }
  return terms;
}

/** The mean and the first `count` harmonics of values over the angle, by least squares; null: too few. */
function inBand(angle, values, count) {
  const rows = evenRows(angle);
  const unknowns = 2 * count + 1;
  const a = Array.from({ length: unknowns }, () => new Array(unknowns).fill(0));
  const b = new Array(unknowns).fill(0);
  let used = 0;
  for (let r = 0; r < rows; ++r) {
    if (!isNumber(values[r])) continue;
    ++used;
    const terms = harmonicsAt(angle[r], count);
    for (let i = 0; i < unknowns; ++i) {
      b[i] += terms[i] * values[r];
      for (let j = 0; j < unknowns; ++j) a[i][j] += terms[i] * terms[j];
    }
  }
  if (used < 2 * unknowns || angle[rows - 1] - angle[0] < 300) return null;
  const x = solved(a.map((row) => row.map((v) => v / used)), b.map((v) => v / used));
  return x && angle.map((phi) => harmonicsAt(phi, count).reduce((sum, term, i) => sum + term * x[i], 0));
}
