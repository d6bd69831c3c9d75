// Answers while somebody types. A first answer comes from few trials, and while changes come in only
// the newest one is requested; after a pause the result is refined.

const FEW = 100000;
const REST = 250;
const AUDIT = 900;
const QUICK = 150;

export class Answers {
  constructor(program, shown) {
    this.program = program;
    this.shown = shown;
    this.wanted = null;
    this.isAsking = false;
    this.took = 0;
    this.later = null;
    this.slow = null;
  }

  /** Whether an answer is there before a hand makes the next change. */
  get isQuick() { return !this.isAsking && this.took < QUICK; }

  /** Changes a text and asks about it in one: the answer holds the text. */
  async edit(request, edits) {
    this.#stopSlow();
    const { path, at, ...asked } = request;
    const found = await this.program.call("answer", { ...asked, edits, trials: FEW }, { path });
    this.took = performance.now() - at;
    return found;
  }

  /** Shows an answer that somebody else has asked for. */
  given(request, found) {
    // what is asked for is about an older text
    if (this.isAsking || this.wanted) { this.ask(request); return; }
    this.shown.answer(found, request);
    this.#rest(request, found);
  }

  #stopSlow() {
    clearTimeout(this.later);
    // what is refined is out of date
    if (this.slow) this.slow.abort();
    this.slow = null;
  }

  #rest(request, found) {
    clearTimeout(this.later);
    if (!found.diagnostics.length) this.later = setTimeout(() => this.#refine(request, found), REST);
  }

  /** Asks about a text; `at` is when it was changed. */
  ask(request) {
    this.wanted = { ...request, at: performance.now() };
    this.#stopSlow();
    this.#next();
  }

  async #next() {
    if (this.isAsking) return;
    this.isAsking = true;
    while (this.wanted) {
      const request = this.wanted;
      this.wanted = null;
      try {
        const { path, at, ...asked } = request;
        const found = await this.program.call("answer", { ...asked, trials: FEW }, { path });
        this.took = performance.now() - at;
        this.shown.answer(found, request);
        if (!this.wanted) this.#rest(request, found);
      } catch (error) {
        this.shown.unanswered(error);
      }
    }
    this.isAsking = false;
  }

  async #refine(request, first) {
    const { path, at, ...asked } = request;
    if (first.kind !== "model") return;
    const slow = new AbortController();
    this.slow = slow;
    const signal = slow.signal;
    try {
      if (!first.whole) {
        const found = await this.program.call("answer", { ...asked, full: true }, { path, signal });
        if (signal.aborted) return;
        this.shown.answer(found, request);
      }
      await new Promise(done => setTimeout(done, AUDIT - REST));
      if (signal.aborted) return;
      const found = await this.program.call("audit", { text: asked.text, name: asked.name, lang: asked.lang }, { path, signal });
      if (!signal.aborted) this.shown.audit(found);
    } catch (error) {
      if (error.name !== "AbortError" && !signal.aborted) this.shown.failed(error);
    }
  }
}
