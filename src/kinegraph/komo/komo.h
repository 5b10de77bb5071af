#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/features/eval.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A motion problem: T configurations (slices) of a scene, tied together by objectives on features of k+1 consecutive ones.
/// With one phase of one slice and order 0 it is inverse kinematics.
///
/// T = ceil(phases * slices_per_phase); slice t is at phase time (t+1) / slices_per_phase. Before slice 0 lie `order`
/// copies of the given configuration, so that motions start there, at rest. The scene's Program is shared by all slices.
/// Source: Toussaint, A tutorial on Newton methods for constrained trajectory optimization, 2017.
class Komo {
 public:
  struct Objective {
    Residual residual;
    ObjectiveType type;
    std::vector<std::string> frames;
    std::vector<double> times;
    int from, to;  ///< slices, inclusive; none if from > to
  };

  Komo() = default;
  Komo(Komo&&) = default;
  Komo(const Komo&) = delete;
  Komo& operator=(Komo&&) = default;
  Komo(const Config& config, double phases, int slices_per_phase, int order);

  /// In either order, for a Komo made without arguments; before the first objective.
  void setConfig(const Config& config);
  void setTiming(double phases, int slices_per_phase, double duration_per_phase, int order);

  /// Adds scale * (d^order feature / dt^order - target) in the slices that `times` selects: empty all, {a} the one at time a,
  /// {a, b} those from a to b inclusive; negative: the last. `order` -1: the feature's own.
  void addObjective(const std::vector<double>& times, FeatureSymbol feature, const std::vector<std::string>& frames,
                    ObjectiveType type, const MatrixXd& scale = {}, const VectorXd& target = {}, int order = -1);

  /// Sum of squares of the order-th derivative of all dofs, weighted by their control weights and integrated over time;
  /// order 0 is the distance from home.
  void addControlObjective(const std::vector<double>& times, int order, double scale = 1., const VectorXd& target = {},
                           int delta_from = 0, int delta_to = 0);

  /// Keeps quaternions among the dofs at norm one.
  void addQuaternionNorms(const std::vector<double>& times = {}, double scale = 3., bool hard = true);

  void clearObjectives() { objectives_.clear(); }

  int slices() const { return slices_; }             ///< T
  int order() const { return order_; }               ///< k
  int dofs() const { return program_->dofs; }        ///< per slice
  double tau() const { return tau_; }                ///< s per slice
  const Program& program() const { return *program_; }
  const std::vector<Objective>& objectives() const { return objectives_; }
  std::vector<Objective>& objectives() { return objectives_; }

  /// T x n: the joint states of the slices.
  MatrixXd getPath() const;
  void setPath(const MatrixXd& path);   ///< T x n; throws ValueError
  void setConstantPath(const VectorXd& q);
  const State& state(int slice) const { return states_[slice + order_]; }  ///< -order .. T-1

  /// World poses of all frames in a slice, rows x y z qw qx qy qz.
  MatrixXd getFrameState(int slice) const;

  /// Takes over the constant poses (root objects, markers) of the configuration. Throws ValueError if its structure is no
  /// longer the one that this problem was made from.
  void updateRootObjects(const Config& config);

  /// The selected slices [from, to], clipped to the horizon; empty if from > to.
  std::pair<int, int> selectSlices(const std::vector<double>& times) const;

  /// Residual of the objective in a slice, at the present path. Rows of J, where given: order+1 blocks of dofs columns.
  void evaluate(Objective& objective, int slice, Eigen::Ref<VectorXd> y, JacobianRows* J);
  void setSlice(int slice, const double* q) { states_[slice + order_].setJoints(q); }

  std::vector<std::string> takeWarnings() { return std::exchange(warnings_, {}); }

 private:
  void build();
  void requireBuilt(const char* call) const;
  void add(Residual residual, const std::vector<double>& times, std::vector<std::string> frames, ObjectiveType type, int delta_from,
           int delta_to);

  std::shared_ptr<const Program> program_;
  std::shared_ptr<const Parameters> parameters_;
  VectorXd start_;
  int slices_ = 0, slices_per_phase_ = 0, order_ = 0;
  double tau_ = 1.;
  std::vector<State> states_;
  std::vector<const State*> window_;
  std::vector<Objective> objectives_;
  std::vector<std::string> warnings_;
};

/// The problem of a Komo, for a solver. It keeps the Komo alive, and leaves it at the point last evaluated. Objectives that
/// are added to the Komo later are not part of it.
std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo);

}  // namespace kinegraph
