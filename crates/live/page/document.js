// The text of the open file with its history. The text is the truth: every field shows a part of it.

const MOST = 500;
const SAME = 900;

export class Document {
  constructor(changed) {
    this.changed = changed;
    this.replace("", null, null);
  }

  /** Another file. */
  replace(text, path, version) {
    this.text = text;
    this.path = path;
    this.version = version;
    this.saved = path === null ? null : text;
    this.past = [];
    this.future = [];
    this.last = null;
  }

  get isSaved() { return this.saved === this.text; }

  /** A change; changes of one kind that follow each other closely are undone as one. */
  set(text, kind = null) {
    if (text === this.text) return;
    const now = performance.now();
    const same = kind !== null && this.last && this.last.kind === kind && now - this.last.at < SAME;
    if (!same) {
      this.past.push(this.text);
      if (this.past.length > MOST) this.past.shift();
    }
    this.last = { kind, at: now };
    this.future = [];
    this.text = text;
    this.changed(kind);
  }

  undo() { this.#go(this.past, this.future); }
  redo() { this.#go(this.future, this.past); }

  #go(from, to) {
    if (from.length === 0) return;
    to.push(this.text);
    this.text = from.pop();
    this.last = null;
    this.changed("undo");
  }
}
