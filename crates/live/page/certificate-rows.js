// The rows of a certificate: outputs of models, with what is changed for each.

import { at, make, unit } from "./parts.js";

export class CertificateRows {
  constructor(form) {
    this.form = form;
    this.chosen = "";
    this.contents = new Map();
    // values that are chosen to be changed, and not typed yet, by the place of the row
    this.pending = new Map();
  }

  get page() { return this.form.page; }
  get said() { return this.form.said; }
  get words() { return this.form.words; }

  get shape() {
    const rows = this.form.list(["rows"]).map(row => row && [row.model, row.output, row.table, Object.keys(row.set || {})]);
    const functions = this.form.list(["functions"]).map(of => of && [of.model, of.fit]);
    return [rows, functions, [...this.pending], this.chosen, this.contents.get(this.chosen) || null];
  }

  /** What is known of models is asked again. */
  forget() { this.contents.clear(); }

  build() {
    const { form, said } = this;
    const found = form.get(["rows"]);
    if (found !== undefined && !Array.isArray(found)) return [make("p", { class: "hint" }, said.only_text)];
    const rows = form.list(["rows"]);
    const functions = form.list(["functions"]);
    return [
      rows.length + functions.length ? null : make("p", { class: "hint" }, said.no_rows),
      make("div", { class: "rows" }, ...rows.map((row, place) => this.#row(row, place, rows.length))),
      make("div", { class: "rows" }, ...functions.map((of, place) => this.#function(of, place, functions.length))),
      this.#adder(),
    ].filter(part => part !== null);
  }

  /** What a row is called on the form. */
  name(place) { return this.said.row(place + 1); }

  #row(row, place, count) {
    const { form, said } = this;
    const path = ["rows", place];
    const of = this.name(place);
    if (row === null || typeof row !== "object") {
      return make("div", { class: "stated" }, make("p", { class: "head" }, make("b", {}, of), " ", said.only_text, form.movers(path, of, count)));
    }
    const model = form.models[row.model] || {};
    const outputs = model.outputs || [];
    const output = outputs.find(one => one.name === row.output);
    const tables = form.list(["layout", "tables"]).map(table => table && table.name).filter(name => typeof name === "string");
    const nominal = form.text([...path, "nominal"], said.nominal, { of, kind: "number", size: 9 });
    if (output && output.unit !== "1") nominal.firstChild.append(" in ", ...unit(output.unit));
    const names = [...new Set([...this.#files(), row.model].filter(name => typeof name === "string"))];
    const modelChoice = form.choice([...path, "model"], said.model, names.map(name => [name, this.#title(name)]), { of });
    modelChoice.classList.add("wide");
    form.fields.set(`${at(path)}#name`, form.fields.get(at([...path, "model"])));
    const about = output && output.about ? `${row.output}, ${output.about}` : row.output || "";
    return make("div", { class: "stated" },
      make("p", { class: "head" }, make("b", {}, `${place + 1}. ${about}`), form.movers(path, of, count)),
      model.error ? make("p", { class: "hint" }, model.error) : null,
      make("div", { class: "pairs" },
        modelChoice,
        form.choice([...path, "output"], said.output, [...outputs.map(one => [one.name, this.#quantity(one)])], { of }),
        tables.length ? form.choice([...path, "table"], said.in_table, [["", said.none], ...tables.map(name => [name, name])], { of }) : "",
        nominal,
        ...form.localized([...path, "label"], said.label, { of })),
      model.sweep ? make("p", { class: "hint" }, said.sweep(model.rows, (model.conditions || []).map(one => one.name).join(", "))) : null,
      this.#changed(row, place, model, of),
      this.#rarely(row, path, of));
  }

  #rarely(row, path, of) {
    const { form, said } = this;
    const name = `${at(path)}#more`;
    const keys = ["statement", "cmc", "cmc_floor"];
    const details = make("details", { class: "fold", open: form.folds.get(name) ?? keys.some(key => row[key] !== undefined), ontoggle: () => form.folds.set(name, details.open) },
      make("summary", {}, said.rarely),
      make("div", { class: "pairs" },
        form.text([...path, "cmc"], said.cmc, { of, kind: "number" }),
        form.choice([...path, "statement"], said.statement, [["", said.as_certificate], ...["auto", "gum", "monte-carlo"].map(value => [value, said.statements[value]])], { of }),
        row.cmc !== undefined ? form.yes([...path, "cmc_floor"], said.cmc_floor, false, of) : ""));
    return details;
  }

  /** The values that a row changes, and a choice of further ones. */
  #changed(row, place, model, of) {
    const { form, said, words } = this;
    const path = ["rows", place, "set"];
    const known = [...(model.conditions || []), ...(model.inputs || [])].map(one => one.readings
      ? { ...one, key: `${one.name}.values`, says: said.readings_of(one.name) } : { ...one, key: one.name, says: this.#quantity(one) });
    const set = Object.keys(row.set && typeof row.set === "object" ? row.set : {});
    const waiting = (this.pending.get(place) || []).filter(key => !set.includes(key));
    const fields = [...set, ...waiting].map(key => {
      const one = known.find(of => of.key === key);
      const field = form.text([...path, key], key, { of, kind: "number", size: 9 });
      const units = one && !one.readings && one.unit !== "1" ? unit(one.unit) : [];
      return make("span", { class: "changed" }, field, make("span", { class: "unit" }, ...units),
        form.button(`${at([...path, key])}#remove`, words.remove_of(words.of(key, of)), "×", () => {
          this.#drop(place, key);
          form.wanted = `${at(path)}#add`;
          if (set.includes(key)) form.edit(form.taken([...path, key])); else form.draw();
        }));
    });
    const rest = known.filter(one => !set.includes(one.key) && !waiting.includes(one.key));
    const add = make("select", {
      "aria-label": words.of(said.change, of),
      onchange: () => {
        if (add.value === "") return;
        this.pending.set(place, [...waiting, add.value]);
        form.wanted = at([...path, add.value]);
        form.draw();
      },
    }, make("option", { value: "" }, said.change), ...rest.map(one => make("option", { value: one.key }, one.says)));
    add.dataset.key = `${at(path)}#add`;
    form.buttons.set(add.dataset.key, add);
    return make("div", { class: "changes" }, ...fields, rest.length ? add : null);
  }

  #drop(place, key) {
    this.pending.set(place, (this.pending.get(place) || []).filter(of => of !== key));
  }

  #function(of, place, count) {
    const { form, said } = this;
    const path = ["functions", place];
    const name = said.function_of(of && of.fit || "");
    if (of === null || typeof of !== "object") return make("p", { class: "hint" }, said.only_text);
    return make("div", { class: "stated" },
      make("p", { class: "head" }, make("b", {}, name), " ", make("span", { class: "detail" }, this.#title(of.model || "")), form.movers(path, name, count)),
      make("div", { class: "pairs" }, ...form.localized([...path, "label"], said.label, { of: name })));
  }

  // adding rows

  #files() { return this.form.files.filter(file => file.kind === "model").map(file => file.name); }

  #title(name) {
    const file = this.form.files.find(of => of.name === name);
    return file && file.title ? `${file.title} (${name})` : name;
  }

  #quantity({ name, unit: of, about }) {
    return name + (of === "1" ? "" : ` (${of})`) + (about ? `, ${about}` : "");
  }

  /** A model, and its outputs to choose from. */
  #adder() {
    const { form, said, page } = this;
    const names = this.#files();
    const choice = make("select", {
      "aria-label": said.add_row, onchange: () => { this.chosen = choice.value; this.#look(); },
    }, make("option", { value: "" }, said.choose_model), ...names.map(name => make("option", { value: name, selected: name === this.chosen }, this.#title(name))));
    choice.dataset.key = "rows#model";
    form.buttons.set(choice.dataset.key, choice);
    const offered = this.contents.get(names.includes(this.chosen) ? this.chosen : "");
    const chip = (key, text, act) => {
      const button = make("button", { type: "button", class: "chip", onclick: () => { form.wanted = key; act(); } }, text);
      button.dataset.key = key;
      form.buttons.set(key, button);
      return button;
    };
    const chips = offered && !offered.error ? [
      said.state, " ",
      ...offered.outputs.map(of => chip(`rows#add#${of.name}`, this.#quantity(of), () => this.add([of.name]))),
      offered.outputs.length > 1 ? chip("rows#add", said.all_outputs, () => this.add(offered.outputs.map(of => of.name))) : null,
      ...offered.functions.map(name => chip(`rows#function#${name}`, said.function_of(name), () => this.#addFunction(name))),
    ].filter(part => part !== null) : [];
    const picked = make("input", { type: "file", multiple: true, hidden: true, accept: ".json,.csv,.png,.svg", onchange: () => form.take([...picked.files]) });
    return make("div", { class: "adder" },
      names.length ? make("label", {}, make("b", {}, said.add_row), " ", choice)
        : make("p", { class: "hint" }, page.program.hasFolder ? said.no_models : said.no_models_held),
      page.program.hasFolder ? null : make("button", { type: "button", onclick: () => picked.click() }, said.from_disk),
      picked,
      make("p", { class: "chips" }, ...chips),
      offered && offered.error ? make("p", { class: "hint" }, said.no_contents(offered.error)) : null);
  }

  async #look() {
    const model = this.chosen;
    if (model !== "" && !this.contents.has(model)) {
      try {
        this.contents.set(model, await this.page.program.call("model", { model }, { path: this.page.document.path }));
      } catch (error) { this.page.failed(error); }
    }
    this.form.draw();
  }

  /** Rows of these outputs of the chosen model. */
  add(outputs) {
    const { form } = this;
    const added = outputs.map(output => ({ model: this.chosen, output }));
    const many = form.list(["rows"]).length;
    form.edit(form.get(["rows"]) === undefined ? [{ path: ["rows"], value: added }]
      : added.map((value, place) => ({ path: ["rows", many + place], value })));
  }

  #addFunction(fit) {
    const { form } = this;
    const value = { model: this.chosen, fit };
    form.edit(form.get(["functions"]) === undefined ? [{ path: ["functions"], value: [value] }] : [{ path: ["functions", form.list(["functions"]).length], value }]);
  }
}
