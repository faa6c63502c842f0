// GLSL of the fallback renderer: the same picture as shaders/render/*.wgsl, effect by effect and name by name.

const frame = `#version 300 es
precision highp float;
precision highp int;
uniform vec2 center, size, domain_min, domain_max, tool_position;
uniform float tool_radius, tool_pressed, color_min, color_scale, pixels_per_meter, particle_radius, water_radius,
    disc_radius, border, line_scale, rest_density;
uniform int color_by;
vec2 to_pixels(vec2 point) {
  return (point - center) * pixels_per_meter * vec2(1.0, -1.0) + 0.5 * size;
}
vec4 to_clip(vec2 pixel) { return vec4((pixel / size * 2.0 - 1.0) * vec2(1.0, -1.0), 0.0, 1.0); }
vec2 square_corner(int index) { return vec2(float(index & 1), float(index >> 1)) * 2.0 - 1.0; }
float domain_distance(vec2 pixel) {
  vec2 low = to_pixels(domain_min), high = to_pixels(domain_max);
  vec2 outside = abs(pixel - 0.5 * (low + high)) - 0.5 * abs(high - low) - border;
  return length(max(outside, vec2(0.0))) + min(max(outside.x, outside.y), 0.0);
}
`;

// A particle's look: -1 not drawn, 0 fluid, 1 wall, 2 and more bodies. `vector` is vec2 or vec3.
export const particleInputs = (vector: string): string => `
layout(location = 0) in ${vector} position;
layout(location = 1) in ${vector} velocity;
layout(location = 2) in float scalar; // density or pressure
layout(location = 3) in float look;
uniform sampler2D color_maps; // one row of 256 colours per map
float color_value() {
  float value = scalar;
  if (color_by == 0) value = length(velocity);
  if (color_by == 2) value = (scalar - rest_density) / rest_density;
  return clamp((value - color_min) * color_scale, 0.0, 1.0);
}
vec3 color_map(float t) { return texelFetch(color_maps, ivec2(int(t * 255.0 + 0.5), color_by), 0).rgb; }
vec3 particle_color() {
  if (look < 0.5) return color_map(color_value());
  if (look < 1.5) return vec3(0.34, 0.40, 0.50);
  int body = int(look - 1.5) % 4;
  return body == 0 ? vec3(0.93, 0.66, 0.36) : body == 1 ? vec3(0.88, 0.47, 0.38)
      : body == 2 ? vec3(0.60, 0.72, 0.46) : vec3(0.78, 0.55, 0.70);
}
`;

// Fragment shaders see y down, as WGSL does.
export const pixel = `
out vec4 target;
vec2 place() { return vec2(gl_FragCoord.x, size.y - gl_FragCoord.y); }
`;

export const noise = `
float pixel_noise(uvec2 at) {
  uint state = (at.x + at.y * 65537u) * 747796405u + 2891336453u;
  state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
  return float(((state >> 22u) ^ state) & 0xffffu) / 65535.0;
}
`;

const background = {
  vertex: `${frame}
void main() { gl_Position = vec4(float(gl_VertexID & 1) * 4.0 - 1.0, float(gl_VertexID >> 1) * 4.0 - 1.0, 0.0, 1.0); }`,
  fragment: `${frame}${pixel}
${noise}void main() {
  vec2 uv = place() / size, from_middle = (uv - 0.5) * 2.0;
  float vignette = 1.0 - 0.38 * smoothstep(0.3, 2.1, dot(from_middle, from_middle));
  vec3 outside = mix(vec3(0.031, 0.045, 0.078), vec3(0.016, 0.023, 0.043), uv.y);
  float domain_top = to_pixels(domain_max).y, domain_bottom = to_pixels(domain_min).y;
  float depth = clamp((place().y - domain_top) / max(domain_bottom - domain_top, 1.0), 0.0, 1.0);
  vec3 inside = mix(vec3(0.050, 0.082, 0.138), vec3(0.020, 0.033, 0.066), sqrt(depth));
  float share = clamp(0.5 - domain_distance(place()), 0.0, 1.0);
  float noise = (pixel_noise(uvec2(place())) - 0.5) / 255.0;
  target = vec4(mix(outside, inside, share) * vignette + noise, 1.0);
}`,
};

