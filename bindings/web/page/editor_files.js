// The project's files, which the engine sends, and the texts that a person has not saved yet.

const PATIENCE = 30000;  // ms to wait for an answer, because of checks and slow disks

export class Files {
  all = [];  // { file, shown, kind }
  #link;

  constructor(link) {
    this.#link = link;
  }

  ask(what, more = {}) {
    return this.#link.ask({ do: "edit", what, ...more }, PATIENCE);
  }

  async list() {
    const answer = await this.ask("list");
    if (answer.ok) this.all = answer.files;
    return answer;
  }

  get(file) {
    return this.all.find((each) => each.file === file);
  }

  /// The file that a message shows as `shown`: the file of this path, or else the only file whose path ends in it.
  named(shown) {
    const exact = this.all.find((each) => each.shown === shown || each.file === shown);
    if (exact) return exact;
    const ends = this.all.filter((each) => each.file.endsWith(`/${shown}`) || shown.endsWith(`/${each.file}`));
    return ends.length === 1 ? ends[0] : null;
  }
}

/// Unsaved texts. They survive a reload of the page, in this tab only.
export const drafts = {
  key: (file) => `nezumi.draft ${file}`,
  get: (file) => JSON.parse(sessionStorage.getItem(drafts.key(file)) ?? "null"),
  set: (file, draft) => {
    try {
      sessionStorage.setItem(drafts.key(file), JSON.stringify(draft));
    } catch {
      // The text is larger than the browser's storage allows: it stays only in the editor.
    }
  },
  remove: (file) => sessionStorage.removeItem(drafts.key(file)),
};
