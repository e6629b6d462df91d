/*
 * A clock that runs faster, for whole processes: preload this library, and every clock a program reads
 * and every timeout it waits for follows the page named by SCALED_CLOCK_PAGE (see clock_page.h). Without
 * that variable each call goes straight to libc.
 *
 * How it works. All times inside this library are nanoseconds of the scaled CLOCK_MONOTONIC. To read a clock, the
 * real CLOCK_MONOTONIC is mapped to the scaled one. To wait, a timeout becomes a deadline on the scaled clock, the
 * deadline is mapped back to the real CLOCK_MONOTONIC, and libc's own function waits for that.
 *
 * Before the switch. The writer may set the switch during a wait. So until it is set, waits
 * are cut into pieces of at most LONGEST_BLIND_WAIT_NS, and the deadline is mapped again after each piece. Waits
 * for a state (a semaphore, a lock, a descriptor, a time) continue with the next piece. A condition variable
 * cannot: a signal between two pieces would be lost, because no thread waits then. So the end of a piece is reported
 * as a spurious wake-up, which POSIX permits and after which the caller checks its predicate again.
 *
 * Not scaled: raw futex system calls with a timeout, socket timeouts set by setsockopt, and timers in
 * the kernel (timerfd, setitimer) that were armed before the switch. CPU-time clocks stay real on purpose.
 */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/epoll.h>
#include <sys/mman.h>
#include <sys/select.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

#include "clock_page.h"

#define NS_PER_S INT64_C(1000000000)
#define NS_PER_MS INT64_C(1000000)
#define NS_PER_US INT64_C(1000)
#define FAR_FUTURE_NS (INT64_MAX / 4) /* 73 years: later deadlines mean "never"; a sum of two does not overflow */
#define LONGEST_BLIND_WAIT_NS (10 * NS_PER_MS)

/* ---- libc's own functions --------------------------------------------------------------- */

/* Without pthread_cond_timedwait, of which libc has two versions: pthread_cond_clockwait replaces it. */
#define LIBC_FUNCTIONS(X)                                                                     \
    X(clock_gettime)                                                                          \
    X(clock_nanosleep)                                                                        \
    X(pthread_cond_clockwait)                                                                 \
    X(pthread_mutex_clocklock)                                                                \
    X(pthread_rwlock_clockrdlock)                                                             \
    X(pthread_rwlock_clockwrlock)                                                             \
    X(sem_clockwait)                                                                          \
    X(ppoll)                                                                                  \
    X(pselect)                                                                                \
    X(epoll_pwait)                                                                            \
    X(sigtimedwait)                                                                           \
    X(timerfd_settime)                                                                        \
    X(timerfd_gettime)                                                                        \
    X(setitimer)                                                                              \
    X(getitimer)

static struct {
#define FIELD(name) __typeof__(name) *name;
    LIBC_FUNCTIONS(FIELD)
#undef FIELD
} libc;

/* ---- start-up --------------------------------------------------------------------------- */

static const struct clock_page *page; /* NULL: time is left alone */
static pthread_once_t started = PTHREAD_ONCE_INIT;
static atomic_bool is_started;

static const struct clock_page *map_page(const char *path)
{
    int fd = open(path, O_RDONLY | O_CLOEXEC);
    struct stat status;
    if (fd < 0 || fstat(fd, &status) != 0 || status.st_size < (off_t)sizeof(struct clock_page)) {
        fprintf(stderr, "scaled_clock: cannot read a clock page at %s; time is not scaled\n", path);
        if (fd >= 0)
            close(fd);
        return NULL;
    }
    const struct clock_page *mapped = mmap(NULL, sizeof(struct clock_page), PROT_READ, MAP_SHARED, fd, 0);
    close(fd);
    if (mapped == MAP_FAILED) {
        perror("scaled_clock: cannot map the clock page; time is not scaled");
        return NULL;
    }
    bool is_page = memcmp(mapped->magic, CLOCK_PAGE_MAGIC, sizeof mapped->magic) == 0;
    if (!is_page || mapped->version != CLOCK_PAGE_VERSION) {
        fprintf(stderr, "scaled_clock: %s is not a clock page of version %u; time is not scaled\n", path,
                CLOCK_PAGE_VERSION);
        return NULL;
    }
    return mapped;
}

