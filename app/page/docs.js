// The interactive documentation: every call of the OpenAPI document, described, with examples, and ready to be tried.

const KEY = "majordomo-token";
const tokenField = document.querySelector("#token");
tokenField.value = sessionStorage.getItem(KEY) ?? "";
tokenField.oninput = () => sessionStorage.setItem(KEY, tokenField.value);

const calls = document.querySelector("#calls");
show().catch((problem) => calls.append(make("p", { className: "wrong" }, `The description cannot be had: ${problem.message}`)));

async function show() {
  const description = await (await fetch("openapi.json")).json();
  calls.append(...prose(description.info.description));
  for (const { name, description: about } of description.tags) {
    const operations = operationsOf(description, name);
    if (operations.length) calls.append(make("h2", {}, name), make("p", { className: "soft" }, ...marked(about)), ...operations);
  }
  calls.setAttribute("aria-busy", "false");
}

function operationsOf(description, tag) {
  return Object.entries(description.paths).flatMap(([path, operations]) =>
    Object.entries(operations)
      .filter(([, operation]) => operation.tags?.includes(tag))
      .map(([method, operation]) => section(description, method.toUpperCase(), path, operation)));
}

function section(description, method, path, operation) {
  const who = { viewer: "viewers and operators", operator: "operators" }[operation["x-role"]] ?? "everybody";
  const details = make("details", {}, make("summary", {}, make("b", {}, `${method} ${path}`), ` ${operation.summary} `, make("i", {}, `for ${who}`)));
  const fill = () => details.append(make("div", { className: "body" },
    ...prose(operation.description), ...parameters(operation), ...body(description, operation), ...answers(description, operation), trial(description, method, path, operation)));
  details.addEventListener("toggle", fill, { once: true });
  return details;
}

function parameters({ parameters: known = [] }) {
  if (!known.length) return [];
  const rows = known.map((p) => [`${p.name}${p.required ? " (required)" : ""}`, p.in, kind(p.schema), p.description ?? ""]);
  return [make("h3", {}, "Parameters"), table(["name", "in", "type", "meaning"], rows)];
}

function body(description, { requestBody }) {
  const schema = requestBody && resolved(description, requestBody.content["application/json"].schema);
  if (!schema) return [];
  const rows = Object.entries(schema.properties ?? {}).map(([name, field]) =>
    [`${name}${schema.required?.includes(name) ? " (required)" : ""}`, kind(resolved(description, field)), field.description ?? ""]);
  return [make("h3", {}, "Body, JSON"), ...prose(schema.description), table(["field", "type", "meaning"], rows)];
}

function answers(description, { responses }) {
  const shown = Object.entries(responses).map(([status, response]) => {
    const [type, content] = Object.entries(response.content ?? {})[0] ?? [];
    const example = content?.example ?? Object.values(content?.examples ?? {})[0]?.value;
    const more = example ? [make("pre", { tabIndex: 0 }, JSON.stringify(example, null, 1))] : [];
    const about = response.description || resolved(description, content?.schema)?.description || "";
    return make("details", {}, make("summary", {}, make("b", {}, status), " ", ...marked(about), make("i", {}, ` ${type ?? ""}`)), make("div", { className: "body" }, ...more));
  });
  return [make("h3", {}, "Answers"), ...shown];
}

function trial(description, method, path, operation) {
  const fields = (operation.parameters ?? []).map((parameter) => [parameter, make("input", { value: parameter.schema?.default ?? "", required: Boolean(parameter.required), name: parameter.name })]);
  const text = operation.requestBody && make("textarea", { spellcheck: false, value: example(description, operation) });
  const result = make("div", { ariaLive: "polite" });
  const form = make("form", {}, make("h3", {}, "Try it"),
    ...fields.map(([parameter, field]) => make("label", {}, `${parameter.name} `, field)),
    ...(text ? [make("label", {}, "Body", text)] : []), make("button", {}, "Send"), result);
  form.onsubmit = (event) => { event.preventDefault(); send(method, path, fields, text, result); };
  return form;
}

async function send(method, path, fields, text, result) {
  const headers = tokenField.value ? { Authorization: `Bearer ${tokenField.value}` } : {};
  const query = new URLSearchParams();
  let address = path;
  for (const [{ name, in: place }, { value }] of fields) {
    if (place === "path") address = address.replace(`{${name}}`, encodeURIComponent(value));
    else if (value && place === "header") headers[name] = value;
    else if (value) query.append(name, value);
  }
  if (text?.value.trim()) headers["Content-Type"] = "application/json";
  if (`${query}`) address += `?${query}`;
  result.replaceChildren(make("p", {}, `${method} ${address} …`));
  try {
    const response = await fetch(address, { method, headers, body: text?.value.trim() || undefined });
    result.replaceChildren(make("p", { className: response.ok ? "" : "wrong" }, `${response.status} ${response.statusText}`), await content(response));
  } catch (problem) {
    result.replaceChildren(make("p", { className: "wrong" }, `no answer: ${problem.message}`));
  }
}

async function content(response) {
  const type = response.headers.get("content-type") ?? "";
  if (type.startsWith("image/")) return make("img", { alt: "The picture that came back", src: URL.createObjectURL(await response.blob()) });
  const text = await response.text();
  return make("pre", { tabIndex: 0 }, type.includes("json") ? JSON.stringify(JSON.parse(text), null, 1) : text);
}

function example(description, operation) {
  const schema = resolved(description, operation.requestBody.content["application/json"].schema);
  const fields = Object.entries(schema.properties ?? {}).filter(([, field]) => field.examples);
  return JSON.stringify(Object.fromEntries(fields.map(([name, field]) => [name, field.examples[0]])), null, 1);
}

function resolved(description, schema) {
  if (schema?.anyOf) return resolved(description, schema.anyOf.find((one) => one.$ref) ?? schema.anyOf[0]);
  return schema?.$ref ? description.components.schemas[schema.$ref.split("/").at(-1)] : schema;
}

function kind(schema = {}) {
  if (schema.enum) return schema.enum.join(" | ");
  if (schema.anyOf) return schema.anyOf.map(kind).filter((name) => name !== "null").join(" or ");
  return schema.items ? `list of ${kind(schema.items)}` : schema.type ?? schema.$ref?.split("/").at(-1) ?? "";
}

function table(head, rows) {
  return make("table", {}, make("tr", {}, ...head.map((name) => make("th", { scope: "col" }, name))),
    ...rows.map((row) => make("tr", {}, ...row.map((cell) => make("td", {}, ...marked(cell))))));
}

function prose(text = "") { return text.trim().split(/\n\s*\n/).filter(Boolean).map((paragraph) => make("p", {}, ...marked(paragraph))); }

function marked(text) {
  return text.split(/(`[^`]+`|\*\*[^*]+\*\*)/).map((part) =>
    part.startsWith("`") ? make("code", {}, part.slice(1, -1)) : part.startsWith("**") ? make("strong", {}, part.slice(2, -2)) : part);
}

function make(tag, properties, ...children) {
  const element = Object.assign(document.createElement(tag), properties);
  element.append(...children);
  return element;
}
