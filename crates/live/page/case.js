// The form of a case: measured data and what each column is, candidate effects.

import { Effects } from "./effects.js";
import { Fields } from "./fields.js";
import { at, folderOf, labelled, make } from "./parts.js";

// what a column can be for an output, with the key that says so
const OF_OUTPUT = ["value", "standard_uncertainty", "sim", "sim_standard_uncertainty"];
// what a column can be for the rows
const OF_ROWS = ["order", "time", "replication"];

export class CaseForm extends Fields {
  constructor(page) {
    super(page, "case-form");
    this.shape = "";
    this.effects = new Effects(page, this);
    const paste = page.element("case-paste");
    paste.addEventListener("paste", () => setTimeout(() => this.#take()));
    paste.addEventListener("change", () => this.#take());
    page.element("case-file").addEventListener("change", event => this.#choose(event.target.value));
    page.element("case-file").addEventListener("focus", () => this.#files());
  }

  /** Shows what an answer says of the case. */
  show(found, force = false) {
    if (force) this.forget();
    this.found = found;
    const content = this.content;
    const shape = JSON.stringify([this.page.language, found.data, content.observations && content.observations.columns && Object.entries(content.observations.columns).map(([name, of]) => [name, Object.entries(of || {}).map(([key, value]) => this.#column(value) ? [key, value] : key)]),
      OF_ROWS.map(key => (content.observations || {})[key]), Object.keys(content.conditions || {}), Object.keys(content.outputs || {}), this.effects.shape(found)]);
    if (shape !== this.shape) {
      this.shape = shape;
      this.rebuild(() => { this.#build(); this.effects.build(found); });
    }
    this.#fillAll(content, []);
    this.effects.show(found);
    if (this.page.program.hasFolder && this.filesOf !== this.page.document.path) this.#files();
  }

  /** The file as an object, its numbers as texts. */
  get content() { return this.found && this.found.content || {}; }

  get outputs() { return Object.keys(this.content.outputs || {}); }

  #fillAll(value, path) {
    if (value !== null && typeof value === "object") {
      if (path.join() === "observations,values") return;
      for (const [key, inner] of Object.entries(value)) this.#fillAll(inner, [...path, Array.isArray(value) ? Number(key) : key]);
      return;
    }
    this.fill(at(path), value === null ? "" : String(value));
  }

  /** What an answer lacks before it can be diagnosed, in words, each with the places that need it. */
  lacks(found) {
    const { words } = this;
    const content = found.content;
    if (!content) return [];
    const observations = content.observations || {};
    const lacks = [];
    if (!observations.file && !Object.keys(observations.values || {}).length) lacks.push([words.case_lack_data, [["observations"], ["observations", "columns"]]]);
    const measured = Object.entries(observations.columns || {});
    if (!measured.length) lacks.push([words.case_lack_measured, [["observations"], ["observations", "columns"], ["outputs"]]]);
    const computed = (found.equations || []).map(of => of.name);
    for (const [name, of] of measured) {
      if (!(of && of.value)) lacks.push([words.case_lack_value(name), [["observations", "columns", name]]]);
      else if (!of.sim && !computed.includes(name) && !content.model && !content.simulator) lacks.push([words.case_lack_sim(name), [["outputs", name], ["equations"]]]);
    }
    return lacks.map(([say, paths]) => ({ say, paths }));
  }

  /** The mistakes that are none yet: what is still missing is said beside the form. */
  calm(found) {
    const lacks = this.lacks(found);
    if (!lacks.length) return found.diagnostics;
    const paths = new Set([at([]), ...lacks.flatMap(of => of.paths.map(at))]);
    const content = found.content;
    const isEmpty = path => path.length === 1 && content[path[0]] && typeof content[path[0]] === "object" && !Object.keys(content[path[0]]).length;
    return found.diagnostics.filter(({ path }) => !paths.has(at(path)) && !isEmpty(path));
  }

  // the data

  async #take() {
    const area = this.page.element("case-paste");
    const text = area.value;
    if (text.trim() === "") return;
    const { words } = this;
    try {
      const table = await this.page.program.call("table", { text });
      if (area.value !== text) return;
      if (table.fault) return this.#say(words.case_fault[table.fault](table.of), true);
      const taken = table.columns.filter(of => of.values !== null), left = table.columns.filter(of => of.values === null);
      if (!taken.length) return this.#say(words.case_fault.rows(), true);
      const edits = this.#without(taken);
      if ((this.content.observations || {}).file !== undefined) edits.push({ path: ["observations", "file"], remove: true });
      edits.push({ path: ["observations", "values"], value: {} });
      for (const { key, values } of taken) edits.push({ path: ["observations", "values", key], typed: values });
      // a heading that is the name of an output is what was measured of it
      for (const { name } of taken.filter(of => this.outputs.includes(of.name))) {
        if (!((this.content.observations || {}).columns || {})[name]) edits.push({ path: ["observations", "columns", name, "value"], value: name });
      }
      this.page.edit(edits);
      area.value = "";
      const said = left.map(of => words.case_left(of.heading || of.key, of.none[0], of.none[1]));
      this.#say([words.case_taken(table.rows, taken.length), ...said].join(" "));
    } catch (error) { this.page.failed(error); }
  }

  #say(text, isWrong = false) {
    const said = this.page.element("case-said");
    said.textContent = text;
    said.classList.toggle("wrong", isWrong);
    const area = this.page.element("case-paste");
    if (isWrong) area.setAttribute("aria-invalid", "true"); else area.removeAttribute("aria-invalid");
  }

  /** Edits that take away what is said of columns that are no more. */
  #without(columns) {
    const known = columns.flatMap(of => [of.name, of.key]);
    const observations = this.content.observations || {};
    const edits = [];
    const isGone = value => this.#column(value) && !known.includes(value);
    for (const key of OF_ROWS) if (isGone(observations[key])) edits.push({ path: ["observations", key], remove: true });
    for (const [name, of] of Object.entries(observations.columns || {})) {
      const gone = OF_OUTPUT.filter(key => isGone(of[key]));
      if (gone.length === Object.keys(of).length) edits.push({ path: ["observations", "columns", name], remove: true });
      else edits.push(...gone.map(key => ({ path: ["observations", "columns", name, key], remove: true })));
    }
    for (const name of Object.keys(this.content.conditions || {})) if (isGone(name)) edits.push({ path: ["conditions", name], remove: true });
    return edits;
  }

  /** The tables of the folder. */
  async #files() {
    const { path } = this.page.document;
    this.filesOf = path;
    const choice = this.page.element("case-file");
    let files;
    try { ({ files } = await this.page.program.ask("files", {})); } catch (error) { return this.page.failed(error); }
    const folder = folderOf(path);
    const tables = files.map(of => of.path).filter(of => /\.csv$/i.test(of) && of.startsWith(folder)).map(of => of.slice(folder.length));
    const now = (this.content.observations || {}).file || "";
    if (now && !tables.includes(now)) tables.unshift(now);
    this.page.element("case-files").hidden = tables.length === 0;
    choice.replaceChildren(make("option", { value: "" }, this.words.case_no_file), ...tables.map(value => make("option", { value }, value)));
    choice.value = now;
  }

  #choose(name) {
    if (name === "") return;
    const edits = [];
    if ((this.content.observations || {}).values) edits.push({ path: ["observations", "values"], remove: true });
    edits.push({ path: ["observations", "file"], value: name });
    this.#say("");
    this.page.edit(edits);
  }

  // the columns

  get #columns() { return this.found.data && this.found.data.columns || []; }

  /** The column that a text of the file names; undefined if it names none. */
  #column(text) {
    if (typeof text !== "string") return undefined;
    const columns = this.#columns;
    const exact = columns.find(of => of.key === text);
    if (exact) return exact;
    const alike = columns.filter(of => of.name === text);
    return alike.length === 1 ? alike[0] : undefined;
  }

  /** How the file names a column. */
  #named({ name, key }) {
    const column = this.#column(name);
    return column && column.key === key ? name : key;
  }

  /** What the file says that a column is: each with its path. */
  #meanings(column) {
    const is = text => this.#column(text) === column;
    const { conditions = {}, observations = {} } = this.content;
    const all = [];
    for (const [name, of] of Object.entries(observations.columns || {})) {
      for (const key of OF_OUTPUT) if (is((of || {})[key])) all.push([`${key}:${name}`, ["observations", "columns", name, key]]);
    }
    for (const name of Object.keys(conditions)) if (is(name)) all.push(["condition", ["conditions", name]]);
    for (const key of OF_ROWS) if (is(observations[key])) all.push([key, ["observations", key]]);
    return all;
  }

  #build() {
    const { words } = this;
    const { data } = this.found;
    const place = this.page.element("case-columns");
    const columns = this.#columns;
    this.page.element("case-columns-hint").hidden = columns.length === 0;
    if (data && data.fault) return place.replaceChildren(make("p", { class: "said wrong" }, words.case_fault[data.fault](data.of)));
    const measured = Object.keys((this.content.observations || {}).columns || {});
    place.replaceChildren(
      ...columns.map(column => this.#row(column, data.rows)),
      ...measured.filter(name => this.outputs.includes(name)).map(name => this.#uncertainty(name)).filter(of => of !== null));
  }

  #row(column, rows) {
    const { words } = this;
    const meanings = this.#meanings(column);
    const choice = make("select", { "aria-label": words.case_column(column.name), onchange: () => this.#mean(column, meanings, choice.value) });
    const option = (value, text) => make("option", { value }, text);
    // what is said of an output that is no more is shown, so that it can be changed
    const outputs = [...new Set([...this.outputs, ...meanings.map(([of]) => of.split(":")[1]).filter(of => of)])];
    choice.append(option("", words.case_unused), option("condition", words.case_condition));
    for (const name of outputs) choice.append(make("optgroup", { label: name }, ...OF_OUTPUT.map(key => option(`${key}:${name}`, words.case_is[key](name)))));
    choice.append(option("new", words.case_is_new), ...OF_ROWS.map(key => option(key, words.case_is[key])));
    choice.value = meanings.length ? meanings[0][0] : "";
    for (const [, path] of meanings) {
      this.fields.set(at(path) + "#choice", choice);
    }
    choice.dataset.key = `column\u0001${column.key}`;
    this.fields.set(choice.dataset.key, choice);
    const condition = meanings.find(([meaning]) => meaning === "condition");
    const unit = condition ? labelled(words.unit,
      this.field([...condition[1], "unit"], words.case_unit(column.name), { kind: "text", list: "units", size: 6, class: "unit" })) : null;
    const also = meanings.slice(1).map(([meaning]) => this.#said(meaning));
    return make("div", { class: "row case-column" },
      make("span", { class: "name" }, column.heading),
      make("span", { class: "detail" }, `${words.case_rows(rows)}: ${column.first.join("; ")}${rows > column.first.length ? " …" : ""}`),
      column.none ? make("span", { class: "said" }, words.case_not_numbers(column.none[0], column.none[1])) : choice, unit,
      also.length ? make("span", { class: "detail" }, words.case_also(also.join(", "))) : null);
  }

  #said(meaning) {
    const [key, name] = meaning.split(":");
    const { words } = this;
    return key === "condition" ? words.case_condition : name ? words.case_is[key](name) : words.case_is[key];
  }

  /** What is said of an uncertainty in place of a column. */
  #uncertainty(name) {
    const { words } = this;
    const of = this.content.observations.columns[name] || {};
    if (this.#column(of.standard_uncertainty)) return null;
    return make("div", { class: "row" }, make("span", { class: "labelled wide" },
      make("span", { class: "key" }, words.case_uncertainty(name)),
      this.field(["observations", "columns", name, "standard_uncertainty"], words.case_uncertainty(name), { size: 16 }),
      make("span", { class: "detail" }, words.case_uncertainty_hint)));
  }

  /** A column is something else from now on. */
  async #mean(column, meanings, meaning) {
    const named = this.#named(column);
    const edits = [];
    const columns = (this.content.observations || {}).columns || {};
    const left = new Map(Object.entries(columns).map(([name, of]) => [name, Object.keys(of || {})]));
    for (const [, path] of meanings) {
      if (path[1] === "columns") left.set(path[2], left.get(path[2]).filter(key => key !== path[3]));
      if (path[1] !== "columns" || left.get(path[2]).length) edits.push({ path, remove: true });
      else edits.push({ path: path.slice(0, 3), remove: true });
    }
    const [key, output] = meaning.split(":");
    if (meaning === "new") {
      const made = await this.#newOutput(column);
      if (made === null) { this.shape = ""; this.show(this.found); return; }
      edits.push({ path: ["outputs", made.name], value: { unit: made.unit || "1" } }, { path: ["observations", "columns", made.name, "value"], value: named });
    } else if (meaning === "condition") {
      edits.push({ path: ["conditions", named], value: { unit: column.unit || "1" } });
    } else if (OF_ROWS.includes(key)) {
      const other = { order: "time", time: "order" }[key];
      if (other && (this.content.observations || {})[other] !== undefined && !meanings.some(([of]) => of === other)) edits.push({ path: ["observations", other], remove: true });
      edits.push({ path: ["observations", key], value: named });
    } else if (output !== undefined) {
      edits.push({ path: ["observations", "columns", output, key], value: named });
    }
    if (edits.length) this.page.edit(edits);
  }

  /** Asks for a new output; null if there is to be none. */
  async #newOutput(column) {
    const { words } = this;
    const name = make("input", { value: column.name, size: 14, autocomplete: "off" });
    const unit = make("input", { value: column.unit || "", size: 8, list: "units", autocomplete: "off", placeholder: "1" });
    const body = make("div", { class: "row" },
      make("label", { class: "labelled" }, make("span", { class: "key" }, words.name), name),
      make("label", { class: "labelled" }, make("span", { class: "key" }, words.unit), unit));
    const chosen = await this.page.dialog.choose(words.case_new_output, body, [[words.ok, "ok"], [words.cancel, null]]);
    return chosen && name.value.trim() !== "" ? { name: name.value.trim(), unit: unit.value.trim() } : null;
  }
}

