// The diagnosis of a case beside its form: made after a pause, with its share, a way to stop it, and
// what it proposes.

import { make } from "./parts.js";

// a diagnosis takes as long as a hand needs for several changes
const PAUSE = 1500;
// where the headline of the report says that something is sure, or likely
const SURE = 0.95;
const LIKELY = 0.5;
// composed effects that are less probable are not offered
const OFFERED = 0.02;

export class Diagnosis {
  constructor(page) {
    this.page = page;
    this.element = page.element;
    this.clear();
    this.element("case-stop").addEventListener("click", () => this.stop());
    this.element("case-diagnose").addEventListener("click", () => this.#begin());
  }

  get words() { return this.page.words; }

  /** Another file: nothing of the last one stays, and what is being computed for it ends. */
  clear() {
    clearTimeout(this.later);
    if (this.running) this.running.abort.abort();
    this.running = null;
    this.done = null;
    this.isHeld = false;
    this.wanted = null;
    this.element("case-result").hidden = true;
  }

  /** What an answer says of the case: it may be diagnosed, or lacks something. */
  show(found, request) {
    const { text, path } = request;
    this.element("case-result").hidden = false;
    this.lacks = this.page.caseForm.lacks(found);
    const isComplete = !this.lacks.length && !found.diagnostics.length && found.content !== null;
    const isNew = !this.wanted || this.wanted.text !== text;
    this.wanted = isComplete ? { text, path } : null;
    if (this.running && this.running.text !== text) {
      this.running.abort.abort();
      this.running = null;
    }
    if (!isComplete || isNew) clearTimeout(this.later);
    if (isComplete && isNew && !this.isHeld && !this.isCurrent && !this.running) {
      this.later = setTimeout(() => this.#begin(), this.done ? PAUSE : 0);
    }
    this.#draw();
  }

  /** Whether the page that is there is that of the text as it is. */
  get isCurrent() { return Boolean(this.done && this.wanted && this.done.text === this.wanted.text); }

  /** Stops what is being computed; the next one begins when somebody asks for it. */
  stop() {
    clearTimeout(this.later);
    if (this.running) this.running.abort.abort();
    this.running = null;
    this.isHeld = true;
    this.#draw();
    this.element("case-diagnose").focus();
  }

  async #begin() {
    clearTimeout(this.later);
    if (!this.wanted || this.running) return;
    this.isHeld = false;
    const running = { ...this.wanted, abort: new AbortController(), share: null };
    this.running = running;
    this.#draw();
    const told = share => {
      running.share = share;
      if (this.running === running) this.#share();
    };
    try {
      const { text, path } = running;
      const made = await this.page.program.page({ path, text }, { signal: running.abort.signal, told });
      if (this.running !== running) return;
      this.running = null;
      this.done = { text, answer: made.answer };
      this.page.result.turn(made.address);
      this.page.mistakes.told(null);
    } catch (error) {
      if (this.running !== running) return;
      this.running = null;
      this.isHeld = true;
      const told = error.answer && error.answer.diagnostics;
      if (told) this.page.mistakes.show({ ...this.page.found, diagnostics: told }, { text: running.text });
      else this.page.failed(error);
    }
    this.#draw();
  }

  // what is shown

  #share() {
    const bar = this.element("case-progress");
    const { share } = this.running;
    if (share === null) bar.removeAttribute("value"); else bar.value = share;
    this.element("case-state").textContent = share === null ? this.words.case_running : `${this.words.case_running} ${Math.floor(100 * share)} %`;
  }

