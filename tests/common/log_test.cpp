#include "kinegraph/common/log.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace kinegraph;

TEST(Log, MessagesGoToTheSinkAndNowhereWithoutOne) {
  std::vector<std::string> lines;
  logMessage(LogLevel::info, "before");
  setLogSink([&](LogLevel level, std::string_view message) {
    lines.push_back((level == LogLevel::notice ? "notice: " : "info: ") + std::string(message));
  });
  logMessage(LogLevel::info, "one");
  logMessage(LogLevel::notice, "two");
  setLogSink({});
  logMessage(LogLevel::info, "after");
  EXPECT_EQ(lines, (std::vector<std::string>{"info: one", "notice: two"}));
}

TEST(Log, NothingIsPrintedUnlessAskedFor) {
  ::testing::internal::CaptureStdout();
  logMessage(LogLevel::notice, "silent");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  setLogSink(printMessage);
  ::testing::internal::CaptureStdout();
  logMessage(LogLevel::notice, "printed");
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "printed\n");
  setLogSink({});
}

TEST(Log, ASinkMayReplaceItself) {
  int calls = 0;
  setLogSink([&](LogLevel, std::string_view) {
    ++calls;
    setLogSink({});
  });
  logMessage(LogLevel::info, "one");
  logMessage(LogLevel::info, "two");
  EXPECT_EQ(calls, 1);
}
