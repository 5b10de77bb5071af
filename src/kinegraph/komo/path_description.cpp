#include "kinegraph/komo/path_description.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path_motion.h"

namespace kinegraph::inline komo_internal {

namespace {

/// Returns the unit of each dof of a model.
std::vector<Measure> measuresOfDofs(const KinematicModel& model) {
  std::vector<Measure> measures(model.dofs, Measure::number);
  for (std::size_t l = 1; l < model.links.size(); ++l) {
    const KinematicModel::Link& link = model.links[l];
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = model.steps[s];
      const Measure measure = step.translates() ? Measure::length : step.rotates() ? Measure::angle : Measure::number;
      for (int i = 0; i < step.dofs(); ++i) measures[dof++] = measure;
    }
  }
  return measures;
}

/// Returns the unit that all components of a joint objective have; number if they differ.
Measure measureOfJoints(const Path& path, const Objective& objective, int slice) {
  const KinematicModel& model = path.state(slice).model();
  const std::vector<Measure> all = measuresOfDofs(model);
  std::vector<Measure> used;
  for (const std::string& name : objective.frames) {
    const auto [first, count] = model.frame_dofs[frameId(model, name, objective.name())];
    used.insert(used.end(), all.begin() + first, all.begin() + first + count);
  }
  if (used.empty()) used = all;
  const bool same = !used.empty() && std::all_of(used.begin(), used.end(), [&](Measure m) { return m == used[0]; });
  return same ? used[0] : Measure::number;
}

/// Returns the unit for reports. Velocities are lengths and angles per time.
Measure measureOf(FeatureUnit unit) {
  switch (unit) {
    case FeatureUnit::meter:
    case FeatureUnit::meter_per_second:
      return Measure::length;
    case FeatureUnit::radian:
    case FeatureUnit::radian_per_second:
      return Measure::angle;
    case FeatureUnit::quaternion:
      return Measure::quaternion;
    case FeatureUnit::direction:
      return Measure::axis;
    case FeatureUnit::cosine:
      return Measure::cosine;
    case FeatureUnit::none:
    case FeatureUnit::joint:  // depends on the joint: measureOfJoints
    case FeatureUnit::newton:
    case FeatureUnit::newton_meter:
    case FeatureUnit::joule:
      return Measure::number;
  }
  return Measure::number;
}

/// Returns the number of times that a unit is divided by seconds.
int timeOrderOf(FeatureUnit unit) {
  return unit == FeatureUnit::meter_per_second || unit == FeatureUnit::radian_per_second;
}

/// Describes component `entry` of an objective's feature. Components of custom features are plain numbers.
void describeEntry(RowDescription& out, const Path& path, const Objective& objective, int slice, int entry) {
  if (!objective.feature.symbol()) return;
  const FeatureInfo& info = featureInfo(*objective.feature.symbol());
  const FeatureUnit unit = info.unitOf(entry);
  out.time_order = objective.between_slices ? 0 : objective.order - info.order + timeOrderOf(unit);
  out.measure = unit == FeatureUnit::joint ? measureOfJoints(path, objective, slice) : measureOf(unit);
}

}  // namespace

std::string objectiveName(const Objective& objective) {
  const std::string name = objective.name() + (objective.between_slices ? " between slices" : "");
  return objective.frames.empty() ? name : cat(name, " of ", join(objective.frames, ", "));
}

RowDescription describePathComponent(const Path& path, const PathProblem& problem, int row) {
  const PathProblem::Term& term = problem.termOf(row);
  const Objective& objective = problem.objectives()[term.objective];
  RowDescription out;
  out.objective = objectiveName(objective);
  out.group = term.objective;
  out.frames = objective.frames;
  out.slice = term.slice;
  out.time_order = objective.between_slices ? 0 : objective.order;
  const int r = row - term.first_row;
  const MatrixXd& scale = objective.scale;
  const bool mixes_components = scale.size() > 1 && (scale.cols() > 1 || scale.rows() != term.rows);
  if (scale.size() == 1) out.scale = scale(0, 0);
  if (scale.size() > 1) out.scale = mixes_components ? scale.row(r).norm() : scale(r, 0);
  int raw = r;  // the component of the feature
  if (mixes_components) scale.row(r).cwiseAbs().maxCoeff(&raw);
  describeEntry(out, path, objective, term.slice, raw);
  if (out.measure == Measure::cosine && objective.target.size() > 0) out.target = objective.target[0];
  return out;
}

VariableDescription describePathVariable(const Path& path, int variable) {
  VariableDescription out;
  const PathLayout& layout = path.layout();
  const KinematicModel* model = path.initial().model.get();
  int dof = -1;
  if (layout.plain) {
    out.slice = variable / path.dofs();
    dof = variable % path.dofs();
  } else {
    for (std::size_t i = 0; i < layout.column.size() && dof < 0; ++i) {
      const auto place = std::find(layout.column[i].begin(), layout.column[i].end(), variable);
      if (place == layout.column[i].end()) continue;
      dof = int(place - layout.column[i].begin());
      out.slice = int(i) - path.grid().order();
      model = &path.state(out.slice).model();
    }
  }
  if (dof < 0) return out;
  const int frame = frameOfDof(*model, dof);
  if (frame >= 0) out.frame = model->frame_name[std::size_t(frame)];
  out.name = cat("joint of ", out.frame);
  out.measure = measuresOfDofs(*model)[dof];
  return out;
}

std::vector<std::string> pathComponentDetails(const Path& path, const PathProblem& problem, int row) {
  const PathProblem::Term& term = problem.termOf(row);
  const Objective& objective = problem.objectives()[term.objective];
  if (objective.feature != FeatureSymbol::accumulatedCollisions) return {};
  if (objective.between_slices) {
    std::vector<std::string> contacts;
    for (const PathContact& contact : contactsOf({motionInto(path, term.slice)}, objective.margin, 1e-5))
      contacts.push_back(contact.str());
    return contacts;
  }
  const Config config = path.configuration(term.slice);
  std::vector<Config::NearPair> near = config.getCollisions(objective.margin);
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.distance < b.distance; });
  std::vector<std::string> pairs;
  for (const Config::NearPair& pair : near) {
    if (!config.model()->movesApart(pair.a, pair.b)) continue;  // no joint could separate them
    const std::string a = config.getFrame(pair.a).getName(), b = config.getFrame(pair.b).getName();
    const auto named = [&](const std::string& name) {
      return std::find(objective.frames.begin(), objective.frames.end(), name) != objective.frames.end();
    };
    if (!objective.frames.empty() && !named(a) && !named(b)) continue;
    const double mm = std::round(-1e4 * pair.distance) / 10.;
    pairs.push_back(cat(a, " and ", b, mm < 0. ? " come within " : " overlap by ", std::abs(mm), " mm"));
  }
  return pairs;
}

}  // namespace kinegraph::inline komo_internal
