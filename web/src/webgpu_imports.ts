// The JavaScript half of webgpu.h in a browser (the C half: src/webgpu_web). Every import takes scalars only: handles,
// pointers with lengths, numbers. Objects live in a table whose slots are reused; what has finished waits in its
// instance's queue until wgpuInstanceProcessEvents(). Calls of every frame allocate nothing but the browser's objects.

import * as names from './webgpu_enums.ts';

import {
  ADAPTER_ERROR, CANCELLED, ERROR_NONE, ERROR_TYPES, FAILED, LOST_DESTROYED,
  LOST_FAILED_CREATION, LOST_UNKNOWN, MAP_ABORTED, PIPELINE_FAILED, PIPELINE_INVALID, SUCCESS, UNAVAILABLE, WebGpuHost,
  reasonText,
} from './webgpu_host.ts';
import type { DeviceHome, InstanceHome, WebEvent, WebGpuExports } from './webgpu_host.ts';

export type Canvas = HTMLCanvasElement | OffscreenCanvas;
type Surface = { canvas: Canvas; context: GPUCanvasContext };
type MappedRange = { offset: number; size: number; at: number; bytes: Uint8Array; writable: boolean };

const LIMITS = [
  'maxTextureDimension1D', 'maxTextureDimension2D', 'maxTextureDimension3D', 'maxTextureArrayLayers',
  'maxBindGroups', 'maxBindGroupsPlusVertexBuffers', 'maxBindingsPerBindGroup',
  'maxDynamicUniformBuffersPerPipelineLayout', 'maxDynamicStorageBuffersPerPipelineLayout',
  'maxSampledTexturesPerShaderStage', 'maxSamplersPerShaderStage', 'maxStorageBuffersPerShaderStage',
  'maxStorageTexturesPerShaderStage', 'maxUniformBuffersPerShaderStage', 'maxUniformBufferBindingSize',
  'maxStorageBufferBindingSize', 'minUniformBufferOffsetAlignment', 'minStorageBufferOffsetAlignment',
  'maxVertexBuffers', 'maxBufferSize', 'maxVertexAttributes', 'maxVertexBufferArrayStride',
  'maxInterStageShaderVariables', 'maxColorAttachments', 'maxColorAttachmentBytesPerSample',
  'maxComputeWorkgroupStorageSize', 'maxComputeInvocationsPerWorkgroup', 'maxComputeWorkgroupSizeX',
  'maxComputeWorkgroupSizeY', 'maxComputeWorkgroupSizeZ', 'maxComputeWorkgroupsPerDimension', 'maxImmediateSize',
] as const;

const SOFTWARE = /swiftshader|llvmpipe|lavapipe|softpipe|software|basic render|warp/i;

export class WebGpuImports {
  // Import module "webgpu" of the program.
  readonly functions: WebAssembly.ModuleImports = {};

  readonly #host = new WebGpuHost();
  readonly #gpu: GPU | null;
  readonly #canvases: Canvas[] = [];
  readonly #ranges = new Map<number, MappedRange[]>();

  // Parts of the descriptor that the next creating call takes.
  #requiredFeatures: GPUFeatureName[] = [];
  #requiredLimits: Record<string, number> = {};
  #layoutEntries: GPUBindGroupLayoutEntry[] = [];
  #groupLayouts: GPUBindGroupLayout[] = [];
  #groupEntries: GPUBindGroupEntry[] = [];
  #blend: GPUBlendState | undefined;
  #targets: GPUColorTargetState[] = [];
  #vertex: GPUVertexState | undefined;
  #fragment: GPUFragmentState | undefined;
  #depth: GPUDepthStencilState | undefined;

  // Descriptors of the calls that every frame makes, used again and again.
  readonly #labelOnly: { label: string } = { label: '' };
  readonly #computeTimes: GPUComputePassTimestampWrites = { querySet: undefined as unknown as GPUQuerySet };
  readonly #computePass: GPUComputePassDescriptor = { label: '' };
  readonly #renderTimes: GPURenderPassTimestampWrites = { querySet: undefined as unknown as GPUQuerySet };
  readonly #attachmentPool: GPURenderPassColorAttachment[] = [];
  readonly #attachments: GPURenderPassColorAttachment[] = [];
  readonly #depthAttachment: GPURenderPassDepthStencilAttachment = { view: undefined as unknown as GPUTextureView };
  readonly #renderPass: GPURenderPassDescriptor = { label: '', colorAttachments: this.#attachments };
  readonly #commands: GPUCommandBuffer[] = [];

