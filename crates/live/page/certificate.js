// The form of a certificate: what its file says, section by section in the order of the printed page.

import { CertificateColumns } from "./certificate-columns.js";
import { CertificateRows } from "./certificate-rows.js";
import { Fields } from "./fields.js";
import { at, folderOf, make, relative } from "./parts.js";

const LANGUAGES = ["en", "de", "fr", "it"];
const PARTY = ["name", "street", "street_number", "post_code", "city", "country", "email", "phone", "code"];
const PLACES = ["laboratory", "customer", "laboratoryBranch", "customerBranch", "other"];
const TEXTS = ["environment", "method", "traceability"];
const COVERAGE = ["coverage_factor", "coverage_probability"];

const isObject = value => typeof value === "object" && value !== null && !Array.isArray(value);
const isDay = text => /^\d{4}-\d\d-\d\d$/.test(text) && !Number.isNaN(Date.parse(text));

export class CertificateForm extends Fields {
  constructor(page) {
    super(page, "certificate-form");
    this.content = {};
    this.models = {};
    this.files = [];
    this.shape = "";
    this.folds = new Map();
    this.rows = new CertificateRows(this);
    this.columns = new CertificateColumns(this);
  }

  get said() { return this.words.certificate; }

  /** Shows what an answer says of the file; `force` also in the field that somebody writes in. */
  show(found, force = false) {
    // a text with an error in its brackets has no content: the fields stay as they are
    if (!isObject(found.content)) return;
    if (force) this.forget();
    this.content = found.content;
    this.models = found.models || {};
    this.#lookForFiles();
    this.draw();
  }

  /** The fields as the content asks for them. */
  draw() {
    const days = ["receipt_date", "issue_date", "calibration_date"].flatMap(key => this.get([key]) || []).map(isDay);
    const shape = JSON.stringify([this.page.language, this.languages, skeleton(this.content, this.languages),
      days.includes(false), COVERAGE.map(key => this.get([key]) !== undefined), ["device", "customer", "laboratory"].map(key => typeof this.get([key])),
      this.models, this.files, this.rows.shape, this.columns.shape]);
    if (shape !== this.shape) {
      this.shape = shape;
      this.shown = [];
      this.buttons = new Map();
      this.rebuild(() => this.element.replaceChildren(...this.#sections()));
    }
    for (const show of this.shown) show();
    const button = this.wanted && (this.fields.get(this.wanted) || this.buttons.get(this.wanted));
    if (button) { button.focus(); this.wanted = null; }
  }

  // the files of the folder

  /** The folder of the open file. */
  get folder() { return folderOf(this.page.document.path); }

  async #lookForFiles() {
    const of = `${this.page.document.path}\u0001${this.page.pristine}`;
    if (this.lookedFor === of) return;
    this.lookedFor = of;
    await this.lookAgain();
  }

  /** The files have changed. */
  async lookAgain() {
    try {
      const { files } = await this.page.program.ask("files", {});
      this.files = files.filter(file => ["model", "picture"].includes(file.kind) && file.path !== this.page.document.path)
        .map(({ path, kind, title }) => ({ name: relative(this.folder, path), kind, title }));
      this.rows.forget();
      this.draw();
    } catch (error) { this.page.failed(error); }
  }

  /** Models and pictures of this computer, for a page without a folder. */
  async take(files) {
    for (const file of files) await this.page.program.hold(file.name, await file.arrayBuffer());
    await this.lookAgain();
    this.page.result.reported = null;
    this.page.ask();
  }

  /** The file gets its first place: the files that it names are found from there. */
  moved(path) {
    const folder = folderOf(path);
    const edits = [];
    const name = (...of) => {
      const now = this.get(of);
      if (typeof now === "string" && now !== "" && relative(folder, now) !== now) edits.push({ path: of, value: relative(folder, now) });
    };
    for (const key of ["rows", "functions"]) this.list([key]).forEach((_, place) => name(key, place, "model"));
    for (const key of ["logo", "accreditation_mark"]) name("letterhead", key);
    if (edits.length) this.edit(edits);
  }

  // what the file says

  get languages() {
    const found = this.content.language;
    const all = (Array.isArray(found) ? found : [found]).filter(code => LANGUAGES.includes(code));
    return all.length ? [...new Set(all)] : ["en"];
  }

  get(path) {
    return path.reduce((value, key) => value === null || typeof value !== "object" ? undefined : value[key], this.content);
  }

  list(path) {
    const found = this.get(path);
    return Array.isArray(found) ? found : [];
  }

  /** A value as a field shows it. */
  written(path) {
    const found = this.get(path);
    return typeof found === "string" ? found : "";
  }

  // changes

  /** Changes the file, and at once what is known of it. */
  edit(edits, kind = null) {
    if (edits.length === 0) return;
    for (const edit of edits) apply(this.content, edit);
    this.page.edit(edits, kind);
  }

  /** Edits that write a value; a text on the way to it becomes an object that says the same. */
  put(path, given) {
    for (let depth = 1; depth < path.length; depth++) {
      const here = this.get(path.slice(0, depth));
      if (here === undefined) break;
      if (typeof here !== "string" && here !== null) continue;
      const whole = here === null ? {} : this.#grown(path.slice(0, depth), here);
      const rest = path.slice(depth);
      let inside = whole;
      for (const key of rest.slice(0, -1)) inside = inside[key] ||= {};
      inside[rest[rest.length - 1]] = given.value !== undefined ? given.value : numberOrText(given.typed);
      return [{ path: path.slice(0, depth), value: whole }];
    }
    return [{ path, ...given }];
  }

  /** Edits that take a value away, and what would be empty without it. */
  taken(path) {
    let whole = path;
    if (this.get(path) === undefined) return [];
    while (whole.length > 1) {
      const above = whole.slice(0, -1);
      const inside = this.get(above);
      const isElement = typeof above[above.length - 1] === "number";
      if (isElement || Object.keys(inside).length > 1 || above[0] === "rows" && above.length === 1) break;
      whole = above;
    }
    return [{ path: whole, remove: true }];
  }

  #grown(path, text) {
    return path[0] === "layout" ? this.columns.whole(text) : { name: text };
  }

