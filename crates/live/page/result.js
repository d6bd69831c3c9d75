// The result of a model: headline, budget, figures; of other files their page.

import { grouped, make, printed, put, unit } from "./parts.js";

const SPEAK = 900;
const REPORT = 500;

export class Result {
  constructor(page) {
    this.page = page;
    this.element = page.element;
  }

  get words() { return this.page.words; }

  /** Nothing is shown, as of a file that was just opened. */
  clear() {
    this.hasResults = false;
    this.reported = null;
    // what the last full answer stated
    this.stated = null;
    this.hasPage = false;
    this.element("box-audit").hidden = true;
    this.element("results").hidden = true;
    this.#bar();
    this.page.diagnosis.clear();
  }

  /** What is no answer to the text as it stands is grey as a whole, and says what it belongs to. */
  age() {
    const { words, page } = this;
    const why = page.isLost ? words.old_lost : page.isUnanswered ? words.old_failed : this.isBefore ? words.stale : null;
    this.element("results").classList.toggle("stale", why !== null);
    this.element("bar").classList.toggle("stale", why !== null);
    const stale = this.element("stale");
    stale.hidden = why === null || !this.hasResults;
    if (stale.textContent !== (why || "")) stale.textContent = why || "";
    if (page.isLost || page.isUnanswered) this.element("report").classList.add("stale");
    this.#bar();
  }

