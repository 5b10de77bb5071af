#include "kinegraph/nlp/problems.h"

#include <Eigen/QR>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/nlp/convex_core.h"
#include "kinegraph/nlp/evaluation_sizes.h"

namespace kinegraph {

namespace {

using enum ObjectiveType;
using Types = std::vector<ObjectiveType>;
constexpr double kPi = std::numbers::pi;

/// A problem of two functions: one computes phi and J, the other the Hessian of the costs of type f.
class FormulaNlp final : public Nlp {
 public:
  using Function = std::function<void(const VectorXd& x, VectorXd& phi, MatrixXd& J)>;
  using Hessian = std::function<void(const VectorXd& x, MatrixXd& H)>;

  FormulaNlp(std::string name, int n, Types types, double half_width, Function function, Hessian hessian = {})
      : name_(std::move(name)),
        function_(std::move(function)),
        hessian_(std::move(hessian)),
        J_(Eigen::Index(types.size()), n) {
    types_ = std::move(types);
    lower_ = VectorXd::Constant(n, -half_width);
    upper_ = VectorXd::Constant(n, half_width);
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    prepareEvaluation(*this, x, phi, J);
    J_.setZero();
    function_(x, phi, J_);
    if (!J) return;
    for (Eigen::Index row = 0; row < J_.rows(); ++row) {
      for (Eigen::Index i = 0; i < J_.cols(); ++i) J->values[std::size_t(row * J_.cols() + i)] = J_(row, i);
    }
  }

  bool addCostHessian(const VectorXd& x, MatrixXd& H) override {
    if (hessian_) hessian_(x, H);
    return bool(hessian_);
  }

  std::string report(int) const override {
    return cat(name_, ": ", dimension(), " variables, ", types_.size(), " residuals");
  }

