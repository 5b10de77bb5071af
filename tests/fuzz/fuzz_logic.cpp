#include <cstddef>
#include <cstdint>
#include <string_view>

#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/grounding.h"

/// Domains of both languages. A domain that is read is also written and grounded; all that may come of it is an Error.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace kinegraph;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    LogicProblem problem;
    problem.domain = readFol(text, "fuzz.fol");
    problem.start = problem.domain.start;
    readFol(writeFol(problem.domain));
    ground(problem, 1000);
  } catch (const Error&) {
  }
  try {
    readLiterals(text);
  } catch (const Error&) {
  }
  try {
    const LogicDomain domain = readPddlDomain(text, "fuzz.pddl");
    readPddlDomain(writePddlDomain(domain));
    readPddlProblem(text, domain);
  } catch (const Error&) {
  }
  return 0;
}
