// The page's side of Python: requests that are answered in turn, and the means to end one.
import { ALLOWED_MS, EVENT, HEAD, NUMBERS, REQUEST, RING, SIGNALS, SLOTS, STOP, TAIL, shareNumbers }
  from "./shared.js";

const LOOK_MS = 50; // how often the grader's clock is looked at
const STUBBORN_MS = 5000; // until Python is started anew where it does not stop
const QUIT = 256;
const INTERRUPT = 2; // the number of the signal SIGINT

export class Python {
  constructor(hear) {
    this.hear = hear; // told pictures, titles of checks, and what is printed
    this.answers = new Map();
    this.count = 0;
    setInterval(() => this.lookAtClock(), LOOK_MS);
  }

  start() {
    this.signals = shareNumbers(SIGNALS);
    this.ring = shareNumbers(RING);
    this.seen = this.since = 0;
    this.worker = new Worker("./worker.js", { type: "module" });
    this.worker.onmessage = ({ data }) => {
      if (data.kind === "answer") this.answers.get(data.id)?.(data);
      else this.hear(data);
    };
    this.worker.onerror = (event) => this.endAll(`Python cannot start: ${event.message}`);
    return this.ask({ kind: "start", signals: this.signals, ring: this.ring });
  }

  // Ask for something; `failed` in the answer is a text about what went wrong.
  ask(message) {
    const id = ++this.count;
    for (const place of [0, STOP]) Atomics.store(this.signals, place, 0);
    return new Promise((resolve) => {
      this.answers.set(id, (answer) => {
        this.answers.delete(id);
        resolve(answer);
      });
      this.worker.postMessage({ ...message, id });
    });
  }

  get busy() {
    return this.answers.size > 0;
  }

  send(type, a = 0, b = 0, c = 0) {
    const head = Atomics.load(this.ring, HEAD), next = (head + 1) % SLOTS;
    if (next === Atomics.load(this.ring, TAIL)) return; // full: nobody reads
    this.ring.set([type, a, b, c].slice(0, NUMBERS), EVENT(head));
    Atomics.store(this.ring, HEAD, next);
    Atomics.notify(this.ring, HEAD);
  }

  // End what runs: close its window, else interrupt it, else start Python anew.
  async stop() {
    const pending = this.count;
    const ended = async (ms) => {
      await new Promise((resolve) => setTimeout(resolve, ms));
      return !this.answers.has(pending);
    };
    Atomics.store(this.signals, STOP, 1);
    this.send(QUIT);
    if (await ended(500)) return true;
    for (let waited = 0; waited < STUBBORN_MS; waited += 500) {
      this.interrupt();
      if (await ended(500)) return true;
    }
    this.worker.terminate();
    this.endAll("It did not stop, so Python was started anew.");
    return false;
  }

  endAll(failed) {
    for (const answer of [...this.answers.values()]) answer({ failed });
  }

  interrupt() {
    Atomics.store(this.signals, 0, INTERRUPT);
  }

  // End a request of the grader that takes too long, again and again until it ends.
  lookAtClock() {
    if (!this.signals) return;
    const request = Atomics.load(this.signals, REQUEST), now = performance.now();
    if (request !== this.seen) [this.seen, this.since] = [request, now];
    const allowed = Atomics.load(this.signals, ALLOWED_MS);
    if (allowed && now - this.since > allowed) this.interrupt();
  }
}
