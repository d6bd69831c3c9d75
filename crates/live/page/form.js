// The form: fields that show parts of the file and change them.

import { Fields } from "./fields.js";
import { at, isNumber, make, put, unit } from "./parts.js";

const CENTRES = ["mean", "value", "mode", "count"];
const ASIDE = ["unit", "distribution", "about", "components", "complex"];
// fields that are there whether the file says something or not
const OPTIONS = ["\u0001dof", "\u0001about", "tolerance\u0001lower", "tolerance\u0001upper"];
const WORDED = ["std", "half_width", "semi_range", "scale", "expanded", "lower", "upper", "std_low", "std_high"];

export class Form extends Fields {
  constructor(page) {
    super(page, "form");
    this.kinds = { distributions: [], units: [] };
    this.slid = null;
    this.shape = "";
  }

  /** Shows what an answer says of the file; `force` also in the field that somebody writes in. */
  show(found, force = false) {
    if (force) this.forget();
    const shape = JSON.stringify([this.page.language, found.model, (found.inputs || []).map(signature),
      (found.outputs || []).map(signature), found.correlations && found.correlations.map(of => at(of.path)),
      found.conditions && found.conditions.rows.map(signature)]);
    if (shape !== this.shape) {
      this.shape = shape;
      this.rebuild(() => this.#build(found));
    }
    const rows = [...(found.inputs || []), ...(found.outputs || []), ...((found.conditions || {}).rows || [])];
    const there = new Set(rows.flatMap(row => row.cells.map(cell => at(cell.path))));
    // what the file does not say any more
    for (const [key, field] of this.fields) {
      if (field.tagName === "INPUT" && !key.includes("#") && key.includes("\u0001") && !there.has(key) && OPTIONS.some(of => key.endsWith(of))) this.fill(key, "");
    }
    for (const row of rows) {
      for (const cell of row.cells) this.fill(at(cell.path), cell.raw, cell.kind);
      if (row.form === "text") this.fill(at(row.path), row.text, "text");
      this.fill(at(row.path) + "#name", row.name);
      const picture = this.fields.get(at(row.path) + "#picture");
      if (picture && (row.picture || found.results)) put(picture, row.picture || "");
      const said = this.fields.get(at(row.path) + "#said");
      if (said && row.said) said.replaceChildren(`u = ${row.said[1]} `, ...unit(row.said[2] === "1" ? "" : row.said[2]));
    }
    for (const of of found.correlations || []) {
      of.between.forEach((name, place) => this.fill(at([...of.path, place]), name));
      this.fill(at([...of.path, 2]), of.raw);
    }
    this.#settings(found);
    this.#chips(found);
    this.#slides(found);
  }

  #build(found) {
    const inputs = (found.inputs || []).map(row => this.#input(row, found));
    this.page.element("inputs").replaceChildren(...inputs);
    this.page.element("outputs").replaceChildren(...(found.outputs || []).map(row => this.#output(row, found)));
    this.page.element("correlations").replaceChildren(...(found.correlations || []).map(of => this.#correlation(of)));
    this.page.element("conditions").replaceChildren(...((found.conditions || {}).rows || []).map(row => this.#condition(row)));
    this.page.element("add-correlation").hidden = found.correlations === null;
    this.page.element("add-condition").hidden = Boolean(found.conditions && found.conditions.file);
  }

  #name(row, above) {
    const path = row.path;
    const field = make("input", {
      class: "name", autocomplete: "off", spellcheck: false, autocapitalize: "off", size: 10,
      "aria-label": `${this.words.name}: ${row.name}`,
      onchange: () => this.page.rename(above, row.name, field.value.trim()),
    });
    field.dataset.key = at(path) + "#name";
    this.fields.set(field.dataset.key, field);
    return field;
  }

  #input(row, found) {
    const { words, kinds } = this;
    const cell = key => row.cells.find(of => of.key === key);
    const shape = cell("distribution");
    const known = make("td", { role: "cell", class: "known" });
    const keys = shapeOf(kinds, shape && shape.raw);
    if (row.form === "object") {
      const own = row.cells.filter(of => of.key !== "dof" || !keys || !WORDED.some(key => cell(key))).filter(of => keys ? keys.keys.includes(of.key) : !ASIDE.includes(of.key) && of.kind !== "other");
      own.sort((a, b) => rank(a.key) - rank(b.key));
      const fields = own.filter(of => of.kind !== "other")
        .map(of => this.labelled(of, row.name, kindOf(of)));
      known.append(...fields);
      if (keys && keys.keys.includes("dof") && WORDED.some(key => cell(key))) {
        const path = [...row.path, "dof"];
        const dof = this.field(path, words.of(words.key.dof, row.name), { size: 4, inputmode: "decimal", class: "figure few", placeholder: "∞" });
        known.append(make("span", { class: "labelled" }, make("span", { class: "key", "aria-hidden": true }, words.key.dof), dof));
      }
    } else if (row.form === "text") {
      known.append(make("span", { class: "labelled wide" }, make("span", { class: "key", "aria-hidden": true }, words.text_value),
        this.field(row.path, words.of(words.text_value, row.name), { kind: "text", size: 24 })));
    }
    if (!row.component || cell("about")) {
      const about = cell("about") ? cell("about").path : [...row.path, "about"];
      if (row.form !== "text") {
        known.append(make("span", { class: "labelled wide" }, make("span", { class: "key", "aria-hidden": true }, words.key.about),
          this.field(about, words.of(words.key.about, row.name), { kind: "text", class: "about", size: 20 })));
      }
    }
    const unitPath = cell("unit") ? cell("unit").path : [...row.path, "unit"];
    const said = make("span", { class: "said" });
    const picture = make("span", { class: "picture", "aria-hidden": "true" });
    this.fields.set(at(row.path) + "#said", said);
    this.fields.set(at(row.path) + "#picture", picture);
    const choice = row.form === "object" || row.form === "text" ? this.#distribution(row, shape) : make("span", { class: "said" }, words[row.form]);
    const isFixed = Boolean(found.model) || row.component;
    const name = isFixed ? make("span", { class: "name" }, row.name) : this.#name(row, row.path);
    return make("tr", { role: "row", class: row.component ? "component" : "" },
      make("th", { scope: "row", role: "rowheader" }, name),
      make("td", { role: "cell", class: "shape" }, choice),
      known,
      make("td", { role: "cell", class: "unit" }, row.form === "text" || row.component ? null
        : this.field(unitPath, words.of(words.unit, row.name), { kind: "text", list: "units", size: 6, class: "unit" })),
      make("td", { role: "cell", class: "density" }, picture, said),
      make("td", { role: "cell", class: "removes" }, found.model ? null : this.remove(row.path, row.name)));
  }

  #distribution(row, shape) {
    const { words, kinds } = this;
    const choice = make("select", {
      "aria-label": words.of(words.distribution, row.name),
      onchange: () => this.page.reshape(row.path, choice.value),
    });
    if (row.form === "text") choice.append(make("option", { value: "" }, words.written));
    for (const { name } of kinds.distributions) {
      choice.append(make("option", { value: name }, words.shapes[name] || name));
    }
    const known = shape && shapeOf(kinds, shape.raw);
    if (shape && !known) choice.prepend(make("option", { value: shape.raw }, shape.raw));
    // a value without a name of a distribution is a constant
    const unnamed = row.cells.some(of => of.key === "value") ? "constant" : "";
    choice.value = known ? known.name : shape ? shape.raw : unnamed;
    choice.dataset.key = at([...row.path, "distribution"]) + "#choice";
    this.fields.set(choice.dataset.key, choice);
    return choice;
  }

  #output(row) {
    const { words } = this;
    const cell = key => row.cells.find(of => of.key === key);
    const path = (...keys) => [...row.path, ...keys];
    const field = (keys, word, more) => make("span", { class: "labelled" },
      make("span", { class: "key", "aria-hidden": true }, word), this.field(path(...keys), words.of(word, row.name), more));
    const complexTolerance = cell("tolerance") && cell("tolerance").kind !== "other";
    return make("div", { class: "row" },
      make("span", { class: "name" }, row.name),
      field(["unit"], words.unit, { kind: "text", list: "units", size: 8, class: "unit" }),
      complexTolerance ? null : field(["tolerance", "lower"], `${words.key.tolerance}: ${words.key.lower}`, { size: 8, inputmode: "decimal", class: "figure" }),
      complexTolerance ? null : field(["tolerance", "upper"], `${words.key.tolerance}: ${words.key.upper}`, { size: 8, inputmode: "decimal", class: "figure" }),
      field(["about"], words.key.about, { kind: "text", size: 18, class: "about" }),
      this.remove(row.path, row.name));
  }

  #correlation(of) {
    const { words } = this;
    const name = place => this.field([...of.path, place], `${words.between} ${place + 1}`, { kind: "text", size: 9 });
    return make("div", { class: "row" }, make("span", { class: "key" }, words.between), name(0),
      make("span", { class: "key" }, words.and), name(1),
      make("span", { class: "labelled" }, make("span", { class: "key", "aria-hidden": true }, "r"),
        this.field([...of.path, 2], words.coefficient, { size: 6, inputmode: "decimal", class: "figure" })),
      this.remove(of.path, of.between.join(", ")));
  }

  #condition(row) {
    const { words } = this;
    const cells = row.cells.filter(cell => cell.kind !== "other").map(cell =>
      this.labelled(cell, row.name || words.conditions, kindOf(cell)));
    return make("div", { class: "row" }, row.name ? make("span", { class: "name" }, row.name) : null, ...cells, this.remove(row.path, row.name));
  }

  #settings(found) {
    const place = this.page.element("settings");
    if (place.dataset.language !== this.page.language || !place.childElementCount || !this.fields.has(at(["coverage_probability"]))) {
      place.dataset.language = this.page.language;
      const field = (path, key) => make("span", { class: "labelled" },
        make("span", { class: "key", "aria-hidden": true }, this.words.key[key]),
        this.field(path, this.words.key[key], { size: 9, inputmode: "decimal", class: "figure" }));
      place.replaceChildren(make("div", { class: "row" }, field(["coverage_probability"], "coverage_probability"),
        field(["coverage_factor"], "coverage_factor"), field(["monte_carlo", "trials"], "trials"),
        field(["monte_carlo", "seed"], "seed"), field(["monte_carlo", "digits"], "digits")));
    }
    const of = found.settings || {};
    this.fill(at(["coverage_probability"]), of.coverage_probability || "");
    this.fill(at(["coverage_factor"]), of.coverage_factor || "");
    for (const key of ["trials", "seed", "digits"]) this.fill(at(["monte_carlo", key]), of[key] || "");
  }

