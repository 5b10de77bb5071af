#pragma once

#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline nlp_internal {
class InitialGuesses;
class LazyConstraints;
}

namespace kinegraph {

/// The kind of quantity that a residual or variable measures.
enum class Measure {
  number,      ///< no unit
  length,      ///< m
  angle,       ///< rad
  quaternion,  ///< component of the difference of two unit quaternions
  axis,        ///< component of the difference of two unit vectors
  cosine,      ///< cos(angle) - cos(target)
};

/// Describes a residual in terms of the user: phi = scale * (quantity of kind `measure`).
struct RowDescription {
  std::string objective;  ///< "positionDiff of l_gripper, target"
  int group = -1;         ///< residuals of one group are one requirement of the user, which holds as a whole or not
  std::vector<std::string> frames;
  int slice = -1;  ///< of a path; -1: no path
  Measure measure = Measure::number;
  double scale = 1.;
  double target = 0.;  ///< of a cosine
  int time_order = 0;  ///< 1: per s, 2: per s^2
};

/// Describes a variable in terms of the user.
struct VariableDescription {
  std::string name;   ///< "panda_joint4"
  std::string frame;  ///< frame of the joint; may be empty
  int slice = -1;     ///< of a path; -1: no path
  Measure measure = Measure::number;
};

class Nlp;

/// An equivalent form of a problem, in which separate inequalities c_i <= 0 replace sums phi = sum_i max(0, c_i). It
/// has the same solutions, and a solver sees each term and how close it is to its bound. Variables and all other
/// residuals are the same.
struct Separation {
  std::shared_ptr<Nlp> problem;  ///< null if there are no such sums
  std::vector<int> row_of;       ///< per residual of `problem`: the residual of the original that it belongs to
  std::vector<bool> is_term;     ///< per residual of `problem`: whether it is a c_i

  /// Returns the `rows` residuals of the original.
  VectorXd joined(const VectorXd& phi, Eigen::Index rows) const;

  /// Returns the multipliers of the original; that of a sum is the largest of its terms.
  VectorXd joinedDual(const VectorXd& dual, Eigen::Index rows) const;
};

/// The result of a check that goes beyond the constraints: whether a solution is valid between the points that the
/// constraints sample.
struct ValidityReport {
  bool valid = true;
  std::string message{};  ///< if not valid: the place and size of the violation
};

/// A validity report that is computed when it is requested first. Safe to use from several threads.
class LazyValidity {
 public:
  /// If the check throws, as it may if it is cancelled, the next request starts it again.
  using Check = std::function<ValidityReport(const CancellationToken& cancellation)>;

  explicit LazyValidity(Check check) : check_(std::move(check)) {}
  explicit LazyValidity(ValidityReport known) : known_(std::move(known)) {}

  const ValidityReport& get(const CancellationToken& cancellation = {}) const;

 private:
  mutable std::mutex mutex_;
  mutable Check check_;
  mutable std::optional<ValidityReport> known_;
};

/// The role of a residual phi_i in the problem. The numbers are those of the Python enum `ry.OT`.
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

/// A sparse Jacobian with a fixed pattern. Each row is a list of segments of consecutive columns: one segment for a
/// dense row or a residual of consecutive slices, several if distant columns are involved. Zero rows may share their
/// values, so the offsets of a row may change with its values.
struct Jacobian {
  struct Segment {
    int column;  ///< first column
    int width;   ///< number of columns
    int offset;  ///< index of its first value in `values`
  };
  int columns = 0;
  std::vector<int> row_start = {0};  ///< row i owns segments row_start[i] .. row_start[i+1]-1
  std::vector<Segment> segments;
  std::vector<double> values;
  std::vector<char> zero_row;  ///< per row: whether all values are known to be zero
  int constant = 0;            ///< number of leading values that are finite and never change

