// A pool of threads that share a loop. What an item computes must not depend on who computes it or when.
#pragma once

#include <stdint.h>

typedef struct WeirPool WeirPool;

// `threads` counts the caller; 0: one per core. NULL if memory runs out. If fewer threads can be started, or
// the target has none, it makes do.
WeirPool *weir_pool_create(uint32_t threads);
void weir_pool_destroy(WeirPool *pool); // NULL is allowed
uint32_t weir_pool_threads(const WeirPool *pool);

typedef void WeirPoolBody(void *context, uint32_t begin, uint32_t end);
// Calls body for pieces of [0, items) of at most `chunk` items, on all threads; returns when all are done.
void weir_pool_run(WeirPool *pool, uint32_t items, uint32_t chunk, WeirPoolBody *body, void *context);
