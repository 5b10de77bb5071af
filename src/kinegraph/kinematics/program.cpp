#include "kinegraph/kinematics/program.h"

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

void nameFrames(Program& program, std::vector<std::string> names) {
  program.frame_name = std::move(names);
  for (std::size_t i = 0; i < program.frame_name.size(); ++i) program.frame_index.try_emplace(program.frame_name[i], int(i));
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
  program.turn_dof.clear();
  program.turn_factor.clear();
  for (std::size_t l = 1; l < program.links.size(); ++l) {
    Program::Link& link = program.links[l];
    link.first_column = int(program.column_dof.size());
    int dof = link.dof, last = program.last_column[link.parent];
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = program.steps[s];
      if (step.kind == MotionKind::rotate || step.kind == MotionKind::rotateAbout) {
        program.turn_dof.push_back(dof);
        program.turn_factor.push_back(step.sign * link.scale);
      }
      for (int i = 0; i < step.dofs(); ++i) {
        program.column_before.push_back(last);
        last = int(program.column_dof.size());
        program.column_dof.push_back(dof++);
      }
    }
    program.last_column.push_back(last);
  }
  if (program.turn_dof.size() % 2 != 0) {
    program.turn_dof.push_back(program.turn_dof.back());
    program.turn_factor.push_back(program.turn_factor.back());
  }
}

}  // namespace kinegraph