  int rows() const { return int(row_start.size()) - 1; }
  static Jacobian dense(int rows, int columns);
  void addRow(std::initializer_list<std::pair<int, int>> column_and_width);  ///< appends a row of zeros
  MatrixXd toDense() const;

  /// Copies the rows of another Jacobian with the same pattern to the first rows. The values of further rows are lost.
  void copyRows(const Jacobian& other);

  std::span<const Segment> row_segments(int row) const {
    return {segments.data() + row_start[row], std::size_t(row_start[row + 1] - row_start[row])};
  }
  double rowTimes(int row, const VectorXd& x) const;         ///< J_row x
  void addRowTo(int row, double factor, VectorXd& x) const;  ///< x += factor J_row^T
};

/// Thrown by an evaluation without a result, for example after Ctrl-C in a function of the user. It ends the solver,
/// which returns the best point before.
struct EvaluationCancelled : std::exception {
  const char* what() const noexcept override { return "the evaluation of a nonlinear program was cancelled"; }
};

/// The outcome of a search for violated lazy constraints.
enum class Refinement {
  none,    ///< all constraints hold
  little,  ///< x is close to a point at which all constraints hold
  much,    ///< x is too far from such a point to continue from it
};

/// A nonlinear program: minimize  sum_f phi_i + sum_sos phi_i^2  subject to  phi_ineq <= 0,  phi_eq = 0,  lower <= x <=
/// upper. Solvers depend on this interface only.
class Nlp {
 public:
  virtual ~Nlp() = default;

  int dimension() const { return int(lower_.size()); }
  const std::vector<ObjectiveType>& types() const { return types_; }  ///< one per entry of phi
  const VectorXd& lower() const { return lower_; }                    ///< -infinity for no bound
  const VectorXd& upper() const { return upper_; }                    ///< +infinity for no bound

  /// Creates a Jacobian with the pattern of the problem. It holds the values of linear rows; other values are zero.
  virtual Jacobian makeJacobian() const { return Jacobian::dense(int(types_.size()), dimension()); }

  /// Whether a row of the Jacobian is constant; `evaluate` may then leave it unchanged.
  bool isLinear(int row) const { return !linear_.empty() && linear_[std::size_t(row)]; }

  /// Computes phi(x) and, unless `J` is null, its Jacobian. x has `dimension()` entries, phi has one per type, and
  /// makeJacobian made `J`. Sets `J->zero_row` if that costs nothing. Avoids allocations.
  virtual void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) = 0;

  /// Whether `evaluate` may throw EvaluationCancelled.
  virtual bool mayBeCancelled() const { return false; }

  /// Moves the object that the problem describes, such as a path, to x, as `evaluate` does, but computes nothing.
  virtual void leaveAt(const VectorXd&) {}

  /// Adds the Hessian of sum_f phi_i to `H` (n x n). False if the problem does not know it; solvers then take zero.
  virtual bool addCostHessian(const VectorXd& x, MatrixXd& H);

  /// Consecutive residuals with known second derivatives, and the consecutive variables that they depend on.
  struct CurvedRows {
    int first, rows;
    int column, width;
  };
  virtual std::span<const CurvedRows> curvedRows() const { return {}; }

  /// Adds sum_i weights_i d^2 phi_(first + i) / dx^2 at the x last evaluated to the lower triangle of H (width x
  /// width), for the k-th of curvedRows.
  virtual void addCurvature(int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H);

  /// Returns a form that is easier to solve, if there is one. It shares the state of this problem.
  virtual Separation separation() { return {}; }

  /// Returns a check of x beyond the sampled constraints, or null if the problem needs none (see ValidityReport).
  virtual std::shared_ptr<const LazyValidity> validity(const VectorXd&) { return nullptr; }

  /// Optional abilities of a problem; null without them.
  virtual InitialGuesses* initialGuesses() { return nullptr; }
  virtual LazyConstraints* lazyConstraints() { return nullptr; }

