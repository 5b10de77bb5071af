#include "kinegraph/common/log.h"

#include <cstdio>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

namespace kinegraph {

namespace {

struct CurrentSink {
  std::mutex mutex;
  std::shared_ptr<const LogSink> sink;
};

CurrentSink& current() {
  static CurrentSink* const current = new CurrentSink;  // never destroyed: threads log until the end of the process
  return *current;
}

}  // namespace

void setLogSink(LogSink sink) {
  auto next = sink ? std::make_shared<const LogSink>(std::move(sink)) : nullptr;
  const std::lock_guard lock(current().mutex);
  current().sink.swap(next);
}

void printMessage(LogLevel, std::string_view message) {
  const std::string line = std::string(message) + "\n";  // one call, so that lines of several threads do not mix
  std::fwrite(line.data(), 1, line.size(), stdout);
  std::fflush(stdout);
}

void logMessage(LogLevel level, std::string_view message) {
  std::shared_ptr<const LogSink> sink;
  {
    const std::lock_guard lock(current().mutex);
    sink = current().sink;
  }
  if (sink) (*sink)(level, message);
}

}  // namespace kinegraph
