#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/nlp/row_description.h"
#include "kinegraph/nlp/separation.h"
#include "kinegraph/nlp/validity_report.h"

namespace kinegraph {

/// What a residual phi_i means to the problem. The numbers are those of the Python enum `ry.OT`.
enum class ObjectiveType : int {
  f = 0,      ///< cost: phi
  sos = 1,    ///< cost: phi^2
  ineq = 2,   ///< constraint: phi <= 0
  eq = 3,     ///< constraint: phi = 0
  ineqB = 4,  ///< constraint phi <= 0, as explicit log barrier
  ineqP = 5,  ///< constraint phi <= 0, as plain squared penalty
  none = 6,
};

std::string objectiveTypeName(ObjectiveType type);

/// A Jacobian whose pattern is fixed while its values change. Each row is a list of segments of consecutive columns:
/// one segment for a dense row or one of a path, several where far columns are touched as well. Rows that are zero may
/// share their values, and where the values of a row are may change with them.
struct Jacobian {
  struct Segment {
    int column;  ///< first column
    int width;   ///< number of columns
    int offset;  ///< of its first value in `values`
  };
  int columns = 0;
  std::vector<int> row_start = {0};  ///< row i owns segments row_start[i] .. row_start[i+1]-1
  std::vector<Segment> segments;
  std::vector<double> values;
  std::vector<char> zero_row;  ///< per row: is it known that all its values are zero?
  int constant = 0;            ///< values at the beginning that are finite and never change

  int rows() const { return int(row_start.size()) - 1; }
  static Jacobian dense(int rows, int columns);
  void addRow(std::initializer_list<std::pair<int, int>> column_and_width);  ///< appends a row of zeros
  MatrixXd toDense() const;

  /// Makes the first rows those of another one, which has the same pattern there. The values of further rows are lost.
  void copyRows(const Jacobian& other);

  std::span<const Segment> row_segments(int row) const {
    return {segments.data() + row_start[row], std::size_t(row_start[row + 1] - row_start[row])};
  }
  double rowTimes(int row, const VectorXd& x) const;         ///< J_row x
  void addRowTo(int row, double factor, VectorXd& x) const;  ///< x += factor J_row^T
};

/// Thrown by an evaluation that was given up, as by Ctrl-C in a function of the user's: there is no value. It ends a
/// solver, which gives the best it saw before.
struct EvaluationCancelled {};

/// What was found where a problem looked for constraints that are violated.
enum class Refinement {
  none,    ///< nothing: all hold
  little,  ///< x is near to where all hold
  much,    ///< x is no place to go on from
};

/// Minimize  sum_f phi_i + sum_sos phi_i^2  subject to  phi_ineq <= 0,  phi_eq = 0,  lower <= x <= upper.
/// It is all a solver sees.
class Nlp {
 public:
  virtual ~Nlp() = default;

  int dimension() const { return int(lower_.size()); }
  const std::vector<ObjectiveType>& types() const { return types_; }  ///< one per entry of phi
  const VectorXd& lower() const { return lower_; }                    ///< -infinity where there is no bound
  const VectorXd& upper() const { return upper_; }                    ///< +infinity where there is no bound

  /// A Jacobian with this problem's pattern, and the values of rows that are linear; the others are zero.
  virtual Jacobian makeJacobian() const { return Jacobian::dense(int(types_.size()), dimension()); }

  /// Is this row of the Jacobian the same at every x? `evaluate` may then leave it as it is.
  bool isLinear(int row) const { return !linear_.empty() && linear_[std::size_t(row)]; }

  /// Computes phi(x), and its Jacobian where `J` (made by makeJacobian) is given. x has `dimension()` entries,
  /// phi has one per type. Sets `J->zero_row` where that costs nothing. Requests no memory where it can be avoided.
  virtual void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) = 0;

  /// May `evaluate` throw EvaluationCancelled?
  virtual bool mayBeCancelled() const { return false; }

  /// Puts what the problem describes, as a path, at x, as `evaluate` does, but without computing anything.
  virtual void leaveAt(const VectorXd&) {}

  /// Adds the Hessian of sum_f phi_i to `H` (n x n). False if the problem has none to offer; it is then taken as zero.
  virtual bool addCostHessian(const VectorXd& x, MatrixXd& H);

  /// Consecutive rows of which the second derivatives can be told, and the consecutive variables that they depend on.
  struct CurvedRows {
    int first, rows;
    int column, width;
  };
  virtual std::span<const CurvedRows> curvedRows() const { return {}; }

