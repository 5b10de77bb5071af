// A control loop at 1 kHz: inverse kinematics that follow a moving target. Prints how late the periods began and how
// long they took. Argument: seconds (default 2). Exit status 1 if the gripper loses the target.
#include <kinegraph/kinegraph.h>

#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace kinegraph;

namespace {

constexpr long nanoseconds = 1000000000, period = 1000000;

long now() {
  timespec time;
  clock_gettime(CLOCK_MONOTONIC, &time);
  return time.tv_sec * nanoseconds + time.tv_nsec;
}

void sleepUntil(long t) {
  const timespec time{t / nanoseconds, t % nanoseconds};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) != 0) {
  }
}

/// Pages that the process had to map or read so far.
long pageFaults() {
  rusage usage;
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt + usage.ru_majflt;
}

/// Counts durations in bins of powers of two of microseconds.
struct Histogram {
  std::array<long, 16> bins{};
  long worst = 0, count = 0;

  void add(long duration) {
    std::size_t bin = 0;
    while (bin + 1 < bins.size() && duration >= 1000l << bin) ++bin;
    ++bins[bin];
    ++count;
    worst = std::max(worst, duration);
  }

  void print(const char* title) const {
    std::printf("%s, worst %.1f us\n", title, 1e-3 * double(worst));
    for (std::size_t i = 0; i < bins.size(); ++i)
      if (bins[i] > 0)
        std::printf("  below %6d us %8ld  %5.1f %%\n", 1 << i, bins[i], 100. * double(bins[i]) / double(count));
  }
};

/// Asks for the scheduling and the memory of a real-time thread; says what the system refuses.
void becomeRealTime() {
  const sched_param parameters{.sched_priority = 80};
  if (sched_setscheduler(0, SCHED_FIFO, &parameters) != 0)
    std::puts("SCHED_FIFO is not allowed here: expect late periods when other programs run");
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) std::puts("memory cannot be locked here: it may be paged out");
}

}  // namespace

int main(int count, char** arguments) try {
  const double seconds = count > 1 ? std::atof(arguments[1]) : 2.;
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Frame target = C.addFrame("target").setPose(C.getFrame("l_gripper").getPose());
  const Vector3d center = target.getPosition();
  DiffIkOptions options;
  options.velocity = VectorXd::Constant(7, 2.);
  DiffIk ik(C, options);
  ik.addTask(FS::poseDiff, {"l_gripper", "target"});

  // Everything that allocates happens here, and once in the loop's own calls.
  const auto control = [&](double t) {
    target.setPosition(center + Vector3d(.1 * std::sin(t), .1 * (1. - std::cos(t)), 0.));
    ik.step(1e-3);
  };
  for (int i = 0; i < 100; ++i) control(1e-3 * i);
  becomeRealTime();

  Histogram late, work;
  const long steps = std::lround(1e3 * seconds), begin = now(), faults = pageFaults();
  for (long i = 0; i < steps; ++i) {
    const long due = begin + i * period;
    sleepUntil(due);
    const long woken = now();
    control(.1 + 1e-3 * double(i));
    late.add(woken - due);
    work.add(now() - woken);
  }
  const long new_faults = pageFaults() - faults;
  const double error = C.eval(FS::positionDiff, {"l_gripper", "target"}).y.norm();
  late.print("late");
  work.print("work of a period");
  std::printf("%ld page faults, %.2f mm from the target\n", new_faults, 1e3 * error);
  return error < 1e-3 ? 0 : 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
