// Messages over the picture: notes with a key stay until they are cleared, toasts go by themselves.

export type NoteKind = 'info' | 'warning' | 'error';
export type NoteAction = { label: string; run: () => void };

const toastSeconds = 8;

export class Notes {
  readonly #container: HTMLElement;
  readonly #keyed = new Map<string, HTMLElement>();

  constructor(container: HTMLElement) {
    this.#container = container;
  }

  // Shows or replaces the note of that key.
  show(key: string, kind: NoteKind, text: string, actions: NoteAction[] = []): void {
    const old = this.#keyed.get(key);
    if (old && old.dataset['text'] === text) return;
    const note = this.#make(kind, text, actions, () => this.clear(key));
    note.dataset['key'] = key;
    if (old) old.replaceWith(note);
    else this.#container.append(note);
    this.#keyed.set(key, note);
  }

  clear(key: string): void {
    this.#keyed.get(key)?.remove();
    this.#keyed.delete(key);
  }

  toast(kind: NoteKind, text: string): void {
    for (const child of this.#container.children) {
      if (!(child instanceof HTMLElement) || child.dataset['toast'] === undefined) continue;
      if (kind === 'error' || !child.classList.contains('error')) child.remove(); // what failed is read first
    }
    const note = this.#make(kind, text, [], () => note.remove());
    note.dataset['toast'] = '';
    this.#container.append(note);
    setTimeout(() => note.remove(), toastSeconds * 1000);
  }

  #make(kind: NoteKind, text: string, actions: NoteAction[], close: () => void): HTMLElement {
    const note = document.createElement('div');
    note.className = `note ${kind}`;
    note.dataset['text'] = text;
    if (kind === 'error') note.setAttribute('role', 'alert');
    const paragraph = document.createElement('p');
    paragraph.textContent = text;
    note.append(paragraph);
    for (const action of actions) {
      const button = document.createElement('button');
      button.textContent = action.label;
      button.addEventListener('click', () => {
        close();
        action.run();
      });
      note.append(button);
    }
    const cross = document.createElement('button');
    cross.className = 'close';
    cross.textContent = '✕';
    cross.setAttribute('aria-label', 'Close');
    cross.addEventListener('click', close);
    note.append(cross);
    return note;
  }
}