  /// Adds sum_i weights_i d^2 phi_(first + i) / dx^2 at the x last evaluated to the lower triangle of H (width x
  /// width), for the k-th of curvedRows.
  virtual void addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H);

  /// The form that is easier to solve, if there is one. It shares the state of this problem.
  virtual Separation separation() { return {}; }

  /// For a motion that is to be free of collisions: is it so at all times, at this x? Null for other problems.
  virtual std::shared_ptr<const LazyValidity> motionValidity(const VectorXd&) { return nullptr; }

  /// For constraints that are to hold at all times of a motion, of which the separate form has some: looks for others
  /// that x violates, and takes them up. `separation()` is then a new one, and `dual`, if it has the multipliers of the
  /// one before, gets zeros for rows that it did not have.
  virtual Refinement refine(const VectorXd& x, VectorXd& dual) {
    (void)x, (void)dual;
    return Refinement::none;
  }

  /// Where a solver starts if the user gives no point. Default: uniform in the bounds, [-1, 1] where there are none.
  virtual VectorXd initialPoint(Rng& rng);

  /// Uniform in the bounds, in [-1, 1] where there are none. Where one is missing, it is taken as 1 or -1, at least 2
  /// apart from the other.
  VectorXd uniformPoint(Rng& rng) const;

  /// Name of a row of phi in reports: "position-l_gripper [slice 0] z".
  virtual std::string rowName(int row) const;

  /// The same as data, with its unit. Default: every residual is a group of its own.
  virtual RowDescription describeRow(int row) const;
  virtual VariableDescription describeVariable(int variable) const;

  /// What can be said of a residual at the point last evaluated: "box - camera: 3 mm deep". Default: nothing.
  virtual std::vector<std::string> detailsOf(int row) const;

  virtual std::string report(int verbose) const;

  /// May all residuals be linear (f terms quadratic)? A solver then tries whether one exact step ends it, at the price
  /// of one evaluation. False where that is known to be in vain.
  virtual bool mayBeQuadratic() const { return true; }

 protected:
  std::vector<ObjectiveType> types_;
  std::vector<char> linear_;  ///< empty, or per row what isLinear says
  VectorXd lower_, upper_;
};

/// Sums over residuals: phi (f), phi^2 (sos), max(0, phi) (ineq), |phi| (eq).
struct ErrorSums {
  double f = 0., sos = 0., ineq = 0., eq = 0.;
};
ErrorSums sumErrors(const std::vector<ObjectiveType>& types, const VectorXd& phi);

/// How much a constraint is violated; 0 for costs.
double violation(ObjectiveType type, double phi);

/// The largest violation of a constraint.
double largestViolation(const std::vector<ObjectiveType>& types, const VectorXd& phi);

/// Which residual, or row of J (which may be null), has a number that is not finite, in words; empty if none has.
std::string describeNotFinite(const Nlp& nlp, const VectorXd& phi, const Jacobian* J);

/// The largest relative difference of a Jacobian from central differences, and where it is. `cancellation`, where given, is
/// called before each column; it may throw, and the problem is then left at x without being evaluated there.
struct JacobianCheck {
  double error = 0.;  ///< |analytic - numeric| / max(1, |numeric|)
  int row = -1, column = -1;
  double analytic = 0., numeric = 0.;
};
JacobianCheck checkJacobian(Nlp& nlp, const VectorXd& x, double step = 1e-5,
                            const CancellationToken& cancellation = {});

/// All entries whose difference is above the tolerance or not a number, the worst first, at most `count`.
std::vector<JacobianCheck> worstJacobianEntries(Nlp& nlp, const VectorXd& x, double tolerance, int count,
                                                double step = 1e-5, const CancellationToken& cancellation = {});

/// The same for addCostHessian and central differences of the gradient of sum_f phi. Nothing to find (row -1) where
/// there are no f residuals, or no Hessian is offered.
JacobianCheck checkHessian(Nlp& nlp, const VectorXd& x, double step = 1e-5, const CancellationToken& cancellation = {});

/// A problem without constraints as one function:  sum_f phi + sum_sos phi^2, its gradient, and 2 J_sos^T J_sos + the
/// Hessian of the f residuals. Throws ValueError if there are other residuals.
struct ScalarEvaluation {
  double value = 0.;
  VectorXd gradient;
  MatrixXd hessian;
};
ScalarEvaluation evaluateScalar(Nlp& nlp, const VectorXd& x);

}  // namespace kinegraph
