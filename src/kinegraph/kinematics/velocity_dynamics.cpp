#include "kinegraph/kinematics/velocity_dynamics.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/kinematics/spatial_motion.h"

namespace kinegraph::inline kinematics_internal {

namespace {

constexpr int kQuaternion = 4, kAngular = 3;

/// First velocity in v of each dof; for quaternions, of the first of their dofs.
struct VelocityLayout {
  std::vector<int> place;
  std::vector<char> is_quaternion;  ///< per dof: true for the first dof of a quaternion
  int size = 0;

  explicit VelocityLayout(const KinematicModel& model)
      : place(std::size_t(model.dofs), -1), is_quaternion(std::size_t(model.dofs), false) {
    std::vector<char> is_inside(std::size_t(model.dofs), false);
    for (std::size_t l = 1; l < model.links.size(); ++l) {
      int index = model.links[l].first_column;
      for (int s = model.links[l].first_step; s < model.links[l].first_step + model.links[l].steps; ++s) {
        const int first = model.column_dof[index], count = model.steps[s].dofs();
        index += count;
        if (count != kQuaternion) continue;
        is_quaternion[std::size_t(first)] = true;
        for (int k = 1; k < count; ++k) is_inside[std::size_t(first + k)] = true;
      }
    }
    for (std::size_t dof = 0; dof < place.size(); ++dof) {
      if (is_inside[dof]) continue;
      place[dof] = size;
      size += is_quaternion[dof] ? kAngular : 1;
    }
  }
};

/// Returns dq/dt of a quaternion (w, x, y, z) for an angular velocity w in its own axes: 1/2 q (0, w), one column per
/// entry of w.
Eigen::Matrix<double, kQuaternion, kAngular> quaternionRates(const Eigen::Ref<const Eigen::Vector4d>& q) {
  Eigen::Matrix<double, kQuaternion, kAngular> rates;
  rates << -q[1], -q[2], -q[3], q[0], -q[3], q[2], q[3], q[0], -q[1], -q[2], q[1], q[0];
  return .5 * rates;
}

/// Motion of a link per unit of an entry of v, and its rate.
struct Column {
  int velocity;
  Motion motion, rate;
};

/// Columns and velocities of all links; a link has the columns of its parent first.
struct LinkColumns {
  std::vector<Column> columns;
  std::vector<std::vector<int>> of_link;  ///< per link: indices in `columns`
  std::vector<Motion> velocity;           ///< per link
};

LinkColumns findColumns(const State& state, const VelocityLayout& layout, const VectorXd& v) {
  const KinematicModel& model = state.model();
  LinkColumns out;
  out.of_link.resize(model.links.size());
  out.velocity.resize(model.links.size());
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    std::vector<int>& own = out.of_link[l];
    own = out.of_link[std::size_t(link.parent)];
    Motion V = out.velocity[std::size_t(link.parent)];
    int index = link.first_column;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const int first = model.column_dof[index], count = model.steps[s].dofs();
      const std::size_t begin = out.columns.size();
      if (count == kQuaternion) {
        const auto rates = quaternionRates(state.q().segment<kQuaternion>(first));
        for (int k = 0; k < kAngular; ++k) {
          Motion motion;
          for (int i = 0; i < kQuaternion; ++i) motion.add(rates(i, k), column(state, index + i));
          out.columns.push_back({layout.place[std::size_t(first)] + k, motion, {}});
        }
      } else {
        for (int k = 0; k < count; ++k)
          out.columns.push_back({layout.place[std::size_t(model.column_dof[index + k])], column(state, index + k), {}});
      }
      index += count;
      for (std::size_t c = begin; c < out.columns.size(); ++c) V.add(v[out.columns[c].velocity], out.columns[c].motion);
      for (std::size_t c = begin; c < out.columns.size(); ++c) {
        out.columns[c].rate = carried(V, out.columns[c].motion);
        own.push_back(int(c));
      }
    }
    out.velocity[l] = V;
  }
  return out;
}

bool isMassless(const LinkInertia& inertia) { return inertia.mass == 0. && inertia.matrix.isZero(0.); }

}  // namespace

int velocityDimension(const KinematicModel& model) { return VelocityLayout(model).size; }

MatrixXd velocityMap(const State& state) {
  const KinematicModel& model = state.model();
  const VelocityLayout layout(model);
  MatrixXd T = MatrixXd::Zero(model.dofs, layout.size);
  for (int dof = 0; dof < model.dofs; ++dof) {
    const int place = layout.place[std::size_t(dof)];
    if (layout.is_quaternion[std::size_t(dof)])
      T.block<kQuaternion, kAngular>(dof, place) = quaternionRates(state.q().segment<kQuaternion>(dof));
    else if (place >= 0)
      T(dof, place) = 1.;
  }
  return T;
}

RigidBodyDynamics rigidBodyDynamics(const State& state, const std::vector<LinkInertia>& inertias, const VectorXd& v,
                                    const Vector3d& gravity) {
  const VelocityLayout layout(state.model());
  if (v.size() != layout.size)
    throw ValueError(cat("rigidBodyDynamics: v has ", v.size(), " numbers; the scene has ", layout.size,
                         " velocities: one per dof, and three per quaternion"));
  const LinkColumns motions = findColumns(state, layout, v);
  RigidBodyDynamics out{MatrixXd::Zero(layout.size, layout.size), MatrixXd::Zero(layout.size, layout.size),
                        VectorXd::Zero(layout.size)};
  for (std::size_t l = 1; l < inertias.size(); ++l) {
    if (isMassless(inertias[l])) continue;
    const WorldInertia inertia(inertias[l], state.linkPose(int(l)));
    const Motion& V = motions.velocity[l];
    const Wrench momentum = inertia.times(V), weight = inertia.times({Vector3d::Zero(), -gravity});
    for (const int d : motions.of_link[l]) {
      const Column& column = motions.columns[std::size_t(d)];
      const Wrench wrench = inertia.times(column.motion);
      // Rate of the momentum, split such that C + C^T is the rate of M.
      Wrench rate = inertia.times(column.rate);
      rate.add(.5, carried(V, wrench));
      rate.add(-.5, inertia.times(carried(V, column.motion)));
      rate.add(.5, carried(column.motion, momentum));
      for (const int c : motions.of_link[l]) {
        const Column& other = motions.columns[std::size_t(c)];
        out.M(other.velocity, column.velocity) += power(other.motion, wrench);
        out.C(other.velocity, column.velocity) += power(other.motion, rate);
      }
      out.g[column.velocity] += power(column.motion, weight);
    }
  }
  return out;
}

MatrixXd centroidalMomentumMatrix(const State& state, const std::vector<LinkInertia>& inertias) {
  const VelocityLayout layout(state.model());
  const LinkColumns motions = findColumns(state, layout, VectorXd::Zero(layout.size));
  const Vector3d center = centerOfMass(state, inertias).second;
  MatrixXd A = MatrixXd::Zero(6, layout.size);
  for (std::size_t l = 1; l < inertias.size(); ++l) {
    if (isMassless(inertias[l])) continue;
    const WorldInertia inertia(inertias[l], state.linkPose(int(l)));
    for (const int c : motions.of_link[l]) {
      const Column& column = motions.columns[std::size_t(c)];
      const Wrench momentum = inertia.times(column.motion);
      A.col(column.velocity).head<3>() += momentum.linear;
      A.col(column.velocity).tail<3>() += momentum.angular - center.cross(momentum.linear);
    }
  }
  return A;
}

}  // namespace kinegraph::inline kinematics_internal
