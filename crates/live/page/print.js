// What a printed sheet says of the measurement, so that it can be told from another one.

import { grouped, make } from "./parts.js";

export function fillPrint(page) {
  const { found, words } = page;
  const place = page.element("print");
  if (found.kind !== "model") { place.replaceChildren(); return; }
  const equations = found.statement && found.statement.length ? found.statement : (found.equations || []).map(of => [of.name, of.formula]);
  const cell = (row, key) => (row.cells.find(of => of.key === key) || {}).raw || "";
  const inputs = (found.inputs || []).map(row => make("tr", {},
    make("th", { scope: "row" }, row.name),
    ...[row.said ? words.number(row.said[0]) : "", row.said ? words.number(row.said[1]) : "", row.said && row.said[2] !== "1" ? row.said[2] : "",
      row.form === "text" ? row.text : words.ways[row.way] || words.shapes[row.way] || row.way || "", cell(row, "about")].map(text => make("td", {}, text))));
  const heads = [words.name, words.key.mean, words.short.std, words.unit, words.how, words.key.about];
  const facts = [page.document.path || page.named || words.unnamed, found.source, found.trials ? words.trials(grouped(found.trials)) : null,
    `${words.key.seed}: ${found.seed}`, `gumption ${page.form.kinds.version}`];
  place.replaceChildren(
    make("h1", {}, found.title || page.document.path || words.unnamed),
    make("p", {}, facts.filter(text => text).join(" · ")),
    make("h2", {}, words.equations),
    ...equations.map(([name, formula]) => make("p", { class: "formula" }, `${name} = ${formula}`)),
    make("h2", {}, words.inputs),
    make("table", {}, make("thead", {}, make("tr", {}, ...heads.map(text => make("th", { scope: "col" }, text)))), make("tbody", {}, ...inputs)));
}
