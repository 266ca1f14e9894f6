// Turns what is shown into what a newly made element looks like, keeping the elements that stay: focus, typing and what was unfolded survive.

const KEPT = new Set(["open"]);
const key = (node) => node.dataset?.key;
const alike = (a, b) => a.nodeName === b.nodeName && key(a) === key(b);

export function morph(shown, made) {
  if (shown.nodeType === Node.TEXT_NODE) {
    if (shown.data !== made.data) shown.data = made.data;
    return;
  }
  for (const { name } of [...shown.attributes]) if (!made.hasAttribute(name) && !KEPT.has(name)) shown.removeAttribute(name);
  for (const { name, value } of made.attributes) if (shown.getAttribute(name) !== value && !KEPT.has(name)) shown.setAttribute(name, value);
  morphChildren(shown, [...made.childNodes]);
}

// Makes the children of `parent` look like `made`; what has a `data-key` is found again by it.
export function morphChildren(parent, made) {
  let at = parent.firstChild;
  for (const child of made) {
    const found = following(at, child);
    if (!found) {
      parent.insertBefore(child, at);
      continue;
    }
    while (at !== found) at = dropped(at);
    morph(found, child);
    at = found.nextSibling;
  }
  while (at) at = dropped(at);
}

// The first of `node` and those after it that can become `child`: without a key only `node` itself, so that little is thrown away.
function following(node, child) {
  if (key(child) === undefined) return node && alike(node, child) ? node : null;
  for (let at = node; at; at = at.nextSibling) if (alike(at, child)) return at;
  return null;
}

function dropped(node) {
  const next = node.nextSibling;
  node.remove();
  return next;
}