 private:
  std::string name_;
  Function function_;
  Hessian hessian_;
  MatrixXd J_;
};

void noHessian(const VectorXd&, MatrixXd&) {}  // of linear costs: zero

MatrixXd randomMatrix(int rows, int columns, Rng& rng) {
  MatrixXd M(rows, columns);
  for (double& value : M.reshaped()) value = rng.normal();
  return M;
}

std::shared_ptr<Nlp> square(int n, Rng& rng) {
  const Eigen::HouseholderQR<MatrixXd> first(randomMatrix(n, n, rng)), second(randomMatrix(n, n, rng));
  VectorXd scale(n), x0(n);
  for (int i = 0; i < n; ++i) scale[i] = std::pow(100., n == 1 ? 0. : double(i) / (n - 1));
  for (double& value : x0) value = rng.uniform(-1., 1.);
  const MatrixXd Q = first.householderQ(), R = second.householderQ(), C = Q * scale.asDiagonal() * R;
  return std::make_shared<FormulaNlp>("square", n, Types(std::size_t(n), sos), 2.,
                                      [C, x0](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                                        phi = C * (x - x0);
                                        J = C;
                                      });
}

std::shared_ptr<Nlp> rugged(int n, Rng& rng) {
  constexpr int kPoints = 1000;
  MatrixXd points(n, kPoints);
  VectorXd heights(kPoints);
  for (double& value : points.reshaped()) value = rng.uniform(-1., 1.);
  for (double& value : heights) value = rng.uniform();
  return std::make_shared<FormulaNlp>("Rugged", n, Types{sos}, 1.,
                                      [points, heights](const VectorXd& x, VectorXd& phi, MatrixXd&) {
                                        Eigen::Index nearest = 0;
                                        (points.colwise() - x).colwise().squaredNorm().minCoeff(&nearest);
                                        phi << heights[nearest];
                                      });
}

std::shared_ptr<Nlp> rastrigin(int n, Rng&) {
  return std::make_shared<FormulaNlp>(
      "Rastrigin", n, Types{f}, 5.12,
      [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        const VectorXd angle = 2. * kPi * x;
        phi << 10. * double(x.size()) + x.squaredNorm() - 10. * angle.array().cos().sum();
        J.row(0) = 2. * x.array() + 20. * kPi * angle.array().sin();
      },
      [](const VectorXd& x, MatrixXd& H) {
        H.diagonal().array() += 2. + 40. * kPi * kPi * (2. * kPi * x).array().cos();
      });
}

std::shared_ptr<Nlp> rosenbrock(int n, Rng&) {
  return std::make_shared<FormulaNlp>(
      "Rosenbrock", n, Types{f}, 2.,
      [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        phi.setZero();
        for (Eigen::Index i = 1; i < x.size(); ++i) {
          const double a = x[i] - x[i - 1] * x[i - 1], b = 1. - x[i - 1];
          phi[0] += a * a + .01 * b * b;
          J(0, i) += 2. * a;
          J(0, i - 1) -= 4. * a * x[i - 1] + .02 * b;
        }
      },
      [](const VectorXd& x, MatrixXd& H) {
        for (Eigen::Index i = 1; i < x.size(); ++i) {
          H(i, i) += 2.;
          H(i, i - 1) -= 4. * x[i - 1];
          H(i - 1, i) -= 4. * x[i - 1];
          H(i - 1, i - 1) += 12. * x[i - 1] * x[i - 1] - 4. * x[i] + .02;
        }
      });
}

std::shared_ptr<Nlp> ackley(int n, Rng&) {
  return std::make_shared<FormulaNlp>("Ackley", n, Types{f}, 2., [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    const double count = double(x.size()), length = x.norm(), root = std::sqrt(count);
    const double a = 20. * std::exp(-.2 * length / root), b = std::exp((2. * kPi * x).array().cos().sum() / count);
    phi << 20. + std::numbers::e - a - b;
    J.row(0) = b * 2. * kPi / count * (2. * kPi * x).array().sin();
    if (length > 0.) J.row(0) += (.2 * a / (root * length) * x).transpose();  // not differentiable at 0
  });
}

std::shared_ptr<Nlp> himmelblau(int, Rng&) {
  return std::make_shared<FormulaNlp>(
      "Himmelblau", 2, Types{f}, 5.,
      [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        const double a = x[0] * x[0] + x[1] - 11., b = x[0] + x[1] * x[1] - 7.;
        phi << a * a + b * b;
        J << 4. * a * x[0] + 2. * b, 2. * a + 4. * b * x[1];
      },
      [](const VectorXd& x, MatrixXd& H) {
        H(0, 0) += 12. * x[0] * x[0] + 4. * x[1] - 42.;
        H(1, 1) += 12. * x[1] * x[1] + 4. * x[0] - 26.;
        H(0, 1) += 4. * (x[0] + x[1]);
        H(1, 0) += 4. * (x[0] + x[1]);
      });
}

std::shared_ptr<Nlp> box(int n, Rng&) {
  return std::make_shared<FormulaNlp>("Box", n, Types(2 * std::size_t(n), ineq), 2.,
                                      [n](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                                        phi << x.array() - 1., -x.array() - 1.;
                                        J.topRows(n).setIdentity();
                                        J.bottomRows(n) = -MatrixXd::Identity(n, n);
                                      });
}

std::shared_ptr<Nlp> modes(int n, Rng&) {
  return std::make_shared<FormulaNlp>("Modes", n, Types{ineq}, 1.2, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    const VectorXd corner = x.unaryExpr([](double value) { return value < 0. ? -1. : 1.; });
    const double to_corner = (x - corner).norm() - .1, to_center = x.norm() - .5;
    const VectorXd offset = to_corner < to_center ? VectorXd(x - corner) : x;
    phi << std::min(to_corner, to_center);
    if (offset.norm() > 0.) J.row(0) = offset.normalized();
  });
}

std::shared_ptr<Nlp> wedge(int n, Rng&) {
  Types types(std::size_t(n) + 1, ineq);
  types[0] = f;
  return std::make_shared<FormulaNlp>(
      "Wedge", n, types, 2.,
      [n](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        phi << x.sum(), 1.5 * x.array() - x.sum() - .2;
        J.row(0).setOnes();
        J.bottomRows(n) = 1.5 * MatrixXd::Identity(n, n) - MatrixXd::Ones(n, n);
      },
      noHessian);
}

std::shared_ptr<Nlp> halfCircle(int n, Rng&) {
  return std::make_shared<FormulaNlp>(
      "HalfCircle", n, Types{f, ineq, ineq}, 2.,
      [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        phi << x.sum(), x.squaredNorm() - .25, -x[0] - .2;
        J.row(0).setOnes();
        J.row(1) = 2. * x;
        J(2, 0) = -1.;
      },
      noHessian);
}

std::shared_ptr<Nlp> linearProgram(int n, Rng& rng) {
  constexpr int kConstraints = 15;
  const MatrixXd G = randomMatrix(kConstraints, n, rng);
  const VectorXd c = randomMatrix(n, 1, rng);
  VectorXd h(kConstraints);
  for (double& value : h) value = rng.uniform(.1, 1.);
  Types types(kConstraints + 1, ineq);
  types[0] = f;
  return std::make_shared<FormulaNlp>(
      "LinearProgram", n, types, 2.,
      [G, c, h](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        phi << c.dot(x), G * x - h;
        J << c.transpose(), G;
      },
      noHessian);
}

/// The variables are the centers of the spheres: x y z x y z ...
class SpherePacking final : public Nlp {
 public:
  static constexpr double kRadius = .21, kHeight = 16.;

