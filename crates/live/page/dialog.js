// The dialog: a title, a body, and buttons of which one is the answer.

import { make } from "./parts.js";

export class Dialog {
  constructor() {
    this.element = id => document.getElementById(id);
    this.dialog = this.element("dialog");
  }

  get isOpen() { return this.dialog.open; }

  /** Asks; the answer is the value of the pressed button, or null. Enter presses the first one. */
  choose(title, body, actions) {
    const { dialog } = this;
    if (dialog.open) dialog.close();
    this.element("dialog-title").textContent = title;
    this.element("dialog-body").replaceChildren(body);
    this.element("dialog-actions").replaceChildren(...actions.map(([label, value], place) =>
      make("button", { type: "button", class: place === 0 && value !== null ? "first" : "", onclick: () => this.close(value) }, label)));
    dialog.showModal();
    const field = body.querySelector("input");
    if (field) {
      field.focus();
      // of a file's name all but its ending
      if (field.value.includes(".")) field.setSelectionRange(0, field.value.lastIndexOf("."));
      field.addEventListener("keydown", event => { if (event.key === "Enter") this.close(actions[0][1]); });
    }
    return new Promise(resolve => {
      this.resolve = resolve;
      dialog.onclose = () => resolve(null);
    });
  }

  close(value) {
    this.resolve(value);
    this.dialog.close();
  }
}
