// What a page does with a script: it shows the values of a figure's points, sorts tables, enlarges
// figures and hides what one method found. It loads nothing, sends nothing and keeps nothing; a page
// says the same without it.
"use strict";
(() => {
  const WORDS = {
    en: { sort: "sort by", enlarge: "Enlarge", close: "Close", larger: "Zoom in", smaller: "Zoom out", whole: "Whole figure", methods: "Show" },
    de: { sort: "sortieren nach", enlarge: "Vergrößern", close: "Schließen", larger: "Näher", smaller: "Weiter", whole: "Ganze Abbildung", methods: "Zeigen" },
    fr: { sort: "trier par", enlarge: "Agrandir", close: "Fermer", larger: "Plus près", smaller: "Plus loin", whole: "Figure entière", methods: "Montrer" },
    it: { sort: "ordinare per", enlarge: "Ingrandire", close: "Chiudere", larger: "Più vicino", smaller: "Più lontano", whole: "Figura intera", methods: "Mostrare" },
  };
  const words = WORDS[document.documentElement.lang] ?? WORDS.en;
  const make = (name, attributes = {}, ...inside) => {
    const made = document.createElement(name);
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    made.append(...inside);
    return made;
  };
  const button = (text, does) => {
    const made = make("button", { type: "button", class: "tool" }, text);
    made.addEventListener("click", does);
    return made;
  };

  document.head.append(make("style", {}, `
    .tool { font: inherit; font-size: 0.85rem; color: var(--after); background: none; border: 1px solid; border-radius: 0.25rem; padding: 0.1rem 0.5rem; cursor: pointer; }
    th .tool { all: unset; cursor: pointer; white-space: inherit; }
    .tool:focus-visible { outline: 2px solid var(--after); outline-offset: 2px; }
    th[aria-sort] .tool::after { content: " \\2195"; color: var(--weak); }
    th[aria-sort="ascending"] .tool::after { content: " \\2191"; color: inherit; }
    th[aria-sort="descending"] .tool::after { content: " \\2193"; color: inherit; }
    .value { position: fixed; z-index: 9; max-width: min(24rem, 90vw); padding: 0.25rem 0.5rem; background: var(--ink); color: var(--paper); font-size: 0.85rem; border-radius: 0.25rem; pointer-events: none; }
    .methods { display: flex; flex-wrap: wrap; gap: 0.25rem 1rem; border: 0; margin: 0.75rem 0; padding: 0; font-size: 0.92rem; }
    .methods legend { float: left; padding: 0 1rem 0 0; }
    .off { display: none; }
    dialog.large { width: 96vw; height: 94vh; max-width: none; max-height: none; padding: 0.5rem; border: 1px solid var(--weak); background: var(--paper); color: var(--ink); }
    dialog.large[open] { display: flex; flex-direction: column; gap: 0.5rem; }
    dialog.large svg { flex: 1; min-height: 0; width: 100%; touch-action: none; cursor: grab; }
    @media print { .tool:not(th .tool), .methods, .value { display: none; } th[aria-sort] .tool::after { content: none; } }
  `));

  // the values of points: the nearest one to the pointer, in a box beside it
  const NEAR = 28;
  const box = make("div", { class: "value", hidden: "", "aria-hidden": "true" });
  document.body.append(box);
  const show = (text, x, y, inside) => {
    inside.append(box);
    box.hidden = text === "";
    box.textContent = text;
    const room = document.documentElement;
    box.style.left = `${Math.max(0, Math.min(x + 14, room.clientWidth - box.offsetWidth - 4))}px`;
    box.style.top = `${Math.max(0, y - box.offsetHeight - 10)}px`;
  };
  const values = (svg, inside) => {
    const points = [...svg.querySelectorAll("circle > title")].map(title => {
      const circle = title.parentNode;
      // the browser's own box would come after a while, and stand over this one
      if (!circle.dataset.value) circle.dataset.value = title.textContent;
      title.remove();
      return circle;
    });
    const all = points.length > 0 ? points : [...svg.querySelectorAll("circle[data-value]")];
    if (all.length === 0) return;
    svg.addEventListener("pointermove", event => {
      let best = null, least = NEAR;
      for (const circle of all) {
        if (circle.closest(".off")) continue;
        const at = circle.getBoundingClientRect();
        const away = Math.hypot(at.x + at.width / 2 - event.clientX, at.y + at.height / 2 - event.clientY);
        if (away < least) [best, least] = [circle, away];
      }
      show(best === null ? "" : best.dataset.value, event.clientX, event.clientY, inside);
    });
    svg.addEventListener("pointerleave", () => show("", 0, 0, inside));
  };

  // tables: a header sorts by its column, up, down, and as it was
  const SPACES = /[\u2007\u2008\u2009\u202f\u00a0\s]/g;
  const number = text => {
    const plain = text.replace(SPACES, "").replace(",", ".").replace(/^[<>≈]/, "").replace("−", "-");
    if (/^[+-]?∞$/.test(plain)) return plain.startsWith("-") ? -Infinity : Infinity;
    const found = /^\(?[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?/i.exec(plain);
    return found ? Number(found[0].replace("(", "")) : NaN;
  };
  const sortable = table => {
    const head = table.tHead?.rows[0], body = table.tBodies[0];
    if (!head || body.rows.length < 3) return;
    const whole = [...body.rows];
    const rows = whole.filter(row => !row.classList.contains("total"));
    // rows that are named by the one above them stay below it
    const names = rows.map(row => row.cells[0].textContent.trim());
    if (new Set(names).size < names.length || names.includes("") || names.includes("to")) return;
    [...head.cells].forEach((cell, place) => {
      if (cell.tagName !== "TH") return;
      const text = cell.textContent;
      const sort = button("", () => {
        const now = cell.getAttribute("aria-sort");
        const next = now === "none" ? "ascending" : now === "ascending" ? "descending" : "none";
        for (const other of head.cells) if (other.hasAttribute("aria-sort")) other.setAttribute("aria-sort", "none");
        cell.setAttribute("aria-sort", next);
        if (next === "none") return body.append(...whole);
        const sign = next === "ascending" ? 1 : -1;
        const of = row => row.cells[place]?.textContent.trim() ?? "";
        const numbers = rows.some(row => !Number.isNaN(number(of(row)))) && cell.classList.contains("number");
        const sorted = [...rows].sort((a, b) => {
          if (!numbers) return sign * of(a).localeCompare(of(b), undefined, { numeric: true });
          const [x, y] = [number(of(a)), number(of(b))];
          // what is no number comes last either way
          if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
          return x === y ? 0 : sign * (x < y ? -1 : 1);
        });
        body.append(...sorted, ...whole.filter(row => !rows.includes(row)));
      });
      sort.title = `${words.sort} ${text}`;
      sort.append(...cell.childNodes);
      cell.append(sort);
      cell.setAttribute("aria-sort", "none");
    });
  };

  // figures: one fills the window, where it is enlarged about the pointer and moved
  const enlarge = figure => {
    const shown = [...figure.querySelectorAll("svg")].find(svg => svg.getClientRects().length > 0) ?? figure.querySelector("svg");
    const svg = shown.cloneNode(true);
    svg.removeAttribute("class");
    svg.removeAttribute("aria-labelledby");
    svg.setAttribute("aria-label", figure.querySelector("figcaption").textContent);
    svg.setAttribute("tabindex", "0");
    const [, , width, height] = svg.getAttribute("viewBox").split(" ").map(Number);
    let view = [0, 0, width, height];
    const look = next => {
      const w = Math.min(width, Math.max(width / 40, next[2])), h = w * height / width;
      view = [Math.min(width - w, Math.max(0, next[0])), Math.min(height - h, Math.max(0, next[1])), w, h];
      svg.setAttribute("viewBox", view.join(" "));
    };
    const zoom = (factor, x = view[0] + view[2] / 2, y = view[1] + view[3] / 2) =>
      look([x - (x - view[0]) * factor, y - (y - view[1]) * factor, view[2] * factor, 0]);
    const place = event => {
      const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
      return [at.x, at.y];
    };
    svg.addEventListener("wheel", event => {
      event.preventDefault();
      zoom(event.deltaY > 0 ? 1.25 : 0.8, ...place(event));
    }, { passive: false });
    let held = null;
    svg.addEventListener("pointerdown", event => { held = place(event); svg.setPointerCapture(event.pointerId); });
    svg.addEventListener("pointerup", () => { held = null; });
    svg.addEventListener("pointermove", event => {
      if (held === null) return;
      const [x, y] = place(event);
      look([view[0] + held[0] - x, view[1] + held[1] - y, view[2], 0]);
    });
    const KEYS = {
      "+": () => zoom(0.8), "=": () => zoom(0.8), "-": () => zoom(1.25), "0": () => look([0, 0, width, height]),
      ArrowLeft: () => look([view[0] - view[2] / 10, view[1], view[2], 0]), ArrowRight: () => look([view[0] + view[2] / 10, view[1], view[2], 0]),
      ArrowUp: () => look([view[0], view[1] - view[3] / 10, view[2], 0]), ArrowDown: () => look([view[0], view[1] + view[3] / 10, view[2], 0]),
    };
    const dialog = make("dialog", { class: "large", "aria-label": words.enlarge });
    dialog.addEventListener("keydown", event => {
      if (!KEYS[event.key] || event.ctrlKey || event.metaKey) return;
      event.preventDefault();
      KEYS[event.key]();
    });
    const tools = make("div", {}, button(words.close, () => dialog.close()), " ", button(words.larger, KEYS["+"]), " ",
      button(words.smaller, KEYS["-"]), " ", button(words.whole, KEYS["0"]));
    dialog.append(tools, svg);
    dialog.addEventListener("close", () => { document.body.append(box); box.hidden = true; dialog.remove(); });
    document.body.append(dialog);
    values(svg, dialog);
    dialog.showModal();
  };

  // methods: what one of them found is hidden, in tables and in figures
  const METHODS = ["GUM", "Monte Carlo", "exact", "quasi-random"];
  const columns = [];
  for (const table of document.querySelectorAll("table")) {
    const cells = [...table.tHead?.rows[0]?.cells ?? []];
    const of = cells.map(cell => METHODS.find(method => cell.textContent.trim().replace(/-\s+/, "-").startsWith(method)));
    // the standard errors beside a method's figures are its own
    const owner = (cell, place) => of[place] ?? (/standard\s*error/.test(cell.textContent) ? of[place - 1] : undefined);
    const owners = cells.map(owner);
    if (new Set(of.filter(Boolean)).size > 1) columns.push([table, owners]);
  }
  const found = METHODS.filter(method => columns.some(([, owners]) => owners.includes(method)));
  if (found.length > 1) {
    const choice = make("fieldset", { class: "methods" }, make("legend", {}, words.methods));
    for (const method of found) {
      const check = make("input", { type: "checkbox" });
      check.checked = true;
      check.addEventListener("change", () => {
        for (const [table, owners] of columns) {
          for (const row of table.rows) {
            owners.forEach((owner, place) => { if (owner === method) row.cells[place]?.classList.toggle("off", !check.checked); });
          }
        }
        for (const part of document.querySelectorAll(`svg [data-method="${method}"]`)) part.classList.toggle("off", !check.checked);
      });
      choice.append(make("label", {}, check, ` ${method}`));
    }
    const before = document.querySelector("main h2") ?? document.querySelector("main").firstChild;
    before.before(choice);
  }

  document.querySelectorAll(".table table").forEach(sortable);
  for (const figure of document.querySelectorAll("figure")) {
    figure.querySelectorAll("svg").forEach(svg => values(svg, document.body));
    figure.querySelector("figcaption")?.append(" ", button(words.enlarge, () => enlarge(figure)));
  }
})();
