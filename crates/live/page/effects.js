// The candidate effects of a case: ready-made ones to be ticked, and own ones.

import { at, free, labelled, make, wholeName } from "./parts.js";

// what a distribution has for how wide and where it is, in the order of reading
const ORDER = ["mean", "mode", "value", "lower", "upper", "std", "half_width", "expanded", "k"];

export class Effects {
  constructor(page, form) {
    this.page = page;
    this.form = form;
    this.all = null;
    this.boxes = [];
    this.pending = null;
    page.element("case-all").addEventListener("change", event => this.#set(event.target.checked ? "all" : []));
    page.element("case-search").addEventListener("input", () => this.#list());
    page.element("case-add-effect").addEventListener("click", () => this.#add());
  }

  get words() { return this.page.words; }

  get own() { return this.form.content.effects || {}; }

  /** The names that the file asks for, or "all"; what was ticked last may not be answered yet. */
  get ticked() { return this.pending || this.form.content.catalogue || []; }

  /** What the fields of the own effects depend on, but not what is in them. */
  shape() {
    const of = effect => [Object.keys(effect.overrides || {}), Object.entries(effect.parameters || {}).map(([name, of]) => [name, of && typeof of === "object" ? [of.distribution, Object.keys(of)] : ""])];
    return [Object.entries(this.own).map(([name, effect]) => [name, effect && typeof effect === "object" ? of(effect) : ""]), this.#targets()];
  }

  show() {
    if (this.page.isSettled) this.pending = null;
    this.#list();
    const all = this.page.element("case-all");
    all.checked = this.ticked === "all";
    for (const [name, effect] of Object.entries(this.own)) {
      this.form.fill(at(["effects", name]) + "#name", name);
      for (const target of Object.keys(effect && effect.overrides || {})) this.form.fill(at(["effects", name, "overrides", target]) + "#choice", target);
      for (const parameter of Object.keys(effect && effect.parameters || {})) this.form.fill(at(["effects", name, "parameters", parameter]) + "#name", parameter);
    }
  }

  // the catalogue

  async #load() {
    if (this.isLoading) return;
    this.isLoading = true;
    let listed;
    try { listed = await this.page.program.call("effects", {}); } catch (error) { return this.page.failed(error); } finally { this.isLoading = false; }
    this.all = new Map();
    // those of any bench first
    listed.sort((a, b) => (a.bench === "any" ? 0 : 1) - (b.bench === "any" ? 0 : 1));
    // one name may have several forms, for models that name their quantities differently
    for (const { name, about } of listed) {
      const known = this.all.get(name);
      if (!known) this.all.set(name, about);
      else if (!known.includes(about)) this.all.set(name, `${known} / ${about}`);
    }
    this.#list();
  }

  #set(names) {
    this.pending = names;
    this.page.edit([{ path: ["catalogue"], value: names }]);
  }

  #list() {
    if (!this.all) { this.#load(); return; }
    const { ticked, words } = this;
    const isAll = ticked === "all";
    const wanted = this.page.element("case-search").value.trim().toLowerCase();
    const place = this.page.element("case-catalogue");
    if (place.dataset.drawn !== wanted) {
      place.dataset.drawn = wanted;
      const shown = [...this.all].filter(([name, about]) => `${name} ${about}`.toLowerCase().includes(wanted));
      this.boxes = shown.map(([name]) => {
        const box = make("input", { type: "checkbox", onchange: () => this.#set(box.checked ? [...this.ticked, name] : this.ticked.filter(of => of !== name)) });
        return [name, box];
      });
      place.replaceChildren(...this.boxes.map(([name, box], number) =>
        make("label", { class: "effect", lang: "en" }, box, make("span", {}, make("b", {}, name), " ", make("span", { class: "detail" }, shown[number][1])))));
    }
    for (const [name, box] of this.boxes) {
      box.checked = isAll || ticked.includes(name);
      box.disabled = isAll;
    }
    this.page.element("case-chosen").textContent = isAll ? words.case_chosen_all : ticked.length ? words.case_chosen(ticked.join(", ")) : !this.boxes.length ? words.case_no_effect : words.case_chosen_none;
  }

  // own effects

  /** What an effect can change. */
  #targets() {
    const { found } = this.form;
    const names = of => (of || []).filter(row => !row.component).map(row => row.name);
    return [...new Set([...names(found.outputs), ...names(found.inputs), ...names(found.equations)])];
  }

  build() {
    this.page.element("case-own").replaceChildren(...Object.entries(this.own)
      .filter(([, effect]) => effect && typeof effect === "object").map(([name, effect]) => this.#effect(name, effect)));
    this.page.element("case-add-effect").disabled = this.#targets().length === 0;
  }

  #effect(name, effect) {
    const { words, form } = this;
    const path = ["effects", name];
    const above = { name: this.#name(path, words.case_effect_name(name), to => [{ path, rename: to }]), about: form.field([...path, "about"], words.of(words.key.about, name), { kind: "text", class: "about", size: 18 }) };
    const labelled = (word, field, more = "") => make("span", { class: `labelled ${more}` }, make("span", { class: "key", "aria-hidden": true }, word), field);
    return make("fieldset", { class: "own-effect" }, make("legend", {}, name),
      make("div", { class: "row" }, labelled(words.key.name, above.name), labelled(words.key.about, above.about), form.remove(path, name)),
      ...Object.entries(effect.overrides || {}).map(([target]) => this.#override(path, name, target, effect)),
      ...Object.entries(effect.parameters || {}).map(([parameter, of]) => this.#parameter(path, name, parameter, of || {})),
      make("p", {},
        make("button", { type: "button", onclick: () => this.#change(path, effect) }, words.case_add_override), " ",
        make("button", { type: "button", onclick: () => this.page.edit([{ path: [...path, "parameters", free("d", Object.keys(effect.parameters || {}))], value: parameterOf("1") }]) }, words.case_add_parameter)));
  }

  /** A field of a name: another one is another key. */
  #name(path, label, edits) {
    const before = path[path.length - 1];
    const field = make("input", { autocomplete: "off", spellcheck: false, autocapitalize: "off", size: 12, "aria-label": label,
      onchange: () => {
        const to = field.value.trim();
        if (to === "" || to === before) field.value = before;
        else this.page.edit(edits(to));
      } });
    field.dataset.key = at(path) + "#name";
    this.form.fields.set(field.dataset.key, field);
    return field;
  }

  #override(above, name, target, effect) {
    const { words, form } = this;
    const path = [...above, "overrides", target];
    const targets = this.#targets();
    if (!targets.includes(target)) targets.push(target);
    const taken = Object.keys(effect.overrides);
    const choice = make("select", { "aria-label": words.case_changes(name), onchange: () => this.page.edit([{ path, rename: choice.value }]) },
      ...targets.filter(of => of === target || !taken.includes(of)).map(value => make("option", { value }, value)));
    choice.value = target;
    choice.dataset.key = at(path) + "#choice";
    form.fields.set(choice.dataset.key, choice);
    return make("div", { class: "row" },
      labelled(words.case_changes_short, choice),
      make("span", { class: "labelled wide" }, make("span", { class: "key", "aria-hidden": true }, words.case_becomes),
        form.field(path, words.case_formula(target, name), { kind: "text", size: 24 })),
      taken.length > 1 ? form.remove(path, target) : null);
  }

  #parameter(above, effect, name, of) {
    const { words, form } = this;
    const path = [...above, "parameters", name];
    const { distributions, ways } = this.page.form.kinds;
    const shape = distributions.find(known => known.name === of.distribution || known.aliases.includes(of.distribution));
    const choice = make("select", { "aria-label": words.of(words.distribution, name), onchange: () => this.page.reshape(path, choice.value) },
      ...distributions.map(({ name: value }) => make("option", { value }, words.shapes[value] || value)));
    if (!shape) choice.prepend(make("option", { value: of.distribution || "" }, of.distribution || words.written));
    choice.value = shape ? shape.name : of.distribution || "";
    choice.dataset.key = at([...path, "distribution"]) + "#choice";
    form.fields.set(choice.dataset.key, choice);
    const { needed } = shape && ways.find(way => way.distribution === shape.name) || { needed: [] };
    const keys = shape ? shape.keys.filter(key => of[key] !== undefined && typeof of[key] !== "object" || of[key] === null || needed.includes(key) && !has(of, "expanded")) : [];
    const rank = key => (ORDER.indexOf(key) + 99) % 99;
    const cells = [...keys].sort((a, b) => rank(a) - rank(b)).map(key => form.labelled({ key, path: [...path, key] }, name, key === "unit" || key === "about" ? "text" : null));
    const rename = to => {
      const whole = wholeName(name);
      const formulas = Object.entries(this.own[effect].overrides || {}).map(([target, formula]) => [target, formula, formula.replace(whole, to)]);
      return [{ path, rename: to }, ...formulas.filter(([, old, now]) => old !== now).map(([target, , value]) => ({ path: [...above, "overrides", target], value }))];
    };
    return make("div", { class: "row" },
      labelled(words.case_parameter, this.#name(path, words.case_parameter_name(name), rename)),
      labelled(words.distribution, choice), ...cells,
      labelled(words.unit, form.field([...path, "unit"], words.of(words.unit, name), { kind: "text", list: "units", size: 6, class: "unit" })),
      form.remove(path, name));
  }

  #change(path, effect) {
    const target = this.#targets().find(of => !has(effect.overrides || {}, of));
    if (target) this.page.edit([{ path: [...path, "overrides", target], value: target }]);
  }

  #add() {
    const [target] = this.#targets();
    const output = (this.form.content.outputs || {})[target];
    const unit = output && output.unit || "1";
    const value = { about: "", parameters: { d: parameterOf(unit) }, overrides: { [target]: `${target} + d` } };
    this.page.edit([{ path: ["effects", free("effect", Object.keys(this.own))], value }]);
  }

  /** Adds an effect that the diagnosis composed, as cases have it. */
  addComposed({ name, about, parameters, overrides }) {
    this.page.edit([{ path: ["effects", name], value: { about, parameters, overrides } }]);
  }

  /** Adds a ready-made effect to the list. */
  addListed(name) { this.#set([...this.ticked, name]); }

  /** Whether the list has it already. */
  has(name) { return has(this.own, name) || this.ticked === "all" && (this.all || new Map()).has(name) || this.ticked.includes(name); }
}

const has = (of, key) => Object.prototype.hasOwnProperty.call(of, key);

/** What is known of a new parameter: about nothing, by an uncertainty that is to be stated. */
const parameterOf = unit => ({ unit, distribution: "normal", mean: 0, std: null });
