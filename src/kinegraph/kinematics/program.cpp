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

void connectChains(Program& program) {
  program.column_dof.clear();
  program.chain.clear();
  program.chain_start = {0, 0};  // nothing moves the world
  for (std::size_t l = 1; l < program.links.size(); ++l) {
    Program::Link& link = program.links[l];
    link.first_column = int(program.column_dof.size());
    int dof = link.dof;
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      for (int i = 0; i < program.steps[s].dofs(); ++i) program.column_dof.push_back(dof++);
    }
    for (int i = program.chain_start[link.parent]; i < program.chain_start[link.parent + 1]; ++i) {
      program.chain.push_back(program.chain[i]);
    }
    for (int c = link.first_column; c < int(program.column_dof.size()); ++c) program.chain.push_back(c);
    program.chain_start.push_back(int(program.chain.size()));
  }
}

}  // namespace kinegraph
