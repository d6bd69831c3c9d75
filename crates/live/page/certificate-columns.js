// The table of a certificate: which columns it has, their order and headings.

import { make } from "./parts.js";

const CONTENTS = ["value", "U", "k", "nu_eff", "p", "limits", "decision", "label"];
const WITH_UNIT = ["value", "U", "limits"];

export class CertificateColumns {
  constructor(form) { this.form = form; }

  get said() { return this.form.said; }
  get words() { return this.form.words; }

  get shape() {
    const columns = this.form.list(["layout", "columns"]).map(column => typeof column === "string" ? column : column && [column.quantity, column.show]);
    return [columns, this.form.list(["layout", "tables"]).length];
  }

  /** A column that is written as a text, as an object. */
  whole(text) {
    const found = /^([^()]+)\(([^()]*)\)$/.exec(text.trim());
    const [show, quantity] = found ? [found[1].trim(), found[2].trim()] : CONTENTS.includes(text.trim()) ? [text.trim(), undefined] : ["value", text.trim()];
    return { ...(quantity === undefined ? {} : { quantity }), ...(show === "value" ? {} : { show }) };
  }

  /** The models of the rows, each once, with the outputs that are stated. */
  #models() {
    const rows = this.form.list(["rows"]).filter(row => row && typeof row === "object");
    return [...new Set(rows.map(row => row.model))].map(name => this.form.models[name]).filter(model => model && !model.error)
      .map(model => ({ ...model, stated: model.outputs.filter(output => rows.some(row => this.form.models[row.model] === model && row.output === output.name)) }));
  }

  #stated() {
    const all = new Map();
    for (const model of this.#models()) {
      for (const output of model.stated) all.set(output.name, { ...output, tolerance: output.tolerance || Boolean((all.get(output.name) || {}).tolerance) });
    }
    return [...all.values()];
  }

  #known(key) {
    const all = new Map(this.#models().flatMap(model => model[key]).map(of => [of.name, of]));
    return [...all.values()].filter(of => !this.#stated().some(output => output.name === of.name));
  }

  /** A column as the file has it: short where that says it. */
  #column(show, quantity) {
    if (show === "label") return "label";
    if (show === "value") return CONTENTS.includes(quantity) ? { quantity } : quantity;
    return this.#stated().length === 1 ? show : `${show}(${quantity})`;
  }

  /** What a column shows, in words. */
  #name(column) {
    const { show = "value", quantity } = typeof column === "string" ? this.whole(column) : column;
    const stated = this.#stated();
    const of = quantity === undefined && stated.length === 1 ? stated[0].name : quantity;
    if (show === "value") return of || "";
    if (show === "label") return this.said.contents.label;
    return of === undefined ? this.said.contents[show] || show : this.words.of(this.said.contents[show] || show, of);
  }

  build() {
    const { form, said } = this;
    const layout = form.get(["layout"]);
    const tables = form.list(["layout", "tables"]);
    if (tables.length) return [make("p", { class: "hint" }, said.several_tables(tables.length))];
    const columns = form.get(["layout", "columns"]);
    if (layout !== undefined && (layout === null || typeof layout !== "object") || columns !== undefined && !Array.isArray(columns)) return [make("p", { class: "hint" }, said.only_text)];
    const isUsual = layout === undefined;
    const stated = this.#stated();
    const choice = make("select", {
      "aria-label": said.columns,
      onchange: () => {
        if (choice.value === "usual") form.edit(form.taken(["layout"]));
        else form.edit([{ path: ["layout"], value: { columns: this.#usual() } }]);
      },
    }, make("option", { value: "usual" }, said.usual_table), make("option", { value: "own" }, said.own_columns));
    choice.value = isUsual ? "usual" : "own";
    choice.disabled = isUsual && stated.length === 0;
    choice.dataset.key = "layout#choice";
    form.buttons.set(choice.dataset.key, choice);
    const head = make("p", {}, make("label", {}, said.columns, " ", choice));
    if (isUsual) return [head, ...(stated.length ? [] : [make("p", { class: "hint" }, said.rows_first)])];
    return [head,
      make("div", { class: "pairs" }, ...form.localized(["layout", "title"], said.table_title)),
      make("ol", { class: "columns" }, ...form.list(["layout", "columns"]).map((column, place, all) => this.#line(column, place, all.length))),
      this.#adder()];
  }

  /** The columns to begin with. */
  #usual() {
    const conditions = this.#known("conditions").map(of => this.#column("value", of.name));
    const outputs = this.#stated().flatMap(of => [this.#column("value", of.name), this.#column("U", of.name), this.#column("k", of.name)]);
    return [...(conditions.length ? conditions : ["label"]), ...outputs];
  }

  #line(column, place, count) {
    const { form, said } = this;
    const path = ["layout", "columns", place];
    if (column === null || typeof column !== "string" && typeof column !== "object") return make("li", {}, said.only_text);
    const name = this.#name(column);
    const of = said.column(place + 1);
    const { show = "value", quantity } = typeof column === "string" ? this.whole(column) : column;
    const isKnown = show === "value" && !this.#stated().some(output => output.name === quantity);
    const relative = this.#relative();
    return make("li", {},
      make("p", { class: "head" }, make("b", {}, name), form.movers(path, name, count, ["layout"])),
      make("div", { class: "pairs" },
        ...form.localized([...path, "heading"], said.heading, { of }),
        WITH_UNIT.includes(show) ? form.text([...path, "unit"], this.words.unit, { of, size: 6, list: "units" }) : "",
        show === "U" ? form.choice([...path, "relative_to"], said.relative_to, [["", said.itself], ...relative.map(one => [one, one])], { of }) : "",
        isKnown ? form.number([...path, "decimals"], said.decimals, { of, size: 3 }) : ""));
  }

  #relative() {
    return [...this.#stated(), ...this.#known("conditions"), ...this.#known("inputs")].map(of => of.name);
  }

  #adder() {
    const { form, said } = this;
    const outputs = this.#stated().map(of => [of.name, [
      ["value", of.name], ["U", of.name], ["k", of.name], ["nu_eff", of.name], ["p", of.name],
      ...(of.tolerance ? [["limits", of.name], ["decision", of.name]] : []),
    ]]);
    const others = [[said.names.conditions_known, this.#known("conditions")], [this.words.inputs, this.#known("inputs")]]
      .map(([title, all]) => [title, all.map(of => ["value", of.name])]);
    const groups = [[said.row(""), [["label", ""]]], ...outputs, ...others].filter(([, all]) => all.length);
    const offered = groups.flatMap(([, all]) => all);
    let number = 0;
    const add = make("select", {
      "aria-label": said.add_column,
      onchange: () => {
        if (add.value === "") return;
        const place = form.list(["layout", "columns"]).length;
        const value = this.#column(...offered[Number(add.value)]);
        form.wanted = "columns#add";
        form.edit(place ? [{ path: ["layout", "columns", place], value }] : [{ path: ["layout", "columns"], value: [value] }]);
      },
    }, make("option", { value: "" }, said.choose_column), ...groups.map(([label, all]) => make("optgroup", { label: label.trim() }, ...all.map(([show, quantity]) =>
      make("option", { value: String(number++) }, this.#name({ show, quantity }))))));
    add.dataset.key = "columns#add";
    form.buttons.set(add.dataset.key, add);
    return make("p", { class: "adder" }, make("label", {}, make("b", {}, said.add_column), " ", add));
  }
}
