// The field of equations: a line an equation, each underlined where it is wrong.

import { Code } from "./code.js";

export class Equations {
  constructor(page) {
    this.page = page;
    this.element = page.element;
    this.code = new Code(this.element("equations-box"));
  }

  show(found, force) {
    const isWritten = document.activeElement === this.code.area;
    const text = (found.equations || []).map(({ name, formula }) => `${name} = ${formula}`).join("\n");
    if (!isWritten || force) this.code.text = text;
    const area = this.code.area;
    area.rows = Math.max(3, Math.min(14, this.code.text.split("\n").length + 1));
    area.readOnly = Boolean(found.model);
    for (const id of ["equations-box", "equations-hint", "add-input"]) this.element(id).hidden = Boolean(found.model);
  }

  /** The lines of the field of equations: where each formula begins, and what is none. */
  lines() {
    const lines = [];
    let start = 0;
    for (const line of this.code.text.split("\n")) {
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
}
