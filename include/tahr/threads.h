/* SPDX-License-Identifier: MIT
 * threads.h: a small pool of threads for the tasks of a crowd (crowd.h), for who has no scheduler of his own. A library
 * of its own: libtahr_threads. libtahr itself has no threads. */
#ifndef TAHR_THREADS_H
#define TAHR_THREADS_H

#include <tahr/crowd.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct tahr_threads tahr_threads;

/* Starts count - 1 threads; the one that hands out tasks is the last of count. They sleep while there is nothing to do.
 * [in] allocator, copied, or NULL for malloc; count 1..256, or 0: as many as the machine has processors. [out] threads,
 * untouched on error; end them with tahr_threads_destroy. Allocates here only.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_ARGUMENT (count), TAHR_E_MEMORY (also: the system gives no more threads).
 * Since 0.1. */
TAHR_API tahr_status tahr_threads_create(const tahr_allocator *allocator, uint32_t count, tahr_threads **threads);

/* Ends the threads and waits for them; no tasks may be under way. NULL is allowed. Since 0.1. */
TAHR_API void tahr_threads_destroy(tahr_threads *threads);

/* How many threads work, the calling one among them; 0 for NULL. May run on several threads. Since 0.1. */
TAHR_API uint32_t tahr_threads_count(const tahr_threads *threads);

/* A tahr_run_tasks_fn: calls task(argument, i) once for every i < count, on all threads that the system lets run in
 * time and the calling one, and returns when all have returned; each has a share of its own, lowest first, then helps
 * the others. threads: a tahr_threads, as tahr_crowd_desc.run_user hands it over; NULL: all on the calling thread, and
 * so if the threads are at work already, for another thread or for the task that calls this. Allocates nothing; may run
 * on several threads. Since 0.1. */
TAHR_API void tahr_threads_run(void *threads, tahr_task_fn task, void *argument, uint32_t count);

#ifdef __cplusplus
}
#endif
#endif
