// Starts the page. ?scene=NAME or URL, ?backend=auto|gpu|cpu, ?particles=N, ?color=speed|density|...; ?embed: the fluid alone,
// for a frame in another page (weir_fluid.ts).
import { App } from './app.ts';
import { obeyHost, tellHost } from './embedded.ts';
import { colorNames } from './legend.ts';
import { fetchScene, fetchSceneIndex, type SceneDocument, type SceneEntry } from './scene_document.ts';
import type { Backend } from './start_engine.ts';
import { Weir } from './weir.ts';

declare global {
  interface Window {
    weir?: App; // for the console and for tests
  }
}

function showPlainError(error: unknown): void {
  const box = document.createElement('p');
  box.className = 'plain';
  box.setAttribute('role', 'alert');
  box.textContent = `Weir could not start: ${error instanceof Error ? error.message : String(error)}`;
  document.body.append(box);
  tellHost({ weir: 'error', message: box.textContent });
}

async function compileEngine(): Promise<WebAssembly.Module> {
  const url = new URL('weir.wasm', document.baseURI);
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return WebAssembly.compile(await response.arrayBuffer());
}

const backendOf = (text: string | null): Backend => (text === 'gpu' || text === 'cpu' ? text : 'auto');

// The scene that was asked for, or the first one with a word about why not.
async function firstScene(weir: Weir, scenes: SceneEntry[], wanted: string | null) {
  const fallback = scenes[0]?.name ?? 'article';
  const name = wanted ?? fallback;
  try {
    const document = (await fetchScene(name)) as SceneDocument;
    const scene = weir.loadScene(document);
    try {
      scene.check();
    } finally {
      scene.destroy();
    }
    return { document, name, trouble: '' };
  } catch (error) {
    if (name === fallback) throw error;
    return { document: (await fetchScene(fallback)) as SceneDocument, name: fallback, trouble: (error as Error).message };
  }
}

async function main(): Promise<void> {
  const query = new URLSearchParams(location.search);
  const [module, scenes] = await Promise.all([compileEngine(), fetchSceneIndex()]);
  const weir = await Weir.load(module);
  const { document, name, trouble } = await firstScene(weir, scenes, query.get('scene'));
  const app = new App(weir, module, scenes, {
    backend: backendOf(query.get('backend')),
    sceneName: name,
    document,
    particles: Number(query.get('particles')) || 0,
    embedded: query.has('embed'),
  });
  window.weir = app;
  const wantedColor = query.get('color');
  const color = colorNames[(wantedColor ?? 'speed').replaceAll(/[-_+]/g, ' ')];
  if (color === undefined) {
    app.notes.toast('error', `color: is "${wantedColor}"; must be one of ${Object.keys(colorNames).join(', ')}`);
  } else {
    app.setColorBy(color);
    if (wantedColor !== null) app.showColors();
  }
  if (trouble) {
    app.notes.toast('error', trouble);
    tellHost({ weir: 'error', message: trouble });
  }
  addEventListener('error', (event) => app.notes.toast('error', event.message));
  addEventListener('unhandledrejection', (event) => app.notes.toast('error', String(event.reason)));
  await app.start();
  obeyHost(app);
  tellHost({ weir: 'ready' });
}

main().catch(showPlainError);