static void ensure_started(void);

static void start_up(void)
{
#define RESOLVE(name) *(void **)&libc.name = dlsym(RTLD_NEXT, #name);
    LIBC_FUNCTIONS(RESOLVE)
#undef RESOLVE
    const char *path = getenv("SCALED_CLOCK_PAGE");
    if (path && *path)
        page = map_page(path);
    atomic_store_explicit(&is_started, true, memory_order_release);
}

/*
 * Follow the page at `path` from now on. For a fork of a process that was started without a page; call it while
 * the fork has a single thread. Returns 0, or -1 if there is no such page.
 */
int scaled_clock_follow(const char *path)
{
    ensure_started();
    const struct clock_page *mapped = map_page(path);
    if (mapped == NULL)
        return -1;
    page = mapped;
    return 0;
}

/* Constructors of other libraries may read a clock before this one has run, so every function calls this first. */
__attribute__((constructor)) static void ensure_started(void)
{
    if (!atomic_load_explicit(&is_started, memory_order_acquire))
        pthread_once(&started, start_up);
}

static bool scaling(void)
{
    ensure_started();
    return page != NULL;
}

/* ---- time as a number ------------------------------------------------------------------- */

static bool is_valid(const struct timespec *t)
{
    return t->tv_sec >= 0 && t->tv_nsec >= 0 && t->tv_nsec < NS_PER_S;
}

static int64_t to_ns(const struct timespec *t)
{
    if (t->tv_sec >= FAR_FUTURE_NS / NS_PER_S)
        return FAR_FUTURE_NS;
    return t->tv_sec * NS_PER_S + t->tv_nsec;
}

static struct timespec to_timespec(int64_t ns)
{
    if (ns < 0)
        ns = 0;
    return (struct timespec){.tv_sec = ns / NS_PER_S, .tv_nsec = ns % NS_PER_S};
}

static int64_t timeval_to_ns(const struct timeval *t)
{
    return to_ns(&(struct timespec){.tv_sec = t->tv_sec, .tv_nsec = t->tv_usec * NS_PER_US});
}

static struct timeval to_timeval(int64_t ns)
{
    struct timespec t = to_timespec(ns);
    return (struct timeval){.tv_sec = t.tv_sec, .tv_usec = t.tv_nsec / NS_PER_US};
}

/* ---- the map between the real and the scaled clock -------------------------------------- */

static int64_t real_now(void)
{
    struct timespec t;
    libc.clock_gettime(CLOCK_MONOTONIC, &t);
    return to_ns(&t);
}

static bool is_set(void)
{
    return atomic_load_explicit(&((struct clock_page *)page)->is_set, memory_order_acquire) != 0;
}

static int64_t scaled_from_real(int64_t real_ns)
{
    if (!is_set() || real_ns <= page->switch_ns)
        return real_ns;
    return page->switch_ns + (int64_t)((double)(real_ns - page->switch_ns) * page->scale);
}

/* Rounded up by a nanosecond: a thread that wakes at the result never reads a scaled time before scaled_ns. */
static int64_t real_from_scaled(int64_t scaled_ns)
{
    if (!is_set() || scaled_ns <= page->switch_ns)
        return scaled_ns + 1;
    double after = (double)(scaled_ns - page->switch_ns) / page->scale;
    if (after >= (double)FAR_FUTURE_NS)
        return FAR_FUTURE_NS;
    return page->switch_ns + (int64_t)after + 1;
}

static int64_t scaled_now(void)
{
    return scaled_from_real(real_now());
}

/* The real CLOCK_MONOTONIC in nanoseconds, for the process that writes the page and is itself preloaded. */
int64_t scaled_clock_real_monotonic_ns(void)
{
    ensure_started();
    return real_now();
}

/* ---- clocks ----------------------------------------------------------------------------- */

static bool counts_from_epoch(clockid_t clock)
{
    return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE;
}

static bool counts_from_boot(clockid_t clock)
{
    return clock == CLOCK_MONOTONIC || clock == CLOCK_MONOTONIC_COARSE || clock == CLOCK_MONOTONIC_RAW ||
           clock == CLOCK_BOOTTIME;
}

