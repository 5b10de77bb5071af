#include "kinegraph/kinematics/program.h"

namespace kinegraph {

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
