#pragma once

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/parsers/xml/findings.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline parsers_internal {

/// A name of an MJCF element: its kind ("body", "joint", "mesh", "class", ...) and the name.
using MjcfName = std::pair<std::string, std::string>;

/// Replaces the names of an element and of all elements inside of it, where they are defined and where they are
/// referred to. `change` returns the new name.
void renameMjcf(XmlElement& element, const std::function<std::string(const MjcfName&)>& change);

/// The names that an element and the elements inside of it refer to, or define.
std::set<MjcfName> mjcfReferences(const XmlElement& element);
std::set<MjcfName> mjcfDefinitions(const XmlElement& element);

/// Replaces each <replicate> in the bodies of `root` by a <frame> per copy: copy i of `count` is rotated by
/// `rotationOf` i times its `euler` and moved from the copy before by `offset`, in that copy's axes. Its names get
/// the suffix `sep` i, with as many digits as `count` has. Elements outside of the bodies that refer to copied names
/// are copied, too.
void expandReplicates(XmlElement& root, const std::function<Quaterniond(const std::vector<double>&)>& rotationOf,
                      Findings& findings);

/// The part of the model `model` that an <attach> adds: `model` has only the bodies (all, or the body of that name),
/// the assets, and the elements that refer to nothing else. All names have a prefix. Returns false after an error.
bool cutOutModel(const XmlElement& attach, XmlElement& model, Findings& findings);

}  // namespace kinegraph::inline parsers_internal
