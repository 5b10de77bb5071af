#include "kinegraph/komo/komo.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/residual.h"
#include "kinegraph/komo/path_components.h"
#include "kinegraph/komo/path_description.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

std::shared_ptr<Komo> requireKomo(const Nlp& nlp) {
  std::shared_ptr<Komo> komo = komoOf(nlp);
  if (!komo) throw ValueError("the problem was not made from a KOMO, so it has no objectives and no frames");
  return komo;
}

const Objective& requireObjective(const Nlp& nlp, int number) {
  requireKomo(nlp);
  const std::vector<Objective>& objectives = *objectivesOf(nlp);
  if (number < 0 || number >= int(objectives.size()))
    throw ValueError(cat("there is no objective ", number, "; the problem has ", objectives.size()));
  const Objective& objective = objectives[std::size_t(number)];
  if (objective.from > objective.to)
    throw ValueError(cat("objective ", number, " (", objectiveName(objective),
                         ") selects no slice: the solution does not depend on it"));
  if (objective.type == ObjectiveType::none)
    throw ValueError(cat("objective ", number, " (", objectiveName(objective),
                         ") has type none: the solution does not depend on it"));
  return objective;
}

Residual residualOf(const Nlp& nlp, const Objective& objective) {
  const std::shared_ptr<Komo> komo = requireKomo(nlp);
  return residualIn(objective, komo->path(), komo->contacts().forces(), objective.from);
}

std::vector<std::string> numbered(const std::string& name, int count) {
  std::vector<std::string> names;
  for (int i = 0; i < count; ++i) names.push_back(count == 1 ? name : cat(name, ", row ", i));
  return names;
}

/// phi = scale (y - target).
class ObjectiveTarget final : public NlpParameter {
 public:
  ObjectiveTarget(int number, const Objective& objective, const Residual& residual)
      : NlpParameter(cat("target of ", objectiveName(objective)),
                     numbered(cat("target of ", objectiveName(objective)), count(objective, residual))),
        objective_(number),
        is_common_(objective.feature == FeatureSymbol::pairCollisions),
        mixes_(residual.mixesRows()),
        scale_(residual.scale()) {}

  void differentiate(const Point& at, int number, VectorXd& phi, VectorXd&) override {
    const std::vector<PathComponent> rows = pathComponents(at.nlp);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].objective != objective_) continue;
      double scale = 1.;
      if (mixes_)
        scale = is_common_ ? scale_.row(rows[i].row).sum() : scale_(rows[i].row, number);
      else if (!is_common_ && rows[i].row != number)
        continue;
      else if (scale_.size() > 0)
        scale = scale_(scale_.size() == 1 ? 0 : rows[i].row);
      phi[Eigen::Index(i)] -= scale;
    }
  }

 private:
  static int count(const Objective& objective, const Residual& residual) {
    if (objective.feature == FeatureSymbol::accumulatedCollisions)
      throw ValueError(
          "accumulatedCollisions is a sum of overlaps and has no target to differentiate by; use pairCollisions");
    return objective.feature == FeatureSymbol::pairCollisions ? 1 : residual.feature().rows();
  }

  int objective_;
  bool is_common_, mixes_;
  MatrixXd scale_;
};

class ObjectiveScale final : public NlpParameter {
 public:
  ObjectiveScale(int number, const Objective& objective, const Residual& residual)
      : NlpParameter(cat("scale of ", objectiveName(objective)),
                     numbered(cat("scale of ", objectiveName(objective)), count(objective, residual))),
        objective_(number),
        scale_(residual.scale().size() == 0 ? VectorXd(VectorXd::Ones(1)) : VectorXd(residual.scale().col(0))) {}

  void differentiate(const Point& at, int number, VectorXd& phi, VectorXd& gradient) override {
    const std::vector<PathComponent> rows = pathComponents(at.nlp);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows[i].objective != objective_ || (size() > 1 && rows[i].row != number)) continue;
      phi[Eigen::Index(i)] += at.phi[Eigen::Index(i)] / scale_[number];
      const double weight = at.weights[Eigen::Index(i)];
      if (weight != 0. && !at.J.zero_row[i]) at.J.addRowTo(int(i), weight / scale_[number], gradient);
    }
  }

 private:
  static int count(const Objective& objective, const Residual& residual) {
    const MatrixXd& scale = residual.scale();
    if (residual.mixesRows())
      throw ValueError(cat("the scale of ", objectiveName(objective),
                           " is a matrix; expected one number, or one per component, to differentiate by"));
    if ((scale.array() == 0.).any())
      throw ValueError(cat("the scale of ", objectiveName(objective),
                           " has zeros; expected nonzero numbers, since zeros hide the derivatives of components"));
    return std::max(1, int(scale.size()));
  }

  int objective_;
  VectorXd scale_;
};

