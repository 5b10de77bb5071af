#include "scene/scene_values.h"

#include <nanobind/stl/string.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"

namespace kinegraph::python {

namespace {

struct ToPython {
  nb::object operator()(bool b) const { return nb::bool_(b); }
  nb::object operator()(double x) const { return nb::float_(x); }
  nb::object operator()(const std::string& s) const { return nb::str(s.c_str(), s.size()); }
  nb::object operator()(const NumberArray& a) const {
    nb::list list;
    for (double x : a.numbers) list.append(x);
    return list;
  }
  nb::object operator()(const StringArray& a) const {
    nb::list list;
    for (const std::string& s : a) list.append(nb::str(s.c_str(), s.size()));
    return list;
  }
  nb::object operator()(const ValueList& l) const {
    nb::list list;
    for (const Value& v : l) list.append(fromValue(v));
    return list;
  }
  nb::object operator()(const AngleText& t) const {
    const std::string quoted = cat("<", t.text, ">");  // in the form that addDict reads
    return nb::str(quoted.c_str(), quoted.size());
  }
  nb::object operator()(const NameTuple& t) const {
    nb::list list;
    for (const std::string& s : t.names) list.append(nb::str(s.c_str()));
    return list;
  }
  nb::object operator()(const Graph& g) const { return toDict(g); }
};

}  // namespace

nb::object fromValue(const Value& value) { return std::visit(ToPython{}, value.data); }

nb::dict toDict(const Graph& graph) {
  nb::dict dict;
  for (const Node& node : graph.nodes) {
    std::string key = node.key;
    if (!node.parents.empty()) key += cat("(", join(node.parents, " "), ")");
    nb::object name = nb::str(key.c_str(), key.size());
    dict[name] = fromValue(node.value);
  }
  return dict;
}

Value toValue(nb::handle value, const std::string& name) {
  Value out;
  Numbers numbers;
  if (nb::isinstance<nb::bool_>(value)) {
    out.data = nb::cast<bool>(value);
  } else if (nb::isinstance<nb::str>(value)) {
    std::string text = nb::cast<std::string>(value);
    if (text.size() > 2 && text.starts_with('<') && text.ends_with('>')) {
      out.data = AngleText{text.substr(1, text.size() - 2)};
    } else {
      out.data = std::move(text);
    }
  } else if (nb::isinstance<nb::dict>(value)) {
    Graph graph;
    for (const auto& [key, entry] : nb::cast<nb::dict>(value)) {
      Node node;
      node.key = nb::cast<std::string>(key);
      node.value = toValue(entry, node.key);
      graph.nodes.push_back(std::move(node));
    }
    out.data = std::move(graph);
  } else if (readNumbers(value, numbers)) {
    if (numbers.rank == 0) {
      out.data = numbers.values[0];
    } else {
      out.data = NumberArray{numbers.list(), 1};
    }
  } else if (nb::isinstance<nb::sequence>(value)) {
    StringArray strings;
    ValueList values;
    for (nb::handle item : nb::cast<nb::sequence>(value)) {
      nb::isinstance<nb::str>(item) ? strings.push_back(nb::cast<std::string>(item))
                                    : values.push_back(toValue(item, name));
    }
    if (!strings.empty() && !values.empty())
      throw ValueError(cat("attribute '", name, "': expected a list of only strings, or without strings"));
    if (values.empty()) {
      out.data = std::move(strings);
    } else {
      out.data = std::move(values);
    }
  } else {
    throw ValueError(cat("attribute '", name, "' is neither bool, number, text, list nor dict"));
  }
  return out;
}

std::string describe(const Frame& frame) {
  std::string text = cat("<Frame '", frame.getName(), "'");
  if (frame.getShapeType() != ShapeType::none) text += cat(", ", shapeTypeName(frame.getShapeType()));
  if (frame.getJointType() != JointType::none) text += cat(", joint ", jointTypeName(frame.getJointType()));
  if (const auto parent = frame.getParent()) text += cat(", parent '", parent->getName(), "'");
  return text + ">";
}

}  // namespace kinegraph::python
