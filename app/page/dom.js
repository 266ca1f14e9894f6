// Elements, made in one line; texts are texts, never markup.

// `attributes`: a class name, or attributes and properties; `on…` are listeners.
export function el(name, attributes = {}, ...content) {
  const node = document.createElement(name);
  const given = typeof attributes === "string" ? { class: attributes } : attributes;
  for (const [key, value] of Object.entries(given)) {
    if (value === undefined || value === null || value === false) continue;
    if (key.startsWith("on")) node.addEventListener(key.slice(2), value);
    else node.setAttribute(key, value === true ? "" : value);
  }
  node.append(...content.flat().filter((part) => part !== null && part !== undefined && part !== ""));
  return node;
}

export const button = (text, onclick, attributes = {}) => el("button", { type: "button", onclick, ...attributes }, text);

// Replaces the content only when it has changed, so that focus, selection and scrolling stay; gives whether it did.
export function replaceIfNew(parent, key, make) {
  if (parent.dataset.key === key) return false;
  const focused = parent.contains(document.activeElement) ? document.activeElement.dataset.focus : undefined;
  parent.dataset.key = key;
  parent.replaceChildren(...[make()].flat());
  if (focused) parent.querySelector(`[data-focus="${CSS.escape(focused)}"]`)?.focus();
  return true;
}
