// The values of webgpu.h's enums as navigator.gpu calls them: each list is indexed by the C value. A test holds them
// against the header.

type Names = readonly (string | undefined)[];

export const featureLevel: Names = [undefined, 'compatibility', 'core'];
export const powerPreference: Names = [undefined, 'low-power', 'high-performance'];
export const featureName: Names = [
  undefined, 'core-features-and-limits', 'depth-clip-control', 'depth32float-stencil8',
  'texture-compression-bc', 'texture-compression-bc-sliced-3d', 'texture-compression-etc2',
  'texture-compression-astc', 'texture-compression-astc-sliced-3d', 'timestamp-query',
  'indirect-first-instance', 'shader-f16', 'rg11b10ufloat-renderable', 'bgra8unorm-storage',
  'float32-filterable', 'float32-blendable', 'clip-distances', 'dual-source-blending', 'subgroups',
  'texture-formats-tier1', 'texture-formats-tier2', 'primitive-index', 'texture-component-swizzle',
];
export const errorFilter: Names = [undefined, 'validation', 'out-of-memory', 'internal'];
export const bufferBindingType: Names = [undefined, undefined, 'uniform', 'storage', 'read-only-storage'];
export const textureSampleType: Names = [
  undefined, undefined, 'float', 'unfilterable-float', 'depth', 'sint', 'uint',
];
export const compareFunction: Names = [
  undefined, 'never', 'less', 'equal', 'less-equal', 'greater', 'not-equal', 'greater-equal', 'always',
];
export const bufferMapState: Names = [undefined, 'unmapped', 'pending', 'mapped'];
export const queryType: Names = [undefined, 'occlusion', 'timestamp'];
export const textureDimension: Names = [undefined, '1d', '2d', '3d'];
export const textureViewDimension: Names = [undefined, '1d', '2d', '2d-array', 'cube', 'cube-array', '3d'];
export const textureAspect: Names = [undefined, 'all', 'stencil-only', 'depth-only'];
export const primitiveTopology: Names = [
  undefined, 'point-list', 'line-list', 'line-strip', 'triangle-list', 'triangle-strip',
];
export const indexFormat: Names = [undefined, 'uint16', 'uint32'];
export const frontFace: Names = [undefined, 'ccw', 'cw'];
export const cullMode: Names = [undefined, 'none', 'front', 'back'];
export const blendOperation: Names = [undefined, 'add', 'subtract', 'reverse-subtract', 'min', 'max'];
export const blendFactor: Names = [
  undefined, 'zero', 'one', 'src', 'one-minus-src', 'src-alpha', 'one-minus-src-alpha', 'dst',
  'one-minus-dst', 'dst-alpha', 'one-minus-dst-alpha', 'src-alpha-saturated', 'constant',
  'one-minus-constant', 'src1', 'one-minus-src1', 'src1-alpha', 'one-minus-src1-alpha',
];
export const loadOp: Names = [undefined, 'load', 'clear'];
export const storeOp: Names = [undefined, 'store', 'discard'];
export const compositeAlphaMode: Names = ['opaque', 'opaque', 'premultiplied', undefined, undefined];
export const compilationMessageType: Names = [undefined, 'error', 'warning', 'info'];
export const textureFormat: Names = [
  undefined, 'r8unorm', 'r8snorm', 'r8uint', 'r8sint', 'r16unorm', 'r16snorm', 'r16uint', 'r16sint',
  'r16float', 'rg8unorm', 'rg8snorm', 'rg8uint', 'rg8sint', 'r32float', 'r32uint', 'r32sint', 'rg16unorm',
  'rg16snorm', 'rg16uint', 'rg16sint', 'rg16float', 'rgba8unorm', 'rgba8unorm-srgb', 'rgba8snorm',
  'rgba8uint', 'rgba8sint', 'bgra8unorm', 'bgra8unorm-srgb', 'rgb10a2uint', 'rgb10a2unorm', 'rg11b10ufloat',
  'rgb9e5ufloat', 'rg32float', 'rg32uint', 'rg32sint', 'rgba16unorm', 'rgba16snorm', 'rgba16uint',
  'rgba16sint', 'rgba16float', 'rgba32float', 'rgba32uint', 'rgba32sint', 'stencil8', 'depth16unorm',
  'depth24plus', 'depth24plus-stencil8', 'depth32float', 'depth32float-stencil8', 'bc1-rgba-unorm',
  'bc1-rgba-unorm-srgb', 'bc2-rgba-unorm', 'bc2-rgba-unorm-srgb', 'bc3-rgba-unorm', 'bc3-rgba-unorm-srgb',
  'bc4-r-unorm', 'bc4-r-snorm', 'bc5-rg-unorm', 'bc5-rg-snorm', 'bc6h-rgb-ufloat', 'bc6h-rgb-float',
  'bc7-rgba-unorm', 'bc7-rgba-unorm-srgb', 'etc2-rgb8unorm', 'etc2-rgb8unorm-srgb', 'etc2-rgb8a1unorm',
  'etc2-rgb8a1unorm-srgb', 'etc2-rgba8unorm', 'etc2-rgba8unorm-srgb', 'eac-r11unorm', 'eac-r11snorm',
  'eac-rg11unorm', 'eac-rg11snorm', 'astc-4x4-unorm', 'astc-4x4-unorm-srgb', 'astc-5x4-unorm',
  'astc-5x4-unorm-srgb', 'astc-5x5-unorm', 'astc-5x5-unorm-srgb', 'astc-6x5-unorm', 'astc-6x5-unorm-srgb',
  'astc-6x6-unorm', 'astc-6x6-unorm-srgb', 'astc-8x5-unorm', 'astc-8x5-unorm-srgb', 'astc-8x6-unorm',
  'astc-8x6-unorm-srgb', 'astc-8x8-unorm', 'astc-8x8-unorm-srgb', 'astc-10x5-unorm', 'astc-10x5-unorm-srgb',
  'astc-10x6-unorm', 'astc-10x6-unorm-srgb', 'astc-10x8-unorm', 'astc-10x8-unorm-srgb', 'astc-10x10-unorm',
  'astc-10x10-unorm-srgb', 'astc-12x10-unorm', 'astc-12x10-unorm-srgb', 'astc-12x12-unorm',
  'astc-12x12-unorm-srgb',
];
