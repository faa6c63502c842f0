// GLSL of the fallback renderer in 3D: the picture of shaders/render/space/*.wgsl without shadow map and occlusion. Light
// falls off with depth below the domain's top instead. Depth runs from 0 far away to 1 at the near plane.
import { lines, noise, particleInputs, pixel } from './points_shaders.ts';

const frame = `#version 300 es
precision highp float;
precision highp int;
uniform vec3 eye, right, up, ahead, domain_min, domain_max, tool_position;
uniform vec4 projection; // clip.xy = xy * view.xy + zw * view.z
uniform vec2 size;
uniform float near, pixel_size, sphere_radius, solid_radius, tool_radius, tool_pressed, color_min, color_scale, line_scale,
    rest_density;
uniform int color_by;
vec3 to_view(vec3 point) {
  vec3 offset = point - eye;
  return vec3(dot(offset, right), dot(offset, up), dot(offset, ahead));
}
vec3 to_world(vec3 direction) { return right * direction.x + up * direction.y + ahead * direction.z; }
vec4 project(vec3 view) { return vec4(projection.xy * view.xy + projection.zw * view.z, near, view.z); }
vec2 view_to_pixel(vec3 view) {
  vec4 clip = project(view);
  return (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * size;
}
vec2 square_corner(int index) { return vec2(float(index & 1), float(index >> 1)) * 2.0 - 1.0; }
vec3 to_linear(vec3 color) { return pow(color, vec3(2.2)); }
vec3 to_srgb(vec3 color) { return pow(max(color, vec3(0.0)), vec3(1.0 / 2.2)); }
`;

const backdrop = {
  vertex: `${frame}
void main() { gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`,
  fragment: `${frame}${pixel}${noise}
void main() {
  vec2 from_middle = (place() / size - vec2(0.5, 0.46)) * vec2(1.0, 1.15);
  float glow = exp(-4.2 * dot(from_middle, from_middle));
  vec3 color = mix(vec3(0.020, 0.028, 0.052), vec3(0.086, 0.128, 0.205), glow);
  target = vec4(color + (pixel_noise(uvec2(place())) - 0.5) / 255.0, 1.0);
}`,
};

const ground = {
  vertex: `${frame}
out vec3 point;
void main() {
  vec3 side = domain_max - domain_min, middle = 0.5 * (domain_min + domain_max);
  vec2 corner = square_corner(gl_VertexID) * 2.6 * max(side.x, side.z);
  point = vec3(middle.x + corner.x, domain_min.y - 0.25 * sphere_radius, middle.z + corner.y);
  gl_Position = project(to_view(point));
}`,
  fragment: `${frame}${pixel}
in vec3 point;
float grid_lines(vec2 at, float spacing) {
  vec2 cell = at / spacing, width = fwidth(cell);
  vec2 away = abs(fract(cell + 0.5) - 0.5) / max(width, vec2(1e-6));
  vec2 line = clamp(1.0 - away, 0.0, 1.0) * clamp(0.5 / width - 1.0, 0.0, 1.0);
  return max(line.x, line.y);
}
void main() {
  vec2 side = domain_max.xz - domain_min.xz, middle = 0.5 * (domain_min.xz + domain_max.xz);
  float longest = max(side.x, side.y);
  float decade = pow(10.0, floor(log(longest) / log(10.0) - 0.3));
  vec2 place = point.xz - domain_min.xz;
  float lines = 0.22 * grid_lines(place, decade) + 0.09 * grid_lines(place, 0.2 * decade);
  float from_middle = length(point.xz - middle) / (2.6 * longest);
  vec2 outside = abs(point.xz - middle) - 0.5 * side;
  float distance = max(outside.x, outside.y) / longest;
  float inside = 1.0 - smoothstep(-0.004, 0.004, distance);
  float lamp = exp(-16.0 * from_middle * from_middle);
  float lit = mix(0.5, 1.0, smoothstep(-0.02, 0.05, distance)); // a soft shadow of the whole
  vec3 color = (vec3(0.0065, 0.0100, 0.0180) + lamp * vec3(0.019, 0.028, 0.044) + inside * vec3(0.007, 0.012, 0.019)) * lit
      + 0.085 * lines * vec3(1.0, 1.5, 2.2) * lamp;
  float alpha = (1.0 - smoothstep(0.25, 0.95, from_middle)) * float(eye.y > point.y);
  target = vec4(to_srgb(color) * alpha, alpha);
}`,
};

