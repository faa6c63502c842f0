// Draws particles that the C solver moved on the CPU: WebGL2, or a 2D canvas where there is none.
import { CanvasPoints } from './points_2d.ts';
import { flatShaders } from './points_shaders.ts';
import { spaceShaders } from './points_space_shaders.ts';
import { cameraAxes } from './view.ts';
import type { View } from './weir.ts';

// What a frame needs beside the view. `values` holds the positions of all particles, x, y (and z in 3D) each, then
// their velocities, then one scalar each (density or pressure; unused by the speed), then one look each: -1 not drawn,
// 0 fluid, 1 wall, 2 and more bodies.
export type PointsFrame = {
  values: Float32Array;
  count: number;
  changed: boolean; // false: the values are those of the last frame
  dimension: number; // 2 or 3
  domainMin: readonly number[];
  domainMax: readonly number[];
  border: number; // 2D: how far inside of the outline's usual place a particle touches the wall, m
  particleSpacing: number;
  restDensity: number;
};

export interface PointsRenderer {
  readonly name: string;
  draw(frame: PointsFrame, view: View): void;
  destroy(): void;
}

export const floatsPerParticle = (dimension: number): number => 2 * dimension + 2;

const uniformNames = [
  'center', 'size', 'domain_min', 'domain_max', 'tool_position', 'tool_radius', 'tool_pressed', 'color_min',
  'color_scale', 'pixels_per_meter', 'particle_radius', 'water_radius', 'disc_radius', 'border', 'line_scale', 'rest_density', 'color_by',
  'eye', 'right', 'up', 'ahead', 'projection', 'near', 'pixel_size', 'sphere_radius', 'solid_radius',
] as const;
type Uniforms = Record<(typeof uniformNames)[number], WebGLUniformLocation | null>;
type Program = { program: WebGLProgram; at: Uniforms };
type Source = { vertex: string; fragment: string };

class WebglPoints implements PointsRenderer {
  readonly name = 'WebGL2';
  readonly #canvas: HTMLCanvasElement;
  readonly #gl: WebGL2RenderingContext;
  readonly #colorMaps: Uint8Array;
  #programs: Record<string, Program> = {}; // made when first drawn with
  #buffer: WebGLBuffer | null = null;
  #bytes = 0;
  #layout = ''; // of the attributes
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
    this.#programs = {};
    this.#buffer = gl.createBuffer();
    this.#bytes = 0;
    this.#layout = '';
    gl.bindBuffer(gl.ARRAY_BUFFER, this.#buffer);
    const texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGB8, 256, 4, 0, gl.RGB, gl.UNSIGNED_BYTE, this.#colorMaps);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
    gl.blendFunc(gl.ONE, gl.ONE_MINUS_SRC_ALPHA);
    gl.clearDepth(0);
    gl.depthFunc(gl.GREATER); // nearer is more
  }

