// Functions of newer C libraries, for binaries that run with glibc 2.28 (cmake/OldGlibc.cmake). They are hidden: other
// libraries of a process keep their own.
#include <pthread.h>
#include <sys/random.h>
#include <time.h>

#include <cstdint>
#include <cstdlib>

#define KINEGRAPH_HIDDEN extern "C" __attribute__((visibility("hidden"), used))

/// The C++ library skips atomic operations if this is true. False is always right.
extern "C" __attribute__((visibility("hidden"))) char __libc_single_threaded;
char __libc_single_threaded = 0;

/// glibc 2.36. The C++ library draws std::random_device from it.
KINEGRAPH_HIDDEN std::uint32_t arc4random() noexcept {
  std::uint32_t drawn = 0;
  while (getrandom(&drawn, sizeof drawn, 0) != ssize_t(sizeof drawn)) {
  }
  return drawn;
}

/// glibc 2.30. Waits by the real-time clock until the same moment. If that clock is set meanwhile, the wait ends early
/// or late; callers such as std::condition_variable::wait_until compare with their own clock and wait again.
KINEGRAPH_HIDDEN int pthread_cond_clockwait(pthread_cond_t* __restrict condition, pthread_mutex_t* __restrict mutex,
                                            clockid_t clock, const timespec* __restrict deadline) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  if (clock == CLOCK_REALTIME) return pthread_cond_timedwait(condition, mutex, deadline);
  timespec now{}, real{};
  clock_gettime(clock, &now);
  clock_gettime(CLOCK_REALTIME, &real);
  const std::int64_t wait = (deadline->tv_sec - now.tv_sec) * kSecond + (deadline->tv_nsec - now.tv_nsec);
  const std::int64_t end = real.tv_sec * kSecond + real.tv_nsec + (wait > 0 ? wait : 0);
  const timespec until{time_t(end / kSecond), long(end % kSecond)};
  return pthread_cond_timedwait(condition, mutex, &until);
}
