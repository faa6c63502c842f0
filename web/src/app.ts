// The page: one scene, one engine that runs it, and the controls around them.
import { isCompressed, isFast, type Engine, type EngineStats, type FaultKind } from './engine.ts';
import { GpuEngine } from './engine_gpu.ts';
import { formatCount, formatNumber } from './format.ts';
import { onKeys } from './keys.ts';
import { chooseRange, Legend } from './legend.ts';
import { Notes } from './notes.ts';
import { Panel, type PanelHost } from './panel.ts';
import { Plot } from './plot.ts';
import { ProbePlots } from './probe_plots.ts';
import { Pointer, type ToolSettings } from './pointer.ts';
import { isSlowMotion, KnownCards, pageStore, RunRate, stepsFit } from './real_time.ts';
import { fetchScene, parseScene, withParameters, type ParameterValue, type SceneDocument, type SceneEntry } from './scene_document.ts';
import { SceneStore } from './scene_store.ts';
import { startCpu, startEngine, startGpu, startMain, type Backend, type EngineSetup } from './start_engine.ts';
import { Sharpness } from './sharpness.ts';
import { StatusLine } from './status.ts';
import { Camera, watchSize } from './view.ts';
import { ColorBy, FluidStyle, type ParameterInfo, type Weir } from './weir.ts';

export type AppOptions = {
  backend: Backend;
  sceneName: string;
  document: SceneDocument;
  particles: number; // 0: as the scene has it
  embedded: boolean; // the fluid alone: no panel, no words but errors
};

const restartDelayMs = 150; // of the last change, so that dragging a slider does not restart at every pixel
const adviceMs = 3000;
const secondLossMs = 10_000; // a device lost again so soon is not asked for a third time
const slowestDisplayMs = 1000 / 60; // what takes longer from frame to frame is late
// What the C solver, on one core, still moves at a rate that one likes to watch.
const cpuParticles = { 2: 5000, 3: 4000 } as const;
const panelWidth = 304; // CSS pixels
const headingWidth = 330;
const small = matchMedia('(max-width: 760px), (max-height: 520px)'); // as in style.css

const element = (id: string): HTMLElement => document.getElementById(id) as HTMLElement;

export class App implements PanelHost {
  readonly weir: Weir;
  readonly scenes: SceneEntry[];
  readonly parameters: ParameterInfo[];
  readonly camera = new Camera();
  readonly notes = new Notes(element('notes'));
  readonly plot = new Plot(element('plot') as HTMLCanvasElement);
  readonly probePlots = new ProbePlots(element('probes'));
  readonly status = new StatusLine(element('footer'));
  readonly store: SceneStore;
  readonly pointer: Pointer;
  sceneName: string;
  backend: Backend;
  engine: Engine | null = null;
  paused = false;
  firstFrameMs = 0; // after navigation started
  readonly #module: WebAssembly.Module;
  readonly #legend = new Legend(element('footer'));
  readonly #stage = element('stage');
  readonly #embedded: boolean;
  #asked: boolean; // the user has asked for this number of particles
  readonly #rate = new RunRate();
  readonly #sharpness = new Sharpness();
  #display = { width: 1, height: 1, ratio: 1 }; // pixels of the stage, and per CSS pixel
  readonly #known = new KnownCards(pageStore());
  #panel: Panel | null = null;
  #panelShown = true;
  readonly #styleAsked = new Map<number, FluidStyle>(); // what the user has chosen, by dimension
  #canvas: HTMLCanvasElement | null = null;
  #engineToken = {};
  #recovering = false;
  #faultOfNext = '';
  #starting: Promise<void> = Promise.resolve();
  #restartTimer = 0;
  #lastGood: SceneDocument; // that an engine runs
  #lastLoss = -Infinity;
  #lastFrame = 0;
  #interval = slowestDisplayMs; // ms between animation frames, averaged
  #plotted: unknown = null;
  #advice = ''; // as last seen
  #fastSince = 0; // the fluid is too fast or too compressed, ms
  #footer = { size: '', height: 0 }; // of the window, of the footer