static bool is_scaled_clock(clockid_t clock)
{
    return counts_from_epoch(clock) || counts_from_boot(clock);
}

/* An absolute time on a clock, as a deadline on the scaled CLOCK_MONOTONIC. */
static int64_t deadline_on(clockid_t clock, const struct timespec *t)
{
    return to_ns(t) - (counts_from_epoch(clock) ? page->realtime_offset_ns : 0);
}

/*
 * The clock of an absolute time of unknown clock, as with a condition variable or a timerfd. The times of the two
 * candidates differ by decades, the age of the Unix epoch, and no real deadline is decades away.
 */
static clockid_t clock_of(const struct timespec *t)
{
    struct timespec epoch, boot;
    clock_gettime(CLOCK_REALTIME, &epoch);
    clock_gettime(CLOCK_MONOTONIC, &boot);
    return t->tv_sec - boot.tv_sec < epoch.tv_sec - t->tv_sec ? CLOCK_MONOTONIC : CLOCK_REALTIME;
}

int clock_gettime(clockid_t clock, struct timespec *t)
{
    if (!scaling() || !is_scaled_clock(clock))
        return libc.clock_gettime(clock, t);
    *t = to_timespec(scaled_now() + (counts_from_epoch(clock) ? page->realtime_offset_ns : 0));
    return 0;
}

int gettimeofday(struct timeval *restrict tv, void *restrict tz)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    *tv = (struct timeval){.tv_sec = now.tv_sec, .tv_usec = now.tv_nsec / NS_PER_US};
    if (tz)
        memset(tz, 0, sizeof(struct timezone)); /* as Linux does */
    return 0;
}

time_t time(time_t *result)
{
    struct timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (result)
        *result = now.tv_sec;
    return now.tv_sec;
}

int timespec_get(struct timespec *t, int base)
{
    if (base != TIME_UTC)
        return 0;
    clock_gettime(CLOCK_REALTIME, t);
    return base;
}

/* ---- one piece of a wait ---------------------------------------------------------------- */

struct piece {
    struct timespec until;     /* real CLOCK_MONOTONIC */
    struct timespec duration;  /* the same, from now */
    bool is_last;              /* it ends at the deadline; other pieces end only to read the page again */
};

static struct piece next_piece(int64_t deadline_ns)
{
    bool set = is_set();
    int64_t now = real_now();
    int64_t until = real_from_scaled(deadline_ns);
    bool is_last = set || until <= now + LONGEST_BLIND_WAIT_NS;
    if (!is_last)
        until = now + LONGEST_BLIND_WAIT_NS;
    return (struct piece){to_timespec(until), to_timespec(until - now), is_last};
}

/* ---- sleeping --------------------------------------------------------------------------- */

int clock_nanosleep(clockid_t clock, int flags, const struct timespec *request, struct timespec *remaining)
{
    if (!scaling() || !is_scaled_clock(clock) || !is_valid(request))
        return libc.clock_nanosleep(clock, flags, request, remaining);
    bool absolute = flags & TIMER_ABSTIME;
    int64_t deadline = absolute ? deadline_on(clock, request) : scaled_now() + to_ns(request);
    struct piece piece;
    int error;
    do {
        piece = next_piece(deadline);
        error = libc.clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &piece.until, NULL);
    } while (error == 0 && !piece.is_last);
    if (error == EINTR && remaining && !absolute)
        *remaining = to_timespec(deadline - scaled_now());
    return error;
}

int nanosleep(const struct timespec *request, struct timespec *remaining)
{
    int error = clock_nanosleep(CLOCK_REALTIME, 0, request, remaining);
    if (error == 0)
        return 0;
    errno = error;
    return -1;
}

int usleep(useconds_t us)
{
    struct timespec t = to_timespec(us * NS_PER_US);
    return nanosleep(&t, NULL);
}

unsigned int sleep(unsigned int seconds)
{
    struct timespec t = {.tv_sec = seconds}, remaining = {0};
    if (nanosleep(&t, &remaining) == 0)
        return 0;
    return (unsigned int)remaining.tv_sec + (remaining.tv_nsec > 0);
}

