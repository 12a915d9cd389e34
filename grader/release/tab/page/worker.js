// Python in a web worker. It answers one message at a time; while a program runs, the page reaches
// it through shared memory alone: `signals` and the ring of `events`, see shared.js.
import { loadPyodide } from "./pyodide/pyodide.mjs";
import { ALLOWED_MS, EVENT, HEAD, REQUEST, SLOTS, STOP, TAIL } from "./shared.js";
import { unpack } from "./unpack.mjs";

const MOST_MEMORY = 1 << 30; // bytes
let py, page, signals, ring, more;

// A submission that fills the memory gets a MemoryError, and the tab lives on.
const grow = WebAssembly.Memory.prototype.grow;
WebAssembly.Memory.prototype.grow = function (pages) {
  if (this.buffer.byteLength + pages * 65536 > MOST_MEMORY) throw new RangeError("no more memory");
  return grow.call(this, pages);
};

const bridge = {
  draw: (commands, width, height) => postMessage({ kind: "picture", commands, width, height }),
  told(title) {
    postMessage({ kind: "told", title });
    return Atomics.load(signals, STOP) === 1;
  },
  printed: (text) => postMessage({ kind: "printed", text }),
  // Wait so many ms, or less if an event comes and is waited for.
  rest(ms, untilEvent) {
    const end = performance.now() + ms;
    for (let left = ms; left > 0; left = end - performance.now()) {
      const head = Atomics.load(ring, HEAD);
      if (untilEvent && head !== Atomics.load(ring, TAIL)) return;
      Atomics.wait(ring, HEAD, head, left);
    }
  },
  events() {
    const found = [];
    let tail = Atomics.load(ring, TAIL);
    for (const head = Atomics.load(ring, HEAD); tail !== head; tail = (tail + 1) % SLOTS) {
      found.push([...ring.slice(EVENT(tail), EVENT(tail + 1))]);
    }
    Atomics.store(ring, TAIL, tail);
    return JSON.stringify(found);
  },
  // Let the page interrupt Python once a request takes longer than so many seconds.
  watch(seconds) {
    const on = seconds !== undefined && seconds !== null;
    Atomics.store(signals, ALLOWED_MS, on ? Math.max(seconds * 1000, 1) : 0);
    Atomics.add(signals, REQUEST, 1);
    if (!on) Atomics.store(signals, 0, 0);
  },
};

async function load(name) {
  return (await fetch(`./${name}`)).arrayBuffer();
}

async function start(message) {
  ({ signals, ring } = message);
  const lab = load("lab.zip"); // while Python starts
  py = await loadPyodide({ indexURL: "./pyodide/", env: { PYTHONHASHSEED: "0", HOME: "/tmp" } });
  unpack(py, await lab);
  page = py.pyimport("page");
  page.start(bridge);
  py.setInterruptBuffer(new Uint8Array(signals.buffer, 0, 1));
  more = loadMore();
  return {};
}

// Load what is seldom needed, and then what the first check needs, while people read.
async function loadMore() {
  unpack(py, await load("more.zip"));
  setTimeout(() => page.warm(), 0);
}

const requests = {
  start,
  run: ({ module }) => ({ error: page.run(module) }),
  check: ({ only, columns }) => ({ found: page.check(JSON.stringify(only), columns) }),
  replay: ({ todo, check }) => ({ page: page.replay(todo, check) }),
  handIn() {
    const [zip, said] = page.hand_in().toJs();
    return { zip, said };
  },
  export: () => ({ zip: page.export().toJs() }),
  bringIn: ({ data, name }) => ({ files: page.bring_in(new Uint8Array(data), name) }),
};

onmessage = async ({ data }) => {
  try {
    await more;
    if (data.files) page.lay_out(JSON.stringify(data.files));
    postMessage({ kind: "answer", id: data.id, ...(await requests[data.kind](data)) });
  } catch (error) {
    postMessage({ kind: "answer", id: data.id, failed: String(error.message || error) });
  }
};
