#include "kinegraph/kinematics/kinematic_model.h"

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

void nameFrames(Program& program, std::vector<std::string> names) {
  program.frame_name = std::move(names);
  for (std::size_t i = 0; i < program.frame_name.size(); ++i)
    program.frame_index.try_emplace(program.frame_name[i], int(i));
}

int frameId(const Program& program, std::string_view name, std::string_view who) {
  const auto place = program.frame_index.find(name);
  if (place != program.frame_index.end()) return place->second;
  throw FrameNotFound(cat(who, ": frame name '", name, "' doesn't exist", similarHint(name, program.frame_name)));
}

const std::vector<std::pair<int, int>>& Program::collidable() const {
  std::call_once(listed_, [this] {
    for (std::size_t i = 0; i < contacts.bodies.size(); ++i) {
      for (std::size_t j = i + 1; j < contacts.bodies.size(); ++j) {
        if (contacts.allow(i, j)) collidable_.emplace_back(contacts.bodies[i].frame, contacts.bodies[j].frame);
      }
    }
  });
  return collidable_;
}

std::vector<std::pair<int, int>> Program::movingPairs() const {
  std::vector<std::size_t> moving;
  for (std::size_t i = 0; i < contacts.bodies.size(); ++i) {
    if (frame_link[std::size_t(contacts.bodies[i].frame)] != 0) moving.push_back(i);
  }
  std::vector<std::pair<int, int>> pairs;
  for (std::size_t i = 0; i < contacts.bodies.size(); ++i) {
    const int frame = contacts.bodies[i].frame, link = frame_link[std::size_t(frame)];
    const auto add = [&](std::size_t j) {
      const int other = contacts.bodies[j].frame;
      if (j > i && frame_link[std::size_t(other)] != link && contacts.allow(i, j)) pairs.emplace_back(frame, other);
    };
    if (link != 0) {
      for (std::size_t j = i + 1; j < contacts.bodies.size(); ++j) add(j);
    } else {
      for (const std::size_t j : moving) add(j);
    }
  }
  return pairs;
}

void connectChains(Program& program) {
  program.column_dof.clear();
  program.column_before.clear();
  program.last_column = {-1};  // nothing moves the world
  program.fixed_axes = {true};
  program.turn_dof.clear();
  for (std::size_t l = 1; l < program.links.size(); ++l) {
    Program::Link& link = program.links[l];
    link.first_column = int(program.column_dof.size());
    link.first_turn = int(program.turn_dof.size());
    int dof = link.dof, last = program.last_column[link.parent];
    bool fixed_axes = program.fixed_axes[std::size_t(link.parent)];
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = program.steps[s];
      if (step.turns()) program.turn_dof.push_back(dof);
      fixed_axes = fixed_axes && !step.orients();
      for (int i = 0; i < step.dofs(); ++i) {
        program.column_before.push_back(last);
        last = int(program.column_dof.size());
        program.column_dof.push_back(dof++);
      }
    }
    program.last_column.push_back(last);
    program.fixed_axes.push_back(fixed_axes);
  }
  if (program.turn_dof.size() % 2 != 0) program.turn_dof.push_back(program.turn_dof.back());
}

Parameters emptyParameters(const Program& program) {
  Parameters parameters;
  parameters.link.resize(program.links.size());
  parameters.step.resize(program.steps.size());
  parameters.turn_factor.resize(program.turn_dof.size());
  parameters.frame_offset.resize(program.frame_link.size());
  parameters.frame_mass.resize(program.frame_link.size());
  return parameters;
}

RigidTransform placeJoint(const Program& program, int index, const RigidTransform& X_PJ, Parameters& parameters) {
  const Program::Link& link = program.links[index];
  const MotionStep* const steps = program.steps.data() + link.first_step;
  const ConstantTurn turn = classifyTurn(X_PJ.R.data());
  const bool along_axes =
      std::all_of(steps, steps + link.steps, [](const MotionStep& step) { return !step.orients(); });
  const bool turns_axes = along_axes && turn.kind == ConstantTurn::quarters;
  RigidTransform X_LJ;
  if (turns_axes) {
    X_LJ.R.setZero();
    for (int k = 0; k < 3; ++k) X_LJ.R(turn.column[k], k) = turn.sign[k];
  }
  LaneModel::Link& placed = parameters.link[index];
  placed = {link.parent, link.first_step, link.steps, turns_axes ? ConstantTurn{} : turn, {}, {}};
  Eigen::Map<Matrix3d>(placed.R) = turns_axes ? Matrix3d(Matrix3d::Identity()) : X_PJ.R;
  Eigen::Map<Vector3d>(placed.p) = X_PJ.p;
  const Vector3d about = X_LJ.R * link.axis;
  int dof = link.dof, column = link.first_column, turned = link.first_turn;
  for (int s = 0; s < link.steps; ++s) {
    const MotionStep& step = steps[s];
    LaneModel::Step& moves = parameters.step[link.first_step + s];
    moves = {step.kind, step.axis, dof, column, step.sign * link.scale, {about[0], about[1], about[2]}};
    if (turns_axes && step.kind != MotionKind::rotateAbout) {
      moves.axis = turn.column[step.axis];
      moves.factor *= turn.sign[step.axis];
    }
    if (step.turns()) parameters.turn_factor[turned++] = moves.factor;
    dof += step.dofs();
    column += step.dofs();
  }
  return X_LJ;
}

}  // namespace kinegraph