  #compile(name: string, source: Source): Program {
    const gl = this.#gl;
    const program = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, source.vertex], [gl.FRAGMENT_SHADER, source.fragment]] as const) {
      const shader = gl.createShader(kind);
      if (!shader) throw new Error('WebGL2 gives no shader');
      gl.shaderSource(shader, text);
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
    const { count, dimension, values } = frame;
    const layout = `${count} ${dimension}`;
    if (values.byteLength !== this.#bytes) {
      gl.bufferData(gl.ARRAY_BUFFER, values, gl.STREAM_DRAW);
      this.#bytes = values.byteLength;
    } else if (frame.changed || layout !== this.#layout) {
      gl.bufferSubData(gl.ARRAY_BUFFER, 0, values);
    }
    if (layout === this.#layout) return;
    this.#layout = layout;
    const vectors = 4 * dimension * count;
    for (let place = 0; place < 4; place++) {
      gl.enableVertexAttribArray(place);
      gl.vertexAttribDivisor(place, 1);
    }
    gl.vertexAttribPointer(0, dimension, gl.FLOAT, false, 4 * dimension, 0);
    gl.vertexAttribPointer(1, dimension, gl.FLOAT, false, 4 * dimension, vectors);
    gl.vertexAttribPointer(2, 1, gl.FLOAT, false, 4, 2 * vectors);
    gl.vertexAttribPointer(3, 1, gl.FLOAT, false, 4, 2 * vectors + 4 * count);
  }

  #use(name: string, source: Source, frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    const { program, at } = (this.#programs[name] ??= this.#compile(name, source));
    const [width, height] = [this.#canvas.width, this.#canvas.height];
    const range = view.colorMax - view.colorMin;
    gl.useProgram(program);
    gl.uniform2f(at.size, width, height);
    gl.uniform1f(at.tool_pressed, view.toolPressed);
    gl.uniform1f(at.color_min, view.colorMin);
    gl.uniform1f(at.color_scale, range !== 0 ? 1 / range : 0);
    gl.uniform1f(at.line_scale, Math.min(Math.max(Math.min(width, height) / 1000, 1), 4));
    gl.uniform1f(at.rest_density, frame.restDensity);
    gl.uniform1i(at.color_by, view.colorBy);
    if (frame.dimension === 3) this.#spaceUniforms(at, frame, view);
    else this.#flatUniforms(at, frame, view);
  }

  #flatUniforms(at: Uniforms, frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    const scale = view.pixelsPerMeter;
    const radius = view.particleRadius * scale;
    gl.uniform2f(at.center, view.center[0], view.center[1]);
    gl.uniform2f(at.domain_min, frame.domainMin[0] ?? 0, frame.domainMin[1] ?? 0);
    gl.uniform2f(at.domain_max, frame.domainMax[0] ?? 0, frame.domainMax[1] ?? 0);
    gl.uniform2f(at.tool_position, view.toolPosition[0], view.toolPosition[1]);
    gl.uniform1f(at.tool_radius, view.toolRadius * scale);
    gl.uniform1f(at.pixels_per_meter, scale);
    gl.uniform1f(at.particle_radius, radius);
    gl.uniform1f(at.disc_radius, Math.max(0.72 * frame.particleSpacing * scale, radius));
    gl.uniform1f(at.border, frame.border > 0 ? Math.max(radius - frame.border * scale, 0) + 0.6 : radius);
    gl.uniform1f(at.water_radius, Math.max(1.7 * frame.particleSpacing * scale, 1.5));
  }

  #spaceUniforms(at: Uniforms, frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    const { camera } = view;
    const axes = cameraAxes(camera, this.#canvas.width, this.#canvas.height);
    gl.uniform3fv(at.eye, axes.eye);
    gl.uniform3fv(at.right, axes.right);
    gl.uniform3fv(at.up, axes.up);
    gl.uniform3fv(at.ahead, axes.ahead);
    gl.uniform4f(at.projection, axes.focal[0], axes.focal[1], camera.shift[0], camera.shift[1]);
    gl.uniform1f(at.near, axes.near);
    gl.uniform1f(at.pixel_size, 2 / (axes.focal[1] * this.#canvas.height));
    gl.uniform1f(at.sphere_radius, view.particleRadius);
    gl.uniform1f(at.solid_radius, 0.68 * frame.particleSpacing);
    gl.uniform3fv(at.domain_min, frame.domainMin.slice(0, 3));
    gl.uniform3fv(at.domain_max, frame.domainMax.slice(0, 3));
    gl.uniform3fv(at.tool_position, view.toolPosition);
    gl.uniform1f(at.tool_radius, view.toolRadius);
  }

  draw(frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    if (this.#lost) return;
    gl.viewport(0, 0, this.#canvas.width, this.#canvas.height);
    this.#upload(frame);
    if (frame.dimension === 3) this.#drawSpace(frame, view);
    else this.#drawFlat(frame, view);
  }

  #drawFlat(frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    gl.disable(gl.BLEND);
    this.#use('background', flatShaders.background, frame, view);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.enable(gl.BLEND);
    this.#use('water', flatShaders.water, frame, view);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, frame.count);
    this.#use('particles', flatShaders.particles, frame, view);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, frame.count);
    this.#use('overlay', flatShaders.overlay, frame, view);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  #drawSpace(frame: PointsFrame, view: View): void {
    const gl = this.#gl;
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.BLEND);
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    this.#use('backdrop', spaceShaders.backdrop, frame, view);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    gl.clear(gl.DEPTH_BUFFER_BIT);
    gl.enable(gl.DEPTH_TEST);
    gl.enable(gl.BLEND);
    this.#use('ground', spaceShaders.ground, frame, view);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.disable(gl.BLEND);
    gl.enable(gl.SAMPLE_ALPHA_TO_COVERAGE); // smooth outlines
    this.#use('spheres', spaceShaders.spheres, frame, view);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, frame.count);
    gl.disable(gl.SAMPLE_ALPHA_TO_COVERAGE);
    gl.enable(gl.BLEND);
    gl.depthMask(false);
    this.#use('edges', spaceShaders.edges, frame, view);
    gl.drawArraysInstanced(gl.TRIANGLE_STRIP, 0, 4, 12);
    gl.disable(gl.DEPTH_TEST);
    this.#use('toolRing', spaceShaders.toolRing, frame, view);
    gl.drawArrays(gl.TRIANGLE_STRIP, 0, 4);
    gl.depthMask(true);
  }

  destroy(): void {
    this.#gl.getExtension('WEBGL_lose_context')?.loseContext();
    this.#lost = true;
  }
}

// `colorMaps`: 4 maps of 256 sRGB colours. Attributes stay enabled for all programs: the ones without particles
// draw few instances and read none of them.
export function createPointsRenderer(canvas: HTMLCanvasElement, colorMaps: Uint8Array): PointsRenderer {
  const gl = canvas.getContext('webgl2', { alpha: false, antialias: true, depth: true, powerPreference: 'high-performance' });
  if (gl) return new WebglPoints(canvas, gl, colorMaps);
  return new CanvasPoints(canvas, colorMaps);
}
