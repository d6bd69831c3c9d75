// The page: one open file, its form and its text, and what follows from it.

import { Answers } from "./answers.js";
import { CaseForm } from "./case.js";
import { CertificateForm } from "./certificate.js";
import { Code } from "./code.js";
import { Diagnosis } from "./diagnosis.js";
import { Dialog } from "./dialog.js";
import { Document } from "./document.js";
import { Equations } from "./equations.js";
import { Files } from "./files.js";
import { Form } from "./form.js";
import { Import } from "./import.js";
import { Mistakes } from "./mistakes.js";
import { fillPrint } from "./print.js";
import { at, free, make, put, wholeName } from "./parts.js";
import { Result } from "./result.js";
import { Start } from "./start.js";
import { connect } from "./transport.js";
import de from "./words.de.js";
import en from "./words.en.js";

const AUTOSAVE = 1500;

class Page {
  constructor(program) {
    this.program = program;
    this.element = id => document.getElementById(id);
    this.chosen = 0;
    this.row = 0;
    this.queue = [];
    this.kind = "model";
    this.found = null;
    this.isLost = false;
    this.isUnanswered = false;
    this.document = new Document(kind => this.#changed(kind));
    // before a first one is there, nothing is lost
    this.pristine = this.document.text;
    this.answers = new Answers(program, this);
    this.dialog = new Dialog();
    this.mistakes = new Mistakes(this);
    this.result = new Result(this);
    this.files = new Files(this);
    this.equations = new Equations(this);
    this.source = new Code(this.element("source-box"));
    this.form = new Form(this);
    // the forms of each kind of file; files of other kinds are edited as text
    this.caseForm = new CaseForm(this);
    this.diagnosis = new Diagnosis(this);
    this.forms = { model: [this.form], case: [this.form, this.caseForm], certificate: [new CertificateForm(this)] };
    this.language = pickLanguage(program.hello.lang);
    this.words = this.language === "de" ? de : en;
    this.hasFile = false;
    this.beginning = new Start(this);
    this.import = new Import(this);
  }

  async start() {
    this.#translate();
    this.#listen();
    this.form.kinds = await this.program.call("kinds", {});
    this.element("units").replaceChildren(...this.form.kinds.units.map(value => make("option", { value })));
    this.program.watch(event => this.files.onDisk(event), isLost => this.#lost(isLost));
    const listing = await this.program.ask("files", {});
    if (listing.open) await this.files.open(listing.open);
    else await this.beginning.show();
  }

  /** Shows the start page, the open file, or a spreadsheet that is imported. */
  turn(shown) {
    const before = this.shown;
    this.shown = shown;
    for (const id of ["start", "import-view", "file"]) this.element(id).hidden = id !== (shown === "import" ? "import-view" : shown);
    for (const element of document.querySelectorAll(".of-file")) element.hidden = shown !== "file";
    this.files.state();
    if (shown !== "file") this.mistakes.told(null);
    if (before === undefined || before === shown) return;
    scrollTo(0, 0);
    this.element({ start: "start-title", import: "import-title", file: "editor-title" }[shown]).focus({ preventScroll: true });
  }

  /** Another file is open: nothing of the last one stays. */
  begin() {
    this.found = null;
    this.chosen = 0;
    this.row = 0;
    this.force = true;
    this.source.text = this.document.text;
    this.form.clear();
    this.result.clear();
    this.hasFile = true;
    this.turn("file");
    this.show("form");
    this.ask();
  }

  // the document

  #changed(kind) {
    const force = kind === "undo" || kind === "disk";
    const text = this.document.text;
    if (document.activeElement !== this.source.area || force) this.source.text = text;
    this.force = this.force || force;
    this.files.state();
    this.ask();
    clearTimeout(this.saver);
    this.saver = setTimeout(() => this.files.autosave(), AUTOSAVE);
  }

  ask() {
    if (!this.isGiven && this.hasFile) this.answers.ask(this.#request());
  }

  /** What is asked about the text as it is. */
  #request() {
    const narrow = matchMedia("(max-width: 40rem)").matches;
    const { text, path } = this.document;
    return { text, path, name: path || this.named || "", narrow, output: this.chosen, row: this.row, lang: this.language, stated: this.result.stated, at: performance.now() };
  }

  /** The text that a change is made to: what is typed into one field replaces what was typed there before. */
  #base(kind) {
    const { typing, document: { text } } = this;
    return typing && typing.kind === kind && typing.text === text ? typing.base : text;
  }

