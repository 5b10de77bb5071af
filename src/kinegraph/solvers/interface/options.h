#pragma once

#include "kinegraph/common/option_table.h"
#include "kinegraph/solvers/interface/opt_method.h"

namespace kinegraph {

/// Options of a solver; solverOptionTable() documents each field. Names and meanings are those of the package robotic.
/// Some defaults differ, because they let the methods converge.
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

  /// Returns the largest accepted violation: stopGTolerance or, if that is negative, stopTolerance, at most 1e-4.
  double constraintTolerance() const;

  /// Throws ValueError with the first invalid field.
  void validate() const;
};

/// Returns name, unit, meaning and range of each field, for messages, bindings and documents.
const OptionTable<SolverOptions, OptMethod>& solverOptionTable();

}  // namespace kinegraph
