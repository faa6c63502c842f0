// Builds the pages into dist/, with the engine (weir.wasm), the scenes and a generated list of them beside them.
import { createReadStream, existsSync, readdirSync, readFileSync } from 'node:fs';
import { basename, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { defineConfig, type Plugin } from 'vite';

const root = fileURLToPath(new URL('.', import.meta.url));
const sceneFolder = resolve(root, '../scenes');
const wasmFile = process.env['WEIR_WASM'] ?? resolve(root, '../build/wasm/apps/web/weir.wasm');

// First in their groups, in this order; the page opens with the first one.
const order = ['floating_3d', 'dam_3d', 'floating_2d', 'dam_2d', 'weir', 'wave_maker', 'water'];

type Entry = { name: string; title: string; group: string };

// Groups of the chooser, in its order.
const groups = ['3D', '2D', 'Classic (2D)'];

function entryOf(file: string): Entry {
  const document = JSON.parse(readFileSync(resolve(sceneFolder, file), 'utf8')) as { title?: string; method?: string; dimension?: number };
  const name = basename(file, '.json');
  const group = document.method !== 'wcsph' ? 'Classic (2D)' : document.dimension === 3 ? '3D' : '2D';
  return { name, title: document.title ?? name, group };
}

const sceneFiles = (): string[] => readdirSync(sceneFolder).filter((name) => name.endsWith('.json'));

// In the order of the keys 1 to 9: by group, the page's first scene first, then those of `order`, then by name.
function sceneIndex(): string {
  const place = ({ name, group }: Entry): number => {
    const known = order.indexOf(name);
    return 1000 * groups.indexOf(group) + (known >= 0 ? known : 999);
  };
  const list = sceneFiles().map(entryOf);
  list.sort((a, b) => place(a) - place(b) || (a.name < b.name ? -1 : 1));
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
    rollupOptions: {
      input: {
        index: resolve(root, 'index.html'),
        compare: resolve(root, 'compare.html'),
        validation: resolve(root, 'validation.html'),
        'weir-fluid': resolve(root, 'src/weir_fluid.ts'), // other pages name it
      },
      output: { entryFileNames: ({ name }) => (name === 'weir-fluid' ? '[name].js' : 'assets/[name]-[hash].js') },
    },
  },
});
