// What an input takes from another file is picked from a list: a column of a table, a quantity of a
// certificate, an output of a saved result.

import { folderOf, make, relative } from "./parts.js";

export class Pickers {
  constructor(page) { this.page = page; }

  get words() { return this.page.words; }

  /** Asks for a file and what of it the input takes, and makes the input take it. */
  async pick(way, row) {
    const { words, page } = this;
    const { files } = await page.program.ask("files", {});
    const fits = { readings: of => /\.(csv|tsv|txt)$/i.test(of.path), dcc: of => /\.xml$/i.test(of.path), result: of => of.kind === "result" }[way];
    const all = files.filter(fits);
    const file = await this.#one(words.pick_file[way], all.map(of => [of.path, of.path, of.title || ""]), words.pick_none[way]);
    if (!file) return;
    try {
      const named = relative(folderOf(page.document.path), file);
      const found = await page.program.call("contents", { file: named }, { path: page.document.path });
      const set = (key, value) => ({ path: [...row.path, key], value });
      const has = key => row.cells.some(cell => cell.key === key);
      const gone = keys => keys.filter(has).map(key => ({ path: [...row.path, key], remove: true }));
      if (way === "readings" && found.columns) {
        const column = await this.#one(words.pick_column, found.columns.map(name => [name, name, ""]));
        if (column) page.edit([...gone(["values"]), set("file", named), set("column", column)]);
      } else if (way === "dcc" && found.quantities) {
        const chosen = await this.#one(words.pick_quantity, found.quantities.flatMap((of, place) => values(of, place)));
        if (!chosen) return;
        const [place, index] = JSON.parse(chosen);
        const { input: first, unit } = found.quantities[place];
        const input = index === null ? first : { ...first, index };
        const keys = ["id", "ref_type", "within", "status", "quantity", "index", "at"].filter(key => !(key in input));
        page.edit([...gone(keys), ...Object.entries(input).map(([key, value]) => set(key, value)), set("unit", unit || "1")]);
      } else if (way === "result" && found.outputs) {
        const output = await this.#one(words.pick_output, found.outputs.map(of => [of.name, of.name, of.unit]));
        if (output) page.edit([set("file", named), set("output", output), set("unit", found.outputs.find(of => of.name === output).unit)]);
      }
    } catch (error) { page.failed(error); }
  }

  /** Asks which column of a pasted table holds the readings. */
  async column(rows) {
    const { words } = this;
    const head = rows[0];
    const place = await this.#one(words.pick_column, head.map((name, place) =>
      [String(place), name, rows.slice(1, 5).map(row => row[place] || "").join("  ")]));
    return place === null ? null : rows.slice(1).map(row => row[Number(place)] || "").filter(text => text.trim() !== "");
  }

  /** Asks for one of these: value, name, detail, whether it cannot be taken. */
  #one(title, choices, none = "") {
    const { dialog } = this.page;
    const entries = choices.map(([value, name, detail, isRefused]) => make("button", { type: "button", class: "entry", disabled: Boolean(isRefused), onclick: () => dialog.close(value) },
      make("b", {}, name), " ", make("span", { class: "detail" }, detail)));
    return dialog.choose(title, make("div", { class: "list" }, ...(entries.length ? entries : [make("p", {}, none)])), [[this.words.cancel, null]]);
  }
}

/** What a list shows of a quantity of a certificate: an entry for each of its values. */
function values({ name, id, ref_type: type, part, unread, values: all, unit, input }, place) {
  const said = name || id || type || String(place + 1);
  const of = part && part.name ? `, ${part.name}` : "";
  if (input === null) return [[JSON.stringify([place, null]), said, unread || "", true]];
  return all.map((value, index) => [JSON.stringify([place, all.length > 1 ? index : null]), said, `${value} ${unit || ""}${of}`]);
}