  /** What was typed into a field becomes part of the file. */
  typed(field, path, kind) {
    field.written = field.value;
    field.writtenKind = null;
    if (kind === "days") return this.#days();
    if (kind === "localized") return this.#localizedTyped(path.slice(0, -1), path[path.length - 1], field.value);
    let text = kind === "text" ? field.value : field.value.trim();
    if (kind === "country") text = text.trim().toUpperCase();
    if (text.trim() === "") return this.edit(this.taken(path));
    if (!["text", "country"].includes(kind) && this.page.language === "de" && /^[-+]?\d+,\d+(e[-+]?\d+)?$/i.test(text)) text = text.replace(",", ".");
    this.#write(path, ["text", "country"].includes(kind) ? { value: text } : { typed: text });
  }

  #write(path, given) {
    const edits = this.put(path, given);
    // changes of one value that wait are made as one, others each after the other
    const isAlone = edits.length === 1 && edits[0].path.length === path.length;
    this.edit(edits, isAlone ? `typed:${at(path)}` : null);
  }

  #localizedTyped(path, language, text) {
    const now = this.get(path);
    if (isObject(now)) {
      if (text.trim() === "") this.edit(this.taken([...path, language]));
      else this.#write([...path, language], { value: text });
      return;
    }
    const all = {};
    for (const code of this.languages) {
      const field = this.fields.get(at([...path, code]));
      if (field && field.value.trim() !== "") all[code] = field.value;
    }
    const codes = Object.keys(all);
    if (codes.length === 0) this.edit(this.taken(path));
    else if (codes.length === 1 && codes[0] === this.languages[0]) this.#write(path, { value: all[codes[0]] });
    else this.edit(this.put(path, { value: all }));
  }

  #days() {
    const [first, last] = ["first", "last"].map(of => this.fields.get(at(["calibration_date", of])).value);
    const path = ["calibration_date"];
    if (first === "" && last === "") this.edit(this.taken(path));
    else this.edit([{ path, value: first !== "" && last !== "" && first !== last ? [first, last] : first || last }]);
  }

  // kinds of fields

  /** What is shown again with each answer. */
  whenShown(show) { this.shown.push(show); }

  /** A field with its label: `of` names what it belongs to, for those who do not see it. */
  named(label, field, properties = {}) {
    return make("label", { class: "labelled", ...properties }, make("span", { class: "key" }, label), field);
  }

  /** A field of text; a value that no field can say stays as it is. */
  text(path, label, { of = null, show = null, ...properties } = {}) {
    const found = this.get(path);
    if (found !== undefined && typeof found !== "string") return this.named(label, make("input", { disabled: true, value: this.said.only_text, "aria-label": of ? this.words.of(label, of) : label }));
    const field = this.field(path, of ? this.words.of(label, of) : label, { kind: "text", size: 12, ...properties });
    this.whenShown(() => this.fill(at(path), show ? show() : this.written(path), "text"));
    return this.named(label, field, properties.wide ? { class: "labelled wide" } : {});
  }

  number(path, label, properties = {}) {
    return this.text(path, label, { kind: "number", inputmode: "decimal", size: 7, ...properties });
  }

  day(path, label, show = null, kind = "text") {
    const written = show ? show() : this.written(path);
    // a day that no calendar has is shown as it is written
    const type = written === "" || isDay(written) ? "date" : "text";
    return this.text(path, label, { type, kind, show });
  }

  choice(path, label, options, { of = null, act = null } = {}) {
    const now = this.written(path);
    const known = options.some(([value]) => value === now) || now === "" ? options : [...options, [now, now]];
    const field = make("select", {
      "aria-label": of ? this.words.of(label, of) : label,
      onchange: () => act ? act(field.value) : field.value === "" ? this.edit(this.taken(path)) : this.#write(path, { value: field.value }),
    }, ...known.map(([value, name]) => make("option", { value }, name)));
    field.dataset.key = at(path);
    this.fields.set(at(path), field);
    this.whenShown(() => this.fill(at(path), this.written(path)));
    return this.named(label, field);
  }

  /** A choice of yes and no; `usual` is what holds if the file says nothing. */
  yes(path, label, usual, of = null) {
    const field = make("input", {
      type: "checkbox", "aria-label": of ? this.words.of(label, of) : label,
      onchange: () => field.checked === usual ? this.edit(this.taken(path)) : this.edit(this.put(path, { value: field.checked })),
    });
    field.dataset.key = at(path);
    this.fields.set(at(path), field);
    this.whenShown(() => { const now = this.get(path); field.checked = typeof now === "boolean" ? now : usual; });
    return make("label", { class: "yes" }, field, " ", label);
  }

  /** A text in each language of the certificate, and in those that the file has besides. */
  localized(path, label, { of = null, lines = false, size = 16 } = {}) {
    const now = this.get(path);
    const others = isObject(now) ? LANGUAGES.filter(code => code in now && !this.languages.includes(code)) : [];
    const codes = [...this.languages, ...others];
    const fields = codes.map(code => {
      const own = codes.length > 1 ? `${label} (${this.said.in_language[code]})` : label;
      const name = of ? this.words.of(own, of) : own;
      const key = [...path, code];
      const field = this.field(key, name, { kind: "localized", size, lang: code, lines });
      const show = () => {
        const value = this.get(path);
        this.fill(at(key), isObject(value) ? this.written(key) : code === this.languages[0] && typeof value === "string" ? value : "", "text");
      };
      this.whenShown(show);
      return this.named(own, field, { class: lines || codes.length > 1 ? "labelled" : "labelled wide" });
    });
    this.fields.set(`${at(path)}#name`, this.fields.get(at([...path, codes[0]])));
    return lines || codes.length > 1 ? [make("div", { class: "in-languages" }, ...fields)] : fields;
  }

  /** A field of one line, or of several. */
  field(path, label, { lines = false, wide = false, ...properties } = {}) {
    const field = super.field(path, label, properties);
    if (!lines) return field;
    const area = make("textarea", {
      rows: 2, "aria-label": label, spellcheck: true, lang: properties.lang,
      oninput: () => { area.isTyped = true; this.typed(area, path, properties.kind); },
      onblur: () => { area.isTyped = false; },
    });
    area.dataset.key = at(path);
    this.fields.set(at(path), area);
    return area;
  }

  /** The field of a path; where rows or columns are missing, what adds them. */
  fieldAt(path) {
    return super.fieldAt(path) || this.buttons.get({ rows: "rows#model", layout: "layout#choice" }[path[0]]) || null;
  }

  /** A button whose place is found again when the form is made anew. */
  button(key, label, sign, act, isDisabled = false) {
    const button = make("button", { type: "button", class: sign === "×" ? "icon remove" : "icon", "aria-label": label, title: label, disabled: isDisabled, onclick: act }, sign);
    button.dataset.key = key;
    this.buttons.set(key, button);
    return button;
  }

  /** The buttons that move an element of a list, and take it away. */
  movers(path, name, count, whole = path.slice(0, -1)) {
    const place = path[path.length - 1];
    const above = path.slice(0, -1);
    const move = to => {
      this.wanted = `${at([...above, to])}#${to < place ? "up" : "down"}`;
      this.rows.pending.clear();
      this.edit([{ path, exchange: to }]);
    };
    const { said } = this;
    return make("span", { class: "movers" },
      this.button(`${at(path)}#up`, said.up(name), "↑", () => move(place - 1), place === 0),
      this.button(`${at(path)}#down`, said.down(name), "↓", () => move(place + 1), place === count - 1),
      this.button(`${at(path)}#remove`, this.words.remove_of(name), "×", () => {
        this.wanted = count > 1 ? `${at([...above, Math.max(0, place - 1)])}#remove` : null;
        this.rows.pending.clear();
        this.edit(count === 1 && above[0] !== "rows" ? this.taken(whole) : [{ path, remove: true }]);
      }));
  }

  // the sections

  #section(name, title, isOpen, ...children) {
    const details = make("details", { class: "section", open: this.folds.has(name) ? this.folds.get(name) : isOpen,
      ontoggle: () => this.folds.set(name, details.open) },
    make("summary", {}, title), ...children);
    return details;
  }

  #grid(...children) { return make("div", { class: "pairs" }, ...children.flat()); }

  #sections() {
    const { said } = this;
    const whole = name => typeof this.get([name]) === "string";
    // a party or a device that is a text is a name
    const party = name => this.#grid(PARTY.map(key => this.text(key === "name" && whole(name) ? [name] : [name, key], said.party[key], {
      of: said[name], kind: key === "country" ? "country" : "text", wide: key === "name" || key === "email",
      class: key === "country" ? "upper" : null,
    })));
    const device = whole("device")
      ? this.text(["device"], said.device_key.name, { of: said.device, wide: true })
      : this.localized(["device", "name"], said.device_key.name, { of: said.device });
    const own = key => this.text(["device", key], said.device_key[key], { of: said.device });
    const days = this.get(["calibration_date"]);
    const day = place => () => Array.isArray(days) ? this.written(["calibration_date", place]) : place === 0 ? this.written(["calibration_date"]) : "";
    const remarks = this.get(["remarks"]);
    return [
      this.#section("head", said.head, true, this.#grid(
        this.text(["number"], said.number),
        this.localized(["title"], said.title))),
      this.#section("device", said.device, true, this.#grid(device, ["manufacturer", "model", "serial_number", "customer_number"].map(own),
        whole("device") ? [] : this.localized(["device", "condition"], said.device_key.condition, { of: said.device }))),
      this.#section("customer", said.customer, true, party("customer")),
      this.#section("laboratory", said.laboratory, true, party("laboratory")),
      this.#section("dates", said.dates, true, this.#grid(
        this.day(["receipt_date"], said.receipt),
        this.day(["calibration_date", "first"], said.first_day, day(0), "days"),
        this.day(["calibration_date", "last"], said.last_day, day(1), "days"),
        this.day(["issue_date"], said.issue),
        this.choice(["place"], said.place, [["", said.usual(said.places.laboratory)], ...PLACES.map(of => [of, said.places[of]])]),
        this.text(["responsible"], said.responsible))),
      this.#section("texts", said.texts, TEXTS.some(key => this.get([key]) !== undefined), ...TEXTS.map(key => this.#grid(this.localized([key], said.text_key[key], { lines: true }))),
        Array.isArray(remarks)
          ? make("div", {}, ...remarks.map((_, place) => make("div", { class: "pairs" }, this.text(["remarks", place], `${said.text_key.remarks} ${place + 1}`, { wide: true }), this.movers(["remarks", place], `${said.text_key.remarks} ${place + 1}`, remarks.length))))
          : this.#grid(this.localized(["remarks"], said.text_key.remarks, { lines: true }))),
      this.#section("rows", said.rows, true, ...this.rows.build()),
      this.#section("numbers", said.numbers, false, this.#languages(), this.#numbers()),
      this.#section("table", said.table, false, ...this.columns.build()),
      this.#section("letterhead", said.letterhead, false, this.#letterhead()),
      this.#section("more", said.more, false, ...this.#more()),
    ];
  }

  #languages() {
    const { said } = this;
    const write = all => {
      const path = ["language"];
      this.edit(all.length === 1 && all[0] === "en" ? this.taken(path) : [{ path, value: all.length === 1 ? all[0] : all }]);
    };
    const boxes = LANGUAGES.map(code => {
      const box = make("input", {
        type: "checkbox",
        onchange: () => {
          const all = box.checked ? [...this.languages, code] : this.languages.filter(of => of !== code);
          // a certificate has at least one
          if (all.length) write(all); else box.checked = true;
        },
      });
      box.dataset.key = `language#${code}`;
      this.buttons.set(box.dataset.key, box);
      this.whenShown(() => { box.checked = this.languages.includes(code); });
      return make("label", { class: "yes" }, box, " ", said.in_language[code]);
    });
    const first = this.languages.length < 2 ? null : make("label", { class: "yes" }, said.first_language, " ",
      make("select", { "aria-label": said.first_language, onchange: event => write([event.target.value, ...this.languages.filter(of => of !== event.target.value)]) },
        ...this.languages.map(code => make("option", { value: code, selected: code === this.languages[0] }, said.in_language[code]))));
    return make("fieldset", { class: "boxes" }, make("legend", {}, said.languages), ...boxes, first);
  }

  #numbers() {
    const { said } = this;
    const kind = COVERAGE.find(key => this.get([key]) !== undefined) || "";
    const coverage = make("select", {
      "aria-label": said.coverage,
      onchange: () => {
        const gone = [...COVERAGE, "coverage_factor_fixed"].filter(key => this.get([key]) !== undefined && key !== coverage.value);
        const usual = { coverage_factor: 2, coverage_probability: 0.95 }[coverage.value];
        this.edit([...gone.map(key => ({ path: [key], remove: true })), ...(usual ? [{ path: [coverage.value], value: usual }] : [])]);
      },
    }, make("option", { value: "" }, said.coverage_usual), ...COVERAGE.map(value => make("option", { value }, this.words.key[value])));
    coverage.value = kind;
    coverage.dataset.key = "coverage#choice";
    this.fields.set("coverage#choice", coverage);
    return this.#grid(
      this.named(said.coverage, coverage),
      kind ? this.number([kind], this.words.key[kind]) : [],
      kind === "coverage_factor" ? this.yes(["coverage_factor_fixed"], said.fixed, false) : [],
      this.choice(["rounding"], said.rounding, [["", said.usual(said.roundings.nearest)], ...["nearest", "ea", "up"].map(of => [of, said.roundings[of]])]),
      this.choice(["digits"], said.digits, [["", said.usual("2")], ...["1", "2", "3", "4"].map(of => [of, of])], {
        act: value => this.edit(value === "" ? this.taken(["digits"]) : [{ path: ["digits"], value: Number(value) }]),
      }),
      this.choice(["decimal_mark"], said.decimal_mark, [["", said.mark_of_language], ["point", said.marks.point], ["comma", said.marks.comma]]));
  }

  #letterhead() {
    const { said } = this;
    const pictures = this.files.filter(file => file.kind === "picture").map(file => [file.name, file.name]);
    const picture = key => this.choice(["letterhead", key], said.letter[key], [["", said.none], ...pictures]);
    return make("div", {},
      pictures.length || this.get(["letterhead"]) !== undefined ? null : make("p", { class: "hint" }, this.page.program.hasFolder ? said.no_pictures : said.no_pictures_held),
      this.#grid(picture("logo"), picture("accreditation_mark"),
        this.text(["letterhead", "accreditation_number"], said.letter.accreditation_number),
        this.localized(["letterhead", "accreditation"], said.letter.accreditation)));
  }

  #more() {
    const { said } = this;
    const of = key => [...new Set(Object.values(this.models).flatMap(model => (model[key] || []).map(quantity => quantity.name)))];
    const boxes = (key, names) => {
      const now = () => { const found = this.get([key]); return Array.isArray(found) ? found : typeof found === "string" ? [found] : []; };
      const all = [...new Set([...names, ...now()])];
      if (all.length === 0) return null;
      return make("fieldset", { class: "boxes" }, make("legend", {}, said.names[key]), ...all.map(name => {
        const box = make("input", {
          type: "checkbox",
          onchange: () => {
            const chosen = box.checked ? [...now(), name] : now().filter(other => other !== name);
            this.edit(chosen.length ? [{ path: [key], value: chosen }] : this.taken([key]));
          },
        });
        box.dataset.key = `${key}#${name}`;
        this.buttons.set(box.dataset.key, box);
        this.whenShown(() => { box.checked = now().includes(name); });
        return make("label", { class: "yes" }, box, " ", name);
      }));
    };
    return [
      this.#grid(
        this.choice(["statement"], said.statement, [["", said.usual(said.statements.auto)], ...["auto", "gum", "monte-carlo"].map(value => [value, said.statements[value]])]),
        this.number(["monte_carlo", "trials"], this.words.key.trials),
        this.number(["monte_carlo", "seed"], this.words.key.seed)),
      make("div", { class: "boxes" }, this.yes(["equations"], said.equations, true), this.yes(["correlations"], said.correlations, false)),
      boxes("conditions", of("conditions")),
      boxes("shared_inputs", of("inputs")),
      boxes("separate_inputs", of("inputs")),
    ].filter(part => part !== null);
  }
}

