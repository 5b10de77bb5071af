#include "kinegraph/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace kinegraph {

void forParts(int count, int part, int threads, const std::function<void(int, int, int)>& work,
              const std::function<void()>& between) {
  const int parts = count / part + (count % part > 0);
  std::atomic<int> next = 0;
  std::mutex mutex;
  std::exception_ptr failure;
  int failed = parts;
  const auto run = [&](int worker) {
    for (int i = next++; i < parts; i = next++) {
      try {
        if (worker == 0 && between) between();
        work(worker, i * part, std::min(count - i * part, part) + i * part);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (i < failed) failure = std::current_exception();
        failed = std::min(failed, i);
        next = parts;
        return;
      }
    }
  };
  {
    std::vector<std::jthread> others;
    for (int worker = 1; worker < std::min(threads, parts); ++worker) others.emplace_back(run, worker);
    run(0);
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace kinegraph
