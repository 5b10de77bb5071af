#pragma once

#include <optional>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/mjcf/mjcf_mass.h"
#include "kinegraph/parsers/mjcf/mjcf_values.h"
#include "kinegraph/parsers/xml/frame_attributes.h"

namespace kinegraph::inline parsers_internal {

/// Adds mass, center of mass and inertia of an <inertial>.
void addMjcfInertial(const XmlElement& xml, MjcfValues& values, Findings& findings, FrameAttributes& attributes);

/// Applies the rules of <compiler> to the masses of whole bodies: boundmass, boundinertia, balanceinertia and
/// settotalmass.
class MjcfBodyMasses {
 public:
  explicit MjcfBodyMasses(const MjcfSettings& settings) : settings_(settings) {}

  /// Starts a body; `node` is the index of its frame in the graph.
  std::size_t addBody(std::size_t node);

  /// Adds a frame with a mass to a body, at the pose `X` in its frame.
  void addPart(std::size_t body, std::size_t node, const Graph& attributes, const Pose& X);

  /// Changes the masses in the graph as the settings demand.
  void apply(Graph& graph) const;

 private:
  struct Body {
    std::size_t node;
    std::vector<std::size_t> parts;  ///< nodes with masses
    PartMass sum;
  };
  void bound(Body& body, Graph& graph) const;

  const MjcfSettings& settings_;
  std::vector<Body> bodies_;
};

}  // namespace kinegraph::inline parsers_internal