  constructor(weir: Weir, module: WebAssembly.Module, scenes: SceneEntry[], options: AppOptions) {
    this.weir = weir;
    this.#module = module;
    this.scenes = scenes;
    this.parameters = weir.parameters;
    this.backend = options.backend;
    this.sceneName = options.sceneName;
    this.store = new SceneStore(weir, options.document);
    this.#embedded = options.embedded;
    document.body.classList.toggle('embedded', options.embedded);
    this.#asked = options.particles > 0;
    if (this.#asked) this.store.replace(this.store.withParticles(options.particles));
    this.#lastGood = this.store.document;
    this.pointer = new Pointer(this.#stage, this.camera, !options.embedded);
    this.pointer.onRadius = () => this.#panel?.refresh();
    this.pointer.source = () => this.engine?.fluid() ?? null;
  }

  async start(): Promise<void> {
    watchSize(this.#stage, (width, height, ratio) => {
      this.#display = { width, height, ratio };
      this.#setSize();
    });
    new ResizeObserver(() => this.#fit()).observe(element('footer')); // its words take one line or more
    if (small.matches) this.#showPlots(false);
    this.#showScene();
    await this.#chooseEngine();
    requestAnimationFrame(this.#frame);
    if (!this.#embedded) this.#panel = new Panel(element('panel'), this, !small.matches);
    this.#fit();
    this.#listen();
  }

  #setSize(): void {
    const { width, height, ratio } = this.#display;
    const { share } = this.#sharpness;
    this.camera.width = Math.max(Math.round(width * share), 1);
    this.camera.height = Math.max(Math.round(height * share), 1);
    this.camera.pixelRatio = ratio * share;
    this.#fit();
  }

  // ---- Engines ----

  #setup(): EngineSetup {
    const token = (this.#engineToken = {});
    return {
      weir: this.weir,
      module: this.#module,
      newCanvas: () => this.#newCanvas(),
      onFault: (kind, message) => {
        if (token === this.#engineToken) void this.#fault(kind, message);
      },
    };
  }

  #newCanvas(): HTMLCanvasElement {
    const canvas = document.createElement('canvas');
    this.#stage.replaceChildren(canvas);
    return (this.#canvas = canvas);
  }

  async #chooseEngine(): Promise<void> {
    const from = this.engine?.snapshot() ?? null;
    this.engine?.destroy();
    this.engine = null;
    this.notes.clear('engine');
    const { engine, reason } = await startEngine(this.#setup(), this.backend);
    this.engine = engine;
    this.status.reason = reason;
    try {
      const fewer = !from && !this.#asked ? this.#suit() : '';
      if (reason) this.notes.toast('info', this.#explained(reason, fewer));
      await engine.start(this.store.document, from);
      this.#started();
    } catch (error) {
      await this.#fault('engine', (error as Error).message);
    }
  }

  #explained(reason: string, fewer = ''): string {
    const where = this.engine?.kind === 'main' ? "on the page's own thread" : 'on the CPU';
    return `${reason.replace(/[.\s]*$/, '.')} The C solver runs the fluid ${where}${fewer && `: ${fewer}`}.`;
  }

  async #fault(kind: FaultKind, message: string): Promise<void> {
    if (kind === 'unstable') {
      const actions = [{ label: 'Restart', run: () => this.restart() }];
      if (this.#stepIsTooLarge()) {
        actions.unshift({ label: 'Use the stable step', run: () => (this.useStableStep(), this.restart()) });
      }
      this.notes.show('fault', 'error', message, actions);
      return;
    }
    if (this.#recovering) {
      this.#faultOfNext = message; // the engine that is to take over has failed as well
      return;
    }
    this.#recovering = true;
    try {
      await this.#recover(message);
    } finally {
      this.#recovering = false;
    }
  }

  // A lost device is replaced once; then the C solver takes over, in a worker if that works.
  async #recover(message: string): Promise<void> {
    const old = this.engine;
    const from = old?.snapshot() ?? null;
    const again = old?.kind === 'gpu' && performance.now() - this.#lastLoss > secondLossMs;
    this.engine = null;
    this.#engineToken = {};
    old?.destroy();
    if (old?.kind === 'gpu') this.#lastLoss = performance.now();
    const attempts: (() => Promise<Engine> | Engine)[] = [];
    if (again) attempts.push(() => startGpu(this.#setup(), this.backend === 'gpu'));
    if (old?.kind !== 'worker' && old?.kind !== 'main') attempts.push(() => startCpu(this.#setup()));
    if (old?.kind !== 'main') attempts.push(() => startMain(this.#setup()));
    for (const attempt of attempts) {
      let engine: Engine | null = null;
      try {
        this.#faultOfNext = '';
        engine = await attempt();
        await engine.start(this.store.document, from);
        if (this.#faultOfNext) throw new Error(this.#faultOfNext);
        this.engine = engine;
        this.#started();
        if (engine.kind === 'gpu') this.notes.show('engine', 'info', `${message}. A new device goes on from there.`);
        else this.notes.show('engine', 'info', this.#explained(message));
        return;
      } catch {
        engine?.destroy();
      }
    }
    this.notes.show('engine', 'error', `${message}. Nothing else could take over.`, [
      { label: 'Reload', run: () => location.reload() },
    ]);
  }

  // What else is slow, fewer particles would not mend.
  #drawPlainly(now: number, engine: Engine, factor: number): void {
    const { dimension } = this.store.scene;
    if (dimension !== 3 || this.#styleAsked.has(3) || !this.drawsWater() || this.fluidStyle !== FluidStyle.water) return;
    this.#known.noteTooSlowForWater(engine.device);
    this.#showStyle();
    this.#panel?.refresh();
    this.#rate.restart(now);
    this.notes.toast('info', `Particles instead of water, which this graphics card draws too slowly: ${formatNumber(factor, 2)} of real time. W shows it.`);
  }

  // ---- Scenes ----

  // A scene of wcsph made for a fast graphics card gets fewer particles where a slower one or the C solver moves it. In
  // words; '' if not.
  #suit(): string {
    const { scene } = this.store;
    if (scene.method !== 'wcsph') return '';
    if (this.engine?.kind !== 'gpu') return this.#thin(0);
    const known = this.#known.recall(this.engine.device, this.sceneName);
    return known > 0 && this.#isCard() ? this.#thin(known) : '';
  }

  // To so many particles, but no fewer than the C solver moves.
  #thin(wanted: number): string {
    const most = Math.max(wanted, cpuParticles[this.store.scene.dimension === 3 ? 3 : 2]);
    const usual = this.store.derived.particles;
    if (usual <= 1.2 * most) return '';
    try {
      this.store.replace(this.store.withParticles(most));
    } catch {
      return ''; // too coarse for what is in the scene
    }
    return `${formatCount(this.store.derived.particles)} particles instead of ${formatCount(usual)}`;
  }

  #isCard(): boolean {
    return this.engine instanceof GpuEngine && !this.engine.gpu.isSoftware;
  }

  get #timeScale(): number {
    return this.store.scene.parameter('time_scale')[0] ?? 1;
  }
  // Of wcsph: of the wall's time, at the wanted speed; 0: not known.
  #timeStepMs(engine: Engine): number {
    return (1000 * (engine.stats.clock?.timeStep ?? 0)) / this.#timeScale;
  }

  // As many pixels as the graphics card has time for; whether the fluid keeps real time is seen after that.
  #keepSharp(now: number, engine: Engine): void {
    const { drawMs, frameSteps, stepMs } = engine.stats;
    const timeStep = this.#timeStepMs(engine);
    const steps = timeStep > 0 ? this.#interval / timeStep : frameSteps; // that real time asks for
    const load = { drawMs: this.#isCard() && !document.hidden ? drawMs : 0, stepsMs: steps * stepMs };
    if (!this.#sharpness.update(now, load, this.#interval, this.#display.ratio)) return;
    this.#setSize();
    this.#rate.restart(now);
  }

  // What a graphics card shows in slow motion is drawn as plain particles, if drawing is what takes too long, or starts again
  // with as many particles as it moves in real time.
  #keepRealTime(now: number, engine: Engine): void {
    const { scene, derived } = this.store;
    if (this.paused || document.hidden) this.#rate.restart(now);
    const factor = this.#rate.update(now, engine.stats.time);
    if (factor === null || this.#asked || scene.method !== 'wcsph' || !this.#isCard()) return;
    const aimed = factor / this.#timeScale;
    if (isSlowMotion(aimed) && stepsFit(this.#timeStepMs(engine), engine.stats.stepMs, this.#interval)) {
      this.#drawPlainly(now, engine, aimed);
      return;
    }
    const fewer = this.#known.note(engine.device, this.sceneName, derived.particles, aimed, scene.dimension);
    if (fewer === 0) return;
    const words = this.#thin(fewer);
    if (!words) return;
    this.notes.toast('info', `${words}: this graphics card moved those at ${formatNumber(aimed, 2)} of real time. The slider asks for more.`);
    void this.#run(this.store.document);
  }

  // Starts a document; the last good one goes on if it is refused.
  #run(next: SceneDocument, name = this.sceneName, isNew = false): Promise<void> {
    this.#starting = this.#starting.then(async () => {
      const before = this.sceneName;
      try {
        this.store.replace(next);
        this.sceneName = name;
        if (isNew) {
          this.#asked = false;
          this.#suit();
        }
        await this.engine?.start(this.store.document, null);
        this.#started();
      } catch (error) {
        this.notes.toast('error', (error as Error).message);
        this.sceneName = before;
        this.store.replace(this.#lastGood);
        this.#panel?.refresh();
      }
    });
    return this.#starting;
  }

  async loadScene(nameOrUrl: string): Promise<void> {
    try {
      const document = (await fetchScene(nameOrUrl)) as SceneDocument;
      this.setPaused(false);
      await this.#run(document, nameOrUrl, true);
    } catch (error) {
      this.notes.toast('error', (error as Error).message);
      this.#panel?.refresh();
    }
  }

  async loadText(text: string, name: string): Promise<void> {
    try {
      await this.#run(parseScene(text, name) as SceneDocument, name, true);
    } catch (error) {
      this.notes.toast('error', (error as Error).message);
    }
  }

  #started(): void {
    this.#lastGood = this.store.document;
    this.notes.clear('fault');
    this.#advice = '';
    this.plot.clear();
    this.#showScene();
    if (this.engine) this.status.restart(performance.now(), this.engine);
    this.#rate.restart(performance.now());
    this.#showStyle();
    this.#panel?.refresh();
  }

  #showScene(): void {
    const { scene } = this.store;
    const { view } = this.camera;
    const space = scene.dimension === 3;
    if (this.camera.dimension !== scene.dimension || String(Object.values(this.camera.domain)) !== String(Object.values(scene.domain))) {
      this.camera.setDomain(scene.domain, scene.dimension);
    }
    // In 3D a little more than half a spacing, so that the surface looks closed.
    view.particleRadius = (space ? 0.6 : 0.5) * (scene.parameter('particle_spacing')[0] ?? 0.01);
    document.body.classList.toggle('space', space);
    this.plot.unit = space ? 'J' : 'J/m';
    chooseRange(view, scene, this.store.document);
    this.#legend.update(this.weir, view);
    element('title').textContent = scene.title;
    document.title = scene.title ? `${scene.title} · Weir` : 'Weir';
    this.pointer.setRadius(this.pointer.settings.radius);
    this.#fit();
    this.#warn();
  }

  // What the simulation itself warns of while it runs: shown once per run, for a while; then the status line keeps it.
  // The status line marks a splash that is too fast for the speed of sound while it lasts; words come if it goes on.
  #advise(now: number, { warning, clock }: EngineStats): void {
    if (!clock || !(isFast(clock) || isCompressed(clock))) this.#fastSince = now;
    if (warning === this.#advice || now - this.#fastSince < adviceMs) return;
    this.#advice = warning;
    if (warning && warning !== this.store.derived.warning) this.notes.toast('warning', warning);
  }

  #stepIsTooLarge(): boolean {
    const adaptive = this.store.scene.method === 'wcsph' && this.store.scene.parameter('stepping')[0] === 0;
    return !adaptive && (this.store.scene.parameter('time_step')[0] ?? 0) > this.store.derived.stableTimeStep;
  }

  #warn(): void {
    const { warning } = this.store.derived;
    if (!warning) return this.notes.clear('warning');
    const actions = this.#stepIsTooLarge() ? [{ label: 'Use the stable step', run: () => this.useStableStep() }] : [];
    this.notes.show('warning', 'warning', warning, actions);
  }

  // ---- What the panel may do ----

  get tool(): ToolSettings {
    return this.pointer.settings;
  }
  get colorBy(): ColorBy {
    return this.camera.view.colorBy;
  }
  get fluidStyle(): FluidStyle {
    return this.camera.view.fluidStyle ?? FluidStyle.particles;
  }
  method(): string {
    return this.store.scene.method;
  }
  parameter(name: string): number[] {
    return this.store.scene.parameter(name);
  }
  particles(): number {
    return this.store.derived.particles;
  }
  mostParticles(): number {
    return this.engine?.mostParticles ?? 50_000;
  }

  setParameter(name: string, value: ParameterValue): boolean {
    const info = this.parameters.find((parameter) => parameter.name === name);
    try {
      if (!info) throw new Error(`${name}: no such parameter`);
      this.store.set(name, value);
      if (info.live) this.engine?.setParameter(name, this.store.numbers(info), this.store.document);
      else {
        this.#asked = true; // of how fine it is, perhaps
        this.#restartSoon();
      }
      if (this.#restartTimer === 0) this.#lastGood = this.store.document;
    } catch (error) {
      this.notes.toast('error', (error as Error).message);
      return false;
    }
    this.#warn();
    this.#panel?.refresh();
    return true;
  }

  setParticles(count: number): boolean {
    try {
      this.store.replace(this.store.withParticles(count));
      this.#asked = true;
      this.#restartSoon();
    } catch (error) {
      this.notes.toast('error', (error as Error).message);
      return false;
    }
    this.#panel?.refresh();
    return true;
  }

  // Starts the document that holds when the controls have come to rest.
  #restartSoon(): void {
    clearTimeout(this.#restartTimer);
    this.#restartTimer = window.setTimeout(() => {
      this.#restartTimer = 0;
      void this.#run(this.store.document);
    }, restartDelayMs);
  }

