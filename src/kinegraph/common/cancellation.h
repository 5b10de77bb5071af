#pragma once

#include <functional>
#include <type_traits>
#include <utility>

#include "kinegraph/common/errors.h"

namespace kinegraph {

/// Thrown by computations that have no partial result when their CancellationToken asks them to end.
class Cancelled : public Error {
 public:
  using Error::Error;
};

/// Tells a long computation to end early. The computation asks the token now and then, on the calling thread unless its
/// documentation says otherwise.
///
///     planMotion(C, goal, {}, start, [&] { return stop_requested.load(); });
///
/// A token is made of a function. If the function returns true, the computation ends with its best result so far. If
/// the function throws, the computation stops and passes the exception on. A function that returns nothing never
/// cancels; it can only throw. A default token never cancels.
class CancellationToken {
 public:
  CancellationToken() = default;

  template <class Function>
  requires(std::is_invocable_v<Function&> && !std::is_same_v<std::remove_cvref_t<Function>, CancellationToken>)
      CancellationToken(Function function) {
    if (isEmpty(function)) return;
    if constexpr (std::is_void_v<std::invoke_result_t<Function&>>) {
      function_ = [function = std::move(function)]() mutable {
        function();
        return false;
      };
    } else {
      function_ = std::move(function);
    }
  }

  /// Whether the computation shall end now. Throws what the function throws.
  bool isCancelled() const { return function_ && function_(); }
  bool operator()() const { return isCancelled(); }

  /// Throws Cancelled if the computation shall end now, and passes on what the function throws.
  void check() const {
    if (isCancelled()) throw Cancelled("cancelled");
  }

  /// Whether the token has a function, and can cancel at all.
  explicit operator bool() const { return bool(function_); }

 private:
  template <class Result>
  static bool isEmpty(const std::function<Result()>& function) {
    return !function;
  }
  template <class Result>
  static bool isEmpty(Result (*const& function)()) {
    return !function;
  }
  template <class Function>
  static bool isEmpty(const Function&) {  // an object that is always callable
    return false;
  }

  std::function<bool()> function_;
};

/// The progress of a long computation.
struct Progress {
  int done = 0;   ///< finished parts of the computation
  int total = 0;  ///< all parts; 0 if the number is not known
};

/// Receives the progress of a long computation now and then, on the calling thread. An exception of the callback ends
/// the computation.
using ProgressCallback = std::function<void(const Progress& progress)>;

}  // namespace kinegraph
