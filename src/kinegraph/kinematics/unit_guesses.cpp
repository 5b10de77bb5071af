#include "kinegraph/kinematics/unit_guesses.h"

#include <cmath>
#include <numbers>

namespace kinegraph::inline kinematics_internal {

namespace {

constexpr double kTwoTurns = 4. * std::numbers::pi;
constexpr double kLeastAngle = 4.;  // no smaller angle is suspicious
constexpr double kRounding = 1e-3;  // rad, beyond a limit

}  // namespace

bool looksLikeDegrees(const KinematicModel& model, const VectorXd& q) {
  if (q.size() != model.dofs || q.size() == 0 || q.cwiseAbs().maxCoeff() < kLeastAngle) return false;
  bool is_suspicious = false, is_far = false, is_round = true;
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      if (model.steps[s].rotates()) {
        const double angle = q[dof], radians = angle * std::numbers::pi / 180.;
        const bool is_beyond = angle < model.lower[dof] || angle > model.upper[dof] || std::abs(angle) > kTwoTurns;
        is_round &= 2. * angle == std::round(2. * angle);
        is_far |= std::abs(angle) > kTwoTurns && (angle < model.lower[dof] || angle > model.upper[dof]);
        is_suspicious |= is_beyond && std::abs(angle) >= kLeastAngle;
        if (radians < model.lower[dof] - kRounding || radians > model.upper[dof] + kRounding) return false;
      }
      dof += model.steps[s].dofs();
    }
  }
  return is_suspicious && (is_round || is_far);  // people write degrees as round numbers
}

}  // namespace kinegraph::inline kinematics_internal
