// webgpu.h in a browser: the calls that Weir makes, served over navigator.gpu. C unpacks each descriptor and
// calls JavaScript imports (imports.h, web/src/webgpu_imports.ts) that take scalars only. Callbacks of every
// mode run inside wgpuInstanceProcessEvents(), never between two instructions of the caller. A call that is
// not served here fails when the program is linked.
#pragma once

#include <stdbool.h>
#include <webgpu/webgpu.h>

// A surface on a canvas that the page registered under `canvas_id`. The presentation to the screen is the
// browser's own: wgpuSurfacePresent() has nothing to do.
WGPUSurface weir_webgpu_canvas_surface(WGPUInstance instance, uint32_t canvas_id);
