#pragma once

#include <optional>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// What a point of such a problem is as a way.
enum class GuessKind {
  still,    ///< it leads nowhere
  blocked,  ///< it leads through something
  free,
};

/// A problem that may be solvable in several ways, of which a local method finds the one that it starts near to.
class InitialGuesses {
 public:
  virtual ~InitialGuesses() = default;

  virtual GuessKind guessKind(const VectorXd& x) = 0;

  /// A start on another way than x, and than those of other numbers; the same one for the same number. None if there is
  /// none to offer.
  virtual std::optional<VectorXd> initialGuess(const VectorXd& x, int number) = 0;
};

}  // namespace kinegraph
