// What `calibrate` says below its pictures: explanations, runout, further readings, datum.

const formWords = { none: 'no error of form', offset: 'offset', tilt: 'tilt', curvature: 'curvature' };

/** Where the readings decide: how they may have come about, and readings that were left out. */
function explanationsPart(result, keys) {
  const list = result.explanations || [];
  const out = result.outliers || [];
  if (list.length < 2 && !out.length) return null;
  const rows = list.map((one) => [`${formWords[one.form] || one.form}${
    one.feedback && one.feedback !== 'none' ? `, feedback ${one.feedback}` : ''}`, `${number(100 * one.weight, 2)} %`,
  ...keys.map((key) => {
    const entry = one.coefficients?.[key];
    return isNumber(entry?.value) ? [measured(entry.value, half(entry)), el('small', {}, `± ${measured(half(entry), half(entry))}`)]
      : missing;
  }), isNumber(one.eccentricity_mm) ? fixed(micro(one.eccentricity_mm), 3) : missing, fixed(micro(one.rms_mm), 3)]);
  const { own_mm: own, shared_mm: shared } = result.scatter || {};
  return section('explanations', 'How the readings may have come about', 'Explanations',
    list.length > 1 ? prose('The readings may contain more than the cutting: a constant offset, a tilt or a curvature over the height, ' +
      'or a deflection that changes the chip (feedback). Each row is one explanation, the most probable first. The answer is the mean over all ' +
      'explanations. Datum and residuals on this page come from the most probable one.') : null,
    list.length > 1 ? table(['form', 'probability', ...keys.map((key) => [symbol(nameAndUnit(key).name),
      el('small', {}, nameAndUnit(key).unit)]), 'runout, µm', 'left, µm rms'], rows, { class: 'fits' }) : null,
    isNumber(own) ? prose(`Each reading scatters by ${fixed(micro(own), 2)} µm`, isNumber(shared) && shared > 0 ?
      `. All readings of one height or place also scatter together by ${fixed(micro(shared), 2)} µm.` : '.') : null,
    out.length ? prose(`${out.length} reading${out.length > 1 ? 's were' : ' was'} left out because of a large error: `,
      out.slice(0, 6).map((one) => `no. ${one.reading} (${number(micro(one.off_mm), 3)} µm)`).join(', '),
      out.length > 6 ? ', ...' : '', '.') : null);
}

function runoutPart({ result, said }) {
  const { runout } = result;
  if (isEmpty(runout)) return null;
  if (!isNumber(runout.eccentricity_mm)) {
    return section('runout', 'Runout', 'Runout', prose('Not known: ', runout.identifiable || 'not fitted', '.'));
  }
  const width = micro(normalInterval * runout.eccentricity_se_mm);
  const turn = normalInterval * runout.angle_se_deg;
  const less = 100 * (1 - runout.rms_mm / runout.rms_without_mm);
  const pitch = runout.angle_known_up_to_deg;
  return section('runout', 'Runout', 'Runout',
    prose(said.runout_seen ? 'The tool turns ' : 'No runout stands out. The best fit has the tool turn ',
      el('b', {}, `${measured(micro(runout.eccentricity_mm), width)} ± ${measured(width, width)} µm`),
      ' off its centre', turn < 180 ? [', at ', el('b', {}, `${measured(runout.angle_deg, turn)} ± ${measured(turn, turn)}°`),
        ' from the tip of tooth 1 towards tooth 2'] : ', at an angle that is not known', ' (eccentricity, 95 %).', isNumber(pitch) && turn < 180 ?
        ` The readings have no tooth numbers. So the angle may also be larger by any multiple of ${
          number(pitch)}°.` : ''),
    prose(`The residual of all readings is ${fixed(micro(runout.rms_mm), 3)} µm rms with runout and ${
      fixed(micro(runout.rms_without_mm), 3)} µm rms without`, less >= 1 ? `: ${number(less, 2)} % less.` : '.'));
}

/** What ten more readings at each height would give. */
function adviceSection(result, keys, fitted) {
  const advice = (result.ten_more_readings || []).filter((entry) => isNumber(entry.height_mm));
  if (!fitted || !advice.length) return null;
  const chosen = result.answers.find((answer) =>
    answer.model === result.model && answer.feedback === result.feedback);
  const now = keys.map((key) => chosen?.coefficients?.[key]?.se);
  const best = advice[0];
  const sorted = [...advice].sort((a, b) => a.height_mm - b.height_mm);
  const gains = keys.map((key, k) => sorted.map((entry) => 100 * (1 - entry[`se_${key}`] / now[k])));
  const gain = keys.map((key, k) => 100 * (1 - best[`se_${key}`] / now[k]));
  const chart = figure({ key: 'advice', points: true, x: sorted.map((entry) => entry.height_mm), unit: 'mm',
    label: 'height above the tip', caption: zoomHint });
  const series = keys.map((key, k) => ({ name: symbol(nameAndUnit(key).name), values: gains[k],
    color: seriesColor(k), width: 1.8, points: 5, dash: k ? [6, 3] : undefined }));
  const part = section('advice', 'Where further readings would help', 'Advice',
    prose('Ten more readings at ', el('b', {}, `${number(best.height_mm, 3)} mm`), ' above the tip would help most. ' +
      `In the fit to the means (${readingName(result.model, result.feedback)}) the standard error of `, symbol(nameAndUnit(keys[0]).name), ` would fall from ${number(now[0], 3)} to ${
        number(best[`se_${keys[0]}`], 3)} MPa (${number(gain[0], 2)} % less). `, gain[0] < 10 ?
        'That is little, because the readings cover the heights well. Only many more readings or a more compliant wall ' +
        'would tell more.' : ''), sorted.length > 2 ? chart.element : null);
  const panel = { label: 'standard error less by', unit: '%', height: 170, series };
  return { part, draw: sorted.length > 2 ? () => chart.draw([panel]) : undefined };
}

function datumPart(result) {
  if (isEmpty(result.datum)) return null;
  const files = result.datum.map((one, i) => {
    const parts = [];
    if (one.offset_mm) {
      const width = micro(half(one.offset_mm));
      parts.push(`all readings lie ${measured(micro(one.offset_mm.value), width)} ± ${
        measured(width, width)} µm high`);
    }
    (one.slopes_mm_per_mm || []).forEach((slope, k) => {
      const width = micro(half(slope));
      parts.push(`they lean ${measured(micro(slope.value), width)} ± ${measured(width, width)} µm per mm ${
        k ? 'over the height' : 'along the feed'}`);
    });
    return parts.length ? el('li', {}, result.datum.length > 1 ? `Measurement ${i + 1}: ` : '',
      sentence(parts.join(', '))) : null;
  });
  return section('datum', 'Datum of the readings', 'Datum',
    prose('Estimated together with the coefficients (95 %) and subtracted from the readings:'), el('ul', { class: 'reasons' }, files));
}
