/* SPDX-License-Identifier: MIT
 * trace.h: a run in one file: every step of a world, everything that its backend or callbacks were asked and answered;
 * and the way back: the same steps from the file, without backend, callbacks or level. Not part of libtahr: link
 * libtahr_trace. `tahr replay FILE` replays one; backends/trace/README.md describes the format. */
#ifndef TAHR_TRACE_H
#define TAHR_TRACE_H

#include <tahr/record.h>

#ifdef __cplusplus
extern "C" {
#endif

/* A recording:
 *     tahr_trace *trace;
 *     tahr_trace_desc desc = {.struct_size = sizeof desc, .path = "bug.trace"};
 *     tahr_trace_open(&desc, &trace);
 *     tahr_world_record(world, tahr_trace_recorder(trace));   any world, your callbacks' too, at any time
 *     ... step as ever ...
 *     tahr_world_record(world, NULL);                          or close the world
 *     if (tahr_trace_close(trace) < 0) ... */
typedef struct tahr_trace tahr_trace;

/* STEPS_ONLY: what is asked outside of steps (tahr_world_sweep and the like) is left out. FLUSH: each step is handed to
 * the file or to write before the next one begins: for a program that crashes. */
enum { TAHR_TRACE_STEPS_ONLY = 1, TAHR_TRACE_FLUSH = 2 };

/* Takes or gives up to `size` bytes; returns how many, 0 for an error or, reading, the end. */
typedef size_t (*tahr_trace_write_fn)(void *user, const void *bytes, size_t size);
typedef size_t (*tahr_trace_read_fn)(void *user, void *bytes, size_t size);

/* Where it is written to or read from: a file by its path, or, where that is NULL, a function. Zero what is not
 * used. */
typedef struct tahr_trace_desc {
    uint32_t struct_size;
    uint32_t flags; /* TAHR_TRACE_*, writing */
    const char *path;
    tahr_trace_write_fn write;
    tahr_trace_read_fn read;
    void *user;          /* of write and read */
    const tahr_log *log; /* copied; NULL: silent */
} tahr_trace_desc;

/* Opens a file for writing (what was in it is lost). [out] trace, untouched on failure. Returns TAHR_OK, TAHR_E_NULL
 * (also neither path nor write), TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (flags, unknown tail, or a machine with the
 * highest byte first), TAHR_E_MEMORY, TAHR_E_FILE. Allocates by malloc. Since 0.1. */
TAHR_API tahr_status tahr_trace_open(const tahr_trace_desc *desc, tahr_trace **trace);

/* For tahr_world_record; of one world, once. It holds at most one block of 64 kB and what one record needs, and some
 * 700 bytes for each mover that it meets; allocates when it meets one. A write that fails ends it, and no step notices.
 * NULL for NULL. Valid until tahr_trace_close. Since 0.1. */
TAHR_API const tahr_recorder *tahr_trace_recorder(tahr_trace *trace);

/* What was recorded so far: steps, what the backend was asked, bytes (some may still be buffered). Each may be NULL.
 * Since 0.1. */
TAHR_API void tahr_trace_size(const tahr_trace *trace, uint64_t *steps, uint64_t *queries, uint64_t *bytes);

/* Writes what is left and frees the trace, which must not be watching a world any more. Returns TAHR_OK for NULL and
 * where all was written, TAHR_E_FILE where a write failed, TAHR_E_MEMORY. Since 0.1. */
TAHR_API tahr_status tahr_trace_close(tahr_trace *trace);

/* A replay: a world on tahr_backend_v1_trace that holds as many bodies as the file says (spheres will do: what they are
 * comes from the file), with the reader's recorder, which answers in place of that backend; and of each step that
 * tahr_trace_next hands over the same call of tahr_mover_step. bindings/cli/replay.c is a whole one. */
typedef struct tahr_trace_reader tahr_trace_reader;

/* Opens one and reads how the world began. [out] reader, untouched on failure. Returns TAHR_OK, TAHR_E_NULL (also
 * neither path nor read), TAHR_E_STRUCT_SIZE, TAHR_E_UNSUPPORTED (as above), TAHR_E_MEMORY, TAHR_E_NOT_FOUND (no such
 * file), TAHR_E_ABI (recorded by another version), TAHR_E_FILE (no trace, or broken): the log names the byte and what
 * was expected there. Allocates by malloc. Since 0.1. */
TAHR_API tahr_status tahr_trace_read(const tahr_trace_desc *desc, tahr_trace_reader **reader);

/* Of the recorded world: how many bodies the replay's world must have, the name and version of its backend, valid until
 * tahr_trace_reader_close. Since 0.1. */
TAHR_API uint32_t tahr_trace_bodies(const tahr_trace_reader *reader);
TAHR_API const char *tahr_trace_backend_name(const tahr_trace_reader *reader);
TAHR_API const char *tahr_trace_backend_version(const tahr_trace_reader *reader);

/* For tahr_world_record, on a world of tahr_backend_v1_trace: the world becomes the recorded one, and each query is
 * compared bit for bit with the recorded one and answered like it; the first that differs answers TAHR_E_BACKEND, after
 * a message that names step, query and field. NULL for NULL. Valid until tahr_trace_reader_close. Since 0.1. */
TAHR_API const tahr_recorder *tahr_trace_answers(tahr_trace_reader *reader);

enum { TAHR_TRACE_END = 0, TAHR_TRACE_MOVE = 1, TAHR_TRACE_STEP = 2, TAHR_TRACE_DONE = 3 };

/* What happened next. Of a step config is NULL but where the mover is new, and state NULL where it is what the mover's
 * last step left. Of done state is NULL; TAHR_TRUNCATED counts as TAHR_OK: it tells of the report's room. Frozen. */
typedef struct tahr_trace_event {
    uint32_t kind;         /* TAHR_TRACE_* */
    uint32_t queries_left; /* DONE: queries of the recorded step that nobody asked, but for those outside of steps */
    uint64_t number;       /* STEP, DONE: of the step, from 0; END: how many there were */
    tahr_record_move move; /* MOVE */
    tahr_record_step step; /* STEP */
    tahr_record_done done; /* DONE */
} tahr_trace_event;

/* The next event, skipping queries that were not asked. [out] event; what it points to is valid until the next call.
 * Returns TAHR_OK, TAHR_E_NULL, TAHR_E_MEMORY, TAHR_E_FILE (broken or cut off: the log names the byte and what was
 * expected; what came before is good). Since 0.1. */
TAHR_API tahr_status tahr_trace_next(tahr_trace_reader *reader, tahr_trace_event *event);

/* The first difference that a query of the replay had, in words, or NULL. Valid until tahr_trace_reader_close.
 * Since 0.1. */
TAHR_API const char *tahr_trace_difference(const tahr_trace_reader *reader);

/* Frees it; its world must not be watched any more. NULL is allowed. Since 0.1. */
TAHR_API void tahr_trace_reader_close(tahr_trace_reader *reader);

/* The scene of a replay: takes any body, keeps none, and answers every query with TAHR_E_UNSUPPORTED until the recorder
 * of a tahr_trace_reader answers in its place. Static memory. Since 0.1. */
TAHR_API const tahr_backend *tahr_backend_v1_trace(void);

#ifdef __cplusplus
}
#endif
#endif
