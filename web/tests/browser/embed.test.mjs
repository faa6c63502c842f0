// <weir-fluid> on a page of somebody else's, in real Chromium and real Firefox.
import assert from 'node:assert/strict';
import { after, before, describe, test } from 'node:test';
import { browsers, changedPixels, launch, Tab, waterPixels } from './browsers.mjs';
import { serve } from './server.mjs';

const pages = {};
const server = await serve(pages);
after(() => server.close());

// The page in the element's frame; `work` runs in it with its App.
const inFrame = (tab, work) =>
  tab.evaluate(`(${work})(document.querySelector('weir-fluid').shadowRoot.querySelector('iframe').contentWindow.weir)`);

async function untilInFrame(tab, what, condition) {
  await tab.until(what, `(${condition})(document.querySelector('weir-fluid')?.shadowRoot?.querySelector('iframe').contentWindow.weir)`);
}

for (const kind of browsers) {
  describe(kind.name, () => {
    let browser;
    before(async () => (browser = await launch(kind)));
    after(() => browser?.close());

    // What the README tells, on a page that knows nothing of Weir.
    async function open(attributes) {
      pages['/host.html'] = `<!doctype html><html><head><link rel="icon" href="data:,"></head><body style="margin: 0; height: 3000px">
        <script>
          window.told = [];
          addEventListener('ready', (event) => window.told.push('ready'), true);
          addEventListener('error', (event) => event.detail && window.told.push(event.detail), true);
        </script>
        <script type="module" src="weir-fluid.js"></script>
        <weir-fluid style="height: 640px" ${attributes}></weir-fluid></body></html>`;
      return Tab.open(browser, `${server.url}host.html`);
    }

    test('two lines bring a fluid that moves, and nothing else', async () => {
      const tab = await open('scene="water" particles="1500"');
      await untilInFrame(tab, 'frames', (app) => (app?.engine?.stats.frames ?? 0) > 2);
      const first = await tab.pixels();
      await untilInFrame(tab, '0.1 simulated seconds', (app) => app.engine.stats.time > 0.1);
      const later = await tab.pixels();
      assert.ok(waterPixels(first) > 1000, `water covers ${waterPixels(first)} pixels`);
      assert.ok(changedPixels(first, later) > 100, `${changedPixels(first, later)} pixels changed`);
      assert.equal(await inFrame(tab, (app) => app.engine.stats.particles < 3000), true);
      const words = await tab.evaluate(() => document.querySelector('weir-fluid').shadowRoot.querySelector('iframe').contentDocument.body.innerText.trim());
      assert.equal(words, '');
      assert.deepEqual(await tab.evaluate(() => window.told), ['ready']);
      await tab.close();
    });

    test('it obeys the element, rests out of sight, and lets the wheel scroll', async () => {
      const tab = await open('scene="water" particles="1500" paused');
      await untilInFrame(tab, 'a pause', (app) => app?.paused);
      await tab.evaluate(() => (document.querySelector('weir-fluid').paused = false));
      await untilInFrame(tab, 'a run', (app) => !app.paused && app.engine.stats.steps > 5);
      await tab.page.mouse.move(300, 300);
      await tab.page.mouse.wheel({ deltaY: 900 });
      await tab.until('a scrolled page', () => scrollY > 700);
      await untilInFrame(tab, 'a rest', (app) => app.paused);
      await tab.evaluate(() => scrollTo(0, 0));
      await untilInFrame(tab, 'a run again', (app) => !app.paused);
      await tab.evaluate(() => {
        const fluid = document.querySelector('weir-fluid');
        fluid.paused = true;
        fluid.restart();
      });
      await untilInFrame(tab, 'the start', (app) => app.paused && app.engine.stats.time === 0);
      await tab.evaluate(() => document.querySelector('weir-fluid').setAttribute('scene', 'dam_break'));
      await untilInFrame(tab, 'another scene', (app) => app?.sceneName === 'dam_break' && app.paused);
      await tab.close();
    });

    test('what is wrong is told', async () => {
      const tab = await open('scene="nowhere"');
      await tab.until('words', () => window.told.some((text) => /scenes\/nowhere\.json: 404/.test(text)));
      tab.errors.length = 0; // the browser's own word about the missing file
      await tab.close();
    });
  });
}
