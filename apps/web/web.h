// What weir.wasm adds to the public API for web/src/weir.ts: adapters that take scalars where the
// API takes structs.
#pragma once

#include <stdint.h>

// Called from JavaScript under its own name.
#define WEIR_WEB(name) __attribute__((export_name(#name)))
