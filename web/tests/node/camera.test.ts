// The page's camera against the engine's, and where a ray meets the fluid.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pickFluid } from '../../src/pick.ts';
import { Camera, cameraAxes, dot } from '../../src/view.ts';
import { Weir, type Triple } from '../../src/weir.ts';
import { wasmFile } from './support.ts';

const weir = await Weir.load(wasmFile('weir.wasm'), { gpu: null });
const [width, height, ratio] = [900, 600, 1.5];

function camera(): Camera {
  const made = new Camera();
  made.width = width;
  made.height = height;
  made.pixelRatio = ratio;
  made.setDomain({ min: [0, 0, 0], max: [3, 1.5, 1] }, 3);
  made.fit({ left: 20, right: 200, top: 30, bottom: 60 });
  return made;
}

// Device pixel and clip z of a point by the engine's matrix.
function byMatrix(made: Camera, point: Triple): [number, number, number] {
  const m = weir.viewMatrix(made.view, width, height);
  const clip = [0, 1, 2, 3].map((row) => [...point, 1].reduce((sum, part, column) => sum + part * (m[4 * column + row] ?? 0), 0));
  const [x = 0, y = 0, z = 0, w = 1] = clip;
  return [((x / w + 1) * width) / 2, ((1 - y / w) * height) / 2, z / w];
}

const corners = Array.from({ length: 8 }, (_, k): Triple => [k & 1 ? 3 : 0, k & 2 ? 1.5 : 0, k & 4 ? 1 : 0]);

test('a point appears where the engine draws it, turned, shifted and zoomed', () => {
  const made = camera();
  for (const change of [() => {}, () => made.orbit(130, -40), () => made.pan(-30, 12), () => made.zoom(1.7)]) {
    change();
    for (const corner of corners) {
      const [x, y] = made.toClient(corner) ?? [NaN, NaN];
      const [wantedX, wantedY, depth] = byMatrix(made, corner);
      assert.ok(Math.hypot(x * ratio - wantedX, y * ratio - wantedY) < 0.01);
      assert.ok(depth > 0 && depth < 1);
      const ray = made.ray(x, y);
      const wanted = weir.viewRay(made.view, width, height, x * ratio, y * ratio);
      for (let k = 0; k < 3; k++) {
        assert.ok(Math.abs((ray.origin[k] ?? 0) - (wanted.origin[k] ?? 1)) < 1e-4);
        assert.ok(Math.abs((ray.direction[k] ?? 0) - (wanted.direction[k] ?? 1)) < 1e-5);
      }
    }
  }
});

test('the whole domain is seen, in the free part of the window, as large as it goes', () => {
  const places = corners.map((corner): [number, number] => camera().toClient(corner) ?? [NaN, NaN]);
  const [xs, ys] = [places.map((place) => place[0]), places.map((place) => place[1])];
  assert.ok(Math.min(...xs) > 20 && Math.max(...xs) < width / ratio - 200, String(xs));
  assert.ok(Math.min(...ys) > 30 && Math.max(...ys) < height / ratio - 60, String(ys));
  const fills = Math.max((Math.max(...xs) - Math.min(...xs)) / (width / ratio - 220), (Math.max(...ys) - Math.min(...ys)) / (height / ratio - 90));
  assert.ok(fills > 0.8, `${fills}`);
});

test('a camera that the user moved keeps its place in another window; V takes it back', () => {
  const made = camera();
  const { yaw } = made.view.camera;
  made.orbit(50, 0);
  made.zoom(2);
  const { distance } = made.view.camera;
  made.fit({ left: 0, right: 0, top: 0, bottom: 0 });
  assert.equal(made.view.camera.distance, distance);
  assert.notEqual(made.view.camera.yaw, yaw);
  made.home();
  assert.equal(made.view.camera.yaw, yaw);
  made.orbit(0, 1e6);
  assert.ok(made.view.camera.pitch < Math.PI / 2);
  const { right, up, ahead } = cameraAxes(made.view.camera, width, height);
  for (const product of [dot(right, up), dot(up, ahead), dot(ahead, right)]) assert.ok(Math.abs(product) < 1e-12);
});

test('a ray meets the nearest particle of the fluid', () => {
  const positions = new Float32Array([0.5, 0.5, 0.2, 0.5, 0.5, 0.8, 0.9, 0.5, 0.9, 0.5, 0.5, 5]);
  const source = { positions, count: 4, radius: 0.05, min: [0, 0, 0], max: [1, 1, 1] };
  const hit = (origin: Triple, direction: Triple) => pickFluid(source, origin, direction);
  assert.ok(Math.abs((hit([0.5, 0.5, 2], [0, 0, -1]) ?? 0) - 1.2) < 1e-6, 'the one at 0.8');
  assert.ok(Math.abs((hit([0.52, 0.5, -1], [0, 0, 1]) ?? 0) - 1.2) < 1e-6, 'from behind the one at 0.2');
  assert.equal(hit([0.5, 0.6, 2], [0, 0, -1]), null, 'beside');
  assert.equal(hit([0.5, 0.5, 2], [0, 0, 1]), null, 'an empty slot, outside of the domain, is none');
});
