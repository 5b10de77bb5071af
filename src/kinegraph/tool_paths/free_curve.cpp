#include "kinegraph/tool_paths/free_curve.h"

#include <algorithm>

#include "kinegraph/collision/displacement_bound.h"

namespace kinegraph {

namespace {

constexpr double kBothBodiesMove = 2.;

/// Checks parts of the pieces of one curve.
class PartCheck {
 public:
  PartCheck(EdgeChecker& checker, const CubicPieces& curve)
      : checker_(checker), curve_(curve), state_(checker.scene()), margin_(checker.margin()) {}

  /// Whether [from, to] of a piece is free; else the place and the pair are in `contact`.
  bool isFree(int piece, double from, double to, const VectorXd& q_from, const VectorXd& q_to, int divisions) {
    const double h = to - from;
    const MatrixXd& c = curve_.coefficient[std::size_t(piece)];
    const double begin = curve_.begin[std::size_t(piece)];
    const VectorXd bend = (2. * c.col(2) + 6. * (from - begin) * c.col(3))
                              .cwiseAbs()
                              .cwiseMax((2. * c.col(2) + 6. * (to - begin) * c.col(3)).cwiseAbs());
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
  const CubicPieces& curve_;
  State state_;
  double margin_;
};

}  // namespace

std::optional<CurveContact> firstContactAlong(EdgeChecker& checker, const CubicPieces& curve, int max_divisions) {
  PartCheck check(checker, curve);
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const double from = curve.begin[std::size_t(piece)], to = curve.end(piece);
    if (!check.isFree(piece, from, to, curve.eval(piece, from), curve.eval(piece, to), max_divisions))
      return check.contact;
  }
  return std::nullopt;
}

}  // namespace kinegraph
