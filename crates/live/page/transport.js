// The way to the program: a server on this machine, or the program itself in this browser.

/** An error that the program tells; `status` is that of HTTP, `answer` what came with it. */
export class Refused extends Error {
  constructor(status, answer) {
    super((answer && answer.error) || `HTTP ${status}`);
    this.status = status;
    this.answer = answer;
  }
}

/** The secret of the page, which comes behind the `#` of its address and is kept where no other port
 * of the machine, to which the cookie goes as well, gets to see it. */
function secretOfPage() {
  const given = location.hash.slice(1);
  try {
    if (/^[0-9a-f]{64}$/.test(given)) {
      localStorage.setItem("gumption", given);
      history.replaceState(null, "", location.pathname + location.search);
    }
    return localStorage.getItem("gumption") || "";
  } catch { return given; }
}

// how often the share of long work is asked for
const SHARE = 400;

/** Finds out what there is. */
export async function connect() {
  try {
    const found = await fetch("api/hello");
    if (found.ok && (found.headers.get("content-type") || "").includes("json")) {
      return new Server(await found.json());
    }
  } catch { /* no server: a folder of static files */ }
  return Alone.load();
}

class Server {
  #secret = secretOfPage();

  constructor(hello) {
    this.hello = hello;
    this.hasFolder = true;
  }

  async #post(path, body, signal) {
    const answer = await fetch(`api/${path}`, {
      method: "POST", body, signal,
      headers: { "X-Gumption": this.#secret, "Content-Type": "application/json" },
    });
    if (answer.ok) return answer;
    let told = null;
    try { told = await answer.json(); } catch { /* no JSON */ }
    throw new Refused(answer.status, told);
  }

  async call(name, request, { path, signal } = {}) {
    const of = path ? `?path=${encodeURIComponent(path)}` : "";
    return (await this.#post(`call/${name}${of}`, JSON.stringify(request), signal)).json();
  }

  async ask(name, request, signal) {
    return (await this.#post(name, JSON.stringify(request), signal)).json();
  }

  async export(request) {
    return (await this.#post("export", JSON.stringify(request))).blob();
  }

  /** The page of a text: its address, and of a case the answer; `told` is told the share that is done. */
  async page(request, { signal, told } = {}) {
    const progress = `${Date.now()}-${Math.random()}`;
    const look = told && setInterval(async () => {
      try {
        const { share } = await (await fetch(`api/progress/${progress}`, { signal })).json();
        if (share !== null) told(share);
      } catch { /* the work itself says what is wrong */ }
    }, SHARE);
    try {
      return await this.ask("page", { ...request, progress }, signal);
    } finally { clearInterval(look); }
  }

  watch(changed, lost) {
    const events = new EventSource("api/events");
    events.addEventListener("changed", event => changed(JSON.parse(event.data)));
    events.onerror = () => lost(true);
    events.onopen = () => lost(false);
  }

  hold() {}
}

/** The program in a worker, which does one thing after the other. */
class Module {
  constructor() {
    this.waiting = new Map();
    this.number = 0;
    this.worker = new Worker("assets/worker.js");
    this.worker.onmessage = ({ data }) => {
      const of = this.waiting.get(data.number);
      this.waiting.delete(data.number);
      if (!of) return;
      if (data.status === 0) of.resolve(data.answer);
      else {
        let told = { error: data.answer };
        try { told = JSON.parse(data.answer); } catch { /* of the worker itself */ }
        of.reject(new Refused(data.status === 1 ? 400 : 500, told));
      }
    };
    this.worker.onerror = event => this.#refuse(new Refused(500, { error: event.message }));
  }

  #refuse(error) {
    for (const of of this.waiting.values()) of.reject(error);
    this.waiting.clear();
  }

  send(message) {
    const number = ++this.number;
    return new Promise((resolve, reject) => {
      this.waiting.set(number, { resolve, reject });
      this.worker.postMessage({ ...message, number });
    });
  }

  /** Ends it in the middle of its work. */
  end() {
    this.worker.terminate();
    this.#refuse(new DOMException("", "AbortError"));
  }
}

class Alone {
  static async load() {
    const alone = new Alone();
    alone.hello = { version: "", lang: null, folder: "" };
    alone.hasFolder = false;
    alone.held = new Map();
    alone.module = new Module();
    return alone;
  }

  async call(name, request, { signal } = {}) {
    const answer = await this.module.send({ name, request: JSON.stringify(request) });
    if (signal && signal.aborted) throw new DOMException("", "AbortError");
    return JSON.parse(answer);
  }

  async ask(name) {
    if (name === "files") return this.call("files", {});
    throw new Refused(404, { error: name });
  }

  async export({ text, format, path }) {
    const { base64 } = await this.call("export", { text, format, name: path || "model.json" });
    const bytes = Uint8Array.from(atob(base64), letter => letter.charCodeAt(0));
    return new Blob([bytes]);
  }

  /** The page of a text, made in a module of its own: it takes long, and can be ended. */
  async page({ text, path }, { signal } = {}) {
    const module = new Module();
    const end = () => module.end();
    if (signal) signal.addEventListener("abort", end);
    try {
      for (const [hold, bytes] of this.held) await module.send({ hold, bytes });
      const made = await module.send({ name: "page", request: JSON.stringify({ text, name: path || "" }) });
      const { html, answer } = JSON.parse(made);
      return { address: URL.createObjectURL(new Blob([html], { type: "text/html" })), answer };
    } finally {
      if (signal) signal.removeEventListener("abort", end);
      module.end();
    }
  }

  watch() {}

  async hold(name, bytes) {
    this.held.set(name, bytes);
    return this.module.send({ hold: name, bytes });
  }
}
