// Shared code of the programs of benchmarks/cpp_calls.py: lists of joint vectors, and the timing of a call.
#pragma once

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace calls {

using Numbers = std::vector<double>;

/// Reads rows of numbers from a text file, one row per line, each preceded by its length.
inline std::vector<Numbers> readRows(const std::string& path) {
  std::ifstream file(path);
  std::vector<Numbers> rows;
  for (std::size_t count = 0; file >> count;) {
    Numbers row(count);
    for (double& number : row) file >> number;
    rows.push_back(row);
  }
  if (!file.eof() || rows.empty()) throw std::runtime_error("cannot read " + path);
  return rows;
}

/// Returns the processor time of this thread, s, which excludes waiting on a busy machine.
inline double now() {
  timespec time;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Prints JSON: `answer(i)` (the frame's position, then the 6 x n Jacobian by rows) for the first joint vectors, and
/// many samples of the time of `call(i)`, in microseconds.
template <class Call, class Answer>
void report(const std::string& version, std::size_t joint_vectors, const Call& call, const Answer& answer) {
  std::printf("{\"version\": \"%s\", \"answers\": [", version.c_str());
  for (std::size_t i = 0; i < std::min<std::size_t>(joint_vectors, 16); ++i) {
    call(i);
    const Numbers numbers = answer();
    for (std::size_t k = 0; k < numbers.size(); ++k) std::printf("%s%.17g", k ? ", " : i ? "], [" : "[", numbers[k]);
  }
  std::printf("]], \"us\": [");
  for (int sample = 0; sample < 101; ++sample) {
    constexpr int kCalls = 1024;
    const double start = now();
    for (int i = 0; i < kCalls; ++i) call(std::size_t(i) % joint_vectors);
    if (sample > 0) std::printf("%s%.5f", sample > 1 ? ", " : "", 1e6 * (now() - start) / kCalls);
  }
  std::printf("]}\n");
}

}  // namespace calls
