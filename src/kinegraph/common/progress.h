#pragma once

#include <functional>

namespace kinegraph {

/// The progress of a long computation.
struct Progress {
  int done = 0;   ///< finished parts of the computation
  int total = 0;  ///< all parts; 0 if the number is not known
};

/// Receives the progress of a long computation now and then, on the calling thread. An exception of the callback ends
/// the computation.
using ProgressCallback = std::function<void(const Progress& progress)>;

}  // namespace kinegraph