  /// Activates lazy constraints that x violates. `separation()` then returns a new form, and `dual`, which has the
  /// multipliers of the form before, gets zeros for new residuals.
  virtual Refinement refine(const VectorXd& x, VectorXd& dual) {
    (void)x, (void)dual;
    return Refinement::none;
  }

  /// Returns the start of a solver if the user gives none. Default: uniformPoint.
  virtual VectorXd initialPoint(Rng& rng);

  /// Samples a point uniformly within the bounds. A missing bound counts as -1 or 1, but at least 2 apart from the
  /// other.
  VectorXd uniformPoint(Rng& rng) const;

  /// Returns the name of a residual in reports: "position-l_gripper [slice 0] z".
  virtual std::string rowName(int row) const;

  /// Describes a residual as data, with its unit. Default: every residual is a group of its own.
  virtual RowDescription describeRow(int row) const;
  virtual VariableDescription describeVariable(int variable) const;

  /// Returns details of a residual at the last evaluated point: "box - camera: 3 mm deep". Default: none.
  virtual std::vector<std::string> detailsOf(int row) const;

  virtual std::string report(int verbose) const;

  /// Whether all residuals may be linear (f terms quadratic). A solver then tries one exact step, which costs one
  /// evaluation. False if that is known to fail.
  virtual bool mayBeQuadratic() const { return true; }

 protected:
  std::vector<ObjectiveType> types_;
  std::vector<char> linear_;  ///< empty, or isLinear per residual
  VectorXd lower_, upper_;
};

/// Sums over residuals: phi (f), phi^2 (sos), max(0, phi) (ineq), |phi| (eq).
struct ErrorSums {
  double f = 0., sos = 0., ineq = 0., eq = 0.;
};
ErrorSums sumErrors(const std::vector<ObjectiveType>& types, const VectorXd& phi);  ///< sums over all rows

/// Returns the violation of a constraint; 0 for costs.
double violation(ObjectiveType type, double phi);

/// Returns the largest violation of a constraint.
double largestViolation(const std::vector<ObjectiveType>& types, const VectorXd& phi);

/// Describes the first residual or row of J (which may be null) with a number that is not finite; empty if there is
/// none.
std::string describeNotFinite(const Nlp& nlp, const VectorXd& phi, const Jacobian* J);

/// The largest relative difference of a Jacobian from central differences, and its place. `cancellation` is asked
/// before each column. If it is cancelled or throws, the function throws and leaves the problem at x without an
/// evaluation.
struct JacobianCheck {
  double error = 0.;  ///< |analytic - numeric| / max(1, |numeric|)
  int row = -1, column = -1;
  double analytic = 0., numeric = 0.;
};
JacobianCheck checkJacobian(Nlp& nlp, const VectorXd& x, double step = 1e-5,
                            const CancellationToken& cancellation = {});  ///< compares J with central differences

/// Returns up to `count` entries whose difference exceeds the tolerance or is not a number, the worst first.
std::vector<JacobianCheck> worstJacobianEntries(Nlp& nlp, const VectorXd& x, double tolerance, int count,
                                                double step = 1e-5, const CancellationToken& cancellation = {});

/// Compares addCostHessian with central differences of the gradient of sum_f phi. The row is -1 if the problem has no f
/// residuals or no Hessian.
JacobianCheck checkHessian(Nlp& nlp, const VectorXd& x, double step = 1e-5, const CancellationToken& cancellation = {});

/// Evaluates a problem without constraints as one function: sum_f phi + sum_sos phi^2, its gradient, and the Hessian
/// 2 J_sos^T J_sos + that of the f residuals. Throws ValueError if there are residuals of other types.
struct ScalarEvaluation {
  double value = 0.;
  VectorXd gradient;
  MatrixXd hessian;
};
ScalarEvaluation evaluateScalar(Nlp& nlp, const VectorXd& x);  ///< evaluates cost and derivatives

}  // namespace kinegraph