const spheres = {
  vertex: `${frame}${particleInputs('vec3')}
out vec3 ray;
flat out vec4 center;
flat out vec4 color;
flat out float light;
void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // outside of the picture
  ray = vec3(0.0, 0.0, 1.0);
  center = color = vec4(0.0);
  light = 1.0;
  if (look < -0.5) return;
  vec3 middle = to_view(position);
  float extent = look < 0.5 ? sphere_radius : solid_radius;
  if (middle.z - extent < near) return;
  float distance = length(middle), pixel = pixel_size * distance, radius = max(extent, 0.55 * pixel);
  vec3 toward = middle / distance, across = normalize(cross(toward, vec3(0.0, 1.0, 0.0)));
  float reach = radius * inversesqrt(max(1.0 - radius * radius / (distance * distance), 1e-3)) + pixel;
  vec2 corner = square_corner(gl_VertexID) * reach;
  ray = middle + across * corner.x + cross(across, toward) * corner.y;
  gl_Position = project(ray);
  center = vec4(middle, radius);
  color = vec4(to_linear(particle_color()), look < 0.5 ? 1.0 : 0.25);
  light = mix(0.55, 1.0, clamp((position.y - domain_min.y) / (0.6 * (domain_max.y - domain_min.y)), 0.0, 1.0));
}`,
  fragment: `${frame}
in vec3 ray;
flat in vec4 center;
flat in vec4 color;
flat in float light;
out vec4 target;
const vec3 sun = vec3(-0.3496, 0.8591, 0.3737);
vec3 surroundings(vec3 direction) {
  if (direction.y < -0.1) return vec3(0.030, 0.042, 0.065) * (1.0 + direction.y);
  vec3 sky = mix(vec3(0.06, 0.10, 0.18), vec3(0.42, 0.56, 0.78), smoothstep(-0.1, 0.95, direction.y));
  return sky + smoothstep(0.72, 0.95, direction.y) * vec3(0.75, 0.78, 0.80);
}
vec3 shade(vec3 normal, vec3 view) {
  float wrapped = clamp(0.62 * dot(normal, sun) + 0.38, 0.0, 1.0);
  vec3 ambient = mix(vec3(0.16, 0.20, 0.28), vec3(0.62, 0.70, 0.80), 0.5 * normal.y + 0.5);
  vec3 seen = color.rgb * (0.62 * ambient * mix(0.55, 1.0, light) + vec3(1.02, 0.98, 0.92) * (wrapped * light));
  float shine = pow(max(dot(normal, normalize(sun + view)), 0.0), 70.0);
  float fresnel = 0.03 + 0.97 * pow(1.0 - clamp(dot(normal, view), 0.0, 1.0), 5.0);
  return seen + color.a * (0.55 * shine * light + 0.35 * fresnel * surroundings(reflect(-view, normal)) * mix(0.4, 1.0, light));
}
void main() {
  vec3 direction = normalize(ray);
  float along = dot(direction, center.xyz), miss = length(center.xyz - direction * along);
  float coverage = clamp((center.w - miss) / (pixel_size * along) + 0.5, 0.0, 1.0);
  if (coverage <= 0.0) discard;
  vec3 place = direction * (along - sqrt(max(center.w * center.w - miss * miss, 0.0)));
  target = vec4(to_srgb(shade(normalize(to_world(place - center.xyz)), -to_world(direction))), coverage);
  gl_FragDepth = 0.5 + 0.5 * near / place.z;
}`,
};

const edges = {
  vertex: `${frame}
out float side, depth;
void main() {
  int axis = gl_InstanceID / 4;
  vec2 turn = vec2(float(gl_InstanceID & 1), float(gl_InstanceID >> 1 & 1));
  vec3 corner = axis == 0 ? vec3(0.0, turn) : axis == 1 ? vec3(turn.x, 0.0, turn.y) : vec3(turn, 0.0);
  vec3 opposite = corner;
  opposite[axis] = 1.0;
  vec3 extent = domain_max - domain_min;
  vec3 start = to_view(domain_min + extent * corner), end = to_view(domain_min + extent * opposite);
  float cut = 1.01 * near;
  side = 0.0;
  depth = 1.0;
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (start.z < cut && end.z < cut) return;
  if (start.z < cut) start = mix(start, end, (cut - start.z) / (end.z - start.z));
  if (end.z < cut) end = mix(end, start, (cut - end.z) / (start.z - end.z));
  vec2 run = view_to_pixel(end) - view_to_pixel(start), across = vec2(-run.y, run.x) / max(length(run), 1e-6);
  float width = (0.6 * line_scale + 1.0) * float((gl_VertexID & 1) * 2 - 1);
  gl_Position = project(gl_VertexID >= 2 ? end : start);
  gl_Position.xy += across * width * vec2(2.0, -2.0) / size * gl_Position.w;
  side = width * gl_Position.w;
  depth = gl_Position.w;
}`,
  fragment: `${frame}
in float side, depth;
out vec4 target;
void main() {
  float alpha = 0.62 * clamp(0.6 * line_scale + 0.5 - abs(side / depth), 0.0, 1.0);
  target = vec4(vec3(0.38, 0.66, 0.95) * alpha, alpha);
}`,
};

const toolRing = {
  vertex: `${frame}
out vec2 middle;
out float radius;
void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  vec3 view = to_view(tool_position);
  middle = view_to_pixel(view);
  radius = tool_radius / (pixel_size * max(view.z, near));
  if (view.z < near || tool_radius <= 0.0) return;
  vec2 corner = middle + square_corner(gl_VertexID) * (radius + 14.0 * line_scale);
  gl_Position = vec4((corner / size * 2.0 - 1.0) * vec2(1.0, -1.0), 0.0, 1.0);
}`,
  fragment: `${frame}${pixel}${lines}
in vec2 middle;
in float radius;
void main() { target = ring(middle, radius); }`,
};

// In the order in which they are drawn.
export const spaceShaders = { backdrop, ground, spheres, edges, toolRing };
