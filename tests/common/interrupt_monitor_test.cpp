#include "kinegraph/common/interrupt_monitor.h"

#include <gtest/gtest.h>

#include <csignal>
#include <optional>

using namespace kinegraph;

namespace {

volatile std::sig_atomic_t handled_interrupts = 0;

void handleInterrupt(int) { handled_interrupts = handled_interrupts + 1; }

/// Whoever handles SIGINT meanwhile.
class InterruptHandler {
 public:
  explicit InterruptHandler(void (*handler)(int)) {
    struct sigaction action = {};
    action.sa_handler = handler;
    sigaction(SIGINT, &action, &before_);
  }
  ~InterruptHandler() { sigaction(SIGINT, &before_, nullptr); }

 private:
  struct sigaction before_;
};

auto presentHandler() {
  struct sigaction present;
  sigaction(SIGINT, nullptr, &present);
  return present.sa_handler;
}

}  // namespace

TEST(InterruptMonitor, CountsBesideTheHandler) {
  const InterruptHandler handler(handleInterrupt);
  handled_interrupts = 0;
  {
    InterruptMonitor watch;
    EXPECT_FALSE(watch.wasInterrupted());
    std::raise(SIGINT);
    InterruptMonitor later;
    EXPECT_TRUE(watch.wasInterrupted());
    EXPECT_FALSE(watch.wasInterrupted());
    EXPECT_FALSE(later.wasInterrupted());
    std::raise(SIGINT);
    EXPECT_TRUE(watch.wasInterrupted());
    EXPECT_TRUE(later.wasInterrupted());
  }
  EXPECT_EQ(handled_interrupts, 2);
  EXPECT_EQ(presentHandler(), handleInterrupt);
}

TEST(InterruptMonitor, LeavesALaterHandlerAlone) {
  const InterruptHandler handler(SIG_IGN);
  std::optional<InterruptMonitor> watch;
  {
    const InterruptHandler first(handleInterrupt);
    watch.emplace();
  }
  EXPECT_EQ(presentHandler(), SIG_IGN);
  watch.reset();
  EXPECT_EQ(presentHandler(), SIG_IGN);
}

TEST(InterruptMonitor, IsNotInTheWayWhereNobodyHandlesIt) {
  const InterruptHandler handler(SIG_DFL);
  const InterruptMonitor watch;
  EXPECT_EQ(presentHandler(), SIG_DFL);
}
