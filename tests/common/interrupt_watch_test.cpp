#include "kinegraph/common/interrupt_watch.h"

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

TEST(InterruptWatch, CountsBesideTheHandler) {
  const InterruptHandler handler(handleInterrupt);
  handled_interrupts = 0;
  {
    InterruptWatch watch;
    EXPECT_FALSE(watch.takeNew());
    std::raise(SIGINT);
    InterruptWatch later;
    EXPECT_TRUE(watch.takeNew());
    EXPECT_FALSE(watch.takeNew());
    EXPECT_FALSE(later.takeNew());
    std::raise(SIGINT);
    EXPECT_TRUE(watch.takeNew());
    EXPECT_TRUE(later.takeNew());
  }
  EXPECT_EQ(handled_interrupts, 2);
  EXPECT_EQ(presentHandler(), handleInterrupt);
}

TEST(InterruptWatch, LeavesALaterHandlerAlone) {
  const InterruptHandler handler(SIG_IGN);
  std::optional<InterruptWatch> watch;
  {
    const InterruptHandler first(handleInterrupt);
    watch.emplace();
  }
  EXPECT_EQ(presentHandler(), SIG_IGN);
  watch.reset();
  EXPECT_EQ(presentHandler(), SIG_IGN);
}

TEST(InterruptWatch, IsNotInTheWayWhereNobodyHandlesIt) {
  const InterruptHandler handler(SIG_DFL);
  const InterruptWatch watch;
  EXPECT_EQ(presentHandler(), SIG_DFL);
}
