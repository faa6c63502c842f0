// The memory of weir.wasm as seen from JavaScript, what the program exports, and how it says that it failed.

import type { WebGpuExports } from './webgpu_host.ts';

export const enum Status { ok = 0, pending = 1, input = 2, memory = 3, device = 4, unstable = 5, lost = 6 }

export const OUT_OF_MEMORY = 'memory ran out; close other pages or use fewer particles';

export class WeirError extends Error {
  readonly status: Status;

  constructor(status: Status, message: string) {
    super(message);
    this.name = 'WeirError';
    this.status = status;
  }
}

type Call = (...values: number[]) => number;

type Name =
  | 'weir_gpu_backend' | 'weir_gpu_destroy' | 'weir_gpu_device' | 'weir_gpu_error' | 'weir_gpu_is_software'
  | 'weir_gpu_parallelism' | 'weir_gpu_poll' | 'weir_gpu_wgpu_device' | 'weir_scene_check' | 'weir_scene_copy' | 'weir_scene_create'
  | 'weir_scene_destroy' | 'weir_scene_dimension' | 'weir_scene_error' | 'weir_scene_get_parameter'
  | 'weir_scene_method' | 'weir_scene_particle_count' | 'weir_scene_refuse' | 'weir_scene_set_boolean' | 'weir_scene_set_number'
  | 'weir_scene_set_numbers' | 'weir_scene_set_string' | 'weir_scene_stable_time_step' | 'weir_scene_title'
  | 'weir_scene_warning' | 'weir_sim_backend' | 'weir_sim_destroy' | 'weir_sim_device' | 'weir_sim_error'
  | 'weir_sim_particle_count' | 'weir_sim_poll' | 'weir_sim_is_changing' | 'weir_sim_step_time' | 'weir_sim_read' | 'weir_sim_read_motion' | 'weir_sim_reset' | 'weir_sim_scene' | 'weir_sim_wait'
  | 'weir_sim_set_max_steps' | 'weir_sim_set_parameter' | 'weir_sim_set_state' | 'weir_sim_status'
  | 'weir_sim_step' | 'weir_sim_time' | 'weir_sim_warning' | 'weir_web_allocate' | 'weir_web_color_map'
  | 'weir_web_free' | 'weir_web_gpu_create' | 'weir_web_gpu_memory' | 'weir_web_parameter'
  | 'weir_web_renderer_create' | 'weir_web_renderer_destroy' | 'weir_web_renderer_draw'
  | 'weir_web_renderer_draw_time' | 'weir_web_renderer_prepare' | 'weir_web_scene_domain' | 'weir_web_scene_fluid_count' | 'weir_web_sim_clock' | 'weir_web_view_matrix' | 'weir_web_view_ray'
  | 'weir_case_count' | 'weir_web_case_text' | 'weir_validation_create' | 'weir_validation_destroy'
  | 'weir_validation_error' | 'weir_validation_run_count' | 'weir_validation_prepare' | 'weir_validation_begin'
  | 'weir_validation_advance' | 'weir_validation_run_is_done' | 'weir_validation_abandon'
  | 'weir_validation_progress' | 'weir_validation_judge' | 'weir_validation_gate_count'
  | 'weir_validation_curve_count' | 'weir_web_run_text' | 'weir_web_run_numbers' | 'weir_web_gate' | 'weir_web_curve'
  | 'weir_probes_create' | 'weir_probes_destroy' | 'weir_probes_count' | 'weir_probes_update' | 'weir_probes_clear'
  | 'weir_web_probe_info' | 'weir_web_probe_series' | 'weir_scene_look' | 'weir_sim_fluid_slots' | 'weir_sim_run_until' | 'weir_sim_step_until' | 'weir_web_sim_advance' | 'weir_web_sim_create' | 'weir_web_sim_diagnose'
  | 'weir_web_sim_pass_times' | 'weir_web_sim_set_tool' | 'weir_web_sim_step_count' | 'weir_web_version';
export type WeirExports = WebGpuExports & { _initialize(): void } & Record<Name, Call>;

export class WeirMemory {
  readonly #c: WeirExports;
  readonly #encoder = new TextEncoder();
  readonly #decoder = new TextDecoder();
  #bytes: Uint8Array;

  constructor(exports: WeirExports) {
    this.#c = exports;
    this.#bytes = new Uint8Array(exports.memory.buffer);
  }

  // All of it; anew after it has grown.
  get bytes(): Uint8Array {
    if (this.#bytes.buffer !== this.#c.memory.buffer) this.#bytes = new Uint8Array(this.#c.memory.buffer);
    return this.#bytes;
  }

  doubles(at: number, count: number): Float64Array {
    return new Float64Array(this.#c.memory.buffer, at, count);
  }

  floats(at: number, count: number): Float32Array {
    return new Float32Array(this.#c.memory.buffer, at, count);
  }

  // A text that ends with 0; empty for a null pointer.
  text(at: number): string {
    const bytes = this.bytes;
    if (at === 0 || bytes[at] === 0) return '';
    return this.#decoder.decode(bytes.subarray(at, bytes.indexOf(0, at)));
  }

  allocate(size: number): number {
    const at = this.#c.weir_web_allocate(size);
    if (at === 0 && size > 0) throw new WeirError(Status.memory, OUT_OF_MEMORY);
    return at;
  }

  free(at: number): void {
    this.#c.weir_web_free(at);
  }

  // Memory that lives as long as `use` runs.
  scratch<T>(size: number, use: (at: number) => T): T {
    const at = this.allocate(size);
    try {
      return use(at);
    } finally {
      this.free(at);
    }
  }

  withText<T>(text: string, use: (at: number) => T): T {
    const encoded = this.#encoder.encode(text);
    return this.scratch(encoded.length + 1, (at) => {
      this.bytes.set(encoded, at);
      this.bytes[at + encoded.length] = 0;
      return use(at);
    });
  }

  withDoubles<T>(values: readonly number[], use: (at: number) => T): T {
    return this.scratch(8 * values.length + 8, (at) => {
      this.doubles(at, values.length).set(values);
      return use(at);
    });
  }
}