const water = {
  vertex: `${frame}${particleInputs('vec2')}
out vec2 offset;
flat out vec3 color;
flat out vec2 glow;
void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // outside of the picture
  if (look < -0.5 || look > 0.5) return;
  float t = color_value(), strength = smoothstep(0.45, 1.0, t), spread = 1.0 + 0.9 * strength;
  float radius = water_radius * spread;
  vec2 middle = to_pixels(position);
  vec2 low = to_pixels(vec2(domain_min.x, domain_max.y)) - border;
  vec2 high = to_pixels(vec2(domain_max.x, domain_min.y)) + border;
  vec2 corner = clamp(middle + square_corner(gl_VertexID) * radius, low, high);
  gl_Position = to_clip(corner);
  offset = (corner - middle) / radius;
  color = color_map(color_by == 2 ? t : 0.72 * t);
  glow = vec2(0.16 * strength, spread * spread);
}`,
  fragment: `${frame}${pixel}
in vec2 offset;
flat in vec3 color;
flat in vec2 glow;
void main() {
  float part = dot(offset, offset);
  float near = max(1.0 - part * glow.y, 0.0), far = max(1.0 - part, 0.0);
  float alpha = 0.5 * near * near;
  float light = glow.x * far * far * far;
  target = vec4(color * (0.72 * alpha + light), min(alpha + 0.8 * light, 1.0));
}`,
};

const particles = {
  vertex: `${frame}${particleInputs('vec2')}
out vec2 offset;
flat out vec3 color;
flat out vec2 shape; // radius; 1 for a bead, 0 for a flat disc
void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  if (look < -0.5) return;
  shape = look < 0.5 ? vec2(particle_radius, 1.0) : vec2(disc_radius, 0.0);
  offset = square_corner(gl_VertexID) * max(shape.x + 0.5, 1.5);
  gl_Position = to_clip(to_pixels(position) + offset);
  color = particle_color();
}`,
  fragment: `${frame}${pixel}
in vec2 offset;
flat in vec3 color;
flat in vec2 shape;
float disc_coverage(float distance, float radius) {
  float edge = sqrt(max(radius * radius - 1.0 / 12.0, 0.25)) + 0.5;
  float crisp = clamp(edge - distance, 0.0, 1.0);
  float inside = max(1.0 - distance * distance / 2.25, 0.0);
  float soft = min(radius * radius / 0.75, 1.0) * inside * inside;
  return mix(soft, crisp, smoothstep(0.6, 0.85, radius));
}
void main() {
  float radius = shape.x, distance = length(offset);
  float alpha = disc_coverage(distance, radius);
  float detail = shape.y * smoothstep(1.5, 5.0, radius);
  float rim = 1.0 - 0.38 * detail * smoothstep(0.35, 1.05, distance / radius);
  float from_light = length(offset / radius + vec2(0.42));
  float light = 0.30 * detail * (1.0 - smoothstep(0.0, 0.36, from_light));
  target = vec4(mix(color * rim, vec3(1.0), light) * alpha, alpha);
}`,
};

// Of the domain's outline and the tool's ring.
export const lines = `
const vec3 line_color = vec3(0.38, 0.66, 0.95), ring_color = vec3(0.62, 0.90, 1.00);
float line_coverage(float distance, float width) {
  return clamp(0.5 * width + 0.5 - abs(distance), 0.0, 1.0) * min(width, 1.0);
}
float line_glow(float distance) {
  float near = max(1.0 - abs(distance) / (14.0 * line_scale), 0.0);
  return near * near * near;
}
vec4 ring(vec2 middle, float radius) {
  float distance = length(place() - middle) - radius;
  float alpha = mix(0.55, 0.95, tool_pressed) * line_coverage(distance, 1.5 * line_scale);
  float part = clamp(1.0 + distance / max(radius, 1.0), 0.0, 1.0);
  float fill = mix(0.015, 0.11, tool_pressed) * part * part * clamp(0.5 - distance, 0.0, 1.0);
  float light = mix(0.12, 0.38, tool_pressed) * line_glow(distance) + fill;
  return vec4(ring_color * (alpha + light), alpha);
}
`;

// Outline and ring in one pass over the window: the fallback draws few enough pixels elsewhere.
const overlay = {
  vertex: background.vertex,
  fragment: `${frame}${pixel}${lines}vec4 outline() {
  float distance = domain_distance(place());
  float alpha = 0.75 * line_coverage(distance, 1.25 * line_scale);
  return vec4(line_color * alpha + line_color * 0.10 * line_glow(distance), alpha);
}
void main() {
  vec4 under = outline();
  if (tool_radius <= 0.0) { target = under; return; }
  vec4 over = ring(to_pixels(tool_position), tool_radius);
  target = over + under * (1.0 - over.a);
}`,
};

// In the order in which they are drawn.
export const flatShaders = { background, water, particles, overlay };