  #typedFrom(base, kind) {
    this.typing = kind !== null && kind.startsWith("typed:") ? { kind, base, text: this.document.text } : null;
  }

  /** A change whose answer comes with it. */
  async #changeAndAnswer(edits, kind) {
    const { text } = this.document, base = this.#base(kind);
    const request = { ...this.#request(), text: base };
    const found = await this.answers.edit(request, edits);
    if (this.document.text !== text) return false;
    this.isOnItsWay = false;
    this.isGiven = true;
    this.document.set(found.text, kind);
    this.isGiven = false;
    this.#typedFrom(base, kind);
    this.answers.given({ ...request, text: found.text }, found);
    return true;
  }

  /** Changes the file; changes of one kind that wait are made as one. */
  edit(edits, kind = null) {
    const last = this.queue[this.queue.length - 1];
    if (kind !== null && last && last.kind === kind) last.edits = edits;
    else this.queue.push({ edits, kind });
    this.#work();
  }

  async #work() {
    if (this.isWorking) return;
    this.isWorking = true;
    while (this.queue.length) {
      const { call, edits, request, kind } = this.queue.shift();
      this.isOnItsWay = true;
      try {
        if (!call && this.kind === "model" && this.answers.isQuick) {
          if (!await this.#changeAndAnswer(edits, kind)) this.queue.unshift({ edits, kind });
          continue;
        }
        const { text } = this.document, base = this.#base(kind);
        const made = await this.program.call(call || "edit", { text: base, edits, ...request });
        this.isOnItsWay = false;
        // somebody may have typed into the text meanwhile; that is not lost
        if (this.document.text === text) {
          this.document.set(made.text, kind);
          this.#typedFrom(base, kind);
        } else this.queue.unshift({ call, edits, request, kind });
      } catch (error) {
        this.isOnItsWay = false;
        this.unanswered(error);
      }
    }
    this.isWorking = false;
  }

  /** Whether a text has all that was typed and chosen. */
  #isCurrent(text) { return text === this.document.text && !this.isOnItsWay && this.queue.length === 0; }

  /** Whether what was answered last is the text with all changes. */
  get isSettled() { return !this.isWorking && this.answeredText === this.document.text; }

  /** What was typed last is on its way into the text: until it is there. */
  async settled() {
    for (let turn = 0; this.isWorking && turn < 200; turn++) await new Promise(done => setTimeout(done, 10));
  }

  async undo() {
    await this.settled();
    this.document.undo();
  }

  async redo() {
    await this.settled();
    this.document.redo();
  }

  /** Another way in which an input is known; `kept` is what was typed for it before. */
  reshape(path, way, kept) {
    this.queue.push({ call: "reshape", request: { path, way, kept }, kind: null });
    this.#work();
  }

  /** Another name for an input, in the equations and correlations as well. */
  rename(path, from, to) {
    if (to === "" || to === from) { this.form.show(this.found, true); return; }
    const edits = [{ path, rename: to }];
    const name = wholeName(from);
    for (const { path: of, formula } of this.found.equations || []) {
      const changed = formula.replace(name, to);
      if (changed !== formula) edits.push({ path: of, value: changed });
    }
    for (const { path: of, between } of this.found.correlations || []) {
      between.forEach((old, place) => { if (old === from) edits.push({ path: [...of, place], value: to }); });
    }
    this.edit(edits);
  }

  addInputs(names) {
    // the unit follows from what is typed
    const value = { distribution: "normal", mean: null, std: null };
    this.edit(names.map(name => ({ path: ["inputs", name], value })));
    this.#focusSoon(at(["inputs", names[0], "mean"]));
  }

  addOutputs(names) {
    this.edit(names.map(name => ({ path: ["outputs", name], value: {} })));
    this.#focusSoon(at(["outputs", names[0], "unit"]));
  }

  #focusSoon(key, tries = 40) {
    const field = this.form.fields.get(key);
    if (field) { field.focus(); field.select(); }
    else if (tries > 0) setTimeout(() => this.#focusSoon(key, tries - 1), 25);
  }

  #freeName(wanted) {
    const taken = [...(this.found && this.found.inputs || []), ...(this.found && this.found.equations || [])].map(of => of.name);
    return free(wanted, taken);
  }

  // what is shown

  /** The server is gone, or there again. */
  #lost(isLost) {
    if (isLost === this.isLost) return;
    this.isLost = isLost;
    this.element("lost").hidden = !isLost;
    this.files.state();
    this.result.age();
    if (!isLost) this.ask();
  }

  /** There is no answer to what was asked about the text. */
  unanswered(error) {
    this.isUnanswered = true;
    this.result.age();
    this.failed(error);
  }

  audit(found) { this.result.audit(found); }

  failed(error) { this.mistakes.failed(error); }

  answer(found, request) {
    if (found.kind === "case") found = { ...found, diagnostics: this.caseForm.calm(found) };
    this.found = found;
    this.answeredText = request.text;
    this.isUnanswered = false;
    // fields hold what is newer than the answer; one about this follows
    const isCurrent = this.#isCurrent(request.text);
    const force = this.force && isCurrent;
    if (force) this.force = false;
    this.kind = found.kind;
    const isModel = found.kind === "model";
    this.element("editor-title").textContent = this.words.title_of[found.kind] || this.words.measurement;
    this.element("view-form").disabled = !this.forms[found.kind];
    this.show(this.view);
    if (found.inputs !== undefined && isCurrent) {
      this.equations.show(found, force);
      const title = this.element("title");
      if (document.activeElement !== title || force) title.value = found.title || "";
      document.title = `${found.title || request.path || this.words.unnamed} - gumption`;
      const model = this.element("model");
      model.hidden = !found.model;
      model.replaceChildren(...(found.model ? [`${this.words.model_is} ${found.model}`, ...(found.statement || []).map(([name, formula]) => make("code", {}, `${name} = ${formula}`))] : []));
    }
    if (isCurrent) {
      for (const form of this.shownForms) form.show(found, force);
      this.element("certify").hidden = !isModel || (found.results || []).length === 0;
    }
    this.mistakes.show(found, request);
    if (isModel) this.result.results(found);
    else this.result.report(found, request);
    this.files.state();
    document.dispatchEvent(new CustomEvent("answered", { detail: { took: performance.now() - request.at, full: found.full, mistakes: found.diagnostics.length } }));
  }

  /** The forms of the open file. */
  get shownForms() { return this.forms[this.kind] || []; }

  /** Whether the file is shown as text. */
  get isText() { return this.view === "text" || this.shownForms.length === 0; }

  show(view) {
    this.view = view;
    const { isText } = this;
    this.element("view-form").setAttribute("aria-pressed", !isText);
    this.element("view-text").setAttribute("aria-pressed", isText);
    for (const form of Object.values(this.forms).flat()) form.element.hidden = isText || !this.shownForms.includes(form);
    this.element("raw").hidden = !isText;
    if (isText) this.source.text = this.document.text;
  }

  #translate() {
    document.documentElement.lang = this.language;
    for (const element of document.querySelectorAll("[data-w]")) element.textContent = this.words[element.dataset.w];
    for (const element of document.querySelectorAll("[data-w-label]")) {
      element.setAttribute("aria-label", this.words[element.dataset.wLabel]);
      if (element.tagName === "BUTTON") element.title = this.words[element.dataset.wLabel];
    }
    for (const element of document.querySelectorAll("[data-w-placeholder]")) element.placeholder = this.words[element.dataset.wPlaceholder];
    for (const element of document.querySelectorAll("[data-w-title]")) element.title = this.words[element.dataset.wTitle];
    this.element("certify").textContent = this.words.certificate.from_result;
    this.element("language").value = this.language;
  }

  #listen() {
    const on = (id, name, act) => this.element(id).addEventListener(name, act);
    on("title", "input", event => this.edit([{ path: ["title"], value: event.target.value }], "title"));
    on("equations", "input", () => {
      const lines = this.equations.lines().filter(line => !line.isWrong && line.name !== "");
      this.edit([{ path: ["equations"], members: lines.map(line => [line.name, line.formula]) }], "equations");
    });
    on("equations", "blur", () => this.found && this.isSettled && this.equations.show(this.found, this.found.diagnostics.length === 0 && !this.equations.lines().some(line => line.isWrong)));
    on("source", "input", () => this.document.set(this.source.text, "text"));
    on("add-input", "click", () => this.addInputs([this.#freeName("x")]));
    on("add-correlation", "click", () => {
      const names = (this.found && this.found.inputs || []).map(of => of.name);
      const many = (this.found && this.found.correlations || []).length;
      const value = [names[0] || "a", names[1] || "b", 0];
      this.edit([this.found && this.found.correlations && many ? { path: ["correlations", many], value } : { path: ["correlations"], value: [value] }]);
    });
    on("add-condition", "click", () => this.edit([{ path: ["conditions", this.#freeName("condition")], value: { unit: "1", values: [1, 2] } }]));
    const toRow = row => { this.row = row; this.ask(); };
    on("rows", "change", event => toRow(Number(event.target.value)));
    on("row-before", "click", () => toRow(this.row - 1));
    on("row-after", "click", () => toRow(this.row + 1));
    const toView = view => {
      this.show(view);
      if (this.found) this.mistakes.show(this.found, { text: this.document.text });
    };
    on("view-form", "click", () => toView("form"));
    on("view-text", "click", () => toView("text"));
    on("undo", "click", () => this.undo());
    on("redo", "click", () => this.redo());
    on("certify", "click", () => this.files.certify());
    on("save", "click", () => this.files.save());
    on("open", "click", () => this.files.openDialog());
    on("export", "click", () => this.files.exportDialog());
    // with a server, the command line does it
    this.element("verify").hidden = this.program.hasFolder;
    on("verify", "click", () => this.files.verifyDialog());
    on("import", "click", () => this.import.show());
    on("copy", "click", async () => {
      try {
        await navigator.clipboard.writeText(this.document.text);
        this.element("copied").textContent = this.words.copied;
      } catch {
        // without the permission the text is at least there to be marked
        this.show("text");
        this.source.area.select();
      }
    });
    on("bar", "click", () => this.element("answer-title").scrollIntoView());
    window.addEventListener("beforeprint", () => this.found && fillPrint(this));
    // what sticks to the edges of the window takes its place from them
    const measure = (name, of) => new ResizeObserver(() => {
      const isStuck = ["sticky", "fixed"].includes(getComputedStyle(of).position);
      document.documentElement.style.setProperty(name, `${isStuck ? of.offsetHeight : 0}px`);
    }).observe(of);
    measure("--head", document.querySelector(".bar"));
    measure("--foot", this.element("bar"));
    this.result.watch();
    on("language", "change", event => {
      this.language = event.target.value;
      this.words = this.language === "de" ? de : en;
      try { localStorage.setItem("language", this.language); } catch { /* not kept */ }
      this.#translate();
      this.element("mistakes").dataset.shown = "";
      put(this.element("part-audit"), "");
      if (this.found) this.answer(this.found, { text: this.document.text, path: this.document.path, at: performance.now() });
      this.ask();
      this.beginning.translate();
      this.import.translate();
    });
    document.addEventListener("keydown", event => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const key = event.key.toLowerCase();
      const act = key === "s" ? () => this.files.save()
        : key === "z" && !event.shiftKey ? () => this.undo()
        : key === "y" || key === "z" && event.shiftKey ? () => this.redo() : null;
      if (!act || this.dialog.isOpen || this.shown !== "file") return;
      event.preventDefault();
      act();
    });
    document.addEventListener("dragover", event => event.preventDefault());
    document.addEventListener("drop", event => {
      event.preventDefault();
      const files = [...(event.dataTransfer && event.dataTransfer.files || [])];
      if (files.length) this.files.dropped(files);
    });
    window.addEventListener("beforeunload", event => {
      if (!this.document.isSaved && this.document.text !== this.pristine) event.preventDefault();
    });
    matchMedia("(max-width: 40rem)").addEventListener("change", () => this.ask());
  }
}

function pickLanguage(told) {
  let kept = null;
  try { kept = localStorage.getItem("language"); } catch { /* none is kept */ }
  const wanted = kept || told || (navigator.language || "en").slice(0, 2);
  return wanted === "de" ? "de" : "en";
}

const page = new Page(await connect());
await page.start().catch(error => page.failed(error));