/* ---- condition variables ---------------------------------------------------------------- */

int pthread_cond_clockwait(pthread_cond_t *cond, pthread_mutex_t *mutex, clockid_t clock,
                           const struct timespec *t)
{
    if (!scaling() || !is_scaled_clock(clock) || !is_valid(t))
        return libc.pthread_cond_clockwait(cond, mutex, clock, t);
    struct piece piece = next_piece(deadline_on(clock, t));
    int error = libc.pthread_cond_clockwait(cond, mutex, CLOCK_MONOTONIC, &piece.until);
    return error == ETIMEDOUT && !piece.is_last ? 0 : error;
}

int pthread_cond_timedwait(pthread_cond_t *cond, pthread_mutex_t *mutex, const struct timespec *t)
{
    return pthread_cond_clockwait(cond, mutex, clock_of(t), t);
}

/* ---- semaphores and locks --------------------------------------------------------------- */

int sem_clockwait(sem_t *semaphore, clockid_t clock, const struct timespec *t)
{
    if (!scaling() || !is_scaled_clock(clock) || !is_valid(t))
        return libc.sem_clockwait(semaphore, clock, t);
    int64_t deadline = deadline_on(clock, t);
    struct piece piece;
    int result;
    do {
        piece = next_piece(deadline);
        result = libc.sem_clockwait(semaphore, CLOCK_MONOTONIC, &piece.until);
    } while (result == -1 && errno == ETIMEDOUT && !piece.is_last);
    return result;
}

int sem_timedwait(sem_t *restrict semaphore, const struct timespec *restrict t)
{
    return sem_clockwait(semaphore, CLOCK_REALTIME, t);
}

/* Mutexes and both sides of a read-write lock differ only in libc's function. */
#define LOCK_UNTIL(lock_function, lock, clock, t)                                             \
    do {                                                                                      \
        if (!scaling() || !is_scaled_clock(clock) || !is_valid(t))                            \
            return libc.lock_function(lock, clock, t);                                        \
        int64_t deadline = deadline_on(clock, t);                                             \
        struct piece piece;                                                                   \
        int error;                                                                            \
        do {                                                                                  \
            piece = next_piece(deadline);                                                     \
            error = libc.lock_function(lock, CLOCK_MONOTONIC, &piece.until);                  \
        } while (error == ETIMEDOUT && !piece.is_last);                                       \
        return error;                                                                         \
    } while (0)

int pthread_mutex_clocklock(pthread_mutex_t *mutex, clockid_t clock, const struct timespec *t)
{
    LOCK_UNTIL(pthread_mutex_clocklock, mutex, clock, t);
}

int pthread_mutex_timedlock(pthread_mutex_t *restrict mutex, const struct timespec *restrict t)
{
    return pthread_mutex_clocklock(mutex, CLOCK_REALTIME, t);
}

int pthread_rwlock_clockrdlock(pthread_rwlock_t *lock, clockid_t clock, const struct timespec *t)
{
    LOCK_UNTIL(pthread_rwlock_clockrdlock, lock, clock, t);
}

int pthread_rwlock_timedrdlock(pthread_rwlock_t *restrict lock, const struct timespec *restrict t)
{
    return pthread_rwlock_clockrdlock(lock, CLOCK_REALTIME, t);
}

int pthread_rwlock_clockwrlock(pthread_rwlock_t *lock, clockid_t clock, const struct timespec *t)
{
    LOCK_UNTIL(pthread_rwlock_clockwrlock, lock, clock, t);
}

int pthread_rwlock_timedwrlock(pthread_rwlock_t *restrict lock, const struct timespec *restrict t)
{
    return pthread_rwlock_clockwrlock(lock, CLOCK_REALTIME, t);
}

/* ---- descriptors ------------------------------------------------------------------------ */

static int poll_until(struct pollfd *fds, nfds_t count, int64_t deadline, const sigset_t *mask)
{
    struct piece piece;
    int ready;
    do {
        piece = next_piece(deadline);
        ready = libc.ppoll(fds, count, &piece.duration, mask);
    } while (ready == 0 && !piece.is_last);
    return ready;
}

