// What <weir-fluid> and the page in its frame tell each other, by postMessage().
export type ToPage = { weir: 'pause'; paused: boolean } | { weir: 'restart' };
export type FromPage = { weir: 'ready' } | { weir: 'error'; message: string };