/// The pose of a frame that is fixed to its parent, in all slices in which it is.
class FramePoseParameter final : public FiniteDifferenceParameter {
 public:
  FramePoseParameter(const Nlp& nlp, const std::string& name, bool with_rotation)
      : FiniteDifferenceParameter(cat(with_rotation ? "pose of " : "position of ", name),
                                  namesOf(name, with_rotation)) {
    const Path& path = requireKomo(nlp)->path();
    frame_ = frameId(path.state(0).model(), name, "sensitivity");
    std::string joint_of;
    const auto add = [&](const SceneTree& scene) {
      const auto copy = std::make_shared<SceneTree>();
      copy->append(scene, {}, false);
      const FrameData& frame = *copy->frames()[std::size_t(frame_)];
      is_fixed_.push_back(!frame.moves());
      poses_.push_back(frame.pose);
      scenes_.push_back(copy);
      if (frame.moves() && frame.parent) joint_of = frame.parent->name;
    };
    if (path.modes().empty()) add(*path.initial().tree);
    for (const auto& mode : path.modes().list()) add(*mode->config.scene());
    if (std::ranges::find(is_fixed_, true) != is_fixed_.end()) return;
    throw ValueError(cat("frame '", name, "' is moved by its joint; expected a frame that is fixed to its parent",
                         joint_of.empty() ? "" : cat(", such as '", joint_of, "'")));
  }

 private:
  static std::vector<std::string> namesOf(const std::string& frame, bool with_rotation) {
    std::vector<std::string> names;
    for (const char* axis : {"x", "y", "z"}) names.push_back(cat("position of ", frame, ", ", axis));
    for (const char* axis : {"x", "y", "z"}) {
      if (with_rotation) names.push_back(cat("rotation of ", frame, " about ", axis));
    }
    return names;
  }

  /// Finds the terms that depend on more than joints, in trees that contain the frame. Terms of order k use k preceding
  /// slices.
  bool findRows(Nlp& nlp, std::vector<int>& rows) override {
    const Path& path = requireKomo(nlp)->path();
    const std::vector<Objective>& objectives = *objectivesOf(nlp);
    const std::vector<PathTerm> terms = pathTerms(nlp);
    const int order = path.grid().order();
    std::vector<char> is_used(std::size_t(path.grid().slices() + order), false);
    const bool any_is_sparse = std::ranges::any_of(terms, [&](const PathTerm& term) {
      return term.is_sparse && mayDependOn(objectives[std::size_t(term.objective)]);
    });
    terms_.clear();
    rows.clear();
    for (std::size_t i = 0; i < terms.size(); ++i) {
      const PathTerm& term = terms[i];
      const Objective& objective = objectives[std::size_t(term.objective)];
      if (term.is_linear || !(term.is_sparse ? any_is_sparse : mayDependOn(objective))) continue;
      terms_.push_back(int(i));
      for (int row = 0; row < term.rows; ++row) rows.push_back(term.first_row + row);
      for (int t = term.slice - objective.order; t <= term.slice; ++t) is_used[std::size_t(t + order)] = true;
    }
    slices_.clear();
    for (int t = -order; t < path.grid().slices(); ++t) {
      if (is_used[std::size_t(t + order)]) slices_.push_back(t);
    }
    return true;
  }

  /// False for objectives whose frames are all in other trees, and for collisions if the frame has no shape.
  bool mayDependOn(const Objective& objective) const {
    const auto symbol = objective.feature.symbol();
    if (symbol == FeatureSymbol::accumulatedCollisions || symbol == FeatureSymbol::pairCollisions) return hasShapes();
    if (scenes_.size() > 1 || objective.feature.maker() || objective.frames.empty()) return true;
    const auto& frames = scenes_[0]->frames();
    const auto rootOf = [](const FrameData* frame) {
      while (frame->parent) frame = frame->parent;
      return frame;
    };
    const FrameData* own = rootOf(frames[std::size_t(frame_)].get());
    return std::ranges::any_of(objective.frames, [&](const std::string& name) {
      const auto named = std::ranges::find(frames, name, [](const auto& frame) { return frame->name; });
      return named == frames.end() || rootOf(named->get()) == own;
    });
  }

  /// Returns true if the frame or one of its descendants has a shape.
  bool hasShapes() const {
    return std::ranges::any_of(scenes_, [&](const auto& scene) {
      const FrameData* own = scene->frames()[std::size_t(frame_)].get();
      return std::ranges::any_of(scene->frames(), [&](const auto& frame) {
        if (!frame->shape || frame->shape->geometry->type == ShapeType::marker) return false;
        const FrameData* above = frame.get();
        while (above && above != own) above = above->parent;
        return above == own;
      });
    });
  }

  void evaluate(Nlp& nlp, const VectorXd&, VectorXd& phi, Jacobian& J) override {
    evaluatePathTerms(nlp, terms_, phi, J);
  }

  void move(Nlp& nlp, int number, double by) override {
    Path& path = requireKomo(nlp)->path();
    if (original_.empty()) {
      for (const int t : slices_) original_.push_back(path.state(t).sharedParameters());
    }
    if (by == 0.) {
      for (std::size_t i = 0; i < slices_.size(); ++i) path.setParameters(slices_[i], original_[i]);
      original_.clear();
      return;
    }
    std::vector<std::shared_ptr<const Parameters>> moved(scenes_.size());
    for (std::size_t i = 0; i < slices_.size(); ++i) {
      const int t = slices_[i];
      const auto place = std::size_t(t + path.grid().order());
      const std::size_t mode = path.modes().empty() ? 0 : std::size_t(path.modes().ofSlices()[place]);
      if (!is_fixed_[mode]) continue;
      if (!moved[mode]) moved[mode] = movedIn(mode, path.state(t).model(), *original_[i], number, by);
      path.setParameters(t, moved[mode]);
    }
  }