int ppoll(struct pollfd *fds, nfds_t count, const struct timespec *timeout, const sigset_t *mask)
{
    if (!scaling() || !timeout || !is_valid(timeout))
        return libc.ppoll(fds, count, timeout, mask);
    return poll_until(fds, count, scaled_now() + to_ns(timeout), mask);
}

int poll(struct pollfd *fds, nfds_t count, int timeout_ms)
{
    struct timespec timeout = to_timespec(timeout_ms * NS_PER_MS);
    return ppoll(fds, count, timeout_ms < 0 ? NULL : &timeout, NULL);
}

/* Fortified programs call these instead of ppoll and poll; `size` is the array's size in bytes. */
int __ppoll_chk(struct pollfd *fds, nfds_t count, const struct timespec *timeout, const sigset_t *mask,
                size_t size)
{
    if (size / sizeof *fds < count)
        abort();
    return ppoll(fds, count, timeout, mask);
}

int __poll_chk(struct pollfd *fds, nfds_t count, int timeout_ms, size_t size)
{
    if (size / sizeof *fds < count)
        abort();
    return poll(fds, count, timeout_ms);
}

/* A pselect that times out empties the sets, so each piece starts with the caller's sets again. */
static int select_until(int count, fd_set *sets[3], int64_t deadline, const sigset_t *mask)
{
    fd_set requested[3];
    for (int i = 0; i < 3; i++)
        if (sets[i])
            requested[i] = *sets[i];
    for (;;) {
        struct piece piece = next_piece(deadline);
        int ready = libc.pselect(count, sets[0], sets[1], sets[2], &piece.duration, mask);
        if (ready != 0 || piece.is_last)
            return ready;
        for (int i = 0; i < 3; i++)
            if (sets[i])
                *sets[i] = requested[i];
    }
}

int pselect(int count, fd_set *restrict reads, fd_set *restrict writes, fd_set *restrict exceptions,
            const struct timespec *restrict timeout, const sigset_t *restrict mask)
{
    if (!scaling() || !timeout || !is_valid(timeout) || count > FD_SETSIZE)
        return libc.pselect(count, reads, writes, exceptions, timeout, mask);
    fd_set *sets[3] = {reads, writes, exceptions};
    return select_until(count, sets, scaled_now() + to_ns(timeout), mask);
}

int select(int count, fd_set *restrict reads, fd_set *restrict writes, fd_set *restrict exceptions,
           struct timeval *restrict timeout)
{
    if (!timeout)
        return pselect(count, reads, writes, exceptions, NULL, NULL);
    if (timeout->tv_sec < 0 || timeout->tv_usec < 0) {
        errno = EINVAL;
        return -1;
    }
    struct timespec now, t = to_timespec(timeval_to_ns(timeout));
    clock_gettime(CLOCK_MONOTONIC, &now);
    int64_t deadline = to_ns(&now) + to_ns(&t);
    int ready = pselect(count, reads, writes, exceptions, &t, NULL);
    int error = errno;
    clock_gettime(CLOCK_MONOTONIC, &now);
    *timeout = to_timeval(deadline - to_ns(&now)); /* Linux returns the remaining time, and programs rely on it */
    errno = error;
    return ready;
}

/* epoll has a timeout in real milliseconds, too coarse at a high scale; ppoll on its descriptor has nanoseconds. */
int epoll_pwait(int epoll, struct epoll_event *events, int capacity, int timeout_ms, const sigset_t *mask)
{
    if (!scaling() || timeout_ms <= 0)
        return libc.epoll_pwait(epoll, events, capacity, timeout_ms, mask);
    int64_t deadline = scaled_now() + timeout_ms * NS_PER_MS;
    for (;;) {
        struct pollfd fd = {.fd = epoll, .events = POLLIN};
        int ready = poll_until(&fd, 1, deadline, mask);
        if (ready < 0)
            return ready;
        int count = libc.epoll_pwait(epoll, events, capacity, 0, mask);
        if (count != 0 || ready == 0)
            return count;
    }
}

int epoll_wait(int epoll, struct epoll_event *events, int capacity, int timeout_ms)
{
    return epoll_pwait(epoll, events, capacity, timeout_ms, NULL);
}

/* ---- signals ---------------------------------------------------------------------------- */

