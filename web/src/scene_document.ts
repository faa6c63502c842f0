// Scene documents (scenes/*.json) as the page edits them: plain JSON, checked by the core only.

export type ParameterValue = number | number[] | string;

export type SceneDocument = {
  title?: string;
  parameters?: Record<string, ParameterValue>;
  method?: string;
  dimension?: number;
  fluid?: { box?: { max?: number[] }; velocity?: number[]; flow?: string; flow_rate?: number }[];
  walls?: { surface_velocity?: number[]; motion?: { velocity?: number[] } }[];
  bodies?: unknown[];
  emitters?: { speed?: number }[];
  drains?: unknown[];
  [key: string]: unknown;
};

// Whether positions and velocities of the fluid alone are enough to go on from: what moves beside it would start anew.
export function canResume({ walls = [], bodies = [], emitters = [], drains = [] }: SceneDocument): boolean {
  return bodies.length + emitters.length + drains.length === 0 && walls.every((wall) => wall.motion === undefined);
}

export type SceneEntry = { name: string; title: string; group: string };

async function fetchJson(url: string | URL): Promise<unknown> {
  let response: Response;
  try {
    response = await fetch(url);
  } catch {
    throw new Error(`${url}: cannot be reached`);
  }
  if (!response.ok) throw new Error(`${url}: ${response.status} ${response.statusText}`);
  return parseScene(await response.text(), String(url));
}

// Says which file is malformed; the engine's own message follows, with its line and column where it gives them.
export function parseScene(text: string, name: string): unknown {
  try {
    return JSON.parse(text);
  } catch (error) {
    throw new Error(`${name}: no valid JSON: ${(error as Error).message}${placeOf(text, error as Error)}`);
  }
}

// V8 gives an offset ("at position 17"), not always line and column.
function placeOf(text: string, error: Error): string {
  if (/line \d+/.test(error.message)) return '';
  const found = /position (\d+)/.exec(error.message);
  if (!found) return '';
  const before = text.slice(0, Number(found[1])).split('\n');
  return ` (line ${before.length}, column ${(before.at(-1)?.length ?? 0) + 1})`;
}

export const fetchSceneIndex = async (): Promise<SceneEntry[]> =>
  (await fetchJson(new URL('scenes/index.json', document.baseURI))) as SceneEntry[];

// A name from the index, or any URL of a scene file.
export function fetchScene(nameOrUrl: string): Promise<unknown> {
  const isName = /^[\w-]+$/.test(nameOrUrl);
  return fetchJson(new URL(isName ? `scenes/${nameOrUrl}.json` : nameOrUrl, document.baseURI));
}

export function withParameters(scene: SceneDocument, changes: Record<string, ParameterValue>): SceneDocument {
  return { ...scene, parameters: { ...scene.parameters, ...changes } };
}
