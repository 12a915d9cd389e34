// What is kept in this browser: values by name, in IndexedDB.
const opened = new Promise((resolve, reject) => {
  const request = indexedDB.open("physics-lab", 1);
  request.onupgradeneeded = () => request.result.createObjectStore("kept");
  request.onsuccess = () => resolve(request.result);
  request.onerror = () => reject(request.error);
});

const ask = async (mode, question) => {
  const database = await opened;
  return new Promise((resolve, reject) => {
    const request = question(database.transaction("kept", mode).objectStore("kept"));
    request.onsuccess = () => resolve(request.result);
    request.onerror = () => reject(request.error);
  });
};

export const read = (name) => ask("readonly", (kept) => kept.get(name));
export const keep = (name, value) => ask("readwrite", (kept) => kept.put(value, name));
