// Builds the two pages into dist/, with the engine (weir.wasm), the scenes and a generated list of them beside them.
import { createReadStream, existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';

const root = fileURLToPath(new URL('.', import.meta.url));
const sceneFolder = resolve(root, '../scenes');
const wasmFile = process.env['WEIR_WASM'] ?? resolve(root, '../build/wasm/apps/web/weir.wasm');

const firstScene = 'water.json'; // what the page opens with

const sceneFiles = (): string[] =>
  readdirSync(sceneFolder)
    .filter((name) => name.endsWith('.json'))
    .sort((a, b) => Number(b === firstScene) - Number(a === firstScene) || (a < b ? -1 : 1));

// [{ name, title }], in the order of the keys 1 to 9.
function sceneIndex(): string {
  const list = sceneFiles().map((file) => {
    const document = JSON.parse(readFileSync(resolve(sceneFolder, file), 'utf8')) as { title?: string };
    return { name: basename(file, '.json'), title: document.title ?? basename(file, '.json') };
  });
  return JSON.stringify(list);
}

function weirAssets(): Plugin {
  return {
    name: 'weir-assets',
    generateBundle() {
      if (!existsSync(wasmFile)) {
        this.error(`${wasmFile} is missing: build it with tools/build.sh wasm`);
      }
      this.emitFile({ type: 'asset', fileName: 'weir.wasm', source: readFileSync(wasmFile) });
      for (const file of sceneFiles()) {
        const source = readFileSync(resolve(sceneFolder, file));
        this.emitFile({ type: 'asset', fileName: `scenes/${file}`, source });
      }
      this.emitFile({ type: 'asset', fileName: 'scenes/index.json', source: sceneIndex() });
    },
    configureServer(server) {
      server.middlewares.use((request, response, next) => {
        const path = (request.url ?? '').split('?')[0] ?? '';
        if (path === '/weir.wasm') {
          response.setHeader('content-type', 'application/wasm');
          createReadStream(wasmFile)
            .on('error', () => response.writeHead(404).end())
            .pipe(response);
        } else if (path === '/scenes/index.json') {
          response.setHeader('content-type', 'application/json').end(sceneIndex());
        } else if (/^\/scenes\/[\w-]+\.json$/.test(path)) {
          response.setHeader('content-type', 'application/json');
          createReadStream(resolve(sceneFolder, basename(path)))
            .on('error', () => response.writeHead(404).end())
            .pipe(response);
        } else {
          next();
        }
      });
    },
  };
}

export default defineConfig({
  root,
  base: './',
  plugins: [weirAssets()],
  worker: { format: 'es' },
  build: {
    target: 'es2022',
    rollupOptions: { input: [resolve(root, 'index.html'), resolve(root, 'compare.html')] },
  },
});