  std::shared_ptr<const Parameters> movedIn(std::size_t mode, const KinematicModel& model, const Parameters& original,
                                            int number, double by) const {
    FrameData& frame = *scenes_[mode]->frames()[std::size_t(frame_)];
    frame.pose = poses_[mode];
    const Vector3d axis = Vector3d::Unit(number % 3);
    if (number < 3)
      frame.pose.p += by * axis;
    else
      frame.pose.q = Quaterniond(Eigen::AngleAxisd(by, axis)) * frame.pose.q;
    const auto moved = std::make_shared<Parameters>(original);
    updateParameters(frame, model, *moved);
    return moved;
  }

  int frame_ = -1;
  std::vector<std::shared_ptr<SceneTree>> scenes_;           ///< per mode, or the initial one
  std::vector<Pose> poses_;                                  ///< of the frame, per mode
  std::vector<bool> is_fixed_;                               ///< per mode
  std::vector<int> terms_;                                   ///< terms of the problem that may depend on the frame
  std::vector<int> slices_;                                  ///< slices on which these terms depend
  std::vector<std::shared_ptr<const Parameters>> original_;  ///< original parameters of these slices while the frame is
                                                             ///< moved
};

/// The slices before the first.
class MotionStart final : public FiniteDifferenceParameter {
 public:
  explicit MotionStart(const Nlp& nlp) : FiniteDifferenceParameter("start", namesOf(*requireKomo(nlp))) {
    if (requireKomo(nlp)->order() == 0)
      throw ValueError(
          "a problem of order 0 has no slices before the first, so its solution does not depend on a start");
  }

 private:
  static std::vector<std::string> namesOf(const Komo& komo) {
    const KinematicModel& model = *komo.path().initial().model;
    std::vector<std::string> names;
    for (const int frame : komo.path().initial().joint_frames) {
      const int count = model.frame_dofs[std::size_t(frame)].count;
      for (int i = 0; i < count; ++i)
        names.push_back(cat("start of ", model.frame_name[std::size_t(frame)], count > 1 ? cat(", dof ", i) : ""));
    }
    return names;
  }

  void move(Nlp& nlp, int number, double by) override {
    Path& path = requireKomo(nlp)->path();
    const int order = path.grid().order();
    if (original_.empty()) {
      for (int t = -order; t < 0; ++t) original_.push_back(path.state(t).q());
    }
    for (int t = -order; t < 0; ++t) {
      VectorXd q = original_[std::size_t(t + order)];
      if (by != 0.) q[path.dofsOf(path.initial().joint_frames, t)[std::size_t(number)]] += by;
      path.setSlice(t, q.data());
    }
    if (by == 0.) original_.clear();
  }

  std::vector<VectorXd> original_;  ///< original q of these slices while the start is moved
};

}  // namespace

int objectiveNumber(const Nlp& nlp, const std::string& name) {
  requireKomo(nlp);
  const std::vector<Objective>& objectives = *objectivesOf(nlp);
  std::vector<std::string> found, known;
  int number = -1;
  for (std::size_t i = 0; i < objectives.size(); ++i) {
    const std::string whole = objectiveName(objectives[i]);
    known.push_back(whole);
    if (whole != name && objectives[i].name() != name) continue;
    found.push_back(cat(i, " (", whole, ")"));
    number = int(i);
  }
  if (found.size() > 1)
    throw NameError(cat("several objectives are named '", name, "': ", join(found), "; expected the number of one"));
  if (number < 0)
    throw NameError(cat("there is no objective '", name, "'; the problem has ", join(known), similarHint(name, known)));
  return number;
}

std::shared_ptr<NlpParameter> objectiveTarget(const Nlp& nlp, int number) {
  const Objective& objective = requireObjective(nlp, number);
  return std::make_shared<ObjectiveTarget>(number, objective, residualOf(nlp, objective));
}

std::shared_ptr<NlpParameter> objectiveScale(const Nlp& nlp, int number) {
  const Objective& objective = requireObjective(nlp, number);
  return std::make_shared<ObjectiveScale>(number, objective, residualOf(nlp, objective));
}

std::shared_ptr<NlpParameter> framePosition(const Nlp& nlp, const std::string& frame) {
  return std::make_shared<FramePoseParameter>(nlp, frame, false);
}

std::shared_ptr<NlpParameter> framePose(const Nlp& nlp, const std::string& frame) {
  return std::make_shared<FramePoseParameter>(nlp, frame, true);
}

std::shared_ptr<NlpParameter> motionStart(const Nlp& nlp) { return std::make_shared<MotionStart>(nlp); }

}  // namespace kinegraph
