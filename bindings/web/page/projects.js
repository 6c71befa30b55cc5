// The projects that this browser keeps, each under a key of its own.

const STORE = "projects";

const database = () => new Promise((resolve, reject) => {
  const asked = indexedDB.open("nezumi", 1);
  asked.onupgradeneeded = () => asked.result.createObjectStore(STORE, { keyPath: "id" });
  asked.onsuccess = () => resolve(asked.result);
  asked.onerror = () => reject(asked.error);
});

async function use(mode, work) {
  const opened = await database();
  try {
    return await new Promise((resolve, reject) => {
      const asked = work(opened.transaction(STORE, mode).objectStore(STORE));
      asked.onsuccess = () => resolve(asked.result);
      asked.onerror = () => reject(asked.error);
    });
  } finally {
    opened.close();
  }
}

/// A project is { id, name, system, files, changed }: the system's file among the files by name, and the time of the last change.
export const list_projects = async () => (await use("readonly", (store) => store.getAll())).sort((a, b) => b.changed - a.changed);
export const find_project = (id) => use("readonly", (store) => store.get(id));
export const keep_project = (project) => use("readwrite", (store) => store.put({ ...project, changed: Date.now() }));
export const forget_project = (id) => use("readwrite", (store) => store.delete(id));
export const new_id = () => crypto.randomUUID?.() ?? `${Date.now()}-${Math.random()}`;
