// The start page: three examples with their results, ways to begin, the gallery by field of work, the
// files of the folder.

import { make } from "./parts.js";
import { stated } from "./result.js";

const TRIALS = 20000;
const MOST_RECENT = 5;

export class Start {
  constructor(page) {
    this.page = page;
    this.element = page.element;
    this.pictures = new Map();
    const on = (id, act) => this.element(id).addEventListener("click", act);
    on("home", () => this.show());
    on("new", () => this.show());
    on("go-on", () => page.turn("file"));
    on("begin-empty", () => this.begin({}));
    on("begin-certificate", () => this.begin({ kind: "certificate" }));
    on("begin-case", () => this.begin({ kind: "case" }));
    on("begin-paste", () => page.import.show());
    on("begin-open", () => page.files.openDialog());
    this.element("gallery-search").addEventListener("input", () => this.#filter());
  }

  get words() { return this.page.words; }

  async show() {
    this.page.turn("start");
    this.element("start").scrollIntoView();
    const back = this.element("go-on");
    back.hidden = !this.page.hasFile;
    back.textContent = this.words.go_on_with(this.page.document.path || this.page.named || this.words.unnamed);
    try {
      this.gallery ||= await this.page.program.call("examples", {});
      if (this.drawn !== this.page.language) this.#draw();
      this.#whenIdle();
      this.listing = await this.page.program.ask("files", {});
      this.#folder();
    } catch (error) { this.page.failed(error); }
  }

  /** The same in another language. */
  translate() {
    if (this.page.shown === "start") this.show();
  }

  async begin(request) {
    if (await this.page.files.mayLeave()) await this.page.files.begin(request);
  }

  async open(path) {
    if (await this.page.files.mayLeave()) await this.page.files.open(path);
  }

  #draw() {
    this.element("large").replaceChildren(...this.gallery.large.map(of => this.#card(of)));
    this.element("gallery").replaceChildren(...this.gallery.fields.map(({ field, entries }) => make("details", {},
      make("summary", {}, this.words.fields[field] || field, " ", make("span", { class: "detail" }, String(entries.length))),
      make("ul", {}, ...entries.map(of => make("li", {}, this.#entry(of.title, of.source, () => this.begin({ [of.kind]: of.name }))))))));
    this.#filter();
    this.drawn = this.page.language;
  }

  /** An entry of a list: what is in files is in their language, which the page does not know. */
  #entry(title, detail, act) {
    const button = make("button", { type: "button", class: "entry", onclick: act },
      make("b", { lang: "en" }, title || detail), detail && title ? make("span", { class: "detail", lang: "en" }, detail) : null);
    button.sought = `${title || ""} ${detail || ""}`.toLowerCase();
    return button;
  }

  /** Shows what holds all words that are sought; the fields of work are opened by it. */
  #filter() {
    const sought = this.element("gallery-search").value.toLowerCase().split(/\s+/).filter(word => word !== "");
    let found = 0;
    for (const box of this.element("gallery").children) {
      const field = box.querySelector("summary").textContent.toLowerCase();
      let own = 0;
      for (const item of box.querySelectorAll("li")) {
        const all = `${field} ${item.firstChild.sought}`;
        item.hidden = !sought.every(word => all.includes(word));
        if (!item.hidden) own += 1;
      }
      box.hidden = own === 0;
      box.open = sought.length > 0 && own > 0;
      found += own;
    }
    this.element("gallery-found").textContent = sought.length ? this.words.gallery_found(found) : "";
  }

  // the large examples

  #card(of) {
    const picture = make("span", { class: "picture-box", "aria-hidden": true });
    const result = make("span", { class: "card-result" });
    const card = make("button", { type: "button", class: "card", onclick: () => this.begin({ [of.kind]: of.name }) },
      picture, make("b", { lang: "en" }, of.title), result);
    card.of = of;
    this.#fill(card);
    return card;
  }

  #key(of) { return `${of.name} ${this.page.language}`; }

  #fill(card) {
    const made = this.pictures.get(this.#key(card.of));
    if (!made) return;
    const [picture, , result] = card.children;
    picture.replaceChildren(made.svg.cloneNode(true));
    result.replaceChildren(...made.result.map(node => node.cloneNode(true)));
  }

  /** The results of the large examples, one after the other, while nobody waits for anything else. */
  #whenIdle() {
    const soon = window.requestIdleCallback || (act => setTimeout(act, 50));
    soon(async () => {
      if (this.isMaking) return;
      this.isMaking = true;
      for (const card of [...this.element("large").children]) {
        if (this.page.shown !== "start") break;
        if (!this.pictures.has(this.#key(card.of))) await this.#make(card.of).catch(error => this.page.failed(error));
        for (const now of this.element("large").children) this.#fill(now);
      }
      this.isMaking = false;
    });
  }

  async #make(of) {
    const { program, language: lang } = this.page;
    const { text } = await program.call("new", { [of.kind]: of.name });
    const found = await program.call("answer", { text, name: "", narrow: true, output: 0, row: 0, lang, trials: TRIALS });
    const [result] = found.results || [];
    if (!result) return;
    // markup of the program's own report
    const holder = make("template", { innerHTML: result.html.distribution });
    const svg = holder.content.querySelector("svg");
    if (!svg) return;
    svg.removeAttribute("role");
    svg.removeAttribute("aria-label");
    const { value, said } = stated(result, found, this.words);
    this.pictures.set(`${of.name} ${lang}`, { svg, result: [make("span", { class: "value" }, ...value), make("span", { class: "detail" }, said.join(" · "))] });
  }

  // files

  #folder() {
    const { words } = this;
    const shown = this.listing.files.filter(file => !["other", "picture"].includes(file.kind));
    const entry = file => make("li", {}, this.#entry(file.title || file.path, file.title ? file.path : null, () => this.open(file.path)));
    const recent = [...shown].sort((a, b) => b.modified - a.modified).slice(0, MOST_RECENT);
    this.element("recent").hidden = shown.length <= MOST_RECENT;
    this.element("recent-files").replaceChildren(...recent.map(entry));
    this.element("folder").hidden = shown.length === 0;
    const kinds = [...new Set([...Object.keys(words.kinds), ...shown.map(file => file.kind)])];
    this.element("folder-files").replaceChildren(...kinds.flatMap(kind => {
      const files = shown.filter(file => file.kind === kind);
      return files.length ? [make("details", { open: files.length <= 12 },
        make("summary", {}, words.kinds[kind] || kind, " ", make("span", { class: "detail" }, String(files.length))),
        make("ul", {}, ...files.map(entry)))] : [];
    }));
  }
}
