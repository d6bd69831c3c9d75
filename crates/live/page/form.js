// The form of a model: its inputs, each by the way in which it is known, its outputs and settings.

import { Fields } from "./fields.js";
import { Pickers } from "./pickers.js";
import { Slider } from "./slider.js";
import { at, labelled, make, put } from "./parts.js";

// the ways that most inputs are known by; the other distributions come after them
const USUAL = ["standard", "expanded", "expanded-p", "limits", "bounds", "datasheet", "readings", "dcc", "result", "constant"];
// more inputs than this have compact rows
const MANY = 10;
// what a picker fills in
const PICKED = ["readings", "dcc", "result"];
const ASIDE = ["unit", "distribution", "about", "components", "complex"];

export class Form extends Fields {
  constructor(page) {
    super(page, "form");
    this.kinds = { distributions: [], ways: [], units: [] };
    this.slider = new Slider(page);
    this.pickers = new Pickers(page);
    this.clear();
  }

  /** Another file is open. */
  clear() {
    this.shape = "";
    // the ways that were chosen, and what was typed, by the name of the input
    this.chosen = new Map();
    this.kept = new Map();
  }

  /** Shows what an answer says of the file; `force` also in the field that somebody writes in. */
  show(found, force = false) {
    if (force) this.forget();
    const shape = JSON.stringify([this.page.language, found.model, (found.inputs || []).map(row => [this.#way(row), signature(row)]),
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
      if (field.isOptional && !there.has(key)) this.fill(key, "");
    }
    for (const row of found.inputs || []) {
      const typed = row.cells.filter(cell => !ASIDE.includes(cell.key) && ["number", "text", "list"].includes(cell.kind) && cell.raw !== "");
      this.kept.set(row.name, { ...this.kept.get(row.name), ...Object.fromEntries(typed.map(cell => [cell.key, cell.raw])) });
    }
    for (const row of rows) {
      for (const cell of row.cells) this.fill(at(cell.path), cell.raw, cell.kind);
      if (row.form === "text") this.fill(at(row.path), row.text, "text");
      this.fill(at(row.path) + "#name", row.name);
      const picture = this.fields.get(at(row.path) + "#picture");
      if (picture && (row.picture || found.results)) put(picture, row.picture || "");
      const said = this.fields.get(at(row.path) + "#said");
      if (said && row.said) said.textContent = `u = ${this.words.number(row.said[1])}`;
    }
    for (const of of found.correlations || []) {
      of.between.forEach((name, place) => this.fill(at([...of.path, place]), name));
      this.fill(at([...of.path, 2]), of.raw);
    }
    this.#settings(found);
    this.#chips(found);
    this.slider.show(found);
  }

  focused(path) { this.slider.choose(at(path)); }

  #build(found) {
    const inputs = (found.inputs || []).map(row => this.#input(row, found));
    this.page.element("inputs").replaceChildren(...inputs);
    this.page.element("inputs").parentElement.classList.toggle("dense", inputs.length > MANY);
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
    const { words } = this;
    const has = key => row.cells.some(of => of.key === key);
    const said = make("span", { class: "said" });
    const picture = make("span", { class: "picture", "aria-hidden": "true" });
    this.fields.set(at(row.path) + "#said", said);
    this.fields.set(at(row.path) + "#picture", picture);
    const isText = row.form === "text";
    const choice = row.form === "object" || isText ? this.#how(row) : make("span", { class: "said" }, words[row.form]);
    const isFixed = Boolean(found.model) || row.component;
    const name = isFixed ? make("span", { class: "name" }, row.name) : this.#name(row, row.path);
    const about = isText || row.component && !has("about") ? null
      : this.field([...row.path, "about"], words.of(words.key.about, row.name), { kind: "text", class: "about", size: 6, placeholder: "✎", title: words.key.about, isOptional: true });
    return make("tr", { role: "row", class: row.component ? "component" : "" },
      make("th", { scope: "row", role: "rowheader" }, name),
      make("td", { role: "cell", class: "shape" }, choice),
      make("td", { role: "cell", class: "known" }, ...this.#known(row), about),
      make("td", { role: "cell", class: "unit" }, isText || row.component ? null
        : this.field([...row.path, "unit"], words.of(words.unit, row.name), { kind: "text", list: "units", size: 6, class: "unit", placeholder: words.unit, isOptional: true })),
      make("td", { role: "cell", class: "density" }, picture, said),
      make("td", { role: "cell", class: "removes" }, found.model ? null : this.remove(row.path, row.name)));
  }

  /** The fields of the way in which an input is known. */
  #known(row) {
    const { words } = this;
    if (row.form === "text") return [this.withName(row.path, words.text_value, row.name, { kind: "text", size: 24 })];
    if (row.form !== "object") return [];
    const way = this.#wayOf(this.#way(row)) || { needed: [], offered: [] };
    const cells = row.cells.filter(cell => !ASIDE.includes(cell.key) && cell.kind !== "other");
    const keys = [...way.needed, ...cells.map(cell => cell.key), ...way.offered];
    const shown = [...new Set(keys)].filter(key => way.offered.includes(key) || cells.some(cell => cell.key === key));
    const fields = shown.map(key => {
      const cell = cells.find(cell => cell.key === key) || { key, kind: null };
      const kind = kindOf(cell);
      const isWide = kind === "list" || key === "half_width" && way.name === "datasheet";
      return this.withName([...row.path, key], words.key[key] || key, row.name, {
        kind, isOptional: way.offered.includes(key), placeholder: (words.placeholder[way.name] || {})[key] || words.placeholder[key] || null,
        size: 7, inputmode: kind === null && !isWide ? "decimal" : null, class: isWide ? "list" : kind === "text" ? null : key === "dof" || key === "k" || key === "p" ? "figure few" : "figure",
      }, (words.short_of[way.name] || {})[key] || words.short[key]);
    });
    if (PICKED.includes(way.name)) fields.push(make("button", { type: "button", class: "small", onclick: () => this.pickers.pick(way.name, row) }, words.pick[way.name]));
    if (row.undecided && !way.needed.some(key => ["half_width", "expanded"].includes(key))) {
      const as = name => make("button", { type: "button", class: "chip", onclick: () => this.#reshape(row, name) }, words.ways[name]);
      fields.push(make("span", { class: "chips" }, words.plus_minus, " ", as("limits"), as("expanded"), as("expanded-p")));
    }
    return fields;
  }

  #wayOf(name) { return this.kinds.ways.find(of => of.name === name); }

  /** The way of an input: the chosen one while the file can mean it, else that of the file. */
  #way(row) {
    const chosen = this.#wayOf(this.chosen.get(row.name)), own = this.#wayOf(row.way);
    const can = chosen && own && chosen.distribution === own.distribution && chosen.needed.every(key => row.cells.some(cell => cell.key === key));
    return can ? chosen.name : row.way;
  }

  #reshape(row, way) {
    if (way === "") return;
    this.chosen.set(row.name, way);
    this.page.reshape(row.path, way, this.kept.get(row.name) || {});
  }

  /** The choice of the way in which an input is known. */
  #how(row) {
    const { words, kinds } = this;
    const choice = make("select", { "aria-label": words.how_of(row.name), onchange: () => this.#reshape(row, choice.value) });
    const option = name => make("option", { value: name }, words.ways[name] || words.shapes[name] || name);
    const others = kinds.ways.map(of => of.name).filter(name => !USUAL.includes(name));
    const way = this.#way(row);
    if (row.form === "text") choice.append(make("option", { value: "" }, words.written));
    else if (!way) {
      const given = row.cells.find(cell => cell.key === "distribution");
      choice.append(make("option", { value: "" }, given ? given.raw : ""));
    }
    choice.append(make("optgroup", { label: words.how }, ...USUAL.map(option)), make("optgroup", { label: words.other_shapes }, ...others.map(option)));
    choice.value = way || "";
    choice.dataset.key = at([...row.path, "distribution"]) + "#choice";
    this.fields.set(choice.dataset.key, choice);
    return choice;
  }

  #output(row) {
    const { words } = this;
    const cell = key => row.cells.find(of => of.key === key);
    const path = (...keys) => [...row.path, ...keys];
    const field = (keys, word, more) => labelled(word, this.field(path(...keys), words.of(word, row.name), more));
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
      labelled("r", this.field([...of.path, 2], words.coefficient, { size: 6, inputmode: "decimal", class: "figure" })),
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
      const field = (path, key) => labelled(this.words.key[key], this.field(path, this.words.key[key], { size: 9, inputmode: "decimal", class: "figure" }));
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
}

/** What the fields of a row depend on, but not what stands in them. */
function signature(row) {
  const isExtra = cell => ["about", "unit", "tolerance"].includes(cell.key) || cell.path.length > 3 || cell.path[0] === "outputs";
  return [row.name, row.form, row.undecided, row.cells.filter(cell => !isExtra(cell)).map(cell =>
    [cell.key, ["list", "other"].includes(cell.kind) ? cell.kind : "", cell.key === "distribution" ? cell.raw : ""])];
}

function kindOf(cell) {
  if (cell.kind === "list" || ["values", "probabilities"].includes(cell.key) && cell.kind !== "number") return "list";
  return ["file", "column", "id", "output", "unit", "about", "ref_type"].includes(cell.key) ? "text" : null;
}
