// The import of a spreadsheet: its cells, what is asked about them, and the controls that answer.

import { make } from "./parts.js";

const WAIT = 250;
const KINDS = ["heading", "quantity", "constant", "result", "combined", "expanded", "ignore"];
const SHAPES = ["normal", "rectangular", "triangular", "arcsine"];
// the fields about the sheet as a whole, with the choices of those that have any
const FIELDS = { sheet: null, unit: "", equation: "", numbers: "yes", k: "", distribution: SHAPES, coefficients: ["units", "ratios", "one"], estimate: "" };

const letter = place => (place >= 26 ? letter(Math.floor(place / 26) - 1) : "") + String.fromCharCode(65 + place % 26);
const placeOf = letters => [...letters.toUpperCase()].reduce((place, sign) => 26 * place + sign.charCodeAt(0) - 64, 0) - 1;

export class Import {
  constructor(page) {
    this.page = page;
    this.element = page.element;
    const on = (id, name, act) => this.element(id).addEventListener(name, act);
    on("pasted", "input", () => {
      clearTimeout(this.later);
      this.later = setTimeout(() => this.#pasted(), WAIT);
    });
    on("pick-sheet", "click", () => page.files.pick(".csv,.tsv,.xlsx,.xlsm"));
    on("leave-import", "click", () => page.hasFile ? page.turn("file") : page.beginning.show());
    on("use-budget", "click", () => this.#use());
    this.#forget();
  }

  get words() { return this.page.words; }

  show() {
    this.page.turn("import");
    this.element("pasted").focus();
  }

  translate() {
    this.shownKey = null;
    this.fields = null;
    if (this.given) this.#ask();
  }

  /** Nothing is said yet of a sheet. */
  #forget() {
    this.columns = new Map();
    this.units = new Map();
    this.rows = new Map();
    this.said = {};
    this.answer = null;
    this.shownKey = null;
    this.fields = null;
  }

  /** A file of this computer. */
  file(name, bytes) {
    this.page.turn("import");
    this.element("pasted").value = "";
    this.element("sheet-file").textContent = name;
    this.#take(name, bytes);
  }

  #pasted() {
    const text = this.element("pasted").value;
    this.element("sheet-file").textContent = "";
    if (text.trim() === "") {
      this.given = null;
      this.element("sheet").hidden = true;
      return;
    }
    // a corrected text is the same sheet
    const kept = this.given && this.given.isPasted;
    // cells that are copied from a spreadsheet have tabs between them
    const name = `${this.words.pasted_name}.${text.includes("\t") ? "tsv" : "csv"}`;
    this.#take(name, new TextEncoder().encode(text), true, kept);
  }

