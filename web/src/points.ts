// Draws particles that the C solver moved on the CPU: WebGL2, or a 2D canvas where there is none.
import { CanvasPoints } from './points_2d.ts';
import { shaders, type EffectName } from './points_shaders.ts';
import type { View } from './weir.ts';

// What a frame needs beside the view. `values` holds x,y of all particles, then vx,vy of all, then one scalar of all
// (density or pressure; unused by the speed).
export type PointsFrame = {
  values: Float32Array;
  count: number;
  changed: boolean; // false: the values are those of the last frame
  domainMin: readonly number[];
  domainMax: readonly number[];
  particleSpacing: number;
  restDensity: number;
};

export interface PointsRenderer {
  readonly name: string;
  draw(frame: PointsFrame, view: View): void;
  destroy(): void;
}

export const floatsPerParticle = 5;

const uniformNames = [
  'center', 'size', 'domain_min', 'domain_max', 'tool_position', 'tool_radius', 'tool_pressed', 'color_min',
  'color_scale', 'pixels_per_meter', 'particle_radius', 'body_radius', 'line_scale', 'rest_density', 'color_by',
] as const;
type Uniforms = Record<(typeof uniformNames)[number], WebGLUniformLocation | null>;
type Program = { program: WebGLProgram; at: Uniforms };

class WebglPoints implements PointsRenderer {
  readonly name = 'WebGL2';
  readonly #canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  readonly #colorMaps: Uint8Array;
  #programs = {} as Record<EffectName, Program>;
  #buffer: WebGLBuffer | null = null;
  #bytes = 0;
  #count = -1;
  #lost = false;

  constructor(canvas: HTMLCanvasElement, gl: WebGL2RenderingContext, colorMaps: Uint8Array) {
    this.#canvas = canvas;
    this.#gl = gl;
    this.#colorMaps = colorMaps;
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault(); // so that it comes back
      this.#lost = true;
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.#lost = false;
      this.#prepare();
    });
    this.#prepare();
  }

  #prepare(): void {
    const gl = this.#gl;
    for (const name of Object.keys(shaders) as EffectName[]) this.#programs[name] = this.#compile(name);
    this.#buffer = gl.createBuffer();
    this.#bytes = 0;
    this.#count = -1;
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffer);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 4, 0, gl.RGB, gl.UNSIGNED_BYTE, this.#colorMaps);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.disable(gl.DEPTH_TEST);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
  }

  #compile(name: EffectName): Program {
    const gl = this.#gl;
    const program = gl.createProgram();
    const sources = [[gl.VERTEX_SHADER, shaders[name].vertex], [gl.FRAGMENT_SHADER, shaders[name].fragment]] as const;
    for (const [kind, source] of sources) {
      const shader = gl.createShader(kind);
      if (!shader) throw new Error('WebGL2 gives no shader');
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS) && !gl.isContextLost()) {
        throw new Error(`WebGL2, ${name}: ${gl.getShaderInfoLog(shader)}`);
      }
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      throw new Error(`WebGL2, ${name}: ${gl.getProgramInfoLog(program)}`);
    }
    const at = {} as Uniforms;
    for (const uniform of uniformNames) at[uniform] = gl.getUniformLocation(program, uniform);
    return { program, at };
  }

  #upload(frame: PointsFrame): void {
    const gl = this.#gl;
    const bytes = frame.values.byteLength;
    if (bytes !== this.#bytes) {
      gl.bufferData(gl.ARRAY_BUFFER, frame.values, gl.STREAM_DRAW);
      this.#bytes = bytes;
    } else if (frame.changed || frame.count !== this.#count) {
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, frame.values);
    }
    if (frame.count === this.#count) return;
    this.#count = frame.count;
    const [pairs, scalars] = [8 * frame.count, 16 * frame.count];
    for (let place = 0; place < 3; place++) {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribDivisor(place, 1);
    }
    gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 8, 0);
    gl.vertexAttribPointer(1, 2, gl.FLOAT, false, 8, pairs);
    gl.vertexAttribPointer(2, 1, gl.FLOAT, false, 4, scalars);
  }

  #use(name: EffectName, frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    const { program, at } = this.#programs[name];
    const [width, height] = [this.#canvas.width, this.#canvas.height];
    const scale = view.pixelsPerMeter;
    const range = view.colorMax - view.colorMin;
    gl.useProgram(program);
    gl.uniform2f(at.center, view.center[0], view.center[1]);
    gl.uniform2f(at.size, width, height);
    gl.uniform2f(at.domain_min, frame.domainMin[0] ?? 0, frame.domainMin[1] ?? 0);
    gl.uniform2f(at.domain_max, frame.domainMax[0] ?? 0, frame.domainMax[1] ?? 0);
    gl.uniform2f(at.tool_position, view.toolPosition[0], view.toolPosition[1]);
    gl.uniform1f(at.tool_radius, view.toolRadius * scale);
    gl.uniform1f(at.tool_pressed, view.toolPressed);
    gl.uniform1f(at.color_min, view.colorMin);
    gl.uniform1f(at.color_scale, range !== 0 ? 1 / range : 0);
    gl.uniform1f(at.pixels_per_meter, scale);
    gl.uniform1f(at.particle_radius, view.particleRadius * scale);
    gl.uniform1f(at.body_radius, Math.max(1.7 * frame.particleSpacing * scale, 1.5));
    gl.uniform1f(at.line_scale, Math.min(Math.max(Math.min(width, height) / 1000, 1), 4));
    gl.uniform1f(at.rest_density, frame.restDensity);
    gl.uniform1i(at.color_by, view.colorBy);
  }

  draw(frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    if (this.#lost) return;
    gl.viewport(0, 0, this.#canvas.width, this.#canvas.height);
    this.#upload(frame);
    gl.disable(gl.BLEND);
    this.#use('background', frame, view);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.BLEND);
    this.#use('body', frame, view);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, frame.count);
    this.#use('particles', frame, view);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, frame.count);
    this.#use('overlay', frame, view);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  destroy(): void {
    this.#gl.getExtension('WEBGL_lose_context')?.loseContext();
    this.#lost = true;
  }
}

// `colorMaps`: 4 maps of 256 sRGB colours. Attributes stay enabled for all programs: the ones without particles
// draw no instances and read none of them.
export function createPointsRenderer(canvas: HTMLCanvasElement, colorMaps: Uint8Array): PointsRenderer {
  const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false, powerPreference: 'high-performance' });
  if (gl) return new WebglPoints(canvas, gl, colorMaps);
  return new CanvasPoints(canvas, colorMaps);
}
