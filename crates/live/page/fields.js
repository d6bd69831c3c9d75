// Fields that show parts of the file by their paths and change them: what all forms have in common.

import { at, labelled, make } from "./parts.js";

export class Fields {
  /** Fields of a page within the element of that id. */
  constructor(page, id) {
    this.page = page;
    this.element = page.element(id);
    this.fields = new Map();
    this.sessions = 0;
  }

  get words() { return this.page.words; }

  /** The file is shown in every field, in that which somebody writes in as well. */
  forget() {
    for (const field of this.fields.values()) field.isTyped = false;
  }

  /** Makes all fields anew; the one that somebody writes in keeps the focus and what is typed. */
  rebuild(build) {
    const before = document.activeElement;
    const key = before && before.dataset.key;
    const typed = before && before.isTyped ? [before.value, before.selectionStart, before.selectionEnd] : null;
    this.fields.clear();
    build();
    const field = key && this.fields.get(key);
    if (!field) return;
    field.focus();
    if (typed && ["INPUT", "TEXTAREA"].includes(field.tagName)) {
      field.isTyped = true;
      field.value = typed[0];
      // a day has no place of the cursor
      if (typed[1] !== null && field.selectionStart !== null) field.setSelectionRange(typed[1], typed[2]);
    }
  }

  fill(key, value, kind) {
    const field = this.fields.get(key);
    if (!field) return;
    field.written = value;
    field.writtenKind = kind;
    if (document.activeElement === field && field.tagName !== "SELECT" && field.isTyped) return;
    if (kind === "list") value = value.replace(/^\s*\[|\]\s*$/g, "").replace(/\s*,\s*/g, "  ").trim();
    if (kind === "null") value = "";
    if (["number", "list"].includes(kind) && this.page.language === "de") value = value.replaceAll(".", ",");
    if (field.value !== value) field.value = value;
  }

  /** A field has the focus. */
  focused() {}

  /** A field of text for the value at a path. What `isOptional` goes from the file when it is emptied. */
  field(path, label, { kind = null, isOptional = false, ...attributes } = {}) {
    const key = at(path);
    const field = make("input", {
      autocomplete: "off", spellcheck: false, autocapitalize: "off", "aria-label": label, size: 8, ...attributes,
      oninput: () => { field.isTyped = true; this.typed(field, path, kind); },
      // what is typed between two visits of the field is one change of the file
      onfocus: () => { field.session = ++this.sessions; this.focused(path); },
      onblur: () => { field.isTyped = false; this.fill(key, field.written ?? field.value, field.writtenKind); },
      onpaste: event => this.pasted(event, field, kind),
    });
    field.dataset.key = key;
    field.isOptional = isOptional;
    this.fields.set(key, field);
    return field;
  }

  /** A field with its name before it: `short` where there is a symbol for it. */
  withName(path, word, name, properties, short = word) {
    const field = this.field(path, this.words.of(word, name), properties);
    const look = `labelled${properties.class === "list" ? " wide" : ""}${properties.isOptional ? " optional" : ""}`;
    return make("label", { class: look, title: word },
      short === "" ? null : make("span", { class: "key", "aria-hidden": true }, short), field);
  }

  typed(field, path, kind) {
    const change = `typed:${at(path)}#${field.session}`;
    let typed = field.value;
    if (typed.trim() === "") {
      // what need not be said is not said; everything else asks for a value
      const isThere = field.written !== undefined && field.written !== "";
      field.written = "";
      if (field.isOptional || !["inputs", "effects"].includes(path[0])) {
        if (isThere) this.page.edit([{ path: this.whole(path), remove: true }], change);
      } else {
        this.page.edit([{ path, value: kind === "list" ? [] : kind === "text" ? "" : null }], change);
      }
      return;
    }
    field.written = typed;
    field.writtenKind = null;
    if (kind === "list") typed = `[${numbersOf(typed, this.page.language)}]`;
    // between two digits a comma is a decimal one there
    else if (kind === null && this.page.language === "de") typed = typed.replace(/(\d),(?=\d)/g, "$1.");
    const edit = kind === "text" && !isQuantity(typed, path) ? { path, value: typed } : { path, typed };
    this.page.edit([edit], change);
  }

