#pragma once

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A file as MuJoCo itself understands it, beside the scene that was read from it.
class MujocoModel {
 public:
  explicit MujocoModel(const std::string& path) {
    char message[1000] = "";
    model_.reset(mj_loadXML(path.c_str(), nullptr, message, sizeof(message)));
    if (!model_) throw std::runtime_error(message);
    data_.reset(mj_makeData(model_.get()));
  }

  const mjModel& model() const { return *model_; }
  std::string name(mjtObj kind, int i) const {
    const char* name = mj_id2name(model_.get(), kind, i);
    return name ? name : "";
  }

  /// Draws qpos; joints that <equality> couples have the values that it asks for.
  void draw(Rng& rng) {
    const mjModel& m = *model_;
    for (int j = 0; j < m.njnt; ++j) {
      mjtNum* q = data_->qpos + m.jnt_qposadr[j];
      const int count = m.jnt_type[j] == mjJNT_FREE ? 7 : m.jnt_type[j] == mjJNT_BALL ? 4 : 1;
      for (int i = 0; i < count; ++i) q[i] = rng.uniform(-1.5, 1.5);
      if (count > 1) mju_normalize4(q + count - 4);
    }
    for (int round = 0; round < m.neq; ++round) {  // chains
      for (int e = 0; e < m.neq; ++e) {
        if (m.eq_type[e] != mjEQ_JOINT || !m.eq_active0[e]) continue;
        const mjtNum* c = m.eq_data + mjNEQDATA * e;
        const int follower = m.jnt_qposadr[m.eq_obj1id[e]];
        const int source = m.eq_obj2id[e] >= 0 ? m.jnt_qposadr[m.eq_obj2id[e]] : -1;
        const double x = source >= 0 ? data_->qpos[source] - m.qpos0[source] : 0.;
        data_->qpos[follower] = m.qpos0[follower] + c[0] + c[1] * x;
      }
    }
    mj_kinematics(model_.get(), data_.get());
  }

  /// Takes the state of the only keyframe.
  void useKeyframe() {
    if (model_->nkey > 0) mj_resetDataKeyframe(model_.get(), data_.get(), 0);
    mj_kinematics(model_.get(), data_.get());
  }

  /// Sets the joint of that name, which has one dof.
  void setJoint(const std::string& joint, double q) {
    const int id = mj_name2id(model_.get(), mjOBJ_JOINT, joint.c_str());
    ASSERT_GE(id, 0) << joint;
    data_->qpos[model_->jnt_qposadr[id]] = q;
  }
  void update() { mj_kinematics(model_.get(), data_.get()); }

  /// qpos of the joints that are dofs of the scene.
  VectorXd jointState(const Config& config) const {
    std::vector<double> q;
    const mjModel& m = *model_;
    for (int j = 0; j < m.njnt; ++j) {
      bool coupled = false;
      for (int e = 0; e < m.neq; ++e) coupled |= m.eq_type[e] == mjEQ_JOINT && m.eq_active0[e] && m.eq_obj1id[e] == j;
      const int count = m.jnt_type[j] == mjJNT_FREE ? 7 : m.jnt_type[j] == mjJNT_BALL ? 4 : 1;
      const mjtNum* values = data_->qpos + m.jnt_qposadr[j];
      if (!coupled) q.insert(q.end(), values, values + count);
    }
    EXPECT_EQ(int(q.size()), config.getJointDimension());
    return Eigen::Map<VectorXd>(q.data(), Eigen::Index(q.size()));
  }

  /// The largest difference of the poses of bodies, sites and geoms (but meshes, which MuJoCo moves) that have names.
  double largestDifference(const Config& config, int at_least = 2) const {
    const mjModel& m = *model_;
    double worst = 0.;
    int compared = 0;
    const auto compare = [&](mjtObj kind, int i, const mjtNum* position, const mjtNum* rotation) {
      const auto frame = name(kind, i).empty() ? std::nullopt : config.findFrame(name(kind, i));
      if (!frame) return;
      const RigidTransform X = frame->getPose().transform();
      const Matrix3d R = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(rotation);
      worst = std::max(
          {worst, (X.p - Eigen::Map<const Vector3d>(position)).cwiseAbs().maxCoeff(), (X.R - R).cwiseAbs().maxCoeff()});
      ++compared;
    };
    for (int i = 0; i < m.nbody; ++i) compare(mjOBJ_BODY, i, data_->xpos + 3 * i, data_->xmat + 9 * i);
    for (int i = 0; i < m.nsite; ++i) compare(mjOBJ_SITE, i, data_->site_xpos + 3 * i, data_->site_xmat + 9 * i);
    for (int i = 0; i < m.ngeom; ++i) {
      if (m.geom_type[i] != mjGEOM_MESH) compare(mjOBJ_GEOM, i, data_->geom_xpos + 3 * i, data_->geom_xmat + 9 * i);
    }
    EXPECT_GE(compared, at_least);
    return worst;
  }

 private:
  struct Free {
    void operator()(mjModel* model) const { mj_deleteModel(model); }
    void operator()(mjData* data) const { mj_deleteData(data); }
  };
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};

/// Reads a file with both and compares the poses at random states.
inline double largestDifferenceToMujoco(const std::string& path, Config& config, int samples = 20) {
  MujocoModel model(path);
  Rng rng(0);
  double worst = 0.;
  for (int i = 0; i < samples; ++i) {
    model.draw(rng);
    config.setJointState(model.jointState(config));
    worst = std::max(worst, model.largestDifference(config));
  }
  return worst;
}

}  // namespace kinegraph