  /** The bar with the answer, while the headline is out of sight. */
  #bar() {
    const hasValue = this.hasResults && this.element("headline").childElementCount > 0;
    this.element("bar").hidden = !hasValue || this.isInSight || this.element("results").hidden;
    document.body.classList.toggle("has-bar", !this.element("bar").hidden);
  }

  /** Watches whether the headline is in sight. */
  watch() {
    new IntersectionObserver(entries => {
      this.isInSight = entries[entries.length - 1].isIntersecting;
      this.#bar();
    }).observe(this.element("headline"));
  }

  results(found) {
    const { words } = this;
    this.element("report").hidden = true;
    this.page.diagnosis.clear();
    this.element("lacking").hidden = true;
    const has = found.results !== undefined;
    const results = this.element("results");
    this.isBefore = !has;
    if (has && found.whole && found.results.length) {
      const [kind, ...others] = new Set(found.results.map(of => of.statement.kind));
      this.stated = others.length ? null : { interval: "monte-carlo", expanded: "gum" }[kind] || null;
    }
    if (!has) {
      this.age();
      this.element("nothing").textContent = (found.equations || []).length ? words.nothing : words.nothing_yet;
      this.element("nothing").hidden = this.hasResults;
      results.hidden = !this.hasResults;
      return;
    }
    this.hasResults = true;
    results.hidden = false;
    this.element("nothing").hidden = true;
    const outputs = found.results;
    this.page.chosen = Math.max(0, Math.min(this.page.chosen, outputs.length - 1));
    this.#tabs(outputs);
    this.#rows(found);
    const of = outputs[this.page.chosen];
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
    const trials = grouped(found.trials);
    const rest = found.whole ? words.done : found.full ? words.cut : words.refining;
    this.element("progress").textContent = found.trials ? words.trials(trials) + rest : "";
    this.age();
  }

  #tabs(outputs) {
    const tabs = this.element("output-tabs");
    const key = JSON.stringify(outputs.map(of => of.name));
    tabs.hidden = outputs.length < 2;
    if (tabs.dataset.names !== key) {
      tabs.dataset.names = key;
      tabs.replaceChildren(...outputs.map((of, place) => make("button", {
        type: "button", onclick: () => {
          this.page.chosen = place;
          // the parts of the others were not asked for
          if (outputs[place].html.verdict === "") this.page.ask();
          else this.results(this.page.found);
        },
      }, of.name)));
    }
    [...tabs.children].forEach((button, place) => button.setAttribute("aria-pressed", place === this.page.chosen));
  }

  /** The rows of conditions: the headline and the parts below it are about one of them. */
  #rows(found) {
    const box = this.element("rows-box"), choice = this.element("rows");
    const names = found.row_names || [];
    box.hidden = names.length === 0;
    this.page.row = found.row || 0;
    const key = JSON.stringify(names);
    if (choice.dataset.names !== key) {
      choice.dataset.names = key;
      choice.replaceChildren(...names.map((name, place) => make("option", { value: String(place) }, name)));
    }
    choice.value = String(this.page.row);
    const first = this.page.row === 0, last = this.page.row >= names.length - 1;
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
    const { clause_8: clause, conformity } = of;
    const number = text => words.number(printed(text));
    const { value: nodes, said } = stated(of, found, words);
    const value = make("p", { class: "value" }, ...nodes);
    const line = make("p", { class: "said" }, said.join(" · "));
    const key = value.textContent + line.textContent;
    if (place.dataset.key !== key) {
      place.dataset.key = key;
      place.replaceChildren(value, line);
      this.element("bar-value").replaceChildren(value.cloneNode(true), make("p", { class: "said" }, said[0] || ""));
      clearTimeout(this.speaker);
      this.speaker = setTimeout(() => { this.element("spoken").textContent = `${value.textContent}; ${line.textContent}`; }, SPEAK);
    }
    const marks = [];
    if (clause) {
      const text = clause.valid === true ? words.clause_yes : clause.valid === false ? words.clause_no : words.clause_open;
      const look = clause.valid === true ? "yes" : clause.valid === false ? "no" : "open";
      marks.push(make("span", { class: `badge ${look}` }, text), make("span", { class: "detail" }, words.clause_detail(...[clause.d_low, clause.d_high, clause.tolerance].map(number))));
    }
    if (conformity) {
      // what rounds to certainty is none
      const share = 100 * conformity.probability;
      const p = share >= 99.995 ? "> 99.99" : share < 0.005 ? "< 0.01" : String(Number(share.toFixed(2)));
      const { conforms, statement } = conformity;
      const look = conforms ? "yes" : (statement || "").startsWith("conditional") ? "open" : "no";
      const said = statement ? words.stated(statement, number(p)) : conforms ? words.conforms(number(p)) : words.not_conforms(number(p));
      marks.push(make("span", { class: `badge ${look}` }, said));
    }
    badges.replaceChildren(...marks);
    const short = marks.filter(of => of.classList.contains("badge")).map(of => of.cloneNode(true));
    if (clause) short[0].textContent = clause.valid === true ? words.bar_yes : clause.valid === false ? words.bar_no : words.bar_open;
    this.element("bar-badges").replaceChildren(...short);
  }

  audit(found) {
    this.element("box-audit").hidden = !found.html;
    put(this.element("part-audit"), found.html || "");
  }

  /** What a certificate lacks is said in place of its page. */
  #lacking(found) {
    const place = this.element("lacking");
    const lacks = found.lacking || [];
    place.hidden = lacks.length === 0;
    const { lacks: title, lack } = this.words.certificate;
    const key = JSON.stringify([title, lacks]);
    if (place.dataset.key === key) return;
    place.dataset.key = key;
    place.replaceChildren(make("p", {}, title), make("ul", {}, ...lacks.map(path => make("li", {},
      make("button", { type: "button", class: "link", onclick: () => this.page.mistakes.goTo({ path }) }, lack[path[0]])))));
  }

  /** The page of a case, a certificate, a comparison or a recipe. */
  report(found, request) {
    this.element("results").hidden = true;
    this.hasResults = false;
    this.element("output-tabs").hidden = true;
    this.element("nothing").hidden = true;
    if (found.kind === "case") return this.page.diagnosis.show(found, request);
    this.page.diagnosis.clear();
    this.#lacking(found);
    const frame = this.element("report");
    const lacks = (found.lacking || []).length > 0;
    if (["other", "costs", "result"].includes(found.kind)) { frame.hidden = true; return; }
    frame.hidden = (lacks || found.diagnostics.length > 0) && !this.hasPage;
    clearTimeout(this.reporter);
    const { text, path } = request;
    // what was true before the mistake stays there
    frame.classList.toggle("stale", found.diagnostics.length > 0 || lacks);
    this.wanted = null;
    if (this.reported === text || found.diagnostics.length || lacks) return;
    this.wanted = { text, path, found, request };
    this.reporter = setTimeout(() => this.#make(), this.reported ? REPORT : 0);
  }

  /** Makes the page that is wanted; one after the other, since they take a while. */
  async #make() {
    if (this.isMaking) return;
    this.isMaking = true;
    while (this.wanted) {
      const { text, path, found, request } = this.wanted;
      this.wanted = null;
      try {
        const { address } = await this.page.program.page({ path, text });
        if (text !== this.page.document.text) continue;
        this.reported = text;
        this.turn(address);
        this.page.mistakes.told(null);
      } catch (error) {
        const told = error.answer && error.answer.diagnostics;
        if (text !== this.page.document.text) continue;
        if (!told) { this.page.failed(error); continue; }
        this.page.mistakes.show({ ...found, diagnostics: told }, request);
        this.element("report").classList.add("stale");
      }
    }
    this.isMaking = false;
  }

  /** Another page in place of the one that is shown, when it is there, at the place that was read. */
  turn(address) {
    const shown = this.element("report");
    if (this.coming) this.coming.remove();
    this.coming = null;
    if (!this.hasPage) { shown.src = address; this.hasPage = true; return; }
    const next = shown.cloneNode();
    next.removeAttribute("id");
    next.classList.add("coming");
    next.src = address;
    next.onload = () => {
      if (this.coming !== next) return;
      this.coming = null;
      try { next.contentWindow.scrollTo(shown.contentWindow.scrollX, shown.contentWindow.scrollY); } catch { /* another origin */ }
      next.className = "";
      next.title = shown.title;
      if (shown.src.startsWith("blob:")) URL.revokeObjectURL(shown.src);
      shown.remove();
      next.id = "report";
      next.hidden = false;
    };
    this.coming = next;
    shown.after(next);
  }
}

/** What is stated of an output: nodes of the value, and sentences of its uncertainty. */
export function stated({ name, unit: of, statement }, found, words) {
  const bare = of === "" || of === "1";
  const percent = words.number(String(Number((100 * found.coverage_probability).toFixed(2))));
  const number = text => words.number(printed(text));
  const value = [make("i", {}, name)];
  const said = [];
  if (statement.kind === "expanded") {
    const both = `${number(statement.estimate)} ± ${number(statement.expanded)}`;
    value.push(" = ", bare ? both : `(${both})`);
    said.push(`k = ${number(statement.factor)}`, words.coverage(percent));
  } else if (statement.kind === "interval") {
    value.push(" = ", number(statement.estimate));
    said.push(`${words.interval} ${words.from_to(number(statement.low), number(statement.high))} (${statement.shortest ? words.shortest : words.symmetric})`, words.coverage(percent));
    if (statement.uncertainty !== null) said.push(words.standard(number(statement.uncertainty)));
  } else if (statement.kind === "standard") {
    value.push(" = ", number(statement.estimate));
    said.push(words.standard(number(statement.uncertainty)));
  } else {
    value.push(" ", words.undefined);
  }
  if (!bare && statement.kind !== "undefined") value.push("\u2009", make("span", { class: "unit" }, ...unit(of)));
  return { value, said };
}
