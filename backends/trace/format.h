/* SPDX-License-Identifier: MIT
 * format.h: the bytes of a trace file; README.md describes them. */
#ifndef TAHR_TRACE_FORMAT_H
#define TAHR_TRACE_FORMAT_H

#include <tahr/trace.h>

#define TAHR__TRACE_MAGIC "TAHRTRC"
enum {
    TAHR__TRACE_VERSION = 4,
    TAHR__TRACE_BLOCK = 1 << 16,  /* bytes after which a block is written */
    TAHR__TRACE_RECORD = 1 << 15, /* bytes that no record is longer than: 128 hits are 18 kB */
    TAHR__TRACE_BUFFER = TAHR__TRACE_BLOCK + TAHR__TRACE_RECORD,
    TAHR__TRACE_FRAME = 16,   /* bytes before a block: size, number, checksum */
    TAHR__TRACE_ANSWERS = 128 /* of one query; the library asks for 64 at most */
};

enum {
    TAHR__TRACE_WORLD = 1,
    TAHR__TRACE_BODY = 2,
    TAHR__TRACE_CHANGE = 3, /* set, move, touch */
    TAHR__TRACE_POSE = 4,
    TAHR__TRACE_BEGIN = 5, /* of a step */
    TAHR__TRACE_FINISH = 6,
    TAHR__TRACE_LAST = 7,
    TAHR__TRACE_SWEEP = 16, /* queries from here on */
    TAHR__TRACE_CONTACTS = 17,
    TAHR__TRACE_RAY = 18,
    TAHR__TRACE_FLUID = 19,
    TAHR__TRACE_MOTION = 20,
    TAHR__TRACE_PREPARE = 21, /* an announcement that failed or was work */
    TAHR__TRACE_DIRECT = 64   /* added to a query outside of a step */
};

/* Of a BEGIN. */
enum { TAHR__TRACE_HAS_CONFIG = 1, TAHR__TRACE_HAS_STATE = 2, TAHR__TRACE_IS_CUSTOM = 4, TAHR__TRACE_HAS_EVENTS = 8 };

/* The head of a file. Sizes: of every struct that is in it, so that another version is recognised. */
typedef struct tahr__trace_head {
    char magic[8];
    uint32_t version, abi;
    uint32_t sizes[16];
    uint64_t checksum; /* of all before it */
} tahr__trace_head;

void tahr__trace_head_fill(tahr__trace_head *head);
/* FNV-1a, 64 bits, going on from seed; 0 begins. */
uint64_t tahr__trace_hash(uint64_t seed, const void *bytes, size_t size);
/* A description's size, unknown tail and flags, and the order of this machine's bytes: TAHR_OK, TAHR_E_STRUCT_SIZE,
 * TAHR_E_UNSUPPORTED. */
tahr_status tahr__trace_check(const tahr_trace_desc *desc, uint32_t known_flags);
/* Writes "function: name what" to the log (log may be NULL). */
void tahr__trace_complain(const tahr_log *log, const char *function, const char *name, const char *what);

/* What a query or answer is measured against: only words that differ from the last one of its kind are written. */
typedef struct tahr__trace_bases {
    tahr_sweep sweep;
    tahr_contact_query contacts;
    tahr_ray ray;
    tahr_fluid_query fluid;
    tahr_hit hit;
    tahr_contact contact;
    tahr_fluid fluid_answer;
    tahr_body_motion motion;
    tahr_body_pose pose;
    tahr_record_body body;
    tahr_state state;
    tahr_config config;
    double dt;
} tahr__trace_bases;

/* Bytes being written, or read: at never passes end; bad: what was expected where the bytes ended or made no sense. */
typedef struct tahr__trace_bytes {
    unsigned char *at, *end;
    const char *bad;
} tahr__trace_bytes;

/* Numbers in groups of seven bits, the lowest first. */
void tahr__trace_put(tahr__trace_bytes *b, uint64_t number);
uint64_t tahr__trace_get(tahr__trace_bytes *b, const char *what);
/* A struct of whole 8-byte words: a bit for each that differs from base, then those; base becomes it. */
void tahr__trace_put_words(tahr__trace_bytes *b, const void *object, void *base, size_t size);
void tahr__trace_get_words(tahr__trace_bytes *b, void *object, void *base, size_t size, const char *what);
void tahr__trace_put_text(tahr__trace_bytes *b, const char *text, size_t room);
void tahr__trace_get_text(tahr__trace_bytes *b, char *text, size_t room, const char *what);

/* fields.c: the name of the first field in which two queries of a kind differ, and both values; NULL: none. */
const char *tahr__trace_compare(uint32_t kind, const void *asked, const void *recorded, double values[2]);
const char *tahr__trace_kind_name(uint32_t kind);

#endif
