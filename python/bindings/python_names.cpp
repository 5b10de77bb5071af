#include "python_names.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <span>
#include <utility>

namespace kinegraph::python {

namespace {

using Names = std::pair<std::string_view, std::string_view>;

/// Names that differ between C++ and Python.
constexpr std::array kNames = {
    Names{"JointType", "JT"},
    Names{"Komo", "KOMO"},
    Names{"ManipulationHelper", "KOMO_ManipulationHelper"},
    Names{"Nlp", "NLP"},
    Names{"NlpSampler", "NLP_Sampler"},
    Names{"NlpSolver", "NLP_Solver"},
    Names{"ObjectiveType", "OT"},
    Names{"PathCurve", "TimedPath"},  // stores a PathCurve and is pickled with it
    Names{"Recording", "SimulationRecording"},
    Names{"RobotLoop", "BotOp"},
    Names{"ShapeType", "ST"},
    Names{"SolverOptions", "NLP_SolverOptions"},
    Names{"SolverResult", "SolverReturn"},
    Names{"evaluateScalar", "eval_scalar"},
    Names{"objectiveErrorTraces", "info_objectiveErrorTraces"},
    Names{"sliceErrors", "info_sliceErrors"},
};

/// Arguments, as in `first=false`.
constexpr std::array kArguments = {
    Names{"first", "firstSwitch"},
    Names{"transform_mesh", "transformMesh"},
};

bool isWord(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

std::string_view lookUp(std::span<const Names> names, std::string_view word) {
  const auto found = std::find_if(names.begin(), names.end(), [&](const Names& pair) { return pair.first == word; });
  return found == names.end() ? word : found->second;
}

std::string_view nameInPython(char before, std::string_view word, char after) {
  if (before == '=' && word == "true") return "True";
  if (before == '=' && word == "false") return "False";
  return lookUp(after == '=' ? std::span<const Names>(kArguments) : kNames, word);
}

/// Length of the longest name that the text starts with; 0 if there is none.
std::size_t lengthOfName(std::string_view text, std::span<const std::string> names) {
  std::size_t longest = 0;
  for (const std::string& name : names) {
    const bool ends = name.size() >= text.size() || !isWord(text[name.size()]);
    if (text.starts_with(name) && ends) longest = std::max(longest, name.size());
  }
  return longest;
}

}  // namespace

std::string inPython(std::string_view whole, std::span<const std::string> users) {
  const std::size_t similar = whole.find("similar names: ");  // names after this point are the user's
  const std::string_view message = whole.substr(0, similar);
  std::string out;
  bool quoted = false;
  for (std::size_t i = 0; i < message.size();) {
    const char before = i == 0 ? ' ' : message[i - 1], after = i + 1 < message.size() ? message[i + 1] : ' ';
    if (message[i] == '\'' && !isWord(quoted ? after : before))
      quoted = !quoted;  // an apostrophe inside a word is no quote
    if (const std::size_t length = isWord(before) ? 0 : lengthOfName(message.substr(i), users)) {
      out += message.substr(i, length);
      i += length;
    } else if (!quoted && message[i] == ':' && after == ':' && isWord(before)) {
      out += '.';
      i += 2;
    } else if (isWord(message[i])) {
      std::size_t end = i;
      while (end < message.size() && isWord(message[end])) ++end;
      const std::string_view word = message.substr(i, end - i);
      out += quoted ? word : nameInPython(before, word, end < message.size() ? message[end] : ' ');
      i = end;
    } else {
      out += message[i++];
    }
  }
  if (similar != std::string_view::npos) out += whole.substr(similar);
  return out;
}

}  // namespace kinegraph::python
