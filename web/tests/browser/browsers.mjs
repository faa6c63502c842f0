// The two browsers of the distribution, with WebGPU on a software adapter, and what the tests do with their pages.
import assert from 'node:assert/strict';
import puppeteer from 'puppeteer-core';

const quiet = [
  '--disable-background-networking', '--disable-component-update', '--disable-default-apps', '--disable-extensions',
  '--disable-sync', '--no-first-run', '--mute-audio', '--hide-scrollbars',
];

// SwiftShader for WebGPU (through Vulkan) and for WebGL2 (through ANGLE).
const chromium = {
  name: 'chromium',
  options: {
    executablePath: process.env.WEIR_CHROMIUM ?? '/usr/bin/chromium',
    args: [
      '--headless', '--no-sandbox', '--enable-unsafe-webgpu', '--use-webgpu-adapter=swiftshader',
      '--enable-features=Vulkan', '--use-vulkan=swiftshader', '--use-angle=swiftshader', '--enable-unsafe-swiftshader',
      ...quiet,
    ],
  },
};

// lavapipe for WebGPU; no WebGL, so that the 2D canvas is tested too.
const firefox = {
  name: 'firefox',
  options: {
    browser: 'firefox',
    executablePath: process.env.WEIR_FIREFOX ?? '/usr/bin/firefox-esr',
    headless: true,
    extraPrefsFirefox: {
      'dom.webgpu.enabled': true,
      'gfx.webgpu.ignore-blocklist': true,
      'dom.webgpu.workers.enabled': true,
      'datareporting.policy.dataSubmissionEnabled': false,
      'app.normandy.enabled': false,
    },
  },
};

const wanted = (process.env.WEIR_BROWSERS ?? 'chromium,firefox').split(',');
export const browsers = [chromium, firefox].filter((browser) => wanted.includes(browser.name));

export const launch = (browser) => puppeteer.launch({ ...browser.options, protocolTimeout: 120_000 });

// Half a pixel per point: the browsers draw in software, and Tab.pixels() looks at fewer pixels still.
export const pixelRatio = 0.5;

// A tab that remembers every error its console showed.
export class Tab {
  static async open(browser, url, { setUp, size = { width: 1000, height: 640, deviceScaleFactor: pixelRatio } } = {}) {
    const page = await browser.newPage();
    const tab = new Tab(page);
    page.on('console', (message) => {
      if (message.type() === 'error') tab.errors.push(message.text());
    });
    page.on('pageerror', (error) => tab.errors.push(error.message));
    await page.setViewport(size);
    if (setUp) await page.evaluateOnNewDocument(setUp);
    await page.goto(url, { waitUntil: 'load' });
    return tab;
  }

  errors = [];
  constructor(page) {
    this.page = page;
  }

  evaluate(work, ...args) {
    return this.page.evaluate(work, ...args);
  }

  // Polls until `condition` (in the page) is true; what the page shows is in the message if it never is.
  until(what, condition, ...args) {
    return this.within(30, what, condition, ...args);
  }

  async within(seconds, what, condition, ...args) {
    const end = Date.now() + 1000 * seconds;
    for (;;) {
      if (await this.page.evaluate(condition, ...args)) return;
      if (Date.now() > end) {
        const shown = await this.page.evaluate(() => document.body.innerText.replaceAll('\n', ' ').slice(0, 600));
        assert.fail(`${what}: not within ${seconds} s. Errors: ${this.errors.join('; ') || 'none'}. The page shows: ${shown}`);
      }
      await new Promise((resolve) => setTimeout(resolve, 60));
    }
  }

  // `frames` more frames, each with a newer state.
  async frames(frames) {
    const from = await this.evaluate(() => window.weir?.engine?.stats.frames ?? 0);
    await this.until(`${frames} more frames`, (target) => (window.weir?.engine?.stats.frames ?? 0) >= target, from + frames);
  }

  async engine(kind) {
    await this.until(`engine ${kind}`, (wanted) => window.weir?.engine?.kind === wanted, kind);
  }

  // What is really on the screen, as 250 x 160 RGBA pixels.
  async pixels() {
    const png = await this.page.screenshot({ encoding: 'base64' });
    return this.evaluate(async (data) => {
      const image = new Image();
      image.src = `data:image/png;base64,${data}`;
      await image.decode();
      const canvas = document.createElement('canvas');
      [canvas.width, canvas.height] = [250, 160];
      const context = canvas.getContext('2d');
      context.drawImage(image, 0, 0, 250, 160);
      return [...context.getImageData(0, 0, 250, 160).data];
    }, png);
  }

  async close() {
    await this.page.close();
    assert.deepEqual(this.errors, [], 'the console shows no errors');
  }
}

// Pixels of the middle of the window (the domain; neither panel nor text) that differ clearly.
export function changedPixels(a, b) {
  return countMiddle((at) => Math.abs(a[at] - b[at]) + Math.abs(a[at + 1] - b[at + 1]) + Math.abs(a[at + 2] - b[at + 2]) > 24);
}

// Pixels of the middle that water covers: clearly bluer than the background.
export const waterPixels = (a) => countMiddle((at) => a[at + 2] > 90 && a[at + 2] > a[at] + 30);

function countMiddle(test) {
  let count = 0;
  for (let y = 8; y < 136; y++) for (let x = 62; x < 172; x++) if (test(4 * (250 * y + x))) count++;
  return count;
}
