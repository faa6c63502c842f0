// The page in the frame of a <weir-fluid> (weir_fluid.ts): does what the element says, and tells it how things stand.
import type { FromPage, ToPage } from './embed_messages.ts';

type Embedded = { setPaused(paused: boolean): void; restart(): void };

// Nothing but the host may listen or speak; a page that stands alone is its own parent.
export function tellHost(message: FromPage): void {
  if (parent !== window) parent.postMessage(message, '*');
}

export function obeyHost(app: Embedded): void {
  addEventListener('message', (event: MessageEvent) => {
    if (event.source !== parent || parent === window) return;
    const message = event.data as ToPage | null; // other scripts of the host may send what they like
    if (message?.weir === 'pause') app.setPaused(message.paused);
    if (message?.weir === 'restart') app.restart();
  });
}
