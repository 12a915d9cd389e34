// Serves the page from this browser once it has been loaded, offline too, and isolates it.
// FIRST is what Python starts with; LATER is kept once the page asks for it.
const VERSION = "physics-lab-VERSION", FIRST = [], LATER = [];
const ISOLATED = {
  "Cross-Origin-Opener-Policy": "same-origin",
  "Cross-Origin-Embedder-Policy": "require-corp",
  "Cross-Origin-Resource-Policy": "same-origin",
};

self.addEventListener("install", (event) => event.waitUntil(keep(FIRST).then(() => self.skipWaiting())));
self.addEventListener("message", (event) => event.waitUntil(keep(LATER)));
self.addEventListener("activate", (event) => event.waitUntil(take()));
self.addEventListener("fetch", (event) => {
  const url = new URL(event.request.url);
  if (event.request.method === "GET" && url.origin === location.origin) event.respondWith(find(event.request));
});

async function keep(names) {
  const cache = await caches.open(VERSION);
  await Promise.all(names.map(async (name) => {
    if (await cache.match(name)) return;
    const found = await fetch(name, { cache: "no-cache" });
    if (!found.ok) throw new Error(`${name}: ${found.status}`);
    await cache.put(name, isolate(found));
  }));
}

// Say what a server would have to say for the page to share memory with its worker.
function isolate(found) {
  const headers = new Headers(found.headers);
  for (const [name, value] of Object.entries(ISOLATED)) headers.set(name, value);
  return new Response(found.body, { status: found.status, statusText: found.statusText, headers });
}

async function take() {
  for (const name of await caches.keys()) {
    if (name.startsWith("physics-lab-") && name !== VERSION) await caches.delete(name);
  }
  await self.clients.claim();
}

async function find(request) {
  const cache = await caches.open(VERSION);
  return (await cache.match(request, { ignoreSearch: true })) ?? isolate(await fetch(request));
}
