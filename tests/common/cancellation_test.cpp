#include "kinegraph/common/cancellation.h"

#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

namespace kinegraph {
namespace {

bool alwaysTrue() { return true; }

TEST(CancellationToken, WithoutFunctionNeverCancels) {
  bool (*const null)() = nullptr;
  for (const CancellationToken& token : {CancellationToken(), CancellationToken(std::function<bool()>()),
                                         CancellationToken(std::function<void()>()), CancellationToken(null)}) {
    EXPECT_FALSE(bool(token));
    EXPECT_FALSE(token.isCancelled());
    EXPECT_NO_THROW(token.check());
  }
}

TEST(CancellationToken, AsksFunctionsOfAnyKind) {
  bool stop = true;
  const std::function<bool()> function = [&] { return stop; };
  for (const CancellationToken& token : {CancellationToken(function), CancellationToken([&] { return stop; }),
                                         CancellationToken([] { return true; }), CancellationToken(alwaysTrue)}) {
    EXPECT_TRUE(bool(token));
    EXPECT_TRUE(token.isCancelled());
    EXPECT_THROW(token.check(), Cancelled);
  }
  const CancellationToken token = function;
  stop = false;
  EXPECT_FALSE(token.isCancelled());
}

TEST(CancellationToken, PassesOnExceptions) {
  const CancellationToken token = [] { throw std::runtime_error("ended by a key"); };
  EXPECT_TRUE(bool(token));
  EXPECT_THROW(token.isCancelled(), std::runtime_error);
}

}  // namespace
}  // namespace kinegraph
