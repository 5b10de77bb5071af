#include "kinegraph/kinematics/lane_kinematics.h"

#include <algorithm>
#include <numeric>

#include "kinegraph/kinematics/lane_storage.h"
#include "kinegraph/math/lane_widths.h"

namespace kinegraph::inline kinematics_internal {

namespace {

using Block = LaneRows::Block;

std::vector<int> framesOf(const std::vector<Block>& blocks) {
  std::vector<int> frames;
  for (const Block& block : blocks) {
    if (block.kind == Block::joint) continue;
    for (int frame : {block.a, block.b}) {
      if (frame >= 0 && std::ranges::find(frames, frame) == frames.end()) frames.push_back(frame);
    }
  }
  return frames;
}

std::vector<int> everyDof(const KinematicModel& model) {
  std::vector<int> dofs(model.dofs);
  std::iota(dofs.begin(), dofs.end(), 0);
  return dofs;
}

/// Returns true if the values depend on rotations only.
bool dependsOnRotations(Block::Kind kind) { return kind >= Block::quaternion && kind <= Block::axis_product; }

/// Returns true if a common motion of both frames does not change the values.
bool isBetweenFrames(Block::Kind kind) {
  return kind == Block::relative || kind == Block::quaternion_relative || kind == Block::axis_relative ||
         kind == Block::axis_product;
}

}  // namespace

LaneLinks::LaneLinks(const KinematicModel& model, const Parameters& parameters, const std::vector<int>& frames,
                     const std::vector<int>& variable, int variables)
    : lane_link_(model.links.size(), -1), variables_(variables) {
  std::vector<char> needed(model.links.size(), 0);
  needed[0] = 1;
  for (int frame : frames) {
    for (int l = model.frame_link[frame]; !needed[l]; l = model.links[l].parent) needed[l] = 1;
  }
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    if (!needed[l]) continue;
    LaneModel::Link link = parameters.link[l];
    if (l > 0) link.parent = lane_link_[link.parent];
    link.first_step = int(step_.size());
    for (int s = model.links[l].first_step; s < model.links[l].first_step + link.steps; ++s) {
      LaneModel::Step step = parameters.step[s];
      const int dof = step.variable;
      step.variable = variable[dof];
      step.column = int(column_.size());
      step_.push_back(step);
      for (int k = 0; k < model.steps[s].dofs(); ++k) {
        column_.push_back({variable[dof + k], !model.steps[s].translates()});
      }
    }
    lane_link_[l] = int(link_.size());
    link_.push_back(link);
  }
}

LaneModel LaneLinks::view() const {
  return {int(link_.size()), int(step_.size()), int(column_.size()), variables_, link_.data(), step_.data()};
}

LaneRows::Frame LaneLinks::place(const KinematicModel& model, const Parameters& parameters, int frame) const {
  const RigidTransform& offset = parameters.frame_offset[frame];
  LaneRows::Frame placed{lane_link_[model.frame_link[frame]], classifyRotation(offset.R.data()), {}, {}};
  std::copy_n(offset.R.data(), 9, placed.R);
  std::copy_n(offset.p.data(), 3, placed.p);
  return placed;
}

std::vector<int> LaneLinks::chain(int link) const {
  std::vector<int> columns;
  for (int l = link; l > 0; l = link_[l].parent) {
    for (int s = link_[l].first_step; s < link_[l].first_step + link_[l].steps; ++s) {
      const MotionFacts& facts = kMotionFacts[int(step_[s].kind)];
      if (facts.effect == MotionFacts::Effect::none) continue;
      for (int k = 0; k < facts.dofs; ++k) columns.push_back(step_[s].column + k);
    }
  }
  return columns;
}

Block& LaneRowList::add(Block::Kind kind, int rows, int a, int b) {
  blocks_.push_back({kind, false, rows_, rows, a, b, 0, 0, 0, 0, 1., 0.});
  rows_ += rows;
  return blocks_.back();
}

void LaneRowList::addAxes(Block::Kind kind, int rows, int axis_a, int axis_b, int a, int b) {
  Block& block = add(kind, rows, a, b);
  block.axis_a = axis_a;
  block.axis_b = axis_b;
}

void LaneRowList::addPose(int frame) {
  addPosition(Block::position, frame);
  add(Block::quaternion, 4, frame, -1).canonical = true;
}

void LaneRowList::addJoint(int dof, double scale, double shift) {
  Block& block = add(Block::joint, 1, dof, -1);
  block.scale = scale;
  block.shift = shift;
}

LaneKinematics::LaneKinematics(const KinematicModel& model, const Parameters& parameters, const LaneRowList& list)
    : links_(model, parameters, framesOf(list.blocks()), everyDof(model), model.dofs), block_(list.blocks()) {
  const std::vector<int> frames = framesOf(block_);
  for (int frame : frames) frame_.push_back(links_.place(model, parameters, frame));
  const auto slot = [&](int frame) { return frame < 0 ? 0 : int(std::ranges::find(frames, frame) - frames.begin()); };
  for (Block& block : block_) {
    if (block.kind == Block::joint) continue;
    const bool two = block.b >= 0;
    block.a = slot(block.a);
    block.b = two ? slot(block.b) : -1;
    connect(block);
    block.b = std::max(block.b, 0);  // kernels may read it even if unused
  }
}

/// Lists the entries of a block: those of frame a, then those of b, without columns that cannot change the values.
void LaneKinematics::connect(Block& block) {
  block.first_entry = int(entry_.size());
  std::vector<int> of_a = links_.chain(frame_[block.a].link), of_b;
  if (block.b >= 0) of_b = links_.chain(frame_[block.b].link);
  if (isBetweenFrames(block.kind)) {  // chains run from the frame to the world, so the common columns are at their ends
    while (!of_a.empty() && !of_b.empty() && of_a.back() == of_b.back()) of_a.pop_back(), of_b.pop_back();
  }
  std::vector<char> seen(links_.view().variables, 0);
  const auto add = [&](const std::vector<int>& chain, bool is_b) {
    for (int index : chain) {
      const LaneLinks::Column& column = links_.column(index);
      if (dependsOnRotations(block.kind) && !column.is_rotation) continue;
      entry_.push_back({index, column.variable, column.is_rotation, is_b, seen[column.variable] != 0});
      seen[column.variable] = 1;
    }
  };
  add(of_a, false);
  add(of_b, true);
  block.entries = int(entry_.size()) - block.first_entry;
}

LaneRows LaneKinematics::view() const {
  const int rows = block_.empty() ? 0 : block_.back().row + block_.back().rows;
  return {int(frame_.size()), int(block_.size()), rows, frame_.data(), block_.data(), entry_.data()};
}

LaneKinematics::Scratch::Scratch(const LaneKinematics& kinematics, int width) {
  const LaneModel model = kinematics.links_.view();
  const LaneRows rows = kinematics.view();
  const int lanes = checkedLaneWidth(width);
  run_ = laneKernel(lanes);
  const auto size = [](int count) { return std::size_t(count); };
  layOutLanes(storage_, lanes,
              {{&memory_.x, size(model.variables)},
               {&memory_.pose, size(model.links * LaneMemory::kPerPose)},
               {&memory_.motion, size(model.columns * LaneMemory::kPerColumn)},
               {&memory_.frame, size(rows.frames * LaneMemory::kPerPose)},
               {&memory_.y, size(rows.rows)},
               {&memory_.jacobian, size(rows.rows) * size(model.variables)}});
  setWorld(memory_.pose, lanes);
}

}  // namespace kinegraph::inline kinematics_internal