  explicit SpherePacking(int count) : count_(count) {
    types_.assign(std::size_t(count) * std::size_t(count - 1) / 2, ineq);
    types_.insert(types_.end(), std::size_t(count), f);
    const Vector3d inner(kRadius, kRadius, kRadius);
    lower_ = (Vector3d(-1., -1., 0.) + inner).replicate(count, 1);
    upper_ = (Vector3d(1., 1., kHeight) - inner).replicate(count, 1);
  }

  Jacobian makeJacobian() const override {
    Jacobian J;
    J.columns = dimension();
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) J.addRow({{3 * i, 3}, {3 * j, 3}});
    }
    for (int i = 0; i < count_; ++i) J.addRow({{3 * i + 2, 1}});
    return J;
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    prepareEvaluation(*this, x, phi, J);
    int row = 0;
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j, ++row) {
        const Vector3d offset = x.segment<3>(3 * i) - x.segment<3>(3 * j);
        const double distance = offset.norm();
        phi[row] = 2. * kRadius - distance;
        if (!J) continue;
        const Vector3d n = distance > 0. ? Vector3d(offset / distance) : Vector3d::UnitX();
        double* values = J->values.data() + J->row_segments(row)[0].offset;
        for (int k = 0; k < 3; ++k) {
          values[k] = -n[k];
          values[k + 3] = n[k];
        }
      }
    }
    for (int i = 0; i < count_; ++i) phi[row + i] = x[3 * i + 2];
    if (J) std::fill(J->values.end() - count_, J->values.end(), 1.);
  }

  bool addCostHessian(const VectorXd&, MatrixXd&) override { return true; }
  std::string report(int) const override { return cat("SpherePacking: ", count_, " spheres"); }

 private:
  int count_;
};

std::shared_ptr<Nlp> spherePacking(int count, Rng&) { return std::make_shared<SpherePacking>(count); }
std::shared_ptr<Nlp> minimalConvexCore(int, Rng&) { return makeMinimalConvexCore(); }

const std::map<std::string, std::shared_ptr<Nlp> (*)(int, Rng&)>& makers() {
  static const std::map<std::string, std::shared_ptr<Nlp> (*)(int, Rng&)> all = {
      {"square", square},
      {"Rugged", rugged},
      {"Rastrigin", rastrigin},
      {"Rosenbrock", rosenbrock},
      {"Ackley", ackley},
      {"Himmelblau", himmelblau},
      {"Box", box},
      {"Modes", modes},
      {"Wedge", wedge},
      {"HalfCircle", halfCircle},
      {"LinearProgram", linearProgram},
      {"SpherePacking", spherePacking},
      {"MinimalConvexCore", minimalConvexCore}};
  return all;
}

}  // namespace

const std::vector<std::string>& testProblemNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const auto& [name, make] : makers()) list.push_back(name);
    return list;
  }();
  return names;
}

std::shared_ptr<Nlp> makeTestProblem(const std::string& name, const TestProblemOptions& options) {
  const auto maker = makers().find(name);
  if (maker == makers().end()) {
    throw NameError(cat("makeTestProblem: no problem named '", name, "'", similarHint(name, testProblemNames()),
                        "; the problems are ", join(testProblemNames())));
  }
  const int n = options.dimension < 0 ? (name == "SpherePacking" ? 50 : 2) : options.dimension;
  if (n < 1 || (name == "Himmelblau" && n != 2) || (name == "Rosenbrock" && n < 2)) {
    throw ValueError(cat("makeTestProblem: the dimension of ", name, " is ", n, "; expected ",
                         name == "Himmelblau"   ? "2"
                         : name == "Rosenbrock" ? "at least 2"
                                                : "at least 1"));
  }
  Rng rng(options.seed);
  return maker->second(n, rng);
}

}  // namespace kinegraph
