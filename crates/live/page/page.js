// The page: one open file, its form and its text, and what follows from it.

import { Answers } from "./answers.js";
import { Code } from "./code.js";
import { Document } from "./document.js";
import { Form } from "./form.js";
import { at, make, put, unit } from "./parts.js";
import { connect } from "./transport.js";
import de from "./words.de.js";
import en from "./words.en.js";

const AUTOSAVE = 1500;
const SPEAK = 900;
const FORMATS = { model: ["html", "xlsx", "markdown", "latex", "csv", "json"], certificate: ["html", "dcc", "xlsx", "markdown", "latex", "csv"], case: ["html", "json"], comparison: ["html", "json", "csv"], recipe: ["json", "csv"] };
const ENDINGS = { markdown: "md", latex: "tex", dcc: "xml" };

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
    this.equations = new Code(this.element("equations-box"));
    this.source = new Code(this.element("source-box"));
    this.form = new Form(this);
    this.language = pickLanguage(program.hello.lang);
    this.words = this.language === "de" ? de : en;
  }

  async start() {
    this.#translate();
    this.#listen();
    this.form.kinds = await this.program.call("kinds", {});
    this.element("units").replaceChildren(...this.form.kinds.units.map(value => make("option", { value })));
    this.program.watch(event => this.#onDisk(event), isLost => this.#lost(isLost));
    const { open } = await this.program.ask("files", {});
    if (open) await this.#open(open);
    else await this.#begin({});
  }

  // the document

  #changed(kind) {
    const force = kind === "undo" || kind === "disk";
    const text = this.document.text;
    if (document.activeElement !== this.source.area || force) this.source.text = text;
    this.force = this.force || force;
    this.#state();
    this.#ask();
    clearTimeout(this.saver);
    this.saver = setTimeout(() => this.#autosave(), AUTOSAVE);
  }

  #ask() {
    if (!this.isGiven) this.answers.ask(this.#request());
  }

  /** What is asked about the text as it is. */
  #request() {
    const narrow = matchMedia("(max-width: 40rem)").matches;
    const { text, path } = this.document;
    return { text, path, name: path || this.named || "", narrow, output: this.chosen, row: this.row, lang: this.language, at: performance.now() };
  }

  /** A change whose answer comes with it. */
  async #changeAndAnswer(edits, kind) {
    const request = this.#request();
    const found = await this.answers.edit(request, edits);
    if (this.document.text !== request.text) return false;
    this.isGiven = true;
    this.document.set(found.text, kind);
    this.isGiven = false;
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
      try {
        if (!call && this.kind === "model" && this.answers.isQuick) {
          if (!await this.#changeAndAnswer(edits, kind)) this.queue.unshift({ edits, kind });
          continue;
        }
        const text = this.document.text;
        const made = await this.program.call(call || "edit", { text, edits, ...request });
        // somebody may have typed into the text meanwhile; that is not lost
        if (this.document.text === text) this.document.set(made.text, kind);
        else this.queue.unshift({ call, edits, request, kind });
      } catch (error) {
        this.unanswered(error);
      }
    }
    this.isWorking = false;
  }

  /** What was typed last is on its way into the text: until it is there. */
  async #settled() {
    for (let turn = 0; this.isWorking && turn < 200; turn++) await new Promise(done => setTimeout(done, 10));
  }

  async undo() {
    await this.#settled();
    this.document.undo();
  }

  async redo() {
    await this.#settled();
    this.document.redo();
  }

  reshape(path, distribution) {
    if (distribution === "") return;
    this.queue.push({ call: "reshape", request: { path, distribution }, kind: null });
    this.#work();
  }

  /** Another name for an input, in the equations and correlations as well. */
  rename(path, from, to) {
    if (to === "" || to === from) { this.form.show(this.found, true); return; }
    const edits = [{ path, rename: to }];
    const name = new RegExp(`(?<![\\p{L}\\p{N}_.])${from.replace(/[.*+?^${}()|[\]\\]/g, "\\$&")}(?![\\p{L}\\p{N}_])`, "gu");
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
    const value = { unit: "1", distribution: "normal", mean: null, std: null };
    this.edit(names.map(name => ({ path: ["inputs", name], value })));
    this.#focusSoon(at(["inputs", names[0], "mean"]));
  }

  addOutputs(names) {
    this.edit(names.map(name => ({ path: ["outputs", name], value: { unit: "1" } })));
    this.#focusSoon(at(["outputs", names[0], "unit"]));
  }

  #focusSoon(key, tries = 40) {
    const field = this.form.fields.get(key);
    if (field) { field.focus(); field.select(); }
    else if (tries > 0) setTimeout(() => this.#focusSoon(key, tries - 1), 25);
  }

  #freeName(wanted) {
    const taken = [...(this.found && this.found.inputs || []), ...(this.found && this.found.equations || [])].map(of => of.name);
    let name = wanted;
    for (let number = 2; taken.includes(name); number++) name = `${wanted}${number}`;
    return name;
  }

  // what is shown

  /** The server is gone, or there again. */
  #lost(isLost) {
    if (isLost === this.isLost) return;
    this.isLost = isLost;
    this.#state();
    this.#age();
    if (!isLost) this.#ask();
  }

  /** There is no answer to what was asked about the text. */
  unanswered(error) {
    this.isUnanswered = true;
    this.#age();
    this.failed(error);
  }

  /** What is no answer to the text as it stands is old as a whole, and says why. */
  #age() {
    const { words } = this;
    const why = this.isLost ? words.old_lost : this.isUnanswered ? words.old_failed : this.isBefore ? words.stale : null;
    this.element("results").classList.toggle("stale", why !== null);
    if (why !== null) this.element("progress").textContent = this.hasResults ? why : "";
    if (this.isLost || this.isUnanswered) this.element("report").classList.add("stale");
  }

  answer(found, request) {
    this.found = found;
    this.isUnanswered = false;
    const force = this.force && request.text === this.document.text;
    if (force) this.force = false;
    this.kind = found.kind;
    const isModel = found.kind === "model";
    this.element("view-form").disabled = !isModel;
    this.#show(this.view);
    if (found.inputs !== undefined) {
      this.form.show(found, force);
      this.#showEquations(found, force);
      const title = this.element("title");
      if (document.activeElement !== title || force) title.value = found.title || "";
      document.title = `${found.title || request.path || this.words.unnamed} - gumption`;
      const model = this.element("model");
      model.hidden = !found.model;
      model.replaceChildren(...(found.model ? [`${this.words.model_is} ${found.model}. `, ...(found.statement || []).flatMap(([name, formula]) => [make("code", {}, `${name} = ${formula}`), " "])] : []));
    }
    this.#mistakes(found, request);
    if (isModel) this.#results(found);
    else this.#report(found, request);
    this.#state();
    document.dispatchEvent(new CustomEvent("answered", { detail: { took: performance.now() - request.at, full: found.full, mistakes: found.diagnostics.length } }));
  }

  #showEquations(found, force) {
    const isWritten = document.activeElement === this.equations.area;
    const text = (found.equations || []).map(({ name, formula }) => `${name} = ${formula}`).join("\n");
    if (!isWritten || force) this.equations.text = text;
    const area = this.equations.area;
    area.rows = Math.max(3, Math.min(14, this.equations.text.split("\n").length + 1));
    area.readOnly = Boolean(found.model);
    this.element("equations-box").hidden = Boolean(found.model);
  }

  /** The lines of the field of equations: where each formula begins, and what is none. */
  #lines() {
    const lines = [];
    let start = 0;
    for (const line of this.equations.text.split("\n")) {
      const equals = line.indexOf("=");
      if (line.trim() !== "") {
        if (equals < 0) lines.push({ start, end: start + line.length, isWrong: true });
        else {
          const name = line.slice(0, equals).trim(), rest = line.slice(equals + 1);
          const formula = rest.trim();
          lines.push({ name, formula, start, end: start + line.length, at: start + equals + 1 + (rest.length - rest.trimStart().length) });
        }
      }
      start += line.length + 1;
    }
    return lines;
  }

  #mistakes(found, request) {
    const isNow = request.text === this.document.text;
    const lines = this.#lines();
    const ranges = lines.filter(line => line.isWrong).map(line => [line.start, line.end]);
    for (const { path, within } of found.diagnostics) {
      if (path[0] !== "equations" || path.length < 2) continue;
      const line = lines.find(of => of.name === path[1]);
      if (!line) continue;
      ranges.push(within && line.formula ? [line.at + within[0], line.at + within[1]] : [line.start, line.end]);
    }
    this.equations.mark(ranges);
    if (isNow) this.source.mark(found.diagnostics.filter(of => !of.file).map(of => [of.start, of.end]));
    this.form.mark(found.diagnostics);
    const list = this.element("mistakes");
    const items = found.diagnostics.map(of => [of, of.file ? `${of.file}: ${of.message}` : of.message]);
    if (lines.some(line => line.isWrong)) items.unshift([null, this.words.no_equation]);
    const key = JSON.stringify(items.map(([of, message]) => [of && of.line, message]));
    if (list.dataset.shown === key) { this.diagnostics = found.diagnostics; return; }
    list.dataset.shown = key;
    this.diagnostics = found.diagnostics;
    list.replaceChildren(...items.slice(0, 12).map(([of, message], place) => make("li", {},
      of && !of.file ? make("button", { type: "button", onclick: () => this.#goTo(this.diagnostics[items[0][0] ? place : place - 1]) }, `${of.line}:${of.column}`) : null,
      " " + message)));
  }

  /** Goes to the place of a mistake. */
  #goTo(of) {
    if (!of) return;
    if (this.view !== "text" && this.kind === "model") {
      if (of.path[0] === "equations" && of.path.length > 1) {
        const line = this.#lines().find(line => line.name === of.path[1]);
        if (line) {
          const [start, end] = of.within ? [line.at + of.within[0], line.at + of.within[1]] : [line.start, line.end];
          return this.equations.select(start, end);
        }
      }
      const field = this.form.fieldAt(of.path);
      if (field) {
        const folded = field.closest("details");
        if (folded) folded.open = true;
        return field.focus();
      }
      this.#show("text");
    }
    this.source.select(of.start, of.end);
  }

  #results(found) {
    const { words } = this;
    this.element("report").hidden = true;
    const has = found.results !== undefined;
    const results = this.element("results");
    this.isBefore = !has;
    if (!has) {
      this.#age();
      this.element("nothing").hidden = this.hasResults;
      results.hidden = !this.hasResults;
      return;
    }
    this.hasResults = true;
    results.hidden = false;
    this.element("nothing").hidden = true;
    const outputs = found.results;
    this.chosen = Math.max(0, Math.min(this.chosen, outputs.length - 1));
    this.#tabs(outputs);
    this.#rows(found);
    const of = outputs[this.chosen];
    for (const id of ["box-budget", "box-comparison"]) this.element(id).hidden = !of;
    this.#headline(of, found);
    const part = (id, html) => put(this.element(`part-${id}`), html);
    part("distribution", of ? of.html.distribution : "");
    part("budget", of ? of.html.budget : "");
    part("comparison", of ? of.html.comparison : "");
    part("conclusions", of ? of.html.conclusions : "");
    part("verdict", of ? of.html.verdict : "");
    part("together", found.together);
    // the rows of a sweep are the result; correlations of outputs come after the outputs
    const isSweep = (found.row_names || []).length > 0;
    this.element("box-audit").before(this.element("part-together"));
    if (isSweep) this.element("box-budget").before(this.element("part-together"));
    // what the sentences above say already is not said again
    const said = this.element("part-verdict").textContent;
    const further = found.notes.map(text => text.replaceAll("`", "")).filter(text => !said.includes(text));
    const notes = this.element("notes"), key = JSON.stringify(further);
    if (notes.dataset.key !== key) {
      notes.dataset.key = key;
      notes.replaceChildren(...further.map(text => make("li", {}, text)));
    }
    const trials = String(found.trials).replace(/\B(?=(\d{3})+$)/g, "\u202f");
    const rest = found.whole ? words.done : found.full ? words.cut : words.refining;
    this.element("progress").textContent = found.trials ? words.trials(trials) + rest : "";
    this.#age();
  }

  #tabs(outputs) {
    const tabs = this.element("output-tabs");
    const key = JSON.stringify(outputs.map(of => of.name));
    tabs.hidden = outputs.length < 2;
    if (tabs.dataset.names !== key) {
      tabs.dataset.names = key;
      tabs.replaceChildren(...outputs.map((of, place) => make("button", {
        type: "button", onclick: () => {
          this.chosen = place;
          // the parts of the others were not asked for
          if (outputs[place].html.verdict === "") this.#ask();
          else this.#results(this.found);
        },
      }, of.name)));
    }
    [...tabs.children].forEach((button, place) => button.setAttribute("aria-pressed", place === this.chosen));
  }

  /** The rows of conditions: the headline and the parts below it are about one of them. */
  #rows(found) {
    const box = this.element("rows-box"), choice = this.element("rows");
    const names = found.row_names || [];
    box.hidden = names.length === 0;
    this.row = found.row || 0;
    const key = JSON.stringify(names);
    if (choice.dataset.names !== key) {
      choice.dataset.names = key;
      choice.replaceChildren(...names.map((name, place) => make("option", { value: String(place) }, name)));
    }
    choice.value = String(this.row);
    const first = this.row === 0, last = this.row >= names.length - 1;
    this.element("row-before").disabled = first;
    this.element("row-after").disabled = last;
  }

  #headline(of, found) {
    const { words } = this;
    const place = this.element("headline"), badges = this.element("badges");
    if (!of) {
      place.replaceChildren();
      badges.replaceChildren();
      return;
    }
    const { statement, gum, clause_8: clause, conformity } = of;
    const bare = of.unit === "" || of.unit === "1";
    const percent = words.number(String(Number((100 * found.coverage_probability).toFixed(2))));
    const number = text => words.number(text);
    const value = make("p", { class: "value" });
    const said = [];
    if (statement.kind === "expanded") {
      const both = `${number(statement.estimate)} ± ${number(statement.expanded)}`;
      value.append(make("i", {}, of.name), " = ", bare ? both : `(${both})`);
      said.push(`k = ${number(statement.factor)}`, words.coverage(percent));
    } else if (statement.kind === "interval") {
      value.append(make("i", {}, of.name), " = ", number(statement.estimate));
      said.push(`${words.interval} ${words.from_to(number(statement.low), number(statement.high))} (${statement.shortest ? words.shortest : words.symmetric})`, words.coverage(percent));
    } else if (statement.kind === "standard") {
      value.append(make("i", {}, of.name), " = ", number(statement.estimate));
      said.push(words.standard(number(statement.uncertainty)));
    } else {
      value.append(make("i", {}, of.name), " ", words.undefined);
    }
    if (!bare && statement.kind !== "undefined") value.append("\u2009", make("span", { class: "unit" }, ...unit(of.unit)));
    const line = make("p", { class: "said" }, said.join(" · "));
    const key = value.textContent + line.textContent;
    if (place.dataset.key !== key) {
      place.dataset.key = key;
      place.replaceChildren(value, line);
      clearTimeout(this.speaker);
      this.speaker = setTimeout(() => { this.element("spoken").textContent = `${value.textContent}; ${line.textContent}`; }, SPEAK);
    }
    const marks = [];
    if (clause) {
      const text = clause.valid === true ? words.clause_yes : clause.valid === false ? words.clause_no : words.clause_open;
      const look = clause.valid === true ? "yes" : clause.valid === false ? "no" : "open";
      marks.push(make("span", { class: `badge ${look}` }, text), make("span", { class: "detail" }, words.clause_detail(clause)));
    }
    if (conformity) {
      // what rounds to certainty is none
      const share = 100 * conformity.probability;
      const p = share >= 99.995 ? "> 99.99" : share < 0.005 ? "< 0.01" : String(Number(share.toFixed(2)));
      marks.push(make("span", { class: `badge ${conformity.conforms ? "yes" : "no"}` }, conformity.conforms ? words.conforms(number(p)) : words.not_conforms(number(p))));
    }
    badges.replaceChildren(...marks);
  }

  audit(found) {
    this.element("box-audit").hidden = !found.html;
    put(this.element("part-audit"), found.html || "");
  }

  /** The page of a case, a certificate, a comparison or a recipe. */
  #report(found, request) {
    this.element("results").hidden = true;
    this.hasResults = false;
    this.element("output-tabs").hidden = true;
    this.element("nothing").hidden = true;
    const frame = this.element("report");
    if (["other", "costs", "result"].includes(found.kind)) { frame.hidden = true; return; }
    frame.hidden = false;
    clearTimeout(this.reporter);
    const { text, path } = request;
    // what was true before the mistake stays there
    frame.classList.toggle("stale", found.diagnostics.length > 0);
    if (this.reported === text || found.diagnostics.length) return;
    this.reporter = setTimeout(async () => {
      try {
        const address = await this.program.page({ path, text });
        if (text !== this.document.text) return;
        this.reported = text;
        frame.src = address;
        this.#told(null);
      } catch (error) {
        const told = error.answer && error.answer.diagnostics;
        if (!told || text !== this.document.text) return this.failed(error);
        this.#mistakes({ ...found, diagnostics: told }, request);
        frame.classList.add("stale");
      }
    }, this.reported ? 900 : 0);
  }

  failed(error) {
    if (error.name === "AbortError") return;
    this.#told(error.message || String(error));
  }

  /** Something that has gone wrong, beside the mistakes. */
  #told(message) {
    const list = this.element("mistakes");
    list.dataset.shown = "";
    list.querySelectorAll(".told").forEach(item => item.remove());
    if (message) list.prepend(make("li", { class: "told" }, make("pre", {}, message)));
  }

  // files

  #state() {
    const { words } = this;
    const { path, isSaved, text } = this.document;
    this.element("path").textContent = path || this.named || words.unnamed;
    const wrong = this.diagnostics && this.diagnostics.length > 0;
    const state = this.isLost ? words.lost : !this.program.hasFolder ? words.offline : path === null && isSaved ? "" : isSaved ? words.saved : wrong ? words.changed_mistakes : words.changed;
    this.#say("state", state);
    this.element("undo").disabled = this.document.past.length === 0;
    this.element("redo").disabled = this.document.future.length === 0;
    this.element("save").disabled = text === "";
  }

  #say(id, text) {
    if (text === null) { this.#state(); return; }
    if (this.element(id).textContent !== text) this.element(id).textContent = text;
  }

  async #mayLeave() {
    if (this.document.isSaved || this.document.text === this.pristine) return true;
    const { words } = this;
    return await this.#choose(words.leave, make("p", {}, words.leave_text), [[words.go_on, "go"], [words.cancel, null]]) === "go";
  }

  #take(text, path, version, name = null) {
    this.document.replace(text, path, version);
    // the name of a file that is not one of the folder
    this.named = name;
    this.pristine = text;
    this.found = null;
    this.diagnostics = [];
    this.chosen = 0;
    this.row = 0;
    this.hasResults = false;
    this.reported = null;
    this.force = true;
    this.source.text = text;
    this.element("box-audit").hidden = true;
    this.element("results").hidden = true;
    this.#show("form");
    this.#state();
    this.#ask();
  }

  async #open(path) {
    try {
      const { text, version, path: of } = await this.program.ask("open", { path });
      this.#take(text, of || path, version);
    } catch (error) { this.failed(error); }
  }

  async #begin(request) {
    try {
      const { text } = await this.program.call("new", request);
      this.#take(text, null, null);
    } catch (error) { this.failed(error); }
  }

  async #autosave() {
    const { path, isSaved } = this.document;
    if (path === null || isSaved || !this.program.hasFolder) return;
    if (this.diagnostics && this.diagnostics.length) return;
    await this.save();
  }

  async save() {
    const { words } = this;
    clearTimeout(this.saver);
    await this.#settled();
    if (!this.program.hasFolder) return this.#download(new Blob([this.document.text]), this.document.path || this.named || "model.json");
    if (this.document.path === null) {
      const name = await this.#askName();
      if (!name) return;
      this.document.path = name.endsWith(".json") ? name : `${name}.json`;
      this.document.version = null;
    }
    if (this.isSaving) return;
    this.isSaving = true;
    const { path, text, version } = this.document;
    try {
      this.#say("state", words.saving);
      const saved = await this.program.ask("save", { path, text, version });
      this.document.version = saved.version;
      this.document.saved = text;
    } catch (error) {
      if (error.status === 409) { this.isSaving = false; return this.#conflict(error.answer); }
      this.failed(error);
    } finally { this.isSaving = false; }
    this.#state();
  }

  async #askName() {
    const { words } = this;
    const title = (this.found && this.found.title || "model").toLowerCase().normalize("NFKD").replace(/[^\p{L}\p{N}]+/gu, "_").replace(/^_|_$/g, "") || "model";
    const field = make("input", { value: `${title}.json`, size: 36 });
    const body = make("label", {}, words.save_name + " ", field);
    const chosen = await this.#choose(words.save_title, body, [[words.save, "save"], [words.cancel, null]]);
    return chosen ? field.value.trim() : null;
  }

  async #conflict({ text, version }) {
    const { words } = this;
    if (this.isAsked) return;
    this.isAsked = true;
    const chosen = await this.#choose(words.conflict_title, make("p", {}, words.conflict), [[words.mine, "mine"], [words.theirs, "theirs"]]);
    this.isAsked = false;
    this.document.version = version;
    if (chosen === "mine") {
      const mine = this.document.text;
      // the other one is a step of the history
      this.document.past.push(text);
      this.document.text = mine;
      return this.save();
    }
    if (chosen === "theirs") this.#fromDisk(text, version);
  }

  #fromDisk(text, version) {
    this.document.version = version;
    this.document.saved = text;
    if (text !== this.document.text) {
      this.document.last = null;
      this.document.set(text, "disk");
      this.#say("state", this.words.disk);
    }
  }

  async #onDisk({ path, version }) {
    if (path !== this.document.path) {
      // a table that the model names
      if (this.document.path !== null) { this.reported = null; this.#ask(); }
      return;
    }
    if (version === this.document.version || this.isSaving) return;
    if (version === null) { this.#say("state", this.words.gone); return; }
    const found = await this.program.ask("open", { path });
    if (found.version === this.document.version) return;
    if (found.text === this.document.text) { this.document.version = found.version; this.document.saved = found.text; this.#state(); return; }
    if (this.document.isSaved) this.#fromDisk(found.text, found.version);
    else this.#conflict(found);
  }

  async #openDialog() {
    const { words } = this;
    if (!await this.#mayLeave()) return;
    const { files } = await this.program.ask("files", {});
    const shown = files.filter(file => file.kind !== "other");
    const body = make("div", { class: "list" });
    const list = filter => shown.filter(file => `${file.path} ${file.title || ""}`.toLowerCase().includes(filter)).map(file =>
      make("button", { type: "button", class: "entry", onclick: () => this.#close(file.path) },
        make("b", {}, file.path), " ", make("span", { class: "detail" }, file.title || file.kind)));
    body.replaceChildren(...list(""));
    const filter = make("input", { type: "search", placeholder: words.search, "aria-label": words.search, oninput: () => body.replaceChildren(...list(filter.value.toLowerCase())) });
    const all = make("div", {}, shown.length > 8 ? filter : null, shown.length ? body : make("p", {}, words.open_none));
    const chosen = await this.#choose(words.open_title, all, [[words.from_disk, { pick: true }], [words.cancel, null]]);
    if (chosen && chosen.pick) this.#pick(this.program.hasFolder ? ".json,.csv,.xlsx" : "");
    else if (chosen) await this.#open(chosen);
  }

  async #newDialog() {
    const { words } = this;
    if (!await this.#mayLeave()) return;
    const { templates, examples } = await this.program.call("examples", {});
    const body = make("div", { class: "list" });
    const entry = (request, name, title) => make("button", { type: "button", class: "entry", onclick: () => this.#close(request) }, make("b", {}, name), " ", make("span", { class: "detail" }, title || ""));
    const list = filter => {
      const fits = of => `${of.name} ${of.title || ""} ${of.source || ""}`.toLowerCase().includes(filter);
      return [
        make("h3", {}, words.templates), ...templates.filter(fits).map(of => entry({ template: of.name }, of.name, of.title)),
        make("h3", {}, words.examples), ...examples.filter(fits).map(of => entry({ example: of.name }, of.name, of.title || of.source)),
      ];
    };
    body.replaceChildren(...list(""));
    const filter = make("input", { type: "search", placeholder: words.search, "aria-label": words.search, oninput: () => body.replaceChildren(...list(filter.value.toLowerCase())) });
    const chosen = await this.#choose(words.new_title, make("div", {}, filter, body), [[words.empty, {}], [words.cancel, null]]);
    if (chosen) await this.#begin(chosen);
  }

  async #exportDialog() {
    const { words } = this;
    const formats = FORMATS[this.kind] || [];
    const body = make("div", { class: "list" }, ...formats.map(format =>
      make("button", { type: "button", class: "entry", onclick: () => this.#close(format) }, make("b", {}, format))));
    const format = await this.#choose(words.export_title, body, [[words.cancel, null]]);
    if (!format) return;
    try {
      const { path, text } = this.document;
      const blob = await this.program.export({ path: path || (this.program.hasFolder ? null : this.named), text, format });
      const stem = (path || this.named || "model.json").replace(/^.*\//, "").replace(/\.[^.]*$/, "");
      this.#download(blob, `${stem}.${ENDINGS[format] || format}`);
    } catch (error) { this.failed(error); }
  }

  /** Recomputes the published values in this browser, and shows each beside what was published. */
  async #verifyDialog() {
    const { words } = this;
    this.#say("state", words.verifying);
    try {
      const { rows, pass } = await this.program.call("verify", {});
      const { paths } = await this.program.call("paths", {});
      const cells = row => [row.verdict, row.example, row.output, row.quantity, row.published, row.got, row.tolerance];
      const head = make("thead", {}, make("tr", {}, ...words.verify_headers.map(text => make("th", { scope: "col" }, text))));
      const line = row => make("tr", {}, ...cells(row).map(cell => make("td", {}, cell === null ? "" : String(cell))));
      const body = make("div", {},
        make("p", {}, words.verified(pass, rows.length, paths.map(of => of.hash).join(", "))),
        make("div", { class: "list", tabindex: "0" }, make("table", {}, head, make("tbody", {}, ...rows.map(line)))));
      await this.#choose(words.verify_title, body, [[words.close, null]]);
    } catch (error) { this.failed(error); }
    this.#state();
  }

  #download(blob, name) {
    const address = URL.createObjectURL(blob);
    make("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }

  #pick(accept) {
    const picked = this.element("picked");
    picked.accept = accept;
    picked.multiple = !this.program.hasFolder;
    picked.value = "";
    picked.onchange = () => { if (picked.files.length) this.#dropped([...picked.files]); };
    picked.click();
  }

  /**
   * Files of this computer. Those that the open text names are held for it; of others, one that no other
   * one names is opened, or imported where it is a table, and what it names is held.
   */
  async #dropped(files) {
    const { words } = this;
    const isJson = file => /\.json$/i.test(file.name);
    try {
      const texts = new Map();
      for (const file of files.filter(isJson)) texts.set(file, await file.text());
      const held = file => this.document.text.includes(file.name) || [...texts].some(([of, text]) => of !== file && text.includes(file.name));
      const kept = this.program.hasFolder ? [] : files.filter(held);
      const rest = files.filter(file => !kept.includes(file));
      // several files go together: the one that is opened names the others, perhaps after an edit
      const first = rest.find(isJson) || rest[0];
      if (!this.program.hasFolder) {
        for (const file of files) {
          if (file !== first || kept.includes(file)) await this.program.hold(file.name, await file.arrayBuffer());
        }
      }
      if (first && !await this.#mayLeave()) return;
      if (first && isJson(first)) this.#take(texts.get(first), null, null, first.name);
      else if (first) await this.#import(first);
      else this.#ask();
      const others = files.filter(file => file !== first).map(file => file.name);
      if (others.length && !this.program.hasFolder) this.#say("state", words.drop_held(others.join(", ")));
      this.reported = null;
    } catch (error) { this.failed(error); }
  }

  /** A table: one of results to be compared is opened, a budget imported. */
  async #import(file) {
    const { words } = this;
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.csv$/i.test(file.name)) {
      const text = new TextDecoder().decode(bytes);
      if (/^\ufeff?\s*"?label"?\s*[,;\t]/i.test(text)) { this.#take(text, null, null, file.name); return; }
    }
    let binary = "";
    for (let place = 0; place < bytes.length; place += 0x8000) binary += String.fromCharCode(...bytes.subarray(place, place + 0x8000));
    const made = await this.program.call("import", { name: file.name, base64: btoa(binary) });
    this.#take(made.text, null, null);
    const list = (title, said) => said.length ? [make("h3", {}, title), make("ul", {}, ...said.map(text => make("li", {}, text)))] : [];
    await this.#choose(words.import_title, make("div", {}, ...list(words.understood, made.notes)), [[words.ok, null]]);
  }

  // dialogs

  #choose(title, body, actions) {
    const dialog = this.element("dialog");
    if (dialog.open) dialog.close();
    this.element("dialog-title").textContent = title;
    this.element("dialog-body").replaceChildren(body);
    this.element("dialog-actions").replaceChildren(...actions.map(([label, value], place) =>
      make("button", { type: "button", class: place === 0 ? "first" : "", onclick: () => this.#close(value) }, label)));
    dialog.showModal();
    const field = body.querySelector("input");
    if (field) {
      field.focus();
      field.addEventListener("keydown", event => { if (event.key === "Enter") this.#close(actions[0][1]); });
    }
    return new Promise(resolve => {
      this.close = resolve;
      dialog.onclose = () => resolve(null);
    });
  }

  #close(value) {
    this.close(value);
    this.element("dialog").close();
  }

  // what somebody does

  #show(view) {
    this.view = view;
    const isText = view === "text" || this.kind !== "model";
    this.element("view-form").setAttribute("aria-pressed", !isText);
    this.element("view-text").setAttribute("aria-pressed", isText);
    this.element("form").hidden = isText;
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
    for (const element of document.querySelectorAll("[data-w-title]")) element.title = this.words[element.dataset.wTitle];
    this.element("language").value = this.language;
  }

  #listen() {
    const on = (id, name, act) => this.element(id).addEventListener(name, act);
    on("title", "input", event => this.edit([{ path: ["title"], value: event.target.value }], "title"));
    on("equations", "input", () => {
      const lines = this.#lines().filter(line => !line.isWrong && line.name !== "");
      this.edit([{ path: ["equations"], members: lines.map(line => [line.name, line.formula]) }], "equations");
    });
    on("equations", "blur", () => this.found && this.#showEquations(this.found, this.found.diagnostics.length === 0 && !this.#lines().some(line => line.isWrong)));
    on("source", "input", () => this.document.set(this.source.text, "text"));
    on("add-input", "click", () => this.addInputs([this.#freeName("x")]));
    on("add-correlation", "click", () => {
      const names = (this.found && this.found.inputs || []).map(of => of.name);
      const many = (this.found && this.found.correlations || []).length;
      const value = [names[0] || "a", names[1] || "b", 0];
      this.edit([this.found && this.found.correlations && many ? { path: ["correlations", many], value } : { path: ["correlations"], value: [value] }]);
    });
    on("add-condition", "click", () => this.edit([{ path: ["conditions", this.#freeName("condition")], value: { unit: "1", values: [1, 2] } }]));
    const toRow = row => { this.row = row; this.#ask(); };
    on("rows", "change", event => toRow(Number(event.target.value)));
    on("row-before", "click", () => toRow(this.row - 1));
    on("row-after", "click", () => toRow(this.row + 1));
    on("slid", "change", event => this.form.choose(event.target.value));
    on("slide", "input", () => this.form.slide(false));
    on("slide", "change", () => this.form.slide(true));
    on("view-form", "click", () => this.#show("form"));
    on("view-text", "click", () => this.#show("text"));
    on("undo", "click", () => this.undo());
    on("redo", "click", () => this.redo());
    on("save", "click", () => this.save());
    on("open", "click", () => this.#openDialog());
    on("new", "click", () => this.#newDialog());
    on("export", "click", () => this.#exportDialog());
    // with a server, the command line does it
    this.element("verify").hidden = this.program.hasFolder;
    on("verify", "click", () => this.#verifyDialog());
    on("import", "click", () => this.#pick(".csv,.xlsx"));
    on("language", "change", event => {
      this.language = event.target.value;
      this.words = this.language === "de" ? de : en;
      try { localStorage.setItem("language", this.language); } catch { /* not kept */ }
      this.#translate();
      this.element("mistakes").dataset.shown = "";
      put(this.element("part-audit"), "");
      if (this.found) this.answer(this.found, { text: this.document.text, path: this.document.path, at: performance.now() });
      this.#ask();
    });
    document.addEventListener("keydown", event => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
      const key = event.key.toLowerCase();
      const act = key === "s" ? () => this.save()
        : key === "z" && !event.shiftKey ? () => this.undo()
        : key === "y" || key === "z" && event.shiftKey ? () => this.redo() : null;
      if (!act || this.element("dialog").open) return;
      event.preventDefault();
      act();
    });
    document.addEventListener("dragover", event => event.preventDefault());
    document.addEventListener("drop", event => {
      event.preventDefault();
      const files = [...(event.dataTransfer && event.dataTransfer.files || [])];
      if (files.length) this.#dropped(files);
    });
    window.addEventListener("beforeunload", event => {
      if (!this.document.isSaved && this.document.text !== this.pristine) event.preventDefault();
    });
    matchMedia("(max-width: 40rem)").addEventListener("change", () => this.#ask());
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
