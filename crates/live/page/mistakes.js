// The list of errors, each with the way to its place.

import { make } from "./parts.js";

export class Mistakes {
  constructor(page) {
    this.page = page;
    this.element = page.element;
    this.diagnostics = [];
    this.open = [];
  }

  get words() { return this.page.words; }

  show(found, request) {
    const { page } = this;
    this.diagnostics = found.diagnostics.filter(of => !of.open);
    this.open = found.open || [];
    const lines = page.equations.lines();
    const ranges = lines.filter(line => line.isWrong).map(line => [line.start, line.end]);
    for (const { path, within } of this.diagnostics) {
      if (path[0] !== "equations" || path.length < 2) continue;
      const line = lines.find(of => of.name === path[1]);
      if (!line) continue;
      ranges.push(within && line.formula ? [line.at + within[0], line.at + within[1]] : [line.start, line.end]);
    }
    page.equations.code.mark(ranges);
    if (request.text === page.document.text) page.source.mark(this.diagnostics.filter(of => !of.file).map(of => [of.start, of.end]));
    for (const form of page.shownForms) form.mark(this.diagnostics);
    this.#list(lines.some(line => line.isWrong));
    this.#points();
  }

  /** The errors; a press on one goes to its place. */
  #list(isNoEquation) {
    const list = this.element("mistakes");
    const items = this.diagnostics.slice(0, 12).map(of => [of, of.file ? `${of.file}: ${of.message}` : of.message, this.#place(of)]);
    if (isNoEquation) items.unshift([null, this.words.no_equation, ""]);
    const key = JSON.stringify(items.map(([, message, place]) => [message, place]));
    if (list.dataset.shown === key) return;
    list.dataset.shown = key;
    list.replaceChildren(...items.map(([of, message, place], number) => make("li", {},
      place ? make("button", { type: "button", onclick: () => this.goTo(this.diagnostics[isNoEquation ? number - 1 : number]) }, place) : null,
      " " + message)));
  }

  /** What a place is called: on a form by its field, in the text by line and column. */
  #place(of) {
    if (of.file) return "";
    if (this.page.isText) return `${of.line}:${of.column}`;
    if (of.path[0] === "equations" && of.path.length > 1) return of.path[1];
    const field = this.#field(of.path);
    return field ? field.getAttribute("aria-label") : this.words.text;
  }

  #field(path) {
    return this.page.shownForms.map(form => form.fieldAt(path)).find(field => field);
  }

  /** Where equations are written, and where results are chosen. */
  #whole(key) {
    const id = { equations: "equations", outputs: "unreported" }[key];
    return id && this.element(id);
  }

  /** What the file still lacks; a press on it goes there. */
  #points() {
    const { words } = this;
    const line = this.element("points");
    const key = JSON.stringify([this.page.language, this.page.isText, this.open]);
    line.hidden = this.open.length === 0 || this.page.isText;
    if (line.dataset.shown === key) return;
    line.dataset.shown = key;
    const shown = this.open.slice(0, 8).flatMap(({ path, suggestion }) => {
      const [of] = path;
      const field = this.#field(path);
      const name = path.length === 1 ? words.open_list[of] : field ? field.getAttribute("aria-label") : path[path.length - 1];
      const go = make("button", { type: "button", class: "chip", onclick: () => this.goTo({ path }) }, name);
      const use = suggestion ? make("button", { type: "button", class: "chip", onclick: () => this.page.edit([{ path, value: suggestion }]) }, words.use_unit(suggestion)) : null;
      return [go, use];
    });
    const more = this.open.length > 8 ? ` … (${this.open.length})` : "";
    line.replaceChildren(words.open_points + " ", ...shown.filter(of => of), more);
  }

  /** Goes to the place of a mistake. */
  goTo(of) {
    if (!of) return;
    if (!this.page.isText) {
      const whole = of.path.length === 1 && this.#whole(of.path[0]);
      if (whole) return (whole.querySelector("button") || whole).focus();
      if (of.path[0] === "equations" && of.path.length > 1) {
        const line = this.page.equations.lines().find(line => line.name === of.path[1]);
        if (line) {
          const [start, end] = of.within ? [line.at + of.within[0], line.at + of.within[1]] : [line.start, line.end];
          return this.page.equations.code.select(start, end);
        }
      }
      const field = this.#field(of.path);
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
    const isFile = this.page.shown === "file";
    this.element("told").textContent = isFile ? "" : message || "";
    if (!isFile) return;
    const list = this.element("mistakes");
    list.dataset.shown = "";
    list.querySelectorAll(".told").forEach(item => item.remove());
    if (message) list.prepend(make("li", { class: "told" }, make("pre", {}, message)));
  }
}
