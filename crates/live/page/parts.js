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

/** A whole number in groups of three digits. */
export const grouped = number => String(number).replace(/\B(?=(\d{3})+$)/g, "\u202f");

/** A number as print has it: a true minus, and a power of ten instead of `e-7`. */
export function printed(text) {
  const raised = digits => digits.replace(/^\+?0*/, "").replace(/[-0-9]/g, of => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(of)]);
  return text.replace(/e([-+]?\d+)$/i, (_, power) => `\u2009×\u200910${raised(power)}`).replace(/^-/, "\u2212");
}

/** A path as a file in a folder names it: `../` leads out of folders that both do not share. */
export function relative(folder, path) {
  const from = folder.split("/").filter(word => word !== ""), to = path.split("/");
  let same = 0;
  while (same < from.length && same < to.length - 1 && from[same] === to[same]) same++;
  return [...from.slice(same).map(() => ".."), ...to.slice(same)].join("/");
}

/** The folder of a path, with a slash behind it; empty for the opened folder itself. */
export const folderOf = path => (path || "").replace(/[^/]*$/, "");

/** A name that is not taken: the wanted one, or that with a number behind it. */
export function free(wanted, taken) {
  let name = wanted;
  for (let number = 2; taken.includes(name); number++) name = `${wanted}${number}`;
  return name;
}

/** A name wherever a formula has it as a whole. */
export const wholeName = name => new RegExp(`(?<![\\p{L}\\p{N}_.])${name.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")}(?![\\p{L}\\p{N}_])`, "gu");

/** A field with a word over it, for fields that say themselves what they are called. */
export const labelled = (word, field) => make("span", { class: "labelled" }, make("span", { class: "key", "aria-hidden": true }, word), field);