  #take(name, bytes, isPasted = false, kept = false) {
    let binary = "";
    for (let place = 0; place < bytes.length; place += 0x8000) binary += String.fromCharCode(...bytes.subarray(place, place + 0x8000));
    if (!kept) this.#forget();
    this.given = { name, base64: btoa(binary), isPasted };
    this.#ask();
  }

  #options() {
    const named = place => this.columns.get(place) || (this.answer && this.answer.sheet && (this.answer.sheet.columns[place] || {}).name);
    const options = {
      columns: [...this.columns].map(([place, name]) => [name, `#${place + 1}`]),
      "column-units": [...this.units].filter(([place]) => named(place)).map(([place, unit]) => [named(place), unit]),
      rows: [...this.rows].map(([row, kind]) => [kind, String(row)]),
    };
    for (const [name, value] of Object.entries(this.said)) {
      if (value === "") continue;
      if (name === "k") {
        const k = Number(value.replace(",", "."));
        if (Number.isFinite(k) && k > 0) options.k = k;
      } else if (name === "numbers") options.numbers = true;
      else options[name] = name === "estimate" && this.page.language === "de" ? value.replace(",", ".") : value;
    }
    return options;
  }

  /** Asks about the sheet with what is said of it; of several questions the newest one counts. */
  async #ask() {
    const number = this.number = (this.number || 0) + 1;
    const { name, base64 } = this.given;
    this.element("use-budget").disabled = true;
    try {
      const answer = await this.page.program.call("import", { name, base64, options: this.#options(), lang: this.page.language });
      if (number !== this.number) return;
      this.answer = answer;
      this.page.mistakes.told(null);
      this.#show();
    } catch (error) {
      if (number === this.number) this.page.failed(error);
    }
  }

  async #use() {
    if (!this.answer || !this.answer.text || !await this.page.files.mayLeave()) return;
    const { text } = this.answer;
    this.#forget();
    this.given = null;
    this.element("pasted").value = "";
    this.element("sheet").hidden = true;
    this.page.files.take(text, null, null);
  }

  // what is shown

  #show() {
    const { words, answer } = this;
    this.element("sheet").hidden = false;
    const { questions = [], mistakes = [], notes = [] } = answer;
    const open = questions.length + mistakes.length;
    this.element("sheet-state").textContent = open === 0 ? words.sheet_clear : words.sheet_open(open);
    this.element("use-budget").disabled = answer.text === undefined;
    this.element("sheet-questions").replaceChildren(...mistakes.map(of => this.#mistake(of)), ...questions.map(of => this.#question(of)));
    this.element("sheet-understood").hidden = notes.length === 0;
    this.element("sheet-notes").replaceChildren(...notes.map(note => make("li", {}, ...quoted(note))));
    this.#showFields();
    this.#showTable();
    const { more } = answer.sheet || {};
    this.element("sheet-more").textContent = more ? words.sheet_more(more) : "";
  }

  /** Which rows something is about, in words; nothing of what the headings leave open. */
  #where([first, last]) {
    const { heading } = this.answer.sheet || {};
    if (heading && first <= heading) return "";
    return make("span", { class: "detail" }, first === last ? this.words.sheet_row(first) : this.words.sheet_rows(first, last), " ");
  }

  #question({ about, readings, rows, controls }) {
    const { words } = this;
    return make("li", {},
      make("button", { type: "button", class: "asked", onclick: () => this.#goTo(controls, rows) }, this.#where(rows), make("span", { lang: "en" }, ...quoted(about))),
      readings.length ? make("span", { class: "readings" }, words.sheet_readings, " ", make("span", { lang: "en" }, ...quoted(readings.join("; ")))) : null,
      this.#answers(controls));
  }

  #mistake({ row, message, controls }) {
    // an option of the command line is a control here
    let place = 0;
    const text = message.replace(/`(--[^`]*)`/g, () => `\u201c${this.#label(controls[place++] || {})}\u201d`);
    return make("li", { class: "wrong" },
      row === null ? make("span", { lang: "en" }, ...quoted(text))
        : make("button", { type: "button", class: "asked", onclick: () => this.#goTo(controls, [row, row]) }, this.#where([row, row]), make("span", { lang: "en" }, ...quoted(text))),
      this.#answers(controls));
  }

  #answers(controls) {
    const labels = new Map(controls.map(control => [this.#label(control), control]));
    return labels.size === 0 ? null : make("span", { class: "ways" }, ...[...labels].map(([label, control]) =>
      make("button", { type: "button", onclick: () => this.#answerBy(control) }, label)));
  }

  /** A control in words, with what it would say. */
  #label({ option, name, value }) {
    const { words } = this;
    const column = words.sheet_columns[name] || name;
    if (option === "column") {
      if (name && value) return words.column_is(value, column);
      return value ? words.column_what(value) : name ? words.column_where(column) : words.column_any;
    }
    if (option === "column-unit") return name ? words.column_unit_of(column) : words.column_unit_any;
    if (option === "row") return name && value ? words.row_is(value, words.sheet_kinds[name] || name) : words.row_where(words.sheet_kinds[name] || name || "");
    const label = words.sheet_options[option] || option || "";
    const said = (words.sheet_values[option] || {})[value] || words.shapes[value] || value;
    return value && option !== "numbers" ? `${label}: ${said}` : label;
  }

  /** Says what a control says, or goes to it where something is still to be said. */
  #answerBy(control) {
    const { option, name, value } = control;
    const isComplete = option === "column" || option === "row" ? name && value : value || option === "numbers";
    if (isComplete && option !== "column-unit") {
      if (option === "column") this.#sayColumn(placeOf(value), name);
      else if (option === "row") value.split(",").forEach(row => this.#sayRow(Number(row), name));
      else this.said[option] = option === "numbers" ? "yes" : value;
      this.#ask();
    }
    this.#goTo([control], null);
  }

  #goTo(controls, rows) {
    const fields = [...controls.map(control => this.#fieldOf(control)), ...(rows ? [this.#at(`row ${rows[0]}`)] : [])];
    const field = fields.find(field => field && !field.hidden);
    if (!field) return;
    field.scrollIntoView({ block: "nearest", inline: "center" });
    field.focus();
  }

  #at(key) { return this.element("sheet").querySelector(`[data-key="${CSS.escape(key)}"]`); }

  #fieldOf({ option, name, value }) {
    const known = name && this.answer.sheet ? this.answer.sheet.columns.findIndex(of => of.name === name) : -1;
    if (option === "column") {
      // a column that is still to be chosen is one that nothing is known of
      const free = this.answer.sheet ? this.answer.sheet.columns.findIndex(of => of.name === null) : 0;
      return this.#at(`column ${value ? placeOf(value) : known >= 0 ? known : Math.max(0, free)}`);
    }
    if (option === "column-unit") return this.#at(`unit ${Math.max(0, known)}`);
    if (option === "row") return this.#at(value ? `row ${value.split(",")[0]}` : "row 1");
    return this.#at(`field ${option}`);
  }

  // the controls

  #sayColumn(place, name) {
    if (name === "") this.columns.delete(place);
    else {
      // of columns that hold one thing there is one
      if (!["remark", "description", "ignore"].includes(name)) for (const [other, own] of this.columns) if (own === name) this.columns.delete(other);
      this.columns.set(place, name);
    }
  }

  #sayRow(row, kind) {
    if (kind === "heading") for (const [other, own] of this.rows) if (own === kind) this.rows.delete(other);
    if (kind === "") this.rows.delete(row);
    else this.rows.set(row, kind);
  }

  #choice(key, label, options, act) {
    const choice = make("select", { "aria-label": label, onchange: () => { act(choice.value); this.#ask(); } },
      ...options.map(([value, text]) => make("option", { value }, text)));
    choice.dataset.key = key;
    return choice;
  }

  #text(key, label, act) {
    const field = make("input", { "aria-label": label, autocomplete: "off", spellcheck: false, autocapitalize: "off", size: 8, oninput: () => {
      act(field.value.trim());
      clearTimeout(this.later);
      this.later = setTimeout(() => this.#ask(), WAIT);
    } });
    field.dataset.key = key;
    return field;
  }

  #showFields() {
    const { words, answer } = this;
    const key = JSON.stringify(answer.sheets);
    if (this.fields !== key) {
      this.fields = key;
      const box = this.element("sheet-fields");
      box.replaceChildren(...Object.entries(FIELDS).flatMap(([name, kind]) => {
        const choices = name === "sheet" ? answer.sheets : name === "numbers" ? ["yes"] : kind;
        if (name === "sheet" && choices.length < 2) return [];
        const label = words.sheet_options[name];
        const say = value => { this.said[name] = value; if (name === "sheet") { this.columns.clear(); this.units.clear(); this.rows.clear(); } };
        const field = typeof choices === "string" ? this.#text(`field ${name}`, label, say)
          : this.#choice(`field ${name}`, label, [["", name === "sheet" ? words.sheet_of_budget : words.as_sheet], ...choices.map(value => [value, (words.sheet_values[name] || {})[value] || words.shapes[value] || value])], say);
        if (name === "equation") field.placeholder = "y = a/b";
        return [make("span", { class: name === "equation" ? "labelled wide" : "labelled" }, make("span", { class: "key", "aria-hidden": true }, label), field)];
      }));
    }
    for (const name of Object.keys(FIELDS)) this.#fill(`field ${name}`, this.said[name] || "");
    const k = this.#at("field k");
    if (this.said.k && this.#options().k === undefined) k.setAttribute("aria-invalid", "true"); else k.removeAttribute("aria-invalid");
  }

  #fill(key, value) {
    const field = this.#at(key);
    if (field && field.value !== value && document.activeElement !== field) field.value = value;
    else if (field && field.tagName === "SELECT") field.value = value;
  }

  #showTable() {
    const { words } = this;
    const { sheet, questions = [], mistakes = [] } = this.answer;
    this.element("sheet-scroll").hidden = !sheet;
    if (!sheet) return;
    const key = JSON.stringify(sheet.rows);
    if (this.shownKey !== key) {
      this.shownKey = key;
      const columns = [["", words.by_heading], ...sheet.names.map(name => [name, words.sheet_columns[name] || name])];
      const kinds = [["", words.by_words], ...KINDS.map(kind => [kind, words.sheet_kinds[kind]])];
      const head = sheet.columns.map((_, place) => make("th", { scope: "col" },
        make("span", { class: "letter" }, letter(place)),
        this.#choice(`column ${place}`, words.column_holds(letter(place)), columns, name => this.#sayColumn(place, name)),
        this.#text(`unit ${place}`, words.column_unit(letter(place)), unit => unit === "" ? this.units.delete(place) : this.units.set(place, unit))));
      const rows = sheet.rows.map((cells, line) => make("tr", {},
        make("th", { scope: "row" }, make("span", { class: "letter" }, String(line + 1)), this.#choice(`row ${line + 1}`, words.row_holds(line + 1), kinds, kind => this.#sayRow(line + 1, kind))),
        ...sheet.columns.map((_, place) => make("td", {}, cells[place] || ""))));
      this.element("sheet-table").replaceChildren(
        make("thead", {}, make("tr", {}, make("td", {}), ...head)), make("tbody", {}, ...rows));
    }
    const asked = new Set([...questions.flatMap(({ rows: [first, last] }) => first === last ? [first] : []), ...mistakes.map(of => of.row)]);
    const columns = new Set([...questions, ...mistakes].flatMap(of => of.controls).filter(of => of.option === "column" && of.value).map(of => placeOf(of.value)));
    sheet.columns.forEach(({ name, has_unit }, place) => {
      this.#fill(`column ${place}`, this.columns.get(place) || name || "");
      this.#at(`column ${place}`).closest("th").classList.toggle("asked", columns.has(place));
      this.#fill(`unit ${place}`, this.units.get(place) || "");
      const unit = this.#at(`unit ${place}`);
      unit.hidden = !has_unit;
      unit.placeholder = words.unit;
    });
    sheet.rows.forEach((_, line) => {
      this.#fill(`row ${line + 1}`, this.rows.get(line + 1) || (line + 1 === sheet.heading ? "heading" : ""));
      this.#at(`row ${line + 1}`).closest("tr").classList.toggle("asked", asked.has(line + 1));
    });
  }
}

/** A sentence whose quotes are set off. */
function quoted(sentence) {
  return sentence.split("`").map((part, place) => place % 2 ? make("code", {}, part) : part);
}
