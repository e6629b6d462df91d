/*
 * The page by which the processes of an arena share one clock.
 *
 * One process writes it, all others map it read-only. The scaled clock equals the real CLOCK_MONOTONIC
 * until switch_ns, and runs `scale` times as fast from then on. It is switched once. The writer stores is_set last,
 * while switch_ns still lies in the future. A reader reads the real time first and is_set second, so a
 * reader that misses the switch has read a real time before it. Hence the scaled time depends only on the real
 * time: it is the same in all processes, continuous and monotonic. No locks are needed, and a writer that
 * dies half-way does no harm.
 *
 * clock.py packs the same layout; after a change increase CLOCK_PAGE_VERSION here and VERSION there.
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
    int64_t realtime_offset_ns;    /* CLOCK_REALTIME minus CLOCK_MONOTONIC, constant and the same for all */
    int64_t switch_ns;             /* on the real CLOCK_MONOTONIC */
    double scale;                  /* arena seconds per real second, from the switch on */
};

#endif
