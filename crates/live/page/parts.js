// Small makers of elements. Texts of files only ever become text.

/** An element with properties and children. */
export function make(name, properties = {}, ...children) {
  const element = document.createElement(name);
  for (const [key, value] of Object.entries(properties)) {
    if (value === null || value === undefined || value === false) continue;
    if (key.startsWith("on")) element.addEventListener(key.slice(2), value);
    else if (key === "class") element.className = value;
    else if (key in element && !key.includes("-") && key !== "list") element[key] = value;
    else element.setAttribute(key, value === true ? "" : value);
  }
  element.append(...children.filter(child => child !== null && child !== undefined));
  return element;
}

/** A unit with its exponents raised, as nodes. */
export function unit(text) {
  const nodes = [];
  text.split(/\^(-?\d+)/).forEach((part, place) => {
    if (part === "") return;
    nodes.push(place % 2 ? make("sup", {}, part.replace("-", "\u2212")) : part);
  });
  return nodes;
}

/** Puts parts of the report there, unless they are there already. */
export function put(element, html) {
  if (element.shownHtml === html) return;
  element.shownHtml = html;
  element.innerHTML = html || "";
}

/** The key of a path. */
export const at = path => path.join("\u0001");

/** Whether a text is a number. */
export const isNumber = text => text.trim() !== "" && Number.isFinite(Number(text));
