// A form that is made anew takes the place of the old one part by part: what was made alike stays
// as it is, with its focus, with what is typed in it, and open or closed as it was.
'use strict';

const fieldKey = (node) => node.dataset.key;
const isFrame = (node) => node.dataset.table !== undefined || node.classList.contains('more') || node.classList.contains('over');

/** Which part of its form a node is. */
function partOf(node) {
  if (fieldKey(node) !== undefined) return `field ${fieldKey(node)}`;
  return isFrame(node) ? `frame ${node.dataset.table ?? node.className}` : node.outerHTML;
}

/** Fields remember how they were made: mistakes are written into them later. */
function rememberFields(form) {
  for (const field of form.querySelectorAll('[data-key]')) field.made = field.outerHTML;
}

const isAlike = (old, fresh) => old !== undefined && (fieldKey(old) === undefined || old.made === fresh.made);

/** What was typed in it and is not the case's way to write it: `0,04` for 0.04. */
function settle(field) {
  for (const input of field.querySelectorAll('input[type=text]')) {
    if (input !== document.activeElement) input.value = input.defaultValue;
  }
}

/** @param fresh its fields have been remembered; it is used up */
function renew(old, fresh) {
  const parts = new Map([...old.children].map((node) => [partOf(node), node]));
  const wanted = [...fresh.children].map((node) => {
    const known = parts.get(partOf(node));
    if (!isAlike(known, node)) return node;
    parts.delete(partOf(node));
    if (isFrame(known)) renew(known, node);
    else settle(known);
    return known;
  });
  for (const node of parts.values()) node.remove();
  let at = old.firstChild;
  for (const node of wanted) {
    if (node === at) at = at.nextSibling;
    else old.insertBefore(node, at);
  }
}

if (typeof module !== 'undefined') module.exports = { renew, rememberFields };