/** Of which kinds the values are, but not what they are; texts can come and go. */
function skeleton(value, languages) {
  if (typeof value !== "object" || value === null) return value === null ? "null" : typeof value === "boolean" ? "yes" : "text";
  if (Array.isArray(value)) return value.map(of => skeleton(of, languages));
  const keys = Object.keys(value).sort();
  if (keys.length && keys.every(key => LANGUAGES.includes(key) && typeof value[key] === "string")) {
    const others = keys.filter(key => !languages.includes(key));
    return others.length ? others : "text";
  }
  return keys.map(key => [key, skeleton(value[key], languages)]).filter(([, of]) => of !== "text" && of !== "yes");
}

function numberOrText(typed) {
  return typed.trim() !== "" && Number.isFinite(Number(typed)) ? Number(typed) : typed;
}

/** The edit, done to the content that is known. */
function apply(content, { path, value, typed, remove, exchange }) {
  const last = path[path.length - 1];
  let inside = content;
  for (const key of path.slice(0, -1)) {
    if (inside[key] === null || typeof inside[key] !== "object") inside[key] = {};
    inside = inside[key];
  }
  if (exchange !== undefined) [inside[last], inside[exchange]] = [inside[exchange], inside[last]];
  else if (remove && Array.isArray(inside)) inside.splice(last, 1);
  else if (remove) delete inside[last];
  else inside[last] = typed !== undefined ? typed : asWritten(value);
}

/** A value as an answer has it: numbers as texts. */
function asWritten(value) {
  if (typeof value === "number") return String(value);
  if (Array.isArray(value)) return value.map(asWritten);
  return isObject(value) ? Object.fromEntries(Object.entries(value).map(([key, of]) => [key, asWritten(of)])) : value;
}