  #chips(found) {
    const chips = (id, word, names, taken) => {
      const place = this.page.element(id);
      const key = JSON.stringify([word, names]);
      if (place.dataset.names === key) return;
      place.dataset.names = key;
      place.hidden = names.length === 0;
      const buttons = names.map(name => make("button", { type: "button", class: "chip", onclick: () => taken([name]) }, name));
      if (names.length > 1) buttons.push(make("button", { type: "button", class: "chip", onclick: () => taken(names) }, this.words.all));
      place.replaceChildren(word + " ", ...buttons);
    };
    chips("missing", this.words.use, found.missing || [], names => this.page.addInputs(names));
    const reported = (found.outputs || []).map(of => of.name);
    const rest = (found.equations || []).map(of => of.name).filter(name => !reported.includes(name));
    chips("unreported", this.words.report_as, rest, names => this.page.addOutputs(names));
  }

  // the slider

  #slides(found) {
    const choice = this.page.element("slid");
    const numbers = [];
    for (const row of found.inputs || []) {
      for (const cell of [...row.cells].sort((a, b) => rank(a.key) - rank(b.key))) {
        if (cell.kind === "number" && (CENTRES.includes(cell.key) || WORDED.includes(cell.key))) {
          numbers.push({ row, cell, key: at(cell.path) });
        }
      }
    }
    this.numbers = numbers;
    const key = JSON.stringify([this.page.language, numbers.map(of => of.key)]);
    if (choice.dataset.names !== key) {
      choice.dataset.names = key;
      choice.replaceChildren(...numbers.map(({ row, cell, key }) =>
        make("option", { value: key }, this.words.of(this.words.key[cell.key] || cell.key, row.name))));
    }
    if (!numbers.some(of => of.key === this.slid)) this.slid = numbers.length ? numbers[0].key : null;
    if (this.slid !== null && choice.value !== this.slid) choice.value = this.slid;
    const slide = this.page.element("slide");
    slide.disabled = this.slid === null;
    slide.closest(".slider").hidden = this.slid === null;
    const now = numbers.find(of => of.key === this.slid);
    this.page.element("slide-value").textContent = now ? now.cell.raw : "";
    if (now && !this.isSliding) this.#range(now);
  }

  /** The range that the slider covers: about an estimate five standard uncertainties, of a width three times it. */
  #range({ row, cell }) {
    const value = Number(cell.raw);
    const isWidth = WORDED.includes(cell.key) && !["lower", "upper"].includes(cell.key);
    const u = row.standard_uncertainty || Math.abs(value) * 0.02 || 1;
    const [low, high] = isWidth ? [0, 3 * Math.abs(value) || 1] : [value - 5 * u, value + 5 * u];
    const step = 10 ** Math.floor(Math.log10((high - low) / 200));
    this.scale = { low, step, digits: Math.min(12, Math.max(0, -Math.floor(Math.log10(step)))) };
    const slide = this.page.element("slide");
    slide.min = 0;
    slide.max = Math.round((high - low) / step);
    slide.value = Math.round((value - low) / step);
    slide.setAttribute("aria-valuetext", cell.raw);
  }

  /** The slider takes hold of a field. */
  focused(path) {
    const key = at(path);
    if ((this.numbers || []).some(of => of.key === key)) this.choose(key);
  }

  choose(key) {
    this.slid = key;
    this.isSliding = false;
    this.page.element("slid").value = key;
    const now = this.numbers.find(of => of.key === key);
    if (now) {
      this.#range(now);
      this.page.element("slide-value").textContent = now.cell.raw;
    }
  }

  slide(isDone) {
    this.isSliding = !isDone;
    const now = (this.numbers || []).find(of => of.key === this.slid);
    if (!now || !this.scale) return;
    const slide = this.page.element("slide");
    const { low, step, digits } = this.scale;
    // whole steps from a rounded beginning, so that typed numbers stay short
    const value = (Math.round(low / step) + Number(slide.value)) * step;
    const typed = String(Number(value.toFixed(digits)));
    slide.setAttribute("aria-valuetext", typed);
    this.page.element("slide-value").textContent = typed;
    if (isNumber(typed)) this.page.edit([{ path: now.cell.path, typed }], `slide:${this.slid}`);
  }
}

/** What the fields of a row depend on, but not what stands in them. */
function signature(row) {
  const isExtra = cell => ["dof", "about", "tolerance"].includes(cell.key) || cell.path.length > 3 || cell.path[0] === "outputs";
  return [row.name, row.form, row.cells.filter(cell => !isExtra(cell)).map(cell =>
    [cell.key, ["list", "other"].includes(cell.kind) ? cell.kind : "", cell.key === "distribution" ? cell.raw : ""])];
}

function kindOf(cell) {
  if (cell.kind === "list" || ["values", "probabilities"].includes(cell.key) && cell.kind !== "number") return "list";
  return ["file", "column", "id", "output", "unit", "about", "ref_type"].includes(cell.key) ? "text" : null;
}

function shapeOf(kinds, name) {
  return kinds.distributions.find(of => of.name === name || of.aliases.includes(name));
}

function rank(key) {
  const order = ["mean", "value", "mode", "count", "lower", "upper", "std", "half_width", "semi_range", "scale", "expanded", "k", "p", "values"];
  const place = order.indexOf(key);
  return place < 0 ? 50 : place;
}
