// The slider: changes one number of an input.

import { at, isNumber, make } from "./parts.js";

const CENTRES = ["mean", "value", "mode", "count"];
const LIMITS = ["lower", "upper"];
const WIDTHS = ["std", "half_width", "semi_range", "scale", "expanded", "std_low", "std_high"];
const KEYS = [...CENTRES, ...LIMITS, ...WIDTHS];

export class Slider {
  constructor(page) {
    this.page = page;
    this.choice = page.element("slid");
    this.slide = page.element("slide");
    this.shown = page.element("slide-value");
    this.chosen = null;
    this.numbers = [];
    this.choice.addEventListener("change", () => this.choose(this.choice.value));
    this.slide.addEventListener("input", () => this.#moved(false));
    this.slide.addEventListener("change", () => this.#moved(true));
  }

  get #now() { return this.numbers.find(of => of.key === this.chosen); }

  /** Offers the numbers of the inputs. */
  show(found) {
    const { words } = this.page;
    const cells = row => row.cells.filter(cell => cell.kind === "number" && KEYS.includes(cell.key))
      .sort((a, b) => KEYS.indexOf(a.key) - KEYS.indexOf(b.key));
    this.numbers = (found.inputs || []).flatMap(row => cells(row).map(cell => ({ row, cell, key: at(cell.path) })));
    const key = JSON.stringify([this.page.language, this.numbers.map(of => of.key)]);
    if (this.choice.dataset.names !== key) {
      this.choice.dataset.names = key;
      this.choice.replaceChildren(...this.numbers.map(({ row, cell, key }) =>
        make("option", { value: key }, words.of(words.key[cell.key] || cell.key, row.name))));
    }
    if (!this.#now) this.chosen = this.numbers.length ? this.numbers[0].key : null;
    if (this.chosen !== null && this.choice.value !== this.chosen) this.choice.value = this.chosen;
    this.slide.closest(".slider").hidden = this.chosen === null;
    const now = this.#now;
    this.shown.textContent = now ? words.number(now.cell.raw) : "";
    if (now && !this.isMoving) this.#range(now);
  }

  /** The slider takes hold of a number, if it is one of its numbers. */
  choose(key) {
    if (!this.numbers.some(of => of.key === key)) return;
    this.chosen = key;
    this.isMoving = false;
    this.choice.value = key;
    const now = this.#now;
    this.#range(now);
    this.shown.textContent = this.page.words.number(now.cell.raw);
  }

  /** The range that it covers: about an estimate five standard uncertainties, of a width three times it. */
  #range({ row, cell }) {
    const value = Number(cell.raw);
    const u = row.standard_uncertainty || Math.abs(value) * 0.02 || 1;
    const [low, high] = WIDTHS.includes(cell.key) ? [0, 3 * Math.abs(value) || 1] : [value - 5 * u, value + 5 * u];
    const step = 10 ** Math.floor(Math.log10((high - low) / 200));
    this.scale = { low, step, digits: Math.min(12, Math.max(0, -Math.floor(Math.log10(step)))) };
    this.slide.min = 0;
    this.slide.max = Math.round((high - low) / step);
    this.slide.value = Math.round((value - low) / step);
    this.slide.setAttribute("aria-valuetext", cell.raw);
  }

  #moved(isDone) {
    this.isMoving = !isDone;
    const now = this.#now;
    if (!now || !this.scale) return;
    const { low, step, digits } = this.scale;
    // whole steps from a rounded beginning, so that typed numbers stay short
    const value = (Math.round(low / step) + Number(this.slide.value)) * step;
    const typed = String(Number(value.toFixed(digits)));
    this.slide.setAttribute("aria-valuetext", typed);
    this.shown.textContent = this.page.words.number(typed);
    if (isNumber(typed)) this.page.edit([{ path: now.cell.path, typed }], `slide:${this.chosen}`);
  }
}