  setBackend(backend: Backend): void {
    this.backend = backend;
    this.#starting = this.#starting.then(() => this.#chooseEngine());
  }

  setColorBy(colorBy: ColorBy): void {
    const { view } = this.camera;
    view.colorBy = colorBy;
    chooseRange(view, this.store.scene, this.store.document);
    this.#legend.update(this.weir, view);
    if (this.drawsWater() && this.store.scene.dimension === 3) this.showColors();
    this.#panel?.refresh();
  }

  drawsWater(): boolean {
    return this.engine?.kind === 'gpu';
  }
  setFluidStyle(style: FluidStyle): void {
    this.#styleAsked.set(this.store.scene.dimension, style);
    this.#showStyle();
    this.#panel?.refresh();
  }
  toggleWater(): void {
    if (this.drawsWater()) this.setFluidStyle(this.fluidStyle === FluidStyle.water ? FluidStyle.particles : FluidStyle.water);
  }
  // Particles in 3D, where water has no colours.
  showColors(): void {
    this.#styleAsked.set(3, FluidStyle.particles);
    this.#showStyle();
  }
  // Water in 3D has no legend, and without WebGPU there is no key for water. A processor that plays the graphics card is
  // too slow for it unless it is asked for; a card may be so in 3D.
  #showStyle(): void {
    const { classList } = document.body;
    const { dimension } = this.store.scene;
    const asked = this.#styleAsked.get(dimension);
    if (asked !== undefined) this.camera.view.fluidStyle = asked;
    else if (this.engine?.kind === 'gpu') {
      const isWater = this.#isCard() && (dimension === 2 || this.#known.drawsWater(this.engine.device));
      this.camera.view.fluidStyle = isWater ? FluidStyle.water : FluidStyle.particles;
    }
    classList.toggle('may-be-water', this.drawsWater());
    classList.toggle('water', dimension === 3 && this.drawsWater() && this.fluidStyle === FluidStyle.water);
    this.#sharpness.restart(performance.now(), this.#isCard());
    this.#setSize();
  }

  setRadius(radius: number): void {
    this.pointer.setRadius(radius);
  }

  restart(): void {
    this.notes.clear('fault');
    this.#advice = '';
    this.plot.clear();
    this.engine?.reset();
  }

  useStableStep(): void {
    this.setParameter('time_step', Number((0.995 * this.store.derived.stableTimeStep).toPrecision(3)));
  }

  setPaused(paused: boolean): void {
    this.paused = paused;
    this.#panel?.showPaused(paused);
  }
  togglePause(): void {
    this.setPaused(!this.paused);
  }
  stepOnce(): void {
    this.setPaused(true);
    this.engine?.step(1);
  }
  togglePanel(): void {
    this.#panelShown = !this.#panelShown;
    element('panel').classList.toggle('hidden', !this.#panelShown);
    this.#fit();
  }

  // ---- Window ----

  #fit(): void {
    const { camera } = this;
    if (this.#embedded) return camera.fit({ left: 8, right: 8, top: 8, bottom: 8 });
    const narrow = small.matches;
    const right = (this.#panelShown || this.plot.visible) && !narrow ? panelWidth + 20 : 20;
    // It only grows while the window stays: numbers that change their width must not make the picture jump.
    const size = `${innerWidth} ${innerHeight}`;
    this.#footer = { size, height: Math.max(element('footer').offsetHeight, this.#footer.size === size ? this.#footer.height : 0) };
    const footer = this.#footer.height;
    document.body.style.setProperty('--footer', `${footer}px`);
    const insets = { left: 20, right, top: narrow ? 62 : 22, bottom: footer + 30 };
    camera.fit(insets);
    if (narrow) return;
    // A wide domain goes below the heading's words, a tall one beside them.
    const last = element('links');
    const heading = element('heading').offsetTop + last.offsetTop + last.offsetHeight + 10;
    if (camera.reaches(headingWidth, heading)) camera.fit({ ...insets, top: heading });
  }

  #listen(): void {
    onKeys({
      ' ': () => this.togglePause(),
      '.': () => this.stepOnce(),
      r: () => this.restart(),
      h: () => this.togglePanel(),
      p: () => this.#showPlots(!this.plot.visible),
      v: () => this.camera.home(),
      w: () => this.toggleWater(),
      '+': () => this.#zoom(1.15),
      '=': () => this.#zoom(1.15),
      '-': () => this.#zoom(1 / 1.15),
      arrowleft: () => this.#turn(-1, 0),
      arrowright: () => this.#turn(1, 0),
      arrowup: () => this.#turn(0, 1),
      arrowdown: () => this.#turn(0, -1),
      digit: (digit) => {
        const entry = this.scenes[digit - 1];
        if (entry && !this.#embedded) void this.loadScene(entry.name);
      },
    });
    const stage = document.body;
    stage.addEventListener('dragover', (event) => {
      event.preventDefault();
      this.#stage.classList.add('dropping');
    });
    stage.addEventListener('dragleave', (event) => {
      if (event.relatedTarget === null) this.#stage.classList.remove('dropping');
    });
    stage.addEventListener('drop', (event) => {
      event.preventDefault();
      this.#stage.classList.remove('dropping');
      const file = event.dataTransfer?.files[0];
      if (file) void file.text().then((text) => this.loadText(text, file.name));
    });
  }

  #showPlots(visible: boolean): void {
    this.plot.show(visible);
    this.probePlots.show(visible);
    this.#fit();
  }

  #zoom(factor: number): void {
    if (this.camera.dimension === 3) this.camera.zoom(factor);
  }

  #turn(right: number, up: number): void {
    if (this.camera.dimension === 3) this.camera.orbit(-24 * right, 24 * up);
  }

  readonly #frame = (now: number): void => {
    requestAnimationFrame(this.#frame);
    const elapsed = this.#lastFrame > 0 ? now - this.#lastFrame : 0;
    this.#lastFrame = now;
    if (elapsed > 4) this.#interval += 0.05 * (Math.min(elapsed, slowestDisplayMs) - this.#interval);
    const engine = this.engine;
    if (!engine) return;
    this.#resizeCanvas();
    this.pointer.update(elapsed / 1000);
    engine.frame(this.paused ? 0 : elapsed / 1000, this.#interval, this.pointer.tool, this.camera.view);
    const { diagnostics } = engine.stats;
    if (diagnostics && diagnostics !== this.#plotted && !this.paused) this.plot.add(now, diagnostics);
    this.#plotted = diagnostics;
    this.probePlots.update(engine.stats.probes, now);
    if (!this.paused) this.#advise(now, engine.stats);
    this.status.update(now, engine, this.paused);
    this.#keepSharp(now, engine);
    this.#keepRealTime(now, engine);
    if (this.firstFrameMs === 0 && engine.stats.frames > 0) this.firstFrameMs = performance.now();
  };

  // Here and not when the size changes: setting it clears the canvas, which must be drawn in the same frame.
  #resizeCanvas(): void {
    const canvas = this.#canvas;
    if (!canvas) return;
    if (canvas.width !== this.camera.width) canvas.width = this.camera.width;
    if (canvas.height !== this.camera.height) canvas.height = this.camera.height;
  }

  // In plain words, for the console and tests.
  describe(): string {
    const { stats } = this.engine ?? { stats: null };
    if (!stats) return 'starting';
    return `${stats.particles} particles, ${formatNumber(this.status.realTimeFactor)} of real time`;
  }

  set(changes: Record<string, ParameterValue>): Promise<void> {
    return this.#run(withParameters(this.store.document, changes));
  }
}
