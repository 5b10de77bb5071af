#include "kinegraph/parsers/mjcf/mjcf_contacts.h"

#include <algorithm>

#include "kinegraph/common/text.h"

namespace kinegraph::inline parsers_internal {

namespace {

using FramePairs = std::set<std::pair<std::string, std::string>>;

struct ContactGeom {
  const XmlElement* xml;
  std::string name, frame;
  long type, affinity;
};

struct ContactBody {
  std::string frame;
  int weld;   ///< bodies with the same number never move apart
  int above;  ///< weld that carries this one, or -1
  std::vector<ContactGeom> geoms;
};

std::pair<std::string, std::string> ordered(const std::string& a, const std::string& b) {
  return a < b ? std::pair(a, b) : std::pair(b, a);
}

class ContactCollector {
 public:
  ContactCollector(const MjcfDocument& document, MjcfValues& values,
                   const std::map<const XmlElement*, std::string>& frame_of, Findings& findings)
      : document_(document), values_(values), frame_of_(frame_of), findings_(findings) {
    bodies_.push_back({"world", 0, -1, {}});
    for (const XmlElement* world : document_.root().all("worldbody")) visit(*world, "", 0);
  }

  MjcfContacts find(const std::map<std::string, std::vector<std::string>>& excluded_bodies) {
    for (const auto& [frame, others] : excluded_bodies) {
      for (const std::string& other : others) excluded_.insert(ordered(frame, other));
    }
    collectPairs();
    warnOfFlags();
    for (std::size_t i = 0; i < bodies_.size(); ++i) {
      for (std::size_t j = i + 1; j < bodies_.size(); ++j) addBodies(bodies_[i], bodies_[j]);
    }
    for (const ContactBody& body : bodies_) {
      for (const ContactGeom& geom : body.geoms) {
        if (geom.type != 0 || geom.affinity != 0 || paired_.contains(geom.frame)) result_.colliding.insert(geom.xml);
      }
    }
    return std::move(result_);
  }

 private:
  static bool hasJoint(const XmlElement& body) {
    return std::any_of(body.children.begin(), body.children.end(), [](const XmlElement& child) {
      return child.name == "joint" || child.name == "freejoint" || (child.name == "frame" && hasJoint(child));
    });
  }

  void visit(const XmlElement& container, const std::string& outer_class, std::size_t body) {
    const XmlAttribute* own = container.attribute("childclass");
    const std::string childclass = own ? own->value : outer_class;
    for (const XmlElement& child : container.children) {
      if (child.name == "frame") visit(child, childclass, body);
      if (child.name == "geom") addGeom(child, childclass, body);
      if (child.name != "body") continue;
      const bool moves = hasJoint(child);
      const int weld = moves ? ++welds_ : bodies_[body].weld, above = moves ? bodies_[body].weld : bodies_[body].above;
      bodies_.push_back({frame_of_.at(&child), weld, above, {}});
      visit(child, childclass, bodies_.size() - 1);
    }
  }

  void addGeom(const XmlElement& xml, const std::string& childclass, std::size_t body) {
    const MjcfElement geom = document_.element(xml, childclass);
    bodies_[body].geoms.push_back({&xml, geom.name(), frame_of_.at(&xml), long(values_.number(geom, "contype", 1.)),
                                   long(values_.number(geom, "conaffinity", 1.))});
  }

