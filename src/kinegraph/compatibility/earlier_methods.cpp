#include "kinegraph/compatibility/earlier_methods.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline compatibility_internal {

void selectJointsByTag(Config& config, const std::vector<std::string>& attributes, bool not_those) {
  std::vector<std::string> names;
  std::set<std::string> there;
  for (const auto& frame : config.scene()->frames()) {
    if (!frame->moves()) continue;
    bool chosen = false;
    for (const Node& node : frame->attributes->nodes) {
      there.insert(node.key);
      chosen |= std::find(attributes.begin(), attributes.end(), node.key) != attributes.end();
    }
    if (chosen) names.push_back(frame->name);
  }
  for (const std::string& attribute : attributes) {
    if (there.contains(attribute)) continue;
    throw ValueError(cat("selectJointsByTag: no frame with a joint has the attribute '", attribute, "'",
                         similarHint(attribute, {there.begin(), there.end()})));
  }
  config.selectJoints(names, not_those);
}

void makeObjectsFree(Config& config, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    FrameData* top = &config.getFrame(name).data();
    while (!top->joint && top->parent) top = top->parent;
    Frame object(config.scene(), *top);
    if (!top->parent) {
      const Frame first(config.scene(), *config.scene()->frames().front());
      if (top->id == 0)
        throw ValueError(cat("makeObjectsFree: '", top->name,
                             "' is the first frame of the configuration; free objects are attached to it"));
      object.setParent(first, true);
    }
    object.setJoint(JointType::free);
  }
}

VectorXd stepDynamics(Config& config, const VectorXd& velocity, const VectorXd& u, double tau, double noise,
                      bool gravity, Rng& rng) {
  const VectorXd q = config.getJointState();
  if (velocity.size() != q.size() || u.size() != q.size()) {
    throw ValueError(cat("stepDynamics: got ", velocity.size(), " velocities and ", u.size(),
                         " forces; the configuration has ", q.size(), " active dofs"));
  }
  if (!(tau > 0.) || !std::isfinite(tau))
    throw ValueError(cat("stepDynamics: tau is ", tau, " s; expected a finite time > 0"));
  VectorXd disturbance = VectorXd::Zero(q.size());
  for (double& x : disturbance) x = noise > 0. ? noise * rng.normal() : 0.;
  const auto acceleration = [&](const VectorXd& at, const VectorXd& v) {
    config.setJointState(at);
    EquationOfMotion motion = config.equationOfMotion(v);
    if (!gravity) motion.F -= config.equationOfMotion(VectorXd::Zero(q.size())).F;
    return VectorXd(motion.M.ldlt().solve(u - motion.F) + disturbance);
  };
  const VectorXd v1 = velocity, a1 = acceleration(q, v1);
  const VectorXd v2 = velocity + .5 * tau * a1, a2 = acceleration(q + .5 * tau * v1, v2);
  const VectorXd v3 = velocity + .5 * tau * a2, a3 = acceleration(q + .5 * tau * v2, v3);
  const VectorXd v4 = velocity + tau * a3, a4 = acceleration(q + tau * v3, v4);
  config.setJointState(q + tau / 6. * (v1 + 2. * v2 + 2. * v3 + v4));
  return velocity + tau / 6. * (a1 + 2. * a2 + 2. * a3 + a4);
}

}  // namespace kinegraph::inline compatibility_internal
