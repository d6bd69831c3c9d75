// A field of code: a textarea with the mistakes underlined by a copy of its text behind it.

export class Code {
  constructor(box) {
    this.area = box.querySelector("textarea");
    this.back = box.querySelector("pre");
    this.marks = [];
    this.area.addEventListener("scroll", () => this.#scroll());
    this.area.addEventListener("input", () => { this.marks = []; this.#draw(); });
    new ResizeObserver(() => this.#scroll()).observe(this.area);
  }

  get text() { return this.area.value; }

  /** Puts a text there, unless somebody is writing in it. */
  set text(text) {
    if (this.area.value !== text) {
      const [from, to] = [this.area.selectionStart, this.area.selectionEnd];
      this.area.value = text;
      if (document.activeElement === this.area) this.area.setSelectionRange(from, to);
    }
    this.#draw();
  }

  /** Underlines ranges [start, end), in UTF-16 units. */
  mark(ranges) {
    const marks = ranges.map(([a, b]) => [a, Math.max(b, a + 1)]).sort((a, b) => a[0] - b[0]);
    if (String(marks) === String(this.marks)) return;
    this.marks = marks;
    this.area.setAttribute("aria-invalid", ranges.length > 0);
    this.#draw();
  }

  select(start, end) {
    this.area.focus();
    this.area.setSelectionRange(start, Math.max(end, start));
    const line = this.area.value.slice(0, start).split("\n").length;
    this.area.scrollTop = Math.max(0, (line - 5)) * parseFloat(getComputedStyle(this.area).lineHeight);
  }

  #draw() {
    // without marks there is nothing to be seen behind the text, however it is scrolled
    const text = this.area.value, parts = [];
    if (this.marks.length === 0) {
      if (this.isMarked) this.back.replaceChildren();
      this.isMarked = false;
      return;
    }
    this.isMarked = true;
    let at = 0;
    for (const [start, end] of this.marks) {
      if (start < at) continue;
      parts.push(text.slice(at, start));
      const mark = document.createElement("mark");
      // the end of a line has a letter's width, so that it can be seen
      mark.textContent = text.slice(start, end).replace(/^\n?$/, " ");
      parts.push(mark);
      if (text[start] === "\n" && end === start + 1) parts.push("\n");
      at = end;
    }
    parts.push(text.slice(at) + "\n ");
    this.back.replaceChildren(...parts);
    this.#scroll();
  }

  #scroll() {
    this.back.scrollTop = this.area.scrollTop;
    this.back.scrollLeft = this.area.scrollLeft;
  }
}
