// Solves a receding horizon by aligator. Reads problems from a file, solves each from the shifted previous solution,
// and writes processor times, iterations and paths.  horizon PROBLEMS TOLERANCE
#include <aligator/core/traj-opt-problem.hpp>
#include <aligator/core/vector-space.hpp>
#include <aligator/modelling/constraints/box-constraint.hpp>
#include <aligator/modelling/costs/quad-residual-cost.hpp>
#include <aligator/modelling/costs/quad-state-cost.hpp>
#include <aligator/modelling/costs/sum-of-costs.hpp>
#include <aligator/modelling/linear-discrete-dynamics.hpp>
#include <aligator/modelling/multibody/frame-translation.hpp>
#include <aligator/modelling/state-error.hpp>
#include <aligator/solvers/proxddp/solver-proxddp.hpp>
#include <ctime>
#include <fstream>
#include <iostream>
#include <pinocchio/multibody/joint/joint-collection.hpp>
#include <pinocchio/multibody/model.hpp>

using namespace aligator;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using xyz::polymorphic;
using Space = VectorSpaceTpl<double, Eigen::Dynamic>;
using Translation = FrameTranslationResidualTpl<double>;

static double now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return t.tv_sec + 1e-9 * t.tv_nsec;
}

int main(int, char** argv) {
  std::ifstream in(argv[1]);
  const double tolerance = std::stod(argv[2]);
  const auto placement = [&] {  // position, quaternion w x y z
    Eigen::Vector3d p;
    Eigen::Quaterniond q;
    in >> p[0] >> p[1] >> p[2] >> q.w() >> q.x() >> q.y() >> q.z();
    return pinocchio::SE3(q, p);
  };
  pinocchio::Model model;
  int joints;
  in >> joints;
  pinocchio::JointIndex last_joint = 0;
  for (int i = 0; i < joints; ++i) {
    char axis;
    in >> axis;
    const pinocchio::SE3 at = placement();
    pinocchio::JointModel joint = axis == 'X'   ? pinocchio::JointModel(pinocchio::JointModelRX())
                                  : axis == 'Y' ? pinocchio::JointModel(pinocchio::JointModelRY())
                                                : pinocchio::JointModel(pinocchio::JointModelRZ());
    last_joint = model.addJoint(last_joint, joint, at, "joint" + std::to_string(i));
  }
  const auto frame = model.addFrame(pinocchio::Frame("tip", last_joint, 0, placement(), pinocchio::OP_FRAME));
  int count, T;
  double tau, of_motion, of_target;
  in >> count >> T >> tau >> of_motion >> of_target;
  const int n = model.nv;
  VectorXd lower(2 * n), upper(2 * n);
  for (int i = 0; i < 2 * n; ++i) in >> lower[i];
  for (int i = 0; i < 2 * n; ++i) in >> upper[i];
  MatrixXd A = MatrixXd::Identity(2 * n, 2 * n), B(2 * n, n);
  A.topRightCorner(n, n).diagonal().setConstant(tau);
  B << tau * tau * MatrixXd::Identity(n, n), tau * MatrixXd::Identity(n, n);
  const dynamics::LinearDiscreteDynamicsTpl<double> dynamics(A, B, VectorXd::Zero(2 * n));
  const Space space(2 * n);
  const auto target = [&](const Eigen::Vector3d& p) {
    return QuadraticResidualCostTpl<double>(space, Translation(2 * n, n, model, p, frame),
                                            2. * of_target * MatrixXd::Identity(3, 3));
  };
  const StateErrorResidualTpl<double> state(space, n, VectorXd::Zero(2 * n));
  const BoxConstraintTpl<double> box(lower, upper);
  std::vector<VectorXd> xs(T + 1, VectorXd::Zero(2 * n)), us(T, VectorXd::Zero(n)), lams, vs;
  std::cout.precision(12);
  SolverProxDDPTpl<double> solver(tolerance, 1e-2, 100);
  solver.rollout_type_ = RolloutType::LINEAR;
  std::unique_ptr<TrajOptProblemTpl<double>> problem;
  for (int k = 0; k < count; ++k) {
    VectorXd x0(2 * n);
    for (double& number : x0) in >> number;
    std::vector<Eigen::Vector3d> p(T);
    for (auto& point : p) in >> point[0] >> point[1] >> point[2];
    const double start = now();
    if (!problem) {
      std::vector<polymorphic<StageModelTpl<double>>> stages;
      for (int t = 0; t < T; ++t) {
        CostStackTpl<double> cost(space, n);
        cost.addCost("motion", QuadraticControlCostTpl<double>(space, n, 2. * of_motion * MatrixXd::Identity(n, n)));
        cost.addCost("target", target(p[std::max(t - 1, 0)]), t > 0 ? 1. : 0.);
        StageModelTpl<double> stage(cost, dynamics);
        if (t > 0) stage.addConstraint(state, box);
        stages.push_back(stage);
      }
      CostStackTpl<double> last(space, n);
      last.addCost("target", target(p[T - 1]));
      problem = std::make_unique<TrajOptProblemTpl<double>>(x0, stages, last);
      problem->addTerminalConstraint(state, box);
      solver.setup(*problem);
    } else {
      problem->setInitState(x0);
      for (int t = 1; t <= T; ++t) {
        auto* stack = dynamic_cast<CostStackTpl<double>*>(t < T ? &*problem->stages_[t]->cost_ : &*problem->term_cost_);
        auto* cost = stack->getComponent<QuadraticResidualCostTpl<double>>("target");
        cost->getResidual<Translation>()->setReference(p[t - 1]);
      }
      for (int t = 0; t < T; ++t) xs[t] = xs[t + 1];
      for (int t = 0; t + 1 < T; ++t) us[t] = us[t + 1];
      us[T - 1].setZero();
      xs[T] = A * xs[T - 1];
    }
    xs[0] = x0;
    solver.run(*problem, xs, us, vs, lams);
    const double spent = now() - start;
    xs = {solver.results_.xs.begin(), solver.results_.xs.end()};
    us = {solver.results_.us.begin(), solver.results_.us.end()};
    vs = {solver.results_.vs.begin(), solver.results_.vs.end()};
    lams = {solver.results_.lams.begin(), solver.results_.lams.end()};
    std::cout << 1e6 * spent << " " << solver.results_.num_iters;
    for (int t = 1; t <= T; ++t) {
      for (int i = 0; i < n; ++i) std::cout << " " << xs[t][i];
    }
    std::cout << "\n";
  }
}