int sigtimedwait(const sigset_t *restrict set, siginfo_t *restrict info,
                 const struct timespec *restrict timeout)
{
    if (!scaling() || !timeout || !is_valid(timeout))
        return libc.sigtimedwait(set, info, timeout);
    int64_t deadline = scaled_now() + to_ns(timeout);
    struct piece piece;
    int result;
    do {
        piece = next_piece(deadline);
        result = libc.sigtimedwait(set, info, &piece.duration);
    } while (result == -1 && errno == EAGAIN && !piece.is_last);
    return result;
}

/* ---- timers in the kernel --------------------------------------------------------------- */

/* Convert a remaining time from the scaled clock to the real one, and back; 0 stays 0, because it means "not armed". */
static int64_t real_left(int64_t scaled_ns)
{
    if (scaled_ns == 0)
        return 0;
    int64_t now = real_now();
    int64_t left = real_from_scaled(scaled_from_real(now) + scaled_ns) - now;
    return left > 0 ? left : 1;
}

static int64_t scaled_left(int64_t real_ns)
{
    int64_t now = real_now();
    return scaled_from_real(now + real_ns) - scaled_from_real(now);
}

int timerfd_settime(int fd, int flags, const struct itimerspec *value, struct itimerspec *old)
{
    if (!scaling() || !is_valid(&value->it_value) || !is_valid(&value->it_interval))
        return libc.timerfd_settime(fd, flags, value, old);
    int64_t first = to_ns(&value->it_value);
    if (first != 0 && (flags & TFD_TIMER_ABSTIME)) {
        first = deadline_on(clock_of(&value->it_value), &value->it_value) - scaled_now();
        if (first <= 0)
            first = 1;
    }
    /* Always relative, so that the clock of the kernel's timer does not matter. */
    struct itimerspec real = {.it_interval = to_timespec(real_left(to_ns(&value->it_interval))),
                              .it_value = to_timespec(real_left(first))};
    int result = libc.timerfd_settime(fd, 0, &real, old);
    if (result == 0 && old) {
        old->it_value = to_timespec(scaled_left(to_ns(&old->it_value)));
        old->it_interval = to_timespec(scaled_left(to_ns(&old->it_interval)));
    }
    return result;
}

int timerfd_gettime(int fd, struct itimerspec *current)
{
    ensure_started();
    int result = libc.timerfd_gettime(fd, current);
    if (result == 0 && scaling()) {
        current->it_value = to_timespec(scaled_left(to_ns(&current->it_value)));
        current->it_interval = to_timespec(scaled_left(to_ns(&current->it_interval)));
    }
    return result;
}

static struct itimerval scaled_itimer(const struct itimerval *real)
{
    return (struct itimerval){to_timeval(scaled_left(timeval_to_ns(&real->it_interval))),
                              to_timeval(scaled_left(timeval_to_ns(&real->it_value)))};
}

/* These timers count in microseconds; a shorter time must not become 0, which would disarm the timer. */
static struct timeval real_timeval(const struct timeval *scaled)
{
    int64_t left = real_left(timeval_to_ns(scaled));
    return to_timeval(left > 0 && left < NS_PER_US ? NS_PER_US : left);
}

int setitimer(__itimer_which_t which, const struct itimerval *restrict value, struct itimerval *restrict old)
{
    if (!scaling() || which != ITIMER_REAL || !value)
        return libc.setitimer(which, value, old);
    struct itimerval real = {real_timeval(&value->it_interval), real_timeval(&value->it_value)};
    int result = libc.setitimer(which, &real, old);
    if (result == 0 && old)
        *old = scaled_itimer(old);
    return result;
}

int getitimer(__itimer_which_t which, struct itimerval *value)
{
    ensure_started();
    int result = libc.getitimer(which, value);
    if (result == 0 && scaling() && which == ITIMER_REAL)
        *value = scaled_itimer(value);
    return result;
}

unsigned int alarm(unsigned int seconds)
{
    struct itimerval value = {.it_value.tv_sec = seconds}, old = {0};
    setitimer(ITIMER_REAL, &value, &old);
    return (unsigned int)old.it_value.tv_sec + (old.it_value.tv_usec > 0);
}