  #draw() {
    const { words } = this;
    const isRunning = this.running !== null;
    this.element("case-progress").hidden = !isRunning;
    this.element("case-stop").hidden = !isRunning;
    const lacks = this.element("case-lacks");
    lacks.hidden = !this.lacks.length;
    lacks.replaceChildren(...this.lacks.map(of => make("li", {}, of.say)));
    this.element("case-lacks-title").hidden = !this.lacks.length;
    const diagnose = this.element("case-diagnose");
    diagnose.hidden = isRunning || this.isCurrent || Boolean(this.wanted) && !this.isHeld;
    diagnose.disabled = !this.wanted;
    const frame = this.element("report");
    frame.hidden = !this.done;
    frame.classList.toggle("stale", !this.isCurrent);
    this.element("case-proposals").classList.toggle("stale", !this.isCurrent);
    const old = this.element("case-old");
    old.hidden = !this.done || this.isCurrent;
    if (isRunning) this.#share();
    else this.element("case-state").textContent = this.isHeld && this.wanted ? words.case_stopped : this.wanted && !this.isCurrent ? words.case_waiting : "";
    this.#verdict();
    this.#proposals();
  }

  #verdict() {
    const place = this.element("case-verdict");
    place.hidden = !this.done;
    if (!this.done) return;
    const { words } = this;
    const { verdict, hypotheses } = this.done.answer;
    const none = hypotheses.find(of => of.effects && of.effects.length === 0);
    const p = words.number(certainty(verdict.probability));
    const isSure = verdict.kind === "none" || 1 - (none ? none.probability : 0) >= SURE;
    const isLikely = verdict.probability >= LIKELY;
    const names = verdict.effects.join(" + ");
    const what = verdict.kind === "none" ? words.case_none(p) : verdict.kind === "unexplained" ? words.case_unexplained(p) : verdict.beside ? words.case_beside(names, p) : words.case_explained(names, p);
    const said = isSure && isLikely ? what : words.case_open(what);
    if (place.textContent !== said) place.textContent = said;
  }

  #proposals() {
    const place = this.element("case-proposals");
    place.hidden = !this.done;
    if (!this.done) { place.replaceChildren(); return; }
    const { words } = this;
    const { answer } = this.done;
    const { effects } = this.page.caseForm;
    const drawn = JSON.stringify([this.page.language, this.done.text, this.isCurrent, (answer.composed || []).map(of => effects.has(of.name)), (answer.unlisted || []).map(of => effects.has(of.effect))]);
    if (place.dataset.drawn === drawn) return;
    place.dataset.drawn = drawn;
    const button = (name, word, label, add) => effects.has(name) ? make("span", { class: "detail" }, words.case_added)
      : make("button", { type: "button", "aria-label": label, onclick: add }, word);
    const percent = p => words.number(certainty(p));
    const composed = (answer.composed || []).filter(of => of.probability >= OFFERED);
    const unlisted = answer.unlisted || [];
    const next = answer.next_measurement || [];
    const part = (title, hint, items) => items.length ? [make("h3", {}, title), hint ? make("p", { class: "hint" }, hint) : null, make("ul", { class: "proposals" }, ...items)] : [];
    place.replaceChildren(...[
      ...part(words.case_composed, words.case_composed_hint, composed.map(of => make("li", {},
        make("div", {}, make("b", {}, of.name), " ", make("span", { class: "detail" }, words.case_probability(percent(of.probability))),
          ...Object.entries(of.overrides).map(([name, formula]) => make("code", { class: "formula" }, `${name} = ${formula}`))),
        button(of.name, words.case_add_composed, words.case_add_of(of.name), () => effects.addComposed(of))))),
      ...part(words.case_unlisted, null, unlisted.map(of => make("li", {},
        make("div", {}, make("b", {}, of.effect), " ", make("span", { class: "detail" }, words.case_probability(percent(of.probability)))),
        button(of.effect, words.case_add_listed, words.case_add_of(of.effect), () => effects.addListed(of.effect))))),
      ...part(words.case_next, null, next.map(of => make("li", {}, this.#next(of)))),
    ].filter(of => of !== null));
  }

  /** A proposed measurement in words. */
  #next(of) {
    const { words } = this;
    const number = value => words.number(String(Number(value.toPrecision(4))));
    const units = Object.fromEntries(((this.page.found || {}).conditions || { rows: [] }).rows.map(row => [row.name, (row.cells.find(cell => cell.key === "unit") || {}).raw]));
    const unit = text => text && text !== "1" ? ` ${text}` : "";
    const place = Object.entries(of.conditions || {}).map(([name, value]) => `${name} = ${number(value)}${unit(units[name])}`).join(", ");
    if (of.kind === "input") return words.case_next_input(of.input, `${number(of.stated_standard_uncertainty)}${unit(of.unit)}`, `${number(of.standard_uncertainty)}${unit(of.unit)}`);
    if (of.kind === "output") return words.case_next_output(of.output, of.count, place);
    return words.case_next_rows[of.kind](of.count, place);
  }
}

/** A probability in percent; what rounds to certainty is none. */
function certainty(p) {
  return p >= 0.999 ? ">\u00a099.9" : p < 0.001 ? "<\u00a00.1" : (100 * p).toPrecision(p < 0.1 ? 2 : 3);
}
