#include "kinegraph/tool_paths/plan_tool_path.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectories/path_curve.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

namespace {

constexpr double kBothBodiesMove = 2.;
constexpr int kDivisions = 8;  // of a piece of a timed path

/// A curve of polynomial pieces of any degree: coefficients (n, degree + 1) of (s - begin)^k.
struct Polynomials {
  const std::vector<double>& begin;
  const std::vector<MatrixXd>& coefficient;

  VectorXd eval(int piece, double s) const {
    const MatrixXd& c = coefficient[std::size_t(piece)];
    const double x = s - begin[std::size_t(piece)];
    VectorXd y = c.rightCols(1);
    for (Eigen::Index k = c.cols() - 1; k-- > 0;) y = c.col(k) + x * y;
    return y;
  }

  /// Bound of the second derivative on [from, to].
  VectorXd bend(int piece, double from, double to) const {
    const MatrixXd& c = coefficient[std::size_t(piece)];
    const double start = from - begin[std::size_t(piece)], end = to - begin[std::size_t(piece)];
    if (c.cols() < 3) return VectorXd::Zero(c.rows());
    if (c.cols() <= 4) {  // linear: the larger of both ends
      const VectorXd slope = c.cols() == 4 ? VectorXd(6. * c.col(3)) : VectorXd(VectorXd::Zero(c.rows()));
      return (2. * c.col(2) + start * slope).cwiseAbs().cwiseMax((2. * c.col(2) + end * slope).cwiseAbs());
    }
    VectorXd sum = VectorXd::Zero(c.rows());
    for (Eigen::Index k = 2; k < c.cols(); ++k)
      sum += double(k * (k - 1)) * std::pow(end, double(k - 2)) * c.col(k).cwiseAbs();
    return sum;
  }
};

/// Checks parts of the pieces of one curve.
class PartCheck {
 public:
  PartCheck(EdgeChecker& checker, const Polynomials& curve)
      : checker_(checker), curve_(curve), state_(checker.scene()), margin_(checker.margin()) {}

  /// Whether [from, to] of a piece is free; else the place and the pair are in `contact`.
  bool isFree(int piece, double from, double to, const VectorXd& q_from, const VectorXd& q_to, int divisions) {
    const double h = to - from;
    const VectorXd bend = curve_.bend(piece, from, to);
    const VectorXd deviation = h * h / 8. * bend;
    double displacement = 0.;
    if (deviation.maxCoeff() > 0.) {
      const VectorXd spread = .5 * (q_to - q_from).cwiseAbs() + deviation;  // from the closer end
      for (const VectorXd* q : {&q_from, &q_to}) {
        state_.setJoints(q->data());
        displacement = std::max(displacement, displacementBound(state_, deviation, spread));
      }
    }
    checker_.setMargin(margin_ + kBothBodiesMove * displacement);
    const bool free = checker_.isFree(q_from.data(), q_to.data());
    if (!free && checker_.lastHit()) contact = {from + h * checker_.lastHit()->time, *checker_.lastHit()};
    checker_.setMargin(margin_);
    if (free) return true;
    if (divisions == 0) return false;
    const double middle = .5 * (from + to);
    const VectorXd q = curve_.eval(piece, middle);
    return isFree(piece, from, middle, q_from, q, divisions - 1) && isFree(piece, middle, to, q, q_to, divisions - 1);
  }

  CurveContact contact;

 private:
  EdgeChecker& checker_;
  const Polynomials& curve_;
  State state_;
  double margin_;
};

}  // namespace

std::optional<CurveContact> firstContactAlong(EdgeChecker& checker, const CubicPieces& curve, int max_divisions) {
  const Polynomials pieces{curve.begin, curve.coefficient};
  PartCheck check(checker, pieces);
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double from = curve.begin[std::size_t(piece)], to = curve.end(piece);
    if (!check.isFree(piece, from, to, curve.eval(piece, from), curve.eval(piece, to), max_divisions))
      return check.contact;
  }
  return std::nullopt;
}

namespace {

/// The first contact along the first n dofs of a timed path.
std::optional<MotionTouch> contactOf(EdgeChecker& checker, const TimedPath& motion, int dofs) {
  const PathCurve& curve = motion.curve();
  std::vector<double> begin;
  std::vector<MatrixXd> coefficient;
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    begin.push_back(curve.begin(piece));
    MatrixXd c(dofs, curve.degree() + 1);
    for (int power = 0; power <= curve.degree(); ++power)
      c.col(power) = Eigen::Map<const VectorXd>(curve.coefficient(piece, power), dofs);
    coefficient.push_back(std::move(c));
  }
  const Polynomials pieces{begin, coefficient};
  PartCheck check(checker, pieces);
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double from = curve.begin(piece), to = curve.end(piece);
    if (to <= from || check.isFree(piece, from, to, pieces.eval(piece, from), pieces.eval(piece, to), kDivisions))
      continue;
    const std::vector<std::string>& names = checker.scene().model().frame_name;
    const MotionContact& contact = check.contact.contact;
    return MotionTouch{motion.scaling().timeOf(check.contact.place), names[std::size_t(contact.a)],
                       names[std::size_t(contact.b)], contact.distance};
  }
  return std::nullopt;
}

void requireMotion(bool feasible, const std::string& message, int dofs, int expected, double margin) {
  if (!feasible) throw ValueError(cat("firstContact: there is no motion: ", message));
  if (dofs != expected) throw ValueError(cat("firstContact: the motion has ", dofs, " dofs; the scene has ", expected));
  if (!(margin >= 0.) || !std::isfinite(margin))
    throw ValueError(cat("firstContact: margin is ", margin, "; expected a distance >= 0 in m"));
}

}  // namespace

std::optional<MotionTouch> firstContact(const Config& config, const TimedPath& motion, double margin) {
  requireMotion(motion.feasible(), motion.message, motion.dimension(), config.getJointDimension(), margin);
  EdgeChecker checker(config.state(), margin);
  return contactOf(checker, motion, motion.dimension());
}

std::optional<MotionTouch> firstContact(const Config& config, const ToolPathPlan& plan, double margin) {
  requireMotion(plan.feasible(), plan.message, plan.dimension(), config.getJointDimension(), margin);
  EdgeChecker checker(config.state(), margin);
  for (const ToolPathPlan::Part& part : plan.parts())
    if (std::optional<MotionTouch> touch = contactOf(checker, part.timed, plan.dimension())) {
      touch->t += part.begin;
      return touch;
    }
  return std::nullopt;
}

}  // namespace kinegraph
