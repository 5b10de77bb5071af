#include "kinegraph/parsers/mjcf/mjcf_body_masses.h"

#include <Eigen/Eigenvalues>

#include "kinegraph/common/text.h"
#include "kinegraph/parsers/mjcf/mjcf_check.h"

namespace kinegraph::inline parsers_internal {

namespace {

Graph& attributesOf(Graph& graph, std::size_t node) { return std::get<Graph>(graph.nodes[node].value.data); }

std::vector<double> numbersOf(const Graph& attributes, const char* key) {
  const Node* node = attributes.find(key);
  return node ? node->value.as<NumberArray>()->numbers : std::vector<double>{};
}

PartMass partOf(const Graph& attributes) {
  PartMass part;
  const Node* mass = attributes.find("mass");
  if (!mass) return part;
  part.mass = *mass->value.as<double>();
  if (const auto c = numbersOf(attributes, "com"); c.size() == 3) part.com = {c[0], c[1], c[2]};
  const auto m = numbersOf(attributes, "inertia");
  if (m.size() == 3) part.matrix = Vector3d(m[0], m[1], m[2]).asDiagonal();
  if (m.size() == 6) part.matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
  return part;
}

void removeMass(Graph& attributes) {
  std::erase_if(attributes.nodes,
                [](const Node& node) { return node.key == "mass" || node.key == "com" || node.key == "inertia"; });
}

void setMass(Graph& attributes, const PartMass& part, const SourcePosition& where) {
  removeMass(attributes);
  const auto add = [&](const char* key, auto data) {
    Node node;
    node.key = key;
    node.where = node.value.where = where;
    node.value.data = std::move(data);
    attributes.nodes.push_back(std::move(node));
  };
  const Matrix3d& m = part.matrix;
  add("mass", part.mass);
  add("com", NumberArray{{part.com[0], part.com[1], part.com[2]}, 1});
  add("inertia", NumberArray{{m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)}, 1});
}

}  // namespace

void addMjcfInertial(const XmlElement& xml, MjcfValues& values, Findings& findings, FrameAttributes& attributes) {
  checkMjcfAttributes(xml, findings);
  const MjcfElement element(xml, {});
  const double mass = values.number(element, "mass", 0.);
  if (!xml.attribute("mass") || mass < 0.) {
    return findings.error(xml.where, xml.attribute("mass") ? cat("<inertial>: the mass ", mass, " kg is negative")
                                                           : std::string("<inertial> has no attribute 'mass'"));
  }
  if (mass == 0.) return;
  const Pose frame = values.pose(element);
  Matrix3d own = Matrix3d::Zero();
  if (const std::vector<double> m = values.numbers(element, "fullinertia", 6); !m.empty()) {
    own << m[0], m[3], m[4], m[3], m[1], m[5], m[4], m[5], m[2];
  } else {
    own = values.vector(element, "diaginertia", Vector3d::Zero()).asDiagonal();
  }
  const Matrix3d R = frame.q.toRotationMatrix(), m = R * own * R.transpose();
  const SourcePosition body = attributes.setPlace(xml.where);
  attributes.add("mass", mass);
  attributes.addNumbers("com", {frame.p.begin(), frame.p.end()});
  attributes.addNumbers("inertia", {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)});
  attributes.setPlace(body);
}

std::size_t MjcfBodyMasses::addBody(std::size_t node) {
  bodies_.push_back({node, {}, {}});
  return bodies_.size() - 1;
}

void MjcfBodyMasses::addPart(std::size_t body, std::size_t node, const Graph& attributes, const Pose& X) {
  const PartMass part = partOf(attributes);
  if (part.mass <= 0.) return;
  bodies_[body].parts.push_back(node);
  bodies_[body].sum.add(part, X);
}

/// Gives the mass of a body to its frame if the bounds or the balance change it.
void MjcfBodyMasses::bound(Body& body, Graph& graph) const {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(body.sum.matrix);
  Vector3d moments = solver.eigenvalues();
  const Vector3d given = moments;
  const double mass = std::max(body.sum.mass, settings_.bound_mass);
  if (settings_.bound_inertia > 0.) moments = moments.cwiseMax(settings_.bound_inertia);
  if (settings_.balance_inertia && 2. * moments.maxCoeff() > moments.sum()) moments.setConstant(moments.mean());
  if (mass == body.sum.mass && moments == given) return;
  body.sum.mass = mass;
  body.sum.matrix = solver.eigenvectors() * moments.asDiagonal() * solver.eigenvectors().transpose();
  for (const std::size_t part : body.parts) removeMass(attributesOf(graph, part));
  setMass(attributesOf(graph, body.node), body.sum, graph.nodes[body.node].where);
  body.parts = {body.node};
}

void MjcfBodyMasses::apply(Graph& graph) const {
  std::vector<Body> bodies = bodies_;
  double total = 0.;
  for (Body& body : bodies) {
    bound(body, graph);
    total += body.sum.mass;
  }
  if (!(settings_.total_mass > 0.) || !(total > 0.)) return;
  const double factor = settings_.total_mass / total;
  for (const Body& body : bodies) {
    for (const std::size_t node : body.parts) {
      PartMass part = partOf(attributesOf(graph, node));
      part.mass *= factor;
      part.matrix *= factor;
      setMass(attributesOf(graph, node), part, graph.nodes[node].where);
    }
  }
}

}  // namespace kinegraph::inline parsers_internal