  void collectPairs() {
    std::map<std::string, std::pair<const ContactBody*, std::string>> places;  // of named geoms
    std::vector<std::string> names;
    for (const ContactBody& body : bodies_) {
      for (const ContactGeom& geom : body.geoms) {
        if (!geom.name.empty()) places[geom.name] = {&body, geom.frame};
        if (!geom.name.empty()) names.push_back(geom.name);
      }
    }
    for (const XmlElement* pair : document_.inSections("contact", "pair")) {
      std::vector<std::pair<const ContactBody*, std::string>> ends;
      for (const char* role : {"geom1", "geom2"}) {
        const XmlAttribute* name = pair->attribute(role);
        const auto found = name ? places.find(name->value) : places.end();
        if (found != places.end()) ends.push_back(found->second);
        if (name && found == places.end())
          findings_.warn(name->where, cat("<pair>: there is no geom '", name->value, "'; the pair is ignored",
                                          similarHint(name->value, names)));
      }
      if (ends.size() != 2) continue;
      const auto [a, b] = std::pair(ends[0].first, ends[1].first);
      if (a->weld == b->weld || (a->weld > 0 && b->weld > 0 && (a->above == b->weld || b->above == a->weld))) {
        findings_.warn(pair->where, cat("<pair> of '", ends[0].second, "' and '", ends[1].second,
                                        "': bodies that one joint connects, or none, do not collide here"));
      }
      pairs_.insert(ordered(ends[0].second, ends[1].second));
      for (const auto& end : ends) paired_.insert(end.second);
    }
  }

  /// `<flag filterparent="disable">`: neighbors collide in MuJoCo. `<flag contact="disable">`: nothing does.
  void warnOfFlags() {
    for (const XmlElement* flag : document_.inSections("option", "flag")) {
      const auto disabled = [&](const char* name) {
        const XmlAttribute* attribute = flag->attribute(name);
        return attribute && attribute->value == "disable" ? attribute : nullptr;
      };
      if (const XmlAttribute* filter = disabled("filterparent"))
        findings_.warn(filter->where, "filterparent=\"disable\": bodies that one joint connects do not collide here");
      if (const XmlAttribute* contact = disabled("contact"))
        findings_.warn(contact->where, "contact=\"disable\": shapes collide here, by their contype and conaffinity");
    }
  }

  bool allowed(const ContactBody& a, const ContactGeom& x, const ContactBody& b, const ContactGeom& y) const {
    if (pairs_.contains(ordered(x.frame, y.frame))) return true;
    return ((x.type & y.affinity) != 0 || (y.type & x.affinity) != 0) && !excluded_.contains(ordered(a.frame, b.frame));
  }

  /// Returns whether a geom collides with nothing, whatever its partners.
  bool isVisual(const ContactGeom& x) const { return x.type == 0 && x.affinity == 0 && !paired_.contains(x.frame); }

  void addBodies(const ContactBody& a, const ContactBody& b) {
    if (a.weld == b.weld) return;
    int allowed_pairs = 0;
    FramePairs refused;
    for (const ContactGeom& x : a.geoms) {
      if (isVisual(x)) continue;
      for (const ContactGeom& y : b.geoms) {
        if (isVisual(y)) continue;
        if (allowed(a, x, b, y))
          ++allowed_pairs;
        else
          refused.insert({x.frame, y.frame});
      }
    }
    const bool named = excluded_.contains(ordered(a.frame, b.frame));
    if (allowed_pairs == 0 && (named || !refused.empty())) refused = {{a.frame, b.frame}};
    for (const auto& [x, y] : refused) {  // the frame `world` keeps no list
      const bool first = x != "world";
      result_.excluded[first ? x : y].push_back(first ? y : x);
    }
  }

  const MjcfDocument& document_;
  MjcfValues& values_;
  const std::map<const XmlElement*, std::string>& frame_of_;
  Findings& findings_;
  std::vector<ContactBody> bodies_;
  int welds_ = 0;
  FramePairs excluded_;  ///< bodies
  FramePairs pairs_;     ///< geoms of <pair>
  std::set<std::string> paired_;
  MjcfContacts result_;
};

}  // namespace

MjcfContacts mjcfContacts(const MjcfDocument& document, MjcfValues& values,
                          const std::map<const XmlElement*, std::string>& frame_of,
                          const std::map<std::string, std::vector<std::string>>& excluded_bodies, Findings& findings) {
  return ContactCollector(document, values, frame_of, findings).find(excluded_bodies);
}

}  // namespace kinegraph::inline parsers_internal
