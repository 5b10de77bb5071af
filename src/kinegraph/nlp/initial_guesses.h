#pragma once

#include <optional>

#include "kinegraph/math/pose.h"

namespace kinegraph::inline nlp_internal {

/// Describes a point as an initial guess.
enum class GuessKind {
  stationary,  ///< the point describes no change at all, such as a motion that stays at its start
  invalid,     ///< the point violates lazy constraints, such as a motion through an obstacle
  valid,
};

/// Offers initial guesses for a problem with several local solutions, of which a local method finds the nearest one.
class InitialGuesses {
 public:
  virtual ~InitialGuesses() = default;

  virtual GuessKind guessKind(const VectorXd& x) = 0;

  /// Returns a start in another basin than x and than the guesses of other numbers, or none. The same number gives the
  /// same guess.
  virtual std::optional<VectorXd> initialGuess(const VectorXd& x, int number) = 0;
};

}  // namespace kinegraph::inline nlp_internal
