#include "core/cpu/pool.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#if defined(__wasm__)

// One thread: the page runs the whole solver in a worker of its own.
struct WeirPool {
    uint32_t threads;
};

WeirPool *weir_pool_create(uint32_t threads)
{
    (void)threads;
    WeirPool *pool = malloc(sizeof *pool);
    if (pool) pool->threads = 1;
    return pool;
}

void weir_pool_destroy(WeirPool *pool)
{
    free(pool);
}

uint32_t weir_pool_threads(const WeirPool *pool)
{
    return pool->threads;
}

void weir_pool_run(WeirPool *pool, uint32_t items, uint32_t chunk, WeirPoolBody *body, void *context)
{
    (void)pool;
    (void)chunk;
    if (items > 0) body(context, 0, items);
}

#else

#include <pthread.h>
#include <stdalign.h>
#include <unistd.h>

enum { MAX_THREADS = 256, CACHE_LINE = 64 };

// A thread's own part of a loop: loop after loop the same items, which its core's cache still has. Whoever is done with his
// goes on with the others'.
typedef struct Share {
    alignas(CACHE_LINE) atomic_uint next; // first item that nobody has taken
    uint32_t end;
} Share;

typedef struct Worker {
    WeirPool *pool;
    uint32_t number; // 0 is the caller
} Worker;

struct WeirPool {
    uint32_t threads; // the caller included
    pthread_t thread[MAX_THREADS];
    Worker worker[MAX_THREADS];
    pthread_mutex_t mutex;
    pthread_cond_t work, done;
    atomic_uint round;   // of loops; a worker that sees a new one joins it
    atomic_uint running; // workers that have not left the loop
    atomic_bool stop;
    WeirPoolBody *body;
    void *context;
    uint32_t chunk;
    Share share[MAX_THREADS];
};

static void take_chunks(WeirPool *pool, uint32_t number)
{
    for (uint32_t n = 0; n < pool->threads; ++n) {
        Share *share = &pool->share[(number + n) % pool->threads];
        // Looked at first: asking for an item that is not there would take the line from whoever works on that share.
        while (atomic_load_explicit(&share->next, memory_order_relaxed) < share->end) {
            uint32_t begin = atomic_fetch_add_explicit(&share->next, pool->chunk, memory_order_relaxed);
            if (begin >= share->end) break;
            uint32_t left = share->end - begin;
            pool->body(pool->context, begin, begin + (left < pool->chunk ? left : pool->chunk));
        }
    }
}

// Whole chunks each.
static void share_out(WeirPool *pool, uint32_t items)
{
    uint64_t chunks = ((uint64_t)items + pool->chunk - 1) / pool->chunk;
    for (uint32_t n = 0; n < pool->threads; ++n) {
        uint64_t begin = chunks * n / pool->threads * pool->chunk,
                 end = chunks * (n + 1) / pool->threads * pool->chunk;
        atomic_store_explicit(&pool->share[n].next, (uint32_t)begin, memory_order_relaxed);
        pool->share[n].end = end < items ? (uint32_t)end : items;
    }
}

static inline void pause_core(void)
{
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#endif
}

// Loops follow one another within microseconds: looking for the next one a while costs less than sleeping.
enum { SPINS = 500 };

static bool next_round(WeirPool *pool, uint32_t seen)
{
    return atomic_load_explicit(&pool->round, memory_order_acquire) != seen || atomic_load(&pool->stop);
}

static void wait_for_round(WeirPool *pool, uint32_t seen)
{
    for (int n = 0; n < SPINS; ++n) {
        if (next_round(pool, seen)) return;
        pause_core();
    }
    pthread_mutex_lock(&pool->mutex);
    while (!next_round(pool, seen)) pthread_cond_wait(&pool->work, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
}

static void wait_for_workers(WeirPool *pool)
{
    for (int n = 0; n < SPINS; ++n) {
        if (atomic_load_explicit(&pool->running, memory_order_acquire) == 0) return;
        pause_core();
    }
    pthread_mutex_lock(&pool->mutex);
    while (atomic_load(&pool->running) > 0) pthread_cond_wait(&pool->done, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
}

static void *run_worker(void *argument)
{
    const Worker *self = argument;
    WeirPool *pool = self->pool;
    for (uint32_t seen = 0;; ++seen) {
        wait_for_round(pool, seen);
        if (atomic_load(&pool->stop)) return NULL;
        take_chunks(pool, self->number);
        if (atomic_fetch_sub_explicit(&pool->running, 1, memory_order_acq_rel) == 1) {
            pthread_mutex_lock(&pool->mutex);
            pthread_cond_signal(&pool->done);
            pthread_mutex_unlock(&pool->mutex);
        }
    }
}

WeirPool *weir_pool_create(uint32_t threads)
{
    WeirPool *pool = aligned_alloc(alignof(WeirPool), sizeof *pool);
    if (!pool) return NULL;
    memset(pool, 0, sizeof *pool);
    if (threads == 0) {
        long cores = sysconf(_SC_NPROCESSORS_ONLN);
        threads = cores > 0 ? (uint32_t)cores : 1;
    }
    if (threads > MAX_THREADS) threads = MAX_THREADS;
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->work, NULL);
    pthread_cond_init(&pool->done, NULL);
    pool->threads = 1;
    for (uint32_t n = 1; n < threads; ++n) {
        pool->worker[n] = (Worker){pool, n};
        if (pthread_create(&pool->thread[n], NULL, run_worker, &pool->worker[n]) != 0) break;
        ++pool->threads;
    }
    return pool;
}

void weir_pool_destroy(WeirPool *pool)
{
    if (!pool) return;
    pthread_mutex_lock(&pool->mutex);
    atomic_store(&pool->stop, true);
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->mutex);
    for (uint32_t n = 1; n < pool->threads; ++n) pthread_join(pool->thread[n], NULL);
    pthread_cond_destroy(&pool->work);
    pthread_cond_destroy(&pool->done);
    pthread_mutex_destroy(&pool->mutex);
    free(pool);
}

uint32_t weir_pool_threads(const WeirPool *pool)
{
    return pool->threads;
}

void weir_pool_run(WeirPool *pool, uint32_t items, uint32_t chunk, WeirPoolBody *body, void *context)
{
    if (items == 0) return;
    if (pool->threads == 1 || items <= chunk) {
        body(context, 0, items);
        return;
    }
    pthread_mutex_lock(&pool->mutex);
    pool->body = body;
    pool->context = context;
    pool->chunk = chunk;
    share_out(pool, items);
    atomic_store_explicit(&pool->running, pool->threads - 1, memory_order_relaxed);
    atomic_fetch_add_explicit(&pool->round, 1, memory_order_release);
    pthread_cond_broadcast(&pool->work);
    pthread_mutex_unlock(&pool->mutex);
    take_chunks(pool, 0);
    wait_for_workers(pool);
}

#endif
