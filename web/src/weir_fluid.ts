// A living fluid on any page, in two lines:
//   <script type="module" src="weir/weir-fluid.js"></script>
//   <weir-fluid scene="dam_2d"></weir-fluid>
// Attributes: scene (a name, or the URL of a scene file), particles, color and backend, as in the page's query; `controls`
// shows the page's panel and plots; `paused`. Out of sight it rests. Property: paused. Method: restart(). Events: ready;
// error, whose detail is a message in plain words.
import type { FromPage, ToPage } from './embed_messages.ts';

const style = ':host { display: block; height: 360px; } :host([hidden]) { display: none; } iframe { display: block; border: 0; width: 100%; height: 100%; }';
const forThePage = ['scene', 'particles', 'color', 'backend'];

export class WeirFluid extends HTMLElement {
  static readonly observedAttributes = [...forThePage, 'controls', 'paused'];
  readonly #frame = document.createElement('iframe');
  readonly #sight = new IntersectionObserver(([entry]) => {
    this.#seen = entry?.isIntersecting ?? true;
    this.#pause();
  });
  #seen = true;
  #ready = false;

  constructor() {
    super();
    const sheet = document.createElement('style');
    sheet.textContent = style;
    this.#frame.title = 'A fluid that moves';
    this.attachShadow({ mode: 'open' }).append(sheet, this.#frame);
  }

  get paused(): boolean {
    return this.hasAttribute('paused');
  }
  set paused(value: boolean) {
    this.toggleAttribute('paused', value);
  }

  restart(): void {
    this.#tell({ weir: 'restart' });
  }

  connectedCallback(): void {
    addEventListener('message', this.#hear);
    this.#sight.observe(this);
    this.#load();
  }

  disconnectedCallback(): void {
    removeEventListener('message', this.#hear);
    this.#sight.disconnect();
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (!this.isConnected || before === now) return;
    if (name === 'paused') this.#pause();
    else this.#load();
  }

  #load(): void {
    const url = new URL(/* @vite-ignore */ 'index.html', import.meta.url);
    for (const name of forThePage) {
      const value = this.getAttribute(name);
      if (value !== null) url.searchParams.set(name, name === 'scene' && !/^[\w-]+$/.test(value) ? new URL(value, document.baseURI).href : value);
    }
    if (!this.hasAttribute('controls')) url.searchParams.set('embed', '');
    this.#ready = false;
    this.#frame.src = url.href;
  }

  readonly #hear = (event: MessageEvent): void => {
    if (event.source !== this.#frame.contentWindow) return;
    const message = event.data as FromPage | null;
    if (message?.weir === 'ready') {
      this.#ready = true;
      this.#pause();
      this.dispatchEvent(new Event('ready'));
    } else if (message?.weir === 'error') {
      this.dispatchEvent(new CustomEvent('error', { detail: message.message }));
    }
  };

  #pause(): void {
    this.#tell({ weir: 'pause', paused: this.paused || !this.#seen });
  }

  #tell(message: ToPage): void {
    if (this.#ready) this.#frame.contentWindow?.postMessage(message, new URL(this.#frame.src).origin);
  }
}

customElements.define('weir-fluid', WeirFluid);
