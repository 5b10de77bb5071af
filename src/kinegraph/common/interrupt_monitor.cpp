#include "kinegraph/common/interrupt_monitor.h"

#include <csignal>

#include <atomic>
#include <mutex>
#include <utility>

namespace kinegraph::inline common_internal {

namespace {

// Global, because a signal handler belongs to the process and receives nothing but the signal.
std::atomic<unsigned> interrupts = 0;
std::mutex monitors_mutex;
int monitors = 0;
struct sigaction before;  // the handler that ours replaces

void count(int number, siginfo_t* information, void* context) {
  interrupts.fetch_add(1);
  if (before.sa_flags & SA_SIGINFO) {
    before.sa_sigaction(number, information, context);
  } else {
    before.sa_handler(number);
  }
}

bool isOurs(const struct sigaction& action) { return (action.sa_flags & SA_SIGINFO) && action.sa_sigaction == count; }

bool isHandled(const struct sigaction& action) {
  return (action.sa_flags & SA_SIGINFO) || (action.sa_handler != SIG_DFL && action.sa_handler != SIG_IGN);
}

void install() {
  struct sigaction present;
  if (sigaction(SIGINT, nullptr, &present) != 0 || isOurs(present) || !isHandled(present)) return;
  before = present;
  struct sigaction counting = present;
  counting.sa_flags |= SA_SIGINFO;
  counting.sa_sigaction = count;
  sigaction(SIGINT, &counting, nullptr);
}

void uninstall() {
  struct sigaction present;
  if (sigaction(SIGINT, nullptr, &present) == 0 && isOurs(present)) sigaction(SIGINT, &before, nullptr);
}

}  // namespace

InterruptMonitor::InterruptMonitor() {
  const std::lock_guard lock(monitors_mutex);
  if (monitors++ == 0) install();
  seen_ = interrupts;
}

InterruptMonitor::~InterruptMonitor() {
  const std::lock_guard lock(monitors_mutex);
  if (--monitors == 0) uninstall();
}

bool InterruptMonitor::wasInterrupted() {
  const unsigned now = interrupts;
  return std::exchange(seen_, now) != now;
}

}  // namespace kinegraph::inline common_internal
