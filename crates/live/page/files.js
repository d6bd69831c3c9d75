// Files: opened, begun, saved, exported, changed on the disk, dropped, imported.

import { make } from "./parts.js";

const FORMATS = { model: ["html", "xlsx", "markdown", "latex", "csv", "json", "result"], certificate: ["html", "dcc", "xlsx", "markdown", "latex", "csv"], case: ["html", "json"], comparison: ["html", "json", "csv"], recipe: ["json", "csv"] };
const ENDINGS = { markdown: "md", latex: "tex", dcc: "xml", result: "result.json" };

export class Files {
  constructor(page) {
    this.page = page;
    this.element = page.element;
  }

  get words() { return this.page.words; }

  state() {
    const { words } = this;
    const { path, isSaved, text } = this.page.document;
    const isFile = this.page.shown === "file";
    this.element("path").textContent = isFile ? path || this.page.named || words.unnamed : "";
    const { diagnostics, open } = this.page.mistakes;
    const changed = diagnostics.length ? words.changed_mistakes : open.length ? words.changed_open : words.changed;
    const isUntouched = path === null && text === this.page.pristine;
    const state = this.page.isLost ? words.lost : !this.page.program.hasFolder ? words.offline : !isFile || isUntouched ? "" : isSaved ? words.saved : changed;
    this.say("state", state);
    this.element("undo").disabled = this.page.document.past.length === 0;
    this.element("redo").disabled = this.page.document.future.length === 0;
    this.element("save").disabled = text === "";
  }

  say(id, text) {
    if (text === null) { this.state(); return; }
    if (this.element(id).textContent !== text) this.element(id).textContent = text;
  }

  async mayLeave() {
    if (this.page.document.isSaved || this.page.document.text === this.page.pristine) return true;
    const { words } = this;
    return await this.page.dialog.choose(words.leave, make("p", {}, words.leave_text), [[words.go_on, "go"], [words.cancel, null]]) === "go";
  }

  take(text, path, version, name = null) {
    this.page.document.replace(text, path, version);
    // the name of a file that is not one of the folder
    this.page.named = name;
    this.page.pristine = text;
    this.page.found = null;
    this.page.mistakes.diagnostics = [];
    this.page.mistakes.open = [];
    this.page.begin();
    this.state();
  }

  async open(path) {
    try {
      const { text, version, path: of } = await this.page.program.ask("open", { path });
      this.take(text, of || path, version);
    } catch (error) { this.page.failed(error); }
  }

  async begin(request) {
    try {
      const { text } = await this.page.program.call("new", request);
      this.take(text, null, null);
    } catch (error) { this.page.failed(error); }
  }

  /** A certificate whose rows are all outputs of the open model. */
  async certify() {
    await this.page.settled();
    const { document, program, found } = this.page;
    if (program.hasFolder && (document.path === null || !document.isSaved)) await this.save();
    if (program.hasFolder ? !document.isSaved || document.path === null : !await this.mayLeave()) return;
    try {
      const model = document.path || this.page.named || "model.json";
      if (!program.hasFolder) await program.hold(model, new TextEncoder().encode(document.text).buffer);
      const rows = found.outputs.map(({ name: output }) => ({ model, output }));
      const { text } = await program.call("new", { kind: "certificate" });
      const made = await program.call("edit", { text, edits: [{ path: ["rows"], value: rows }] });
      this.take(made.text, null, null);
    } catch (error) { this.page.failed(error); }
  }

  async autosave() {
    const { path, isSaved } = this.page.document;
    if (path === null || isSaved || !this.page.program.hasFolder) return;
    if (this.page.found && this.page.found.diagnostics.length) return;
    await this.save();
  }

  async save() {
    const { words } = this;
    clearTimeout(this.saver);
    await this.page.settled();
    if (!this.page.program.hasFolder) return this.#download(new Blob([this.page.document.text]), this.page.document.path || this.page.named || "model.json");
    if (this.page.document.path === null) {
      const name = await this.askName();
      if (!name) return;
      const path = name.endsWith(".json") ? name : `${name}.json`;
      // what the file names is found from its own folder
      for (const form of this.page.shownForms) if (form.moved) form.moved(path);
      await this.page.settled();
      this.page.document.path = path;
      this.page.document.version = null;
    }
    // one after the other: the version of a file is known when it is written
    while (this.saving) await this.saving;
    this.saving = this.#write();
    const conflict = await this.saving;
    if (conflict) return this.conflict(conflict);
    this.state();
  }