  /** What is pasted into a list: one row or column of a table; of several columns with headings one is chosen. */
  async pasted(event, field, kind) {
    const text = event.clipboardData.getData("text/plain");
    if (kind !== "list" || !/[\t\r\n]/.test(text)) return;
    event.preventDefault();
    const { selectionStart, selectionEnd } = field;
    const lines = text.split(/\r?\n/).filter(line => line.trim() !== "");
    const mark = ["\t", ";", ","].find(mark => lines[0].includes(mark));
    const hasHeadings = mark !== undefined && lines.length > 1 && lines[0].split(mark).some(name => /[a-z]/i.test(name.replace(/\de[-+]?\d/gi, "")));
    const rows = lines.map(line => hasHeadings ? line.split(mark) : [line.replace(/\t+/g, "  ")]);
    const values = hasHeadings ? await this.page.form.pickers.column(rows) : rows.flat();
    if (values === null) return;
    field.focus();
    field.setRangeText(values.join("  "), selectionStart, selectionEnd, "end");
    field.dispatchEvent(new InputEvent("input", { bubbles: true }));
  }

  /** What goes with a cell that goes: a tolerance without limits is none. */
  whole(path) {
    if (path[2] !== "tolerance") return path;
    const other = path[3] === "lower" ? "upper" : "lower";
    const field = this.fields.get(at([...path.slice(0, 3), other]));
    return field && field.value.trim() === "" ? path.slice(0, 3) : path;
  }

  remove(path, name) {
    return make("button", {
      type: "button", class: "icon remove", "aria-label": this.words.remove_of(name), title: this.words.remove_of(name),
      onclick: () => this.page.edit([{ path, remove: true }], null, true),
    }, "×");
  }

  labelled(cell, name, kind) {
    const word = this.words.key[cell.key] || cell.key;
    const numeric = kind !== "text" && kind !== "list";
    const field = this.field(cell.path, this.words.of(word, name), {
      kind, size: kind === "list" ? 28 : 7, inputmode: numeric ? "decimal" : null,
      class: kind === "list" ? "list" : numeric ? "figure" : null,
    });
    return labelled(word, field);
  }

  /** Marks the fields with mistakes. */
  mark(diagnostics) {
    const wrong = new Map();
    for (const of of diagnostics) {
      for (let length = of.path.length; length > 0; length--) {
        const key = at(of.path.slice(0, length));
        const field = this.fields.get(key) || this.fields.get(key + "#choice") || this.fields.get(key + "#name");
        if (field && "value" in field) { wrong.set(field, of.message); break; }
      }
    }
    for (const field of this.fields.values()) {
      if (!("value" in field)) continue;
      const message = wrong.get(field);
      if (message) field.setAttribute("aria-invalid", "true"); else field.removeAttribute("aria-invalid");
      field.title = message || "";
    }
  }

  /** The field of a path, or of what it lies in. */
  fieldAt(path) {
    for (let length = path.length; length > 0; length--) {
      const key = at(path.slice(0, length));
      const field = this.fields.get(key) || this.fields.get(key + "#choice") || this.fields.get(key + "#name");
      if (field && "value" in field) return field;
    }
    return null;
  }
}

/** Numbers as somebody typed or pasted them: with decimal commas where all of them can only be such. */
function numbersOf(text, language) {
  const numbers = text.trim().split(/[\s;]+/).filter(number => number !== "");
  const isComma = number => /^[-+]?(\d+|\d{1,3}(\.\d{3})+)(,\d+)?(e[-+]?\d+)?$/i.test(number);
  const commas = numbers.filter(number => number.includes(","));
  if (commas.length === 0 || !numbers.every(isComma) || numbers.length < 2 && language !== "de") return text;
  return numbers.map(number => number.includes(",") ? number.replaceAll(".", "").replace(",", ".") : number).join(" ");
}

/** Whether a text in a field for a unit begins like a quantity: such a text may fill other fields too. */
function isQuantity(text, path) { return path[path.length - 1] === "unit" && /^\s*[-+]?\d/.test(text) && !/^\s*1(\s*\/|\s*$)/.test(text); }
