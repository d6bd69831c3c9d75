// The list of errors, each with the way to its place.

import { make } from "./parts.js";

export class Mistakes {
  constructor(page) {
    this.page = page;
    this.element = page.element;
    this.diagnostics = [];
  }

  get words() { return this.page.words; }

  show(found, request) {
    const isNow = request.text === this.page.document.text;
    const lines = this.page.equations.lines();
    const ranges = lines.filter(line => line.isWrong).map(line => [line.start, line.end]);
    for (const { path, within } of found.diagnostics) {
      if (path[0] !== "equations" || path.length < 2) continue;
      const line = lines.find(of => of.name === path[1]);
      if (!line) continue;
      ranges.push(within && line.formula ? [line.at + within[0], line.at + within[1]] : [line.start, line.end]);
    }
    this.page.equations.code.mark(ranges);
    if (isNow) this.page.source.mark(found.diagnostics.filter(of => !of.file).map(of => [of.start, of.end]));
    for (const form of this.page.shownForms) form.mark(found.diagnostics);
    const list = this.element("mistakes");
    const items = found.diagnostics.map(of => [of, of.file ? `${of.file}: ${of.message}` : of.message]);
    if (lines.some(line => line.isWrong)) items.unshift([null, this.words.no_equation]);
    const places = items.map(([of]) => of && this.#place(of));
    const key = JSON.stringify(items.map(([, message], place) => [places[place], message]));
    if (list.dataset.shown === key) { this.diagnostics = found.diagnostics; return; }
    list.dataset.shown = key;
    this.diagnostics = found.diagnostics;
    list.replaceChildren(...items.slice(0, 12).map(([of, message], place) => make("li", {},
      of && !of.file ? make("button", { type: "button", onclick: () => this.goTo(this.diagnostics[items[0][0] ? place : place - 1]) }, places[place]) : null,
      " " + message)));
  }

  /** Where a mistake is: the name of its field, or line and column of the text. */
  #place(of) {
    const field = this.page.view === "text" ? null : this.page.shownForms.map(form => form.fieldAt(of.path)).find(field => field);
    return field && field.getAttribute("aria-label") || `${of.line}:${of.column}`;
  }

  /** Goes to the place of a mistake. */
  goTo(of) {
    if (!of) return;
    if (this.page.view !== "text" && this.page.shownForms.length) {
      if (of.path[0] === "equations" && of.path.length > 1) {
        const line = this.page.equations.lines().find(line => line.name === of.path[1]);
        if (line) {
          const [start, end] = of.within ? [line.at + of.within[0], line.at + of.within[1]] : [line.start, line.end];
          return this.page.equations.code.select(start, end);
        }
      }
      const field = this.page.shownForms.map(form => form.fieldAt(of.path)).find(field => field);
      if (field) {
        for (let folded = field.closest("details"); folded; folded = folded.parentElement.closest("details")) folded.open = true;
        return field.focus();
      }
      this.page.show("text");
    }
    this.page.source.select(of.start, of.end);
  }

  failed(error) {
    if (error.name === "AbortError") return;
    this.told(error.message || String(error));
  }

  /** Something that has gone wrong, beside the mistakes. */
  told(message) {
    const list = this.element("mistakes");
    list.dataset.shown = "";
    list.querySelectorAll(".told").forEach(item => item.remove());
    if (message) list.prepend(make("li", { class: "told" }, make("pre", {}, message)));
  }
}
