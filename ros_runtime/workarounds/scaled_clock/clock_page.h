/*
 * The page that makes the processes of an arena agree on one clock.
 *
 * One process writes it, every other one maps it read-only. The scaled clock equals the real CLOCK_MONOTONIC
 * until switch_ns, and runs `scale` times as fast from then on. It is switched once: switch_ns still lies in the
 * future when is_set is stored, which is last. A reader takes the real time first and is_set second, so a
 * reader that misses the switch has also read a time before it. Hence the scaled time depends on the real
 * time alone: it is the same in all processes, continuous and monotonic, without locks, and a writer that
 * dies half-way harms nobody.
 *
 * clock.py packs the same layout; a change here is a new CLOCK_PAGE_VERSION there as well.
 */
#ifndef CLOCK_PAGE_H
#define CLOCK_PAGE_H

#include <stdatomic.h>
#include <stdint.h>

#define CLOCK_PAGE_MAGIC "SCALEDCK"
#define CLOCK_PAGE_VERSION 2u

struct clock_page {
    char magic[8];
    uint32_t version;
    _Atomic uint32_t is_set;       /* the switch is known, so waits need not watch for it */
    int64_t realtime_offset_ns;    /* CLOCK_REALTIME minus CLOCK_MONOTONIC, the same for all and for ever */
    int64_t switch_ns;             /* CLOCK_MONOTONIC as the kernel counts it */
    double scale;                  /* arena seconds per real second, from the switch on */
};

#endif
