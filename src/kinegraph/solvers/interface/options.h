#pragma once

#include "kinegraph/common/option_table.h"
#include "kinegraph/solvers/interface/opt_method.h"

namespace kinegraph {

/// Settings of a solver; solverOptionTable() says what each one means. Names and roles are those that scripts know; where
/// a default differs from older packages, it is because the method converges where theirs stopped.
struct SolverOptions {
  int verbose = 1;
  double stopTolerance = 1e-4;
  double stopFTolerance = 1e-4;
  double stopGTolerance = -1.;
  int stopEvals = 1000;
  int stopInners = 1000;
  int stopOuters = 1000;
  double stepMax = 1.;
  double damping = .1;
  double stepInc = 1.5;
  double stepDec = .5;
  double wolfe = 1e-3;
  double muInit = 1.;
  double muInc = 10.;
  double muMax = 1e7;
  double muLBInit = .1;
  double muLBDec = .2;
  double lambdaMax = -1.;
  double interiorPadding = .01;
  bool boundedNewton = true;
  double finiteDifference = -1.;
  OptMethod method = OptMethod::augmentedLag;

  /// The violation that counts as none: stopGTolerance, or stopTolerance, at most 1e-4, where that is negative.
  double constraintTolerance() const;

  /// Throws ValueError naming the first field that makes no sense.
  void validate() const;
};

/// Name, unit, meaning and range of each field, for messages, bindings and documents.
const OptionTable<SolverOptions, OptMethod>& solverOptionTable();

}  // namespace kinegraph
