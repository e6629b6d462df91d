/*
 * The page that makes the processes of an arena agree on one clock.
 *
 * One process writes it, every other one maps it read-only. The scaled clock is piecewise linear in the
 * real CLOCK_MONOTONIC: segment i holds from its real_start_ns until the next one begins. Segments are
 * only ever appended, with a start that still lies in the future, and segment_count is stored last. A
 * reader takes the real time first and the count second, so a reader that misses the newest segment has
 * also read a time before it. Hence the scaled time depends on the real time alone: it is the same in all
 * processes, continuous and monotonic, without locks, and a writer that dies half-way harms nobody.
 *
 * clock.py packs the same layout; a change here is a new CLOCK_PAGE_VERSION there as well.
 */
#ifndef CLOCK_PAGE_H
#define CLOCK_PAGE_H

#include <stdatomic.h>
#include <stdint.h>

#define CLOCK_PAGE_MAGIC "SCALEDCK"
#define CLOCK_PAGE_VERSION 1u
#define CLOCK_PAGE_SEGMENTS 16u

struct clock_segment {
    int64_t real_start_ns;    /* CLOCK_MONOTONIC as the kernel counts it */
    int64_t scaled_start_ns;  /* CLOCK_MONOTONIC as the arena sees it at that instant */
    double scale;             /* arena seconds per real second */
};

struct clock_page {
    char magic[8];
    uint32_t version;
    _Atomic uint32_t segment_count;
    _Atomic uint32_t is_final;     /* no further segment will come, so waits need not watch for one */
    uint32_t reserved;
    int64_t realtime_offset_ns;    /* CLOCK_REALTIME minus CLOCK_MONOTONIC, the same for all and for ever */
    struct clock_segment segments[CLOCK_PAGE_SEGMENTS];
};

#endif