  // `gpu` null: every request for an adapter ends with "unavailable".
  constructor(gpu: GPU | null) {
    this.#gpu = gpu;
    const groups = [
      this.#instanceCalls(), this.#deviceCalls(), this.#bufferCalls(), this.#textureCalls(), this.#shaderCalls(),
      this.#pipelineCalls(), this.#commandCalls(), this.#passCalls(), this.#queueCalls(), this.#surfaceCalls(),
    ];
    for (const group of groups)
      for (const [name, call] of Object.entries(group)) this.functions[name] = this.#host.guard(name, call);
  }

  // Must be called with the program's exports before any of its functions runs.
  attach(exports: WebGpuExports): void {
    this.#host.exports = exports;
  }

  // Makes a canvas known to weir_webgpu_canvas_surface() under the number returned.
  registerCanvas(canvas: Canvas): number {
    const known = this.#canvases.indexOf(canvas);
    return known >= 0 ? known : this.#canvases.push(canvas) - 1;
  }

  // The object behind a handle, and the number of handles in use: for tests.
  object(handle: number): unknown {
    return this.#host.objects[handle];
  }

  get liveObjects(): number {
    return this.#host.liveObjects;
  }

  #add(object: unknown, home: DeviceHome | InstanceHome | null): number {
    return this.#host.add(object, home);
  }

  #get<T>(handle: number): T {
    return this.#host.objects[handle] as T;
  }

  #homeOf(handle: number): DeviceHome {
    return this.#host.homes[handle] as DeviceHome;
  }

  // -------------------------------------------------------------------------------------------------------
  // Instance and adapter

  #instanceCalls() {
    return {
      add_reference: (handle: number) => {
        this.#host.references[handle] = (this.#host.references[handle] as number) + 1;
      },
      release: (handle: number) => this.#host.release(handle),
      take_text: (to: number) => {
        this.#host.view().set(this.#host.heldText, to);
      },
      device_error: (handle: number, text: number, length: number) => {
        this.#host.report(handle, this.#host.text(text, length));
      },
      instance_create: () => {
        const instance: InstanceHome = { open: true, pending: new Set(), queue: [] };
        return this.#add(instance, instance);
      },
      process_events: (instance: number) => this.#host.processEvents(this.#get<InstanceHome>(instance)),
      request_adapter: (handle: number, power: number, fallback: number, level: number, record: number) => {
        const instance = this.#get<InstanceHome>(handle);
        void this.#requestAdapter(instance, power, fallback, level, this.#host.start(instance, 'adapter', record));
      },
      adapter_text: (adapter: number, which: number) => {
        const info = this.#get<GPUAdapter>(adapter).info;
        return this.#host.hold([info?.vendor, info?.architecture, info?.device, info?.description][which] ?? '');
      },
      adapter_number: (adapter: number, which: number) => {
        const info = this.#get<GPUAdapter>(adapter).info;
        if (which === 0) {
          const text = `${info?.vendor} ${info?.architecture} ${info?.device} ${info?.description}`;
          return info?.isFallbackAdapter || SOFTWARE.test(text) ? 1 : 0;
        }
        return (which === 1 ? info?.subgroupMinSize : info?.subgroupMaxSize) ?? 0;
      },
      limit: (handle: number, index: number) =>
        this.#get<GPUAdapter | GPUDevice>(handle).limits[LIMITS[index] as 'maxBindGroups'] ?? 0,
      has_feature: (handle: number, feature: number) => {
        const name = names.featureName[feature];
        return name !== undefined && this.#get<GPUAdapter | GPUDevice>(handle).features.has(name) ? 1 : 0;
      },
    };
  }

  async #requestAdapter(instance: InstanceHome, power: number, fallback: number, level: number, event: WebEvent) {
    if (!this.#gpu) {
      this.#host.finish(instance, event, UNAVAILABLE, 0, 'this browser has no WebGPU');
      return;
    }
    try {
      const options: GPURequestAdapterOptions = { forceFallbackAdapter: fallback !== 0 };
      const preference = names.powerPreference[power];
      const feature = names.featureLevel[level];
      if (preference) options.powerPreference = preference as GPUPowerPreference;
      if (feature) (options as { featureLevel?: string }).featureLevel = feature;
      const adapter = await this.#gpu.requestAdapter(options);
      if (!adapter) {
        this.#host.finish(instance, event, UNAVAILABLE, 0, 'the browser offers no WebGPU adapter');
        return;
      }
      const handle = this.#add(adapter, instance);
      if (!this.#host.finish(instance, event, SUCCESS, handle)) this.#host.release(handle);
    } catch (error) {
      this.#host.finish(instance, event, ADAPTER_ERROR, 0, reasonText(error));
    }
  }

  // -------------------------------------------------------------------------------------------------------
  // Device

  #deviceCalls() {
    return {
      require_feature: (feature: number) => {
        this.#requiredFeatures.push((names.featureName[feature] ?? `feature ${feature}`) as GPUFeatureName);
      },
      require_limit: (index: number, value: number) => {
        this.#requiredLimits[LIMITS[index] as string] = value;
      },
      request_device: (adapter: number, label: number, length: number, lost: number, error: number, record: number) => {
        const descriptor: GPUDeviceDescriptor = {
          label: this.#host.text(label, length),
          requiredFeatures: this.#requiredFeatures,
          requiredLimits: this.#requiredLimits,
        };
        this.#requiredFeatures = [];
        this.#requiredLimits = {};
        const instance = this.#host.instanceOf(adapter);
        const lostEvent = lost ? this.#host.start(instance, 'lost', lost) : null;
        const event = this.#host.start(instance, 'device', record);
        void this.#requestDevice(this.#get<GPUAdapter>(adapter), instance, descriptor, lostEvent, error, event);
      },
      device_queue: (device: number) => this.#add(this.#get<GPUDevice>(device).queue, this.#homeOf(device)),
      device_destroy: (device: number) => this.#get<GPUDevice>(device).destroy(),
      push_error_scope: (device: number, filter: number) =>
        this.#get<GPUDevice>(device).pushErrorScope(names.errorFilter[filter] as GPUErrorFilter),
      pop_error_scope: (device: number, record: number) => {
        const instance = this.#host.instanceOf(device);
        const event = this.#host.start(instance, 'scope', record);
        this.#get<GPUDevice>(device).popErrorScope().then(
          (error) => {
            const type = error ? (ERROR_TYPES[error.constructor.name] ?? 5) : ERROR_NONE;
            this.#host.finish(instance, event, SUCCESS, type, error?.message);
          },
          (error) => this.#host.finish(instance, event, FAILED, ERROR_NONE, reasonText(error)),
        );
      },
    };
  }

  async #requestDevice(adapter: GPUAdapter, instance: InstanceHome, descriptor: GPUDeviceDescriptor,
    lost: WebEvent | null, errorRecord: number, event: WebEvent) {
    try {
      // A browser refuses limits that it does not know, even at 0: the C struct has them all.
      const limits = descriptor.requiredLimits as Record<string, number>;
      for (const name of Object.keys(limits))
        if (limits[name] === 0 && !(name in adapter.limits)) delete limits[name];
      const device = await adapter.requestDevice(descriptor);
      const home: DeviceHome = { device, handle: 0, instance, errorRecord };
      home.handle = this.#add(device, home);
      if (lost) lost.device = home;
      device.addEventListener('uncapturederror', (e) => {
        e.preventDefault(); // the program reports it, the console need not
        this.#host.queueError(home, ERROR_TYPES[e.error.constructor.name] ?? 5, e.error.message);
      });
      void device.lost.then((info) => {
        const reason = info.reason === 'destroyed' ? LOST_DESTROYED : LOST_UNKNOWN;
        if (lost) this.#host.finish(instance, lost, reason, 0, info.message);
      });
      if (!this.#host.finish(instance, event, SUCCESS, home.handle)) this.#host.release(home.handle);
    } catch (error) {
      if (errorRecord) this.#host.exports.weir_webgpu_forget(errorRecord);
      if (lost) this.#host.finish(instance, lost, LOST_FAILED_CREATION, 0, reasonText(error));
      this.#host.finish(instance, event, FAILED, 0, reasonText(error));
    }
  }

  // -------------------------------------------------------------------------------------------------------
  // Buffers

  #bufferCalls() {
    return {
      buffer_create: (device: number, label: number, length: number, usage: number, size: number, mapped: number) =>
        this.#add(
          this.#get<GPUDevice>(device).createBuffer({
            label: this.#host.text(label, length), usage, size, mappedAtCreation: mapped !== 0,
          }),
          this.#homeOf(device),
        ),
      buffer_size: (buffer: number) => this.#get<GPUBuffer>(buffer).size,
      buffer_usage: (buffer: number) => this.#get<GPUBuffer>(buffer).usage,
      buffer_map_state: (buffer: number) => names.bufferMapState.indexOf(this.#get<GPUBuffer>(buffer).mapState),
      buffer_map: (buffer: number, mode: number, offset: number, size: number, record: number) => {
        const instance = this.#host.instanceOf(buffer);
        const event = this.#host.start(instance, 'status', record);
        this.#get<GPUBuffer>(buffer).mapAsync(mode, offset, size < 0 ? undefined : size).then(
          () => this.#host.finish(instance, event, SUCCESS),
          (error) => {
            const aborted = error instanceof Error && error.name === 'AbortError';
            this.#host.finish(instance, event, aborted ? MAP_ABORTED : FAILED, 0, reasonText(error));
          },
        );
      },
      buffer_find_range: (buffer: number, offset: number, size: number) =>
        this.#ranges.get(buffer)?.find((range) => range.offset === offset && range.size === size)?.at ?? 0,
      buffer_open_range: (buffer: number, offset: number, size: number, at: number, writable: number) => {
        const range = this.#get<GPUBuffer>(buffer).getMappedRange(offset, size < 0 ? undefined : size);
        const bytes = new Uint8Array(range);
        this.#host.view().set(bytes, at);
        const known = this.#ranges.get(buffer) ?? [];
        known.push({ offset, size, at, bytes, writable: writable !== 0 });
        this.#ranges.set(buffer, known);
        return 1;
      },
      buffer_close_range: (buffer: number) => {
        const known = this.#ranges.get(buffer);
        const range = known?.pop();
        if (known?.length === 0) this.#ranges.delete(buffer);
        if (!range) return 0;
        // A range of a destroyed buffer is detached: nothing to write back to.
        if (range.writable && range.bytes.length > 0)
          range.bytes.set(this.#host.view().subarray(range.at, range.at + range.bytes.length));
        return range.at;
      },
      buffer_unmap: (buffer: number) => this.#get<GPUBuffer>(buffer).unmap(),
      buffer_destroy: (buffer: number) => this.#get<GPUBuffer>(buffer).destroy(),
    };
  }

  // -------------------------------------------------------------------------------------------------------
  // Textures and query sets

  #textureCalls() {
    return {
      texture_create: (device: number, label: number, length: number, usage: number, dimension: number, width: number,
        height: number, layers: number, format: number, mipLevelCount: number, sampleCount: number) =>
        this.#add(
          this.#get<GPUDevice>(device).createTexture({
            label: this.#host.text(label, length), usage, size: [width >>> 0, height >>> 0, layers >>> 0], mipLevelCount,
            sampleCount, dimension: names.textureDimension[dimension] as GPUTextureDimension | undefined,
            format: names.textureFormat[format] as GPUTextureFormat,
          }),
          this.#homeOf(device),
        ),
      texture_view: (texture: number, label: number, length: number, format: number, dimension: number,
        baseMipLevel: number, mips: number, baseArrayLayer: number, layers: number, aspect: number) => {
        const object = this.#get<GPUTexture>(texture);
        const plain = format + dimension + baseMipLevel + baseArrayLayer + length === 0 && mips < 0 && layers < 0;
        if (plain && aspect <= 1) return this.#add(object.createView(), this.#homeOf(texture)); // of every frame
        return this.#add(
          object.createView({
            label: this.#host.label(label, length), baseMipLevel, baseArrayLayer,
            format: names.textureFormat[format] as GPUTextureFormat | undefined,
            dimension: names.textureViewDimension[dimension] as GPUTextureViewDimension | undefined,
            aspect: names.textureAspect[aspect] as GPUTextureAspect | undefined,
            mipLevelCount: mips < 0 ? undefined : mips,
            arrayLayerCount: layers < 0 ? undefined : layers,
          }),
          this.#homeOf(texture),
        );
      },
      texture_number: (texture: number, which: number) => {
        const object = this.#get<GPUTexture>(texture);
        if (which === 2) return names.textureFormat.indexOf(object.format);
        return which === 0 ? object.width : object.height;
      },
      texture_destroy: (texture: number) => this.#get<GPUTexture>(texture).destroy(),
      query_set_create: (device: number, label: number, length: number, type: number, count: number) =>
        this.#add(
          this.#get<GPUDevice>(device).createQuerySet({
            label: this.#host.text(label, length), type: names.queryType[type] as GPUQueryType, count: count >>> 0,
          }),
          this.#homeOf(device),
        ),
      query_set_destroy: (querySet: number) => this.#get<GPUQuerySet>(querySet).destroy(),
    };
  }

  // -------------------------------------------------------------------------------------------------------
  // Shaders

  #shaderCalls() {
    return {
      shader_create: (device: number, label: number, length: number, code: number, codeLength: number) =>
        this.#add(
          this.#get<GPUDevice>(device).createShaderModule({
            label: this.#host.text(label, length), code: this.#host.text(code, codeLength),
          }),
          this.#homeOf(device),
        ),
      shader_messages: (shader: number, record: number) => {
        const instance = this.#host.instanceOf(shader);
        const event = this.#host.start(instance, 'shader', record);
        this.#get<GPUShaderModule>(shader).getCompilationInfo().then(
          (info) => {
            event.messages = info.messages;
            this.#host.finish(instance, event, SUCCESS);
          },
          () => this.#host.finish(instance, event, CANCELLED),
        );
      },
      message_number: (index: number, which: number) => {
        const message = this.#host.messages[index];
        if (!message) return 0;
        if (which === 0) return names.compilationMessageType.indexOf(message.type);
        return [0, message.lineNum, message.linePos, message.offset, message.length][which] ?? 0;
      },
      message_text: (index: number) => this.#host.hold(this.#host.messages[index]?.message ?? ''),
    };
  }

  // -------------------------------------------------------------------------------------------------------
  // Layouts, bind groups, pipelines

  #computePipeline(label: number, length: number, layout: number, shader: number, entry: number, entryLength: number):
  GPUComputePipelineDescriptor {
    return {
      label: this.#host.text(label, length),
      layout: layout ? this.#get<GPUPipelineLayout>(layout) : 'auto',
      compute: { module: this.#get(shader), entryPoint: this.#host.entryPoint(entry, entryLength) },
    };
  }

  #pipelineCalls() {
    return {
      layout_buffer: (binding: number, visibility: number, type: number, dynamic: number, minBindingSize: number) => {
        const bufferType = names.bufferBindingType[type] as GPUBufferBindingType | undefined;
        const buffer = { type: bufferType, hasDynamicOffset: dynamic !== 0, minBindingSize };
        this.#layoutEntries.push({ binding, visibility, buffer });
      },
      layout_texture: (binding: number, visibility: number, type: number, dimension: number, multisampled: number) => {
        const sampleType = names.textureSampleType[type] as GPUTextureSampleType | undefined;
        const viewDimension = names.textureViewDimension[dimension] as GPUTextureViewDimension | undefined;
        this.#layoutEntries.push({ binding, visibility, texture: { sampleType, viewDimension, multisampled: multisampled !== 0 } });
      },
      layout_create: (device: number, label: number, length: number) => {
        const entries = this.#layoutEntries;
        this.#layoutEntries = [];
        const descriptor = { label: this.#host.text(label, length), entries };
        return this.#add(this.#get<GPUDevice>(device).createBindGroupLayout(descriptor), this.#homeOf(device));
      },
      pipeline_layout_group: (layout: number) => {
        this.#groupLayouts.push(this.#get<GPUBindGroupLayout>(layout));
      },
      pipeline_layout_create: (device: number, label: number, length: number) => {
        const bindGroupLayouts = this.#groupLayouts;
        this.#groupLayouts = [];
        const descriptor = { label: this.#host.text(label, length), bindGroupLayouts };
        return this.#add(this.#get<GPUDevice>(device).createPipelineLayout(descriptor), this.#homeOf(device));
      },
      group_buffer: (binding: number, buffer: number, offset: number, size: number) => {
        const resource = { buffer: this.#get<GPUBuffer>(buffer), offset, size: size < 0 ? undefined : size };
        this.#groupEntries.push({ binding, resource });
      },
      group_texture: (binding: number, view: number) => {
        this.#groupEntries.push({ binding, resource: this.#get<GPUTextureView>(view) });
      },
      group_create: (device: number, label: number, length: number, layout: number) => {
        const entries = this.#groupEntries;
        this.#groupEntries = [];
        const group = this.#get<GPUDevice>(device).createBindGroup({
          label: this.#host.text(label, length), layout: this.#get<GPUBindGroupLayout>(layout), entries,
        });
        return this.#add(group, this.#homeOf(device));
      },
      compute_pipeline: (device: number, label: number, length: number, layout: number, shader: number,
        entry: number, entryLength: number) =>
        this.#add(
          this.#get<GPUDevice>(device).createComputePipeline(
            this.#computePipeline(label, length, layout, shader, entry, entryLength)),
          this.#homeOf(device),
        ),
      compute_pipeline_async: (device: number, label: number, length: number, layout: number, shader: number,
        entry: number, entryLength: number, record: number) => {
        const instance = this.#host.instanceOf(device);
        const event = this.#host.start(instance, 'pipeline', record);
        const descriptor = this.#computePipeline(label, length, layout, shader, entry, entryLength);
        const home = this.#homeOf(device);
        this.#get<GPUDevice>(device).createComputePipelineAsync(descriptor).then(
          (pipeline) => {
            const handle = this.#add(pipeline, home);
            if (!this.#host.finish(instance, event, SUCCESS, handle)) this.#host.release(handle);
          },
          (error: GPUPipelineError) =>
            this.#host.finish(instance, event, error.reason === 'validation' ? PIPELINE_INVALID : PIPELINE_FAILED, 0,
              reasonText(error)),
        );
      },
      vertex_stage: (shader: number, entry: number, length: number) => {
        this.#vertex = { module: this.#get(shader), entryPoint: this.#host.entryPoint(entry, length) };
        this.#fragment = undefined;
      },
      blend: (operation: number, source: number, destination: number, alphaOperation: number, alphaSource: number,
        alphaDestination: number) => {
        this.#blend = {
          color: blendPart(operation, source, destination),
          alpha: blendPart(alphaOperation, alphaSource, alphaDestination),
        };
      },
      color_target: (format: number, writeMask: number) => {
        this.#targets.push({
          format: names.textureFormat[format] as GPUTextureFormat, blend: this.#blend, writeMask: writeMask >>> 0,
        });
        this.#blend = undefined;
      },
      fragment_stage: (shader: number, entry: number, length: number) => {
        const entryPoint = this.#host.entryPoint(entry, length);
        this.#fragment = { module: this.#get(shader), entryPoint, targets: this.#targets };
        this.#targets = [];
      },
      depth_state: (format: number, write: number, compare: number) => {
        this.#depth = {
          format: names.textureFormat[format] as GPUTextureFormat, depthWriteEnabled: write !== 0,
          depthCompare: names.compareFunction[compare] as GPUCompareFunction | undefined,
        };
      },
      render_pipeline: (device: number, label: number, length: number, layout: number, topology: number,
        strip: number, front: number, cull: number, count: number, mask: number, alpha: number) => {
        const depthStencil = this.#depth;
        this.#depth = undefined;
        return this.#add(
          this.#get<GPUDevice>(device).createRenderPipeline({
            label: this.#host.text(label, length),
            layout: layout ? this.#get<GPUPipelineLayout>(layout) : 'auto',
            vertex: this.#vertex as GPUVertexState,
            fragment: this.#fragment,
            depthStencil,
            primitive: {
              topology: names.primitiveTopology[topology] as GPUPrimitiveTopology | undefined,
              stripIndexFormat: names.indexFormat[strip] as GPUIndexFormat | undefined,
              frontFace: names.frontFace[front] as GPUFrontFace | undefined,
              cullMode: names.cullMode[cull] as GPUCullMode | undefined,
            },
            multisample: { count, mask: mask >>> 0, alphaToCoverageEnabled: alpha !== 0 },
          }),
          this.#homeOf(device),
        );
      },
    };
  }

  // -------------------------------------------------------------------------------------------------------
  // Commands

  #commandCalls() {
    return {
      encoder_create: (device: number, label: number, length: number) => {
        this.#labelOnly.label = this.#host.label(label, length);
        const encoder = this.#get<GPUDevice>(device).createCommandEncoder(this.#labelOnly);
        return this.#add(encoder, this.#homeOf(device));
      },
      encoder_finish: (encoder: number, label: number, length: number) => {
        this.#labelOnly.label = this.#host.label(label, length);
        return this.#add(this.#get<GPUCommandEncoder>(encoder).finish(this.#labelOnly), this.#homeOf(encoder));
      },
      copy_buffer: (encoder: number, source: number, sourceOffset: number, destination: number, offset: number,
        size: number) =>
        this.#get<GPUCommandEncoder>(encoder).copyBufferToBuffer(
          this.#get<GPUBuffer>(source), sourceOffset, this.#get<GPUBuffer>(destination), offset, size,
        ),
      clear_buffer: (encoder: number, buffer: number, offset: number, size: number) =>
        this.#get<GPUCommandEncoder>(encoder).clearBuffer(this.#get(buffer), offset, size < 0 ? undefined : size),
      copy_texture: (encoder: number, texture: number, mipLevel: number, x: number, y: number, z: number,
        aspect: number, buffer: number, offset: number, rowBytes: number, rows: number, width: number, height: number,
        layers: number) =>
        this.#get<GPUCommandEncoder>(encoder).copyTextureToBuffer(
          {
            texture: this.#get(texture), mipLevel, origin: [x, y, z],
            aspect: names.textureAspect[aspect] as GPUTextureAspect | undefined,
          },
          {
            buffer: this.#get(buffer), offset, bytesPerRow: rowBytes < 0 ? undefined : rowBytes,
            rowsPerImage: rows < 0 ? undefined : rows,
          },
          [width, height, layers],
        ),
      resolve_queries: (encoder: number, querySet: number, first: number, count: number, buffer: number,
        offset: number) =>
        this.#get<GPUCommandEncoder>(encoder).resolveQuerySet(
          this.#get(querySet), first >>> 0, count >>> 0, this.#get(buffer), offset,
        ),
    };
  }

  #passCalls() {
    return {
      compute_pass: (encoder: number, label: number, length: number, querySet: number, begin: number, end: number) => {
        const descriptor = this.#computePass;
        descriptor.label = this.#host.label(label, length);
        descriptor.timestampWrites = setTimes(this.#computeTimes, this.#get(querySet), begin, end);
        return this.#add(this.#get<GPUCommandEncoder>(encoder).beginComputePass(descriptor), this.#homeOf(encoder));
      },
      color_attachment: (view: number, depthSlice: number, resolve: number, load: number, store: number, r: number,
        g: number, b: number, a: number) => {
        const index = this.#attachments.length;
        const fresh = { clearValue: { r: 0, g: 0, b: 0, a: 0 } } as unknown as GPURenderPassColorAttachment;
        const attachment = (this.#attachmentPool[index] ??= fresh);
        attachment.view = this.#get<GPUTextureView>(view);
        attachment.depthSlice = depthSlice < 0 ? undefined : depthSlice;
        attachment.resolveTarget = resolve ? this.#get<GPUTextureView>(resolve) : undefined;
        attachment.loadOp = names.loadOp[load] as GPULoadOp;
        attachment.storeOp = names.storeOp[store] as GPUStoreOp;
        const clear = attachment.clearValue as GPUColorDict;
        clear.r = r;
        clear.g = g;
        clear.b = b;
        clear.a = a;
        this.#attachments.push(attachment);
      },
      depth_attachment: (view: number, load: number, store: number, clear: number, readOnly: number) => {
        const attachment = this.#depthAttachment;
        attachment.view = this.#get<GPUTextureView>(view);
        attachment.depthLoadOp = names.loadOp[load] as GPULoadOp | undefined;
        attachment.depthStoreOp = names.storeOp[store] as GPUStoreOp | undefined;
        attachment.depthClearValue = Number.isFinite(clear) ? clear : undefined;
        attachment.depthReadOnly = readOnly !== 0;
        this.#renderPass.depthStencilAttachment = attachment;
      },
      render_pass: (encoder: number, label: number, length: number, querySet: number, begin: number, end: number) => {
        const descriptor = this.#renderPass;
        descriptor.label = this.#host.label(label, length);
        descriptor.timestampWrites = setTimes(this.#renderTimes, this.#get(querySet), begin, end);
        try {
          const pass = this.#get<GPUCommandEncoder>(encoder).beginRenderPass(descriptor);
          return this.#add(pass, this.#homeOf(encoder));
        } finally {
          this.#attachments.length = 0;
          descriptor.depthStencilAttachment = undefined;
        }
      },
      pass_pipeline: (pass: number, pipeline: number) =>
        this.#get<GPUComputePassEncoder>(pass).setPipeline(this.#get(pipeline)),
      pass_group: (pass: number, index: number, group: number, offsets: number, count: number) => {
        const encoder = this.#get<GPUComputePassEncoder>(pass);
        const object = group ? this.#get<GPUBindGroup>(group) : null;
        if (count === 0) {
          encoder.setBindGroup(index, object);
        } else {
          this.#host.view();
          encoder.setBindGroup(index, object, this.#host.words, offsets >>> 2, count);
        }
      },
      pass_end: (pass: number) => this.#get<GPUComputePassEncoder>(pass).end(),
      dispatch: (pass: number, x: number, y: number, z: number) =>
        this.#get<GPUComputePassEncoder>(pass).dispatchWorkgroups(x >>> 0, y >>> 0, z >>> 0),
      dispatch_indirect: (pass: number, sizes: number, offset: number) =>
        this.#get<GPUComputePassEncoder>(pass).dispatchWorkgroupsIndirect(this.#get(sizes), offset),
      draw: (pass: number, vertices: number, instances: number, firstVertex: number, firstInstance: number) =>
        this.#get<GPURenderPassEncoder>(pass).draw(
          vertices >>> 0, instances >>> 0, firstVertex >>> 0, firstInstance >>> 0,
        ),
      draw_indirect: (pass: number, drawn: number, offset: number) =>
        this.#get<GPURenderPassEncoder>(pass).drawIndirect(this.#get(drawn), offset),
    };
  }

  // -------------------------------------------------------------------------------------------------------
  // Queue and surface

  #queueCalls() {
    return {
      submit: (queue: number, at: number, count: number) => {
        this.#host.view();
        this.#commands.length = count;
        for (let k = 0; k < count; k++)
          this.#commands[k] = this.#get<GPUCommandBuffer>(this.#host.words[(at >>> 2) + k] as number);
        this.#get<GPUQueue>(queue).submit(this.#commands);
        this.#commands.length = 0;
      },
      write_buffer: (queue: number, buffer: number, offset: number, data: number, size: number) =>
        this.#get<GPUQueue>(queue).writeBuffer(
          this.#get<GPUBuffer>(buffer), offset, this.#host.exports.memory.buffer, data >>> 0, size >>> 0,
        ),
      work_done: (queue: number, record: number) => {
        const instance = this.#host.instanceOf(queue);
        const event = this.#host.start(instance, 'status', record);
        this.#get<GPUQueue>(queue).onSubmittedWorkDone().then(
          () => this.#host.finish(instance, event, SUCCESS),
          (error) => this.#host.finish(instance, event, FAILED, 0, reasonText(error)),
        );
      },
    };
  }

  #surfaceCalls() {
    return {
      surface_create: (instance: number, id: number) => {
        const canvas = this.#canvases[id];
        const context = canvas?.getContext('webgpu') as GPUCanvasContext | null | undefined;
        return canvas && context ? this.#add({ canvas, context } as Surface, this.#host.instanceOf(instance)) : 0;
      },
      surface_format: () =>
        this.#gpu ? names.textureFormat.indexOf(this.#gpu.getPreferredCanvasFormat()) : 0,
      surface_configure: (handle: number, device: number, format: number, usage: number, width: number,
        height: number, alpha: number) => {
        const { canvas, context } = this.#get<Surface>(handle);
        this.#host.homes[handle] = this.#homeOf(device); // whose errors the surface's are from now on
        if (canvas.width !== width) canvas.width = width;
        if (canvas.height !== height) canvas.height = height;
        context.configure({
          device: this.#get(device), format: names.textureFormat[format] as GPUTextureFormat, usage,
          alphaMode: names.compositeAlphaMode[alpha] as GPUCanvasAlphaMode | undefined,
        });
      },
      surface_unconfigure: (handle: number) => this.#get<Surface>(handle).context.unconfigure(),
      surface_texture: (handle: number) =>
        this.#add(this.#get<Surface>(handle).context.getCurrentTexture(), this.#host.homes[handle] ?? null),
    };
  }
}

function blendPart(operation: number, source: number, destination: number): GPUBlendComponent {
  return {
    operation: names.blendOperation[operation] as GPUBlendOperation | undefined,
    srcFactor: names.blendFactor[source] as GPUBlendFactor | undefined,
    dstFactor: names.blendFactor[destination] as GPUBlendFactor | undefined,
  };
}

function setTimes<T extends GPUComputePassTimestampWrites>(times: T, querySet: GPUQuerySet | undefined, begin: number,
  end: number): T | undefined {
  if (!querySet) return undefined;
  times.querySet = querySet;
  times.beginningOfPassWriteIndex = begin < 0 ? undefined : begin;
  times.endOfPassWriteIndex = end < 0 ? undefined : end;
  return times;
}