  /** Writes the file; what is on the disk, if somebody else has changed it. */
  async #write() {
    const { path, text, version } = this.page.document;
    try {
      this.say("state", this.words.saving);
      const saved = await this.page.program.ask("save", { path, text, version });
      this.page.document.version = saved.version;
      this.page.document.saved = text;
    } catch (error) {
      if (error.status === 409) return error.answer;
      this.page.failed(error);
    } finally { this.saving = null; }
    return null;
  }

  async askName() {
    const { words } = this;
    const title = (this.page.found && this.page.found.title || this.page.kind).toLowerCase().normalize("NFKD").replace(/[^\p{L}\p{N}]+/gu, "_").replace(/^_|_$/g, "") || "model";
    const field = make("input", { value: `${title}.json`, size: 36 });
    const body = make("label", {}, words.save_name + " ", field);
    const chosen = await this.page.dialog.choose(words.save_title, body, [[words.save, "save"], [words.cancel, null]]);
    return chosen ? field.value.trim() : null;
  }

  async conflict({ text, version }) {
    const { words } = this;
    if (this.isAsked) return;
    this.isAsked = true;
    const chosen = await this.page.dialog.choose(words.conflict_title, make("p", {}, words.conflict), [[words.mine, "mine"], [words.theirs, "theirs"]]);
    this.isAsked = false;
    this.page.document.version = version;
    if (chosen === "mine") {
      const mine = this.page.document.text;
      // the other one is a step of the history
      this.page.document.past.push(text);
      this.page.document.text = mine;
      return this.save();
    }
    if (chosen === "theirs") this.fromDisk(text, version);
  }

  fromDisk(text, version) {
    this.page.document.version = version;
    this.page.document.saved = text;
    if (text !== this.page.document.text) {
      this.page.document.last = null;
      this.page.document.set(text, "disk");
      this.say("state", this.words.disk);
    }
  }

  async onDisk({ path, version }) {
    if (path !== this.page.document.path) {
      // a table that the model names
      if (this.page.document.path !== null || this.page.kind === "certificate") { this.page.result.reported = null; this.page.ask(); }
      return;
    }
    if (version === this.page.document.version || this.saving) return;
    if (version === null) { this.say("state", this.words.gone); return; }
    const found = await this.page.program.ask("open", { path });
    if (found.version === this.page.document.version) return;
    if (found.text === this.page.document.text) { this.page.document.version = found.version; this.page.document.saved = found.text; this.state(); return; }
    if (this.page.document.isSaved) this.fromDisk(found.text, found.version);
    else this.conflict(found);
  }

  async openDialog() {
    const { words } = this;
    if (!await this.mayLeave()) return;
    const { files } = await this.page.program.ask("files", {});
    const shown = files.filter(file => !["other", "picture"].includes(file.kind));
    const body = make("div", { class: "list" });
    const list = filter => shown.filter(file => `${file.path} ${file.title || ""}`.toLowerCase().includes(filter)).map(file =>
      make("button", { type: "button", class: "entry", onclick: () => this.page.dialog.close(file.path) },
        make("b", {}, file.path), " ", make("span", { class: "detail" }, file.title || file.kind)));
    body.replaceChildren(...list(""));
    const filter = make("input", { type: "search", placeholder: words.search, "aria-label": words.search, oninput: () => body.replaceChildren(...list(filter.value.toLowerCase())) });
    const all = make("div", {}, shown.length > 8 ? filter : null, shown.length ? body : make("p", {}, words.open_none));
    const chosen = await this.page.dialog.choose(words.open_title, all, [[words.from_disk, { pick: true }], [words.cancel, null]]);
    if (chosen && chosen.pick) this.pick(this.page.program.hasFolder ? ".json,.csv,.xlsx" : "");
    else if (chosen) await this.open(chosen);
  }

  async exportDialog() {
    const { words } = this;
    // a workbook and a saved result need a clock and a disk
    const formats = (FORMATS[this.page.kind] || []).filter(of => this.page.program.hasFolder || !["xlsx", "result"].includes(of));
    const body = make("div", { class: "list" }, ...formats.map(format =>
      make("button", { type: "button", class: "entry", onclick: () => this.page.dialog.close(format) }, make("b", {}, words.formats[format]), " ", make("span", { class: "detail" }, `.${ENDINGS[format] || format}`))));
    const format = await this.page.dialog.choose(words.export_title, body, [[words.cancel, null]]);
    if (!format) return;
    try {
      const { path, text } = this.page.document;
      const blob = await this.page.program.export({ path: path || (this.page.program.hasFolder ? null : this.page.named), text, format });
      const stem = (path || this.page.named || "model.json").replace(/^.*\//, "").replace(/\.[^.]*$/, "");
      this.#download(blob, `${stem}.${ENDINGS[format] || format}`);
    } catch (error) { this.page.failed(error); }
  }

  /** Recomputes the published values in this browser, and shows each beside what was published. */
  async verifyDialog() {
    const { words } = this;
    this.say("state", words.verifying);
    try {
      const { rows, pass } = await this.page.program.call("verify", {});
      const { paths } = await this.page.program.call("paths", {});
      const cells = row => [row.verdict, row.example, row.output, row.quantity, row.published, row.got, row.tolerance];
      const head = make("thead", {}, make("tr", {}, ...words.verify_headers.map(text => make("th", { scope: "col" }, text))));
      const line = row => make("tr", {}, ...cells(row).map(cell => make("td", {}, cell === null ? "" : String(cell))));
      const body = make("div", {},
        make("p", {}, words.verified(pass, rows.length, paths.map(of => of.hash).join(", "))),
        make("div", { class: "list", tabindex: "0" }, make("table", {}, head, make("tbody", {}, ...rows.map(line)))));
      await this.page.dialog.choose(words.verify_title, body, [[words.close, null]]);
    } catch (error) { this.page.failed(error); }
    this.state();
  }

  #download(blob, name) {
    const address = URL.createObjectURL(blob);
    make("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }

  pick(accept) {
    const picked = this.element("picked");
    picked.accept = accept;
    picked.multiple = !this.page.program.hasFolder;
    picked.value = "";
    picked.onchange = () => { if (picked.files.length) this.dropped([...picked.files]); };
    picked.click();
  }

  /**
   * Files of this computer. Those that the open text names are held for it; of others, one that no other
   * one names is opened, or imported where it is a table, and what it names is held.
   */
  async dropped(files) {
    const { words } = this;
    const isJson = file => /\.json$/i.test(file.name);
    try {
      if (this.page.kind === "certificate" && !this.page.program.hasFolder && await this.#forCertificate(files)) return;
      const texts = new Map();
      for (const file of files.filter(isJson)) texts.set(file, await file.text());
      const held = file => this.page.document.text.includes(file.name) || [...texts].some(([of, text]) => of !== file && text.includes(file.name));
      const kept = this.page.program.hasFolder ? [] : files.filter(held);
      const rest = files.filter(file => !kept.includes(file));
      // several files go together: the one that is opened names the others, perhaps after an edit
      const first = rest.find(isJson) || rest[0];
      if (!this.page.program.hasFolder) {
        for (const file of files) {
          if (file !== first || kept.includes(file)) await this.page.program.hold(file.name, await file.arrayBuffer());
        }
      }
      if (first && isJson(first) && !await this.mayLeave()) return;
      if (first && isJson(first)) this.take(texts.get(first), null, null, first.name);
      else if (first) await this.#import(first);
      else this.page.ask();
      const others = files.filter(file => file !== first).map(file => file.name);
      if (others.length && !this.page.program.hasFolder) this.say("state", words.drop_held(others.join(", ")));
      this.page.result.reported = null;
    } catch (error) { this.page.failed(error); }
  }

  /** Whether files are for the certificate that is open. */
  async #forCertificate(files) {
    const { certificate: said } = this.words;
    const names = files.map(file => file.name).join(", ");
    const isOpened = files.some(file => /\.(json|xlsx)$/i.test(file.name));
    if (isOpened && await this.page.dialog.choose(said.hold_title, make("p", {}, said.hold(names)), [[said.hold_use, "use"], [said.hold_open, null]]) !== "use") return false;
    for (const form of this.page.forms.certificate) await form.take(files);
    this.say("state", this.words.drop_held(names));
    return true;
  }

  /** A table: one of results to be compared is opened, a budget imported. */
  async #import(file) {
    const bytes = new Uint8Array(await file.arrayBuffer());
    if (/\.csv$/i.test(file.name)) {
      const text = new TextDecoder().decode(bytes);
      if (/^\ufeff?\s*"?label"?\s*[,;\t]/i.test(text)) {
        if (await this.mayLeave()) this.take(text, null, null, file.name);
        return;
      }
    }
    this.page.import.file(file.name, bytes);
  }
}
