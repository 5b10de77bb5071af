#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/scene/diagnostics.h"
#include "kinegraph/scene/scene_tree.h"

namespace kinegraph {

/// What a file says about the frames of a robot besides what they are: an SRDF file. Frames are meant by their names.
struct RobotSemantics {
  struct Pair {
    std::string a, b;  ///< links; an empty `b` stands for all others
    SourcePosition where;
  };
  struct Member {
    enum class Kind { joint, link, chain, group } kind;
    std::string name, tip;  ///< of a chain the first and the last link
    SourcePosition where;
  };
  struct Group {
    std::string name;
    std::vector<Member> members;
  };
  struct JointValue {
    std::string joint;
    std::vector<double> values;  ///< as SRDF orders them: of a floating joint x y z qx qy qz qw
    SourcePosition where;
  };
  struct State {
    std::string name, group;
    std::vector<JointValue> joints;
  };

  std::vector<Pair> no_contact, contact;  ///< `contact` takes pairs out of those without
  std::vector<Group> groups;
  std::vector<State> states;
  std::vector<std::string> outside;  ///< joints of the robot to its world, which are no frames of it
  std::string file, prefix;          ///< `prefix` is put before the names of frames
  bool asked_for =
      true;  ///< else it was found beside the robot's file, and names that are not there are nobody's mistake
};

/// Enters it into the frames: `contact_exclude`, and the attributes `joint_groups` and `joint_states` of joints. Names
/// that are not there are warnings, and an error if none is.
void applySemantics(const RobotSemantics& semantics, SceneTree& scene, SceneDiagnostics& diagnostics);

/// The semantics of a text. Defined in formats/, the layer above, like sceneFormats().
RobotSemantics readSemantics(std::string_view text, const std::string& file, std::vector<Diagnostic>& found);

/// Is it a file of that kind, by its name?
bool isSemanticsFile(const std::string& file);

/// The SRDF file that belongs to a URDF file: of the same name, beside it, or in a folder srdf beside its folder. "" if
/// there is none.
std::string semanticsBeside(const std::string& file);

}  // namespace kinegraph
