// Keys for the whole page; controls that take text or choices keep theirs.

export type Keys = { digit: (digit: number) => void; [key: string]: ((digit: number) => void) | (() => void) };

export function onKeys(keys: Keys): void {
  addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const target = event.target as HTMLElement;
    const takesText = target instanceof HTMLInputElement && target.type !== 'range';
    if (takesText || target instanceof HTMLSelectElement || target instanceof HTMLTextAreaElement) return;
    if (target instanceof HTMLButtonElement && event.key === ' ') return;
    if (/^[1-9]$/.test(event.key)) return keys.digit(Number(event.key));
    const action = keys[event.key.toLowerCase()];
    if (!action || (event.key.length > 1 && !event.key.startsWith('Arrow'))) return;
    if (target instanceof HTMLInputElement && event.key.startsWith('Arrow')) return; // a slider's own
    event.preventDefault();
    (action as () => void)();
  });
}
