#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A problem whose residuals are computed by a function of the user, with a dense J. The function may throw
/// EvaluationCancelled.
class CallbackNlp final : public Nlp {
 public:
  using Function = std::function<void(const VectorXd& x, VectorXd& phi, MatrixXd& J)>;
  /// Sets H (n x n, zero before) to the Hessian of the sum of the cost terms f. It need not be positive definite.
  using CostHessian = std::function<void(const VectorXd& x, MatrixXd& H)>;

  /// `lower`, `upper`: bounds, shape (n,), or empty for none. Without `hessian`, solvers learn the curvature of terms f
  /// from gradients; sums of squares need none. Throws ValueError for other sizes.
  CallbackNlp(int dimension, std::vector<ObjectiveType> types, VectorXd lower, VectorXd upper, Function function,
              CostHessian hessian = {});

  bool mayBeCancelled() const override { return true; }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override;
  bool addCostHessian(const VectorXd& x, MatrixXd& H) override;

 private:
  Function function_;
  CostHessian hessian_;
  MatrixXd dense_, hessian_values_;
};

struct TestProblemOptions {
  int dimension = -1;      ///< number of variables, or of spheres; < 0: 2, or 50 spheres, or that of the problem
  std::uint64_t seed = 0;  ///< of the random problems square, Rugged and LinearProgram
};

/// Creates a test problem for solvers by name. n is the number of variables. Costs are of type f unless noted
/// otherwise; the last column has the minimum.
///
///   square         C (x - x0) as sos, with random x0 and C of condition 100     0 at x0
///   Rugged         sos, constant in the Voronoi cells of 1000 random points; for derivative-free methods
///   Rastrigin      10 n + sum x^2 - 10 cos(2 pi x)                              0 at 0
///   Rosenbrock     sum (x_i - x_{i-1}^2)^2 + .01 (1 - x_{i-1})^2                0 at 1
///   Ackley         20 + e - 20 exp(-.2 |x| / sqrt n) - exp(mean cos(2 pi x))    0 at 0
///   Himmelblau     (x^2 + y - 11)^2 + (x + y^2 - 7)^2                           0 at (3, 2) and three more
///   Box            |x_i| <= 1, no cost
///   Modes          within .1 of one of the points (+-1, .., +-1), or within .5 of 0; no cost
///   Wedge          sum x  with  1.5 x_i - sum x <= .2                           -.8 at (-.4, -.4)
///   HalfCircle     sum x  with  |x|^2 <= .25, x_0 >= -.2                        -.658258 at (-.2, -.458258)
///   LinearProgram  random linear costs and 15 constraints, 0 feasible
///   SpherePacking  sum of the heights of spheres of radius .21 in a well of 2 x 2, 16 high, which do not overlap
///   MinimalConvexCore  54 variables, see convex_core.h
///
/// Throws NameError with similar names for other names, ValueError for an invalid dimension.
std::shared_ptr<Nlp> makeTestProblem(const std::string& name, const TestProblemOptions& options = {});

const std::vector<std::string>& testProblemNames();

}  // namespace kinegraph
