#include "kinegraph/parsers/mjcf/mjcf_reader.h"

#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/parsers/mjcf/mjcf_body_masses.h"
#include "kinegraph/parsers/mjcf/mjcf_check.h"
#include "kinegraph/parsers/mjcf/mjcf_contacts.h"
#include "kinegraph/parsers/mjcf/mjcf_couplings.h"
#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/mjcf/mjcf_dynamics.h"
#include "kinegraph/parsers/mjcf/mjcf_keyframes.h"
#include "kinegraph/parsers/mjcf/mjcf_shapes.h"
#include "kinegraph/parsers/mjcf/mjcf_values.h"
#include "kinegraph/parsers/xml/axis_motion.h"

namespace kinegraph::inline parsers_internal {

namespace {

/// A joint of a body, and the pose of the <frame> around it.
struct BodyJoint {
  MjcfElement element;
  Pose frame;
};

/// The body that receives elements, and their coordinates.
struct Place {
  std::string frame;  ///< frame of the scene
  std::string body;   ///< its name
  Pose pose;          ///< of the coordinates in that frame; not the identity inside <frame>
  std::string childclass;
  bool on_world = true;               ///< fixed to the world
  bool hangs_on_world = true;         ///< fixed to the world, or connected to it by one joint
  int contact = 1;                    ///< flag of its geoms
  bool with_mass = false;             ///< its geoms have masses
  std::optional<std::size_t> masses;  ///< its number in MjcfBodyMasses; none for the world
};

class MjcfReader {
 public:
  MjcfReader(MjcfDocument& document, Findings& findings)
      : document_(document),
        findings_(findings),
        values_(document, findings),
        shapes_(document, values_, findings),
        masses_(document.settings()) {}

  Graph read() {
    const std::vector<const XmlElement*> worlds = document_.root().all("worldbody");
    names_.insert("world");
    for (const char* kind : {"body", "joint", "freejoint", "site", "camera", "geom"}) {
      for (const XmlElement* world : worlds) nameAll(*world, kind, "world");
    }
    for (const XmlElement* world : worlds) collectJoints(*world, "");
    couplings_ = mjcfCouplings(document_, named_joints_, values_, findings_);
    collectExclusions();
    if (findings_.failed()) return {};
    contacts_ = mjcfContacts(document_, values_, frame_of_, excluded_, findings_);
    motors_ = mjcfMotors(document_, values_, findings_);
    warnOfMjcfDynamics(document_, findings_);
    FrameAttributes attributes(worlds.empty() ? document_.root().where : worlds[0]->where);
    addFrame("world", "", document_.root().where, std::move(attributes));
    Place place;
    place.frame = place.body = "world";
    addExclusions("world", graph_.nodes.back());
    for (const XmlElement* world : worlds) addShapes(*world, place);
    for (const XmlElement* world : worlds) addBodies(*world, place);
    for (Node& frame : graph_.nodes) {
      Node* mimic = std::get<Graph>(frame.value.data).find("mimic");
      const auto body =
          mimic ? bodies_of_joints_.find(std::get<std::string>(mimic->value.data)) : bodies_of_joints_.end();
      if (body != bodies_of_joints_.end()) mimic->value.data = body->second;
    }
    for (MjcfJointPlace& joint : joints_) {
      if (const auto body = bodies_of_joints_.find(joint.frame); body != bodies_of_joints_.end())
        joint.frame = body->second;
    }
    masses_.apply(graph_);
    addKeyframes(document_, joints_, graph_, findings_);
    const auto frameOf = [&](const MjcfName& name) {
      const auto element = elements_.find(name);
      if (element == elements_.end()) return std::string();
      const std::string& frame = frame_of_.at(element->second);
      const auto body = bodies_of_joints_.find(frame);
      return body == bodies_of_joints_.end() ? frame : body->second;
    };
    addActuators(document_, frameOf, graph_);
    values_.angleUnits().ask();
    return std::move(graph_);
  }

 private:
  /// Returns `name`, or a name derived from it if it is taken.
  std::string unusedName(const std::string& name, const std::string& kind) {
    if (names_.insert(name).second) return name;
    const std::string longer = cat(name, "_", kind);
    if (names_.insert(longer).second) return longer;
    for (int& number = numbers_[longer];;) {
      const std::string numbered = cat(longer, "_", ++number);
      if (names_.insert(numbered).second) return numbered;
    }
  }

  /// Assigns a frame name to every element of a kind.
  void nameAll(const XmlElement& container, const std::string& kind, const std::string& body) {
    int shapes = 0;
    nameIn(container, kind, body, shapes);
  }

  void nameIn(const XmlElement& container, const std::string& kind, const std::string& body, int& shapes) {
    for (const XmlElement& child : container.children) {
      if (child.name == kind) nameOne(child, kind == "freejoint" ? "joint" : kind, body, shapes);
      if (child.name == "body") nameAll(child, kind, frame_of_.at(&child));
      if (child.name == "frame") nameIn(child, kind, body, shapes);
    }
  }

  void nameOne(const XmlElement& element, const std::string& kind, const std::string& body, int& shapes) {
    const XmlAttribute* given = element.attribute("name");
    if (given && !given->value.empty()) {
      frame_of_[&element] = unusedName(given->value, kind);
      const auto [other, is_new] = elements_.emplace(std::pair(kind, given->value), &element);
      if (!is_new && (kind == "body" || kind == "joint")) {
        findings_.error(given->where,
                        cat("the ", kind, " '", given->value, "' is already defined at ", other->second->where.str()));
      }
    } else if (kind == "geom") {
      frame_of_[&element] = unusedName(cat(body, "_", shapes), kind);
    } else {
      frame_of_[&element] = unusedName(cat(body, "_", kind), kind);
    }
    if (kind == "geom") ++shapes;
  }

  static std::string childclassOf(const XmlElement& element, const std::string& otherwise) {
    const XmlAttribute* own = element.attribute("childclass");
    return own ? own->value : otherwise;
  }

  /// Returns an element with its defaults, after checking it.
  MjcfElement element(const XmlElement& xml, const std::string& childclass) {
    checkMjcfAttributes(xml, findings_);
    if (const XmlAttribute* reference = xml.attribute("class")) document_.checkClass(*reference);
    return document_.element(xml, childclass);
  }

  /// Collects all named joints, and checks the elements of all bodies.
  void collectJoints(const XmlElement& container, const std::string& outer_class) {
    checkMjcfBody(container, findings_);
    if (const XmlAttribute* reference = container.attribute("childclass")) document_.checkClass(*reference);
    const std::string childclass = childclassOf(container, outer_class);
    for (const XmlElement& child : container.children) {
      if (child.name == "body" || child.name == "frame") collectJoints(child, childclass);
      if (child.name != "joint" && child.name != "freejoint") continue;
      const MjcfElement joint = element(child, childclass);
      if (!joint.name().empty()) named_joints_.emplace(joint.name(), joint);
    }
  }

  /// Collects excluded body pairs, keyed by the element of the first body.
  void collectExclusions() {
    std::vector<std::string> bodies = {"world"};
    for (const auto& [key, element] : elements_) {
      if (key.first == "body") bodies.push_back(key.second);
    }
    for (const XmlElement* exclude : document_.inSections("contact", "exclude")) {
      std::vector<std::string> frames;
      for (const char* role : {"body1", "body2"}) {
        const XmlAttribute* name = exclude->attribute(role);
        if (!name) {
          findings_.warn(exclude->where, cat("<exclude> has no attribute '", role, "'; it is left out"));
          continue;
        }
        const auto found = elements_.find({"body", name->value});
        if (found == elements_.end() && name->value != "world") {
          findings_.warn(name->where, cat("<exclude>: there is no body '", name->value, "'; it is left out",
                                          similarHint(name->value, bodies)));
          continue;
        }
        frames.push_back(found == elements_.end() ? "world" : frame_of_.at(found->second));
      }
      if (frames.size() == 2 && frames[0] != "world") excluded_[frames[0]].push_back(frames[1]);
      if (frames.size() == 2 && frames[0] == "world") excluded_[frames[1]].push_back(frames[0]);
    }
  }

  void addExclusions(const std::string& name, Node& frame) const {
    const auto others = contacts_.excluded.find(name);
    if (others == contacts_.excluded.end()) return;
    Node node;
    node.key = "contact_exclude";
    node.where = node.value.where = frame.where;
    node.value.data = StringArray(others->second);
    std::get<Graph>(frame.value.data).nodes.push_back(std::move(node));
  }

  void addFrame(const std::string& name, const std::string& parent, const SourcePosition& where,
                FrameAttributes attributes) {
    graph_.nodes.push_back(attributes.takeFrame(name, parent, where));
  }

  /// The same body, in the coordinates of a <frame>.
  Place inFrame(const XmlElement& frame, const Place& place) {
    Place inner = place;
    inner.pose = place.pose * values_.pose(MjcfElement(frame, {}));
    inner.childclass = childclassOf(frame, place.childclass);
    return inner;
  }

  void addShapes(const XmlElement& container, const Place& place) {
    for (const XmlElement& child : container.children) {
      if (child.name == "frame") {
        addShapes(child, inFrame(child, place));
        continue;
      }
      const bool is_geom = child.name == "geom", is_site = child.name == "site";
      if (!is_geom && !is_site && child.name != "camera") continue;
      const MjcfElement described = element(child, place.childclass);
      const int contact = contacts_.colliding.contains(&child) ? place.contact : 0;
      MjcfShapes::Placed placed = is_geom   ? shapes_.geom(described, contact, place.with_mass)
                                  : is_site ? shapes_.site(described)
                                            : shapes_.camera(described);
      placed.attributes.addPose(place.pose * placed.pose);
      addFrame(frame_of_.at(&child), place.frame, child.where, std::move(placed.attributes));
      addExclusions(frame_of_.at(&child), graph_.nodes.back());
      if (place.masses)
        masses_.addPart(*place.masses, graph_.nodes.size() - 1, std::get<Graph>(graph_.nodes.back().value.data),
                        place.pose * placed.pose);
    }
  }

  void addBodies(const XmlElement& container, const Place& place) {
    for (const XmlElement& child : container.children) {
      if (child.name == "frame") addBodies(child, inFrame(child, place));
      if (child.name == "body") addBody(child, place);
    }
  }

  std::vector<BodyJoint> jointsOf(const XmlElement& container, const Place& place) {
    std::vector<BodyJoint> joints;
    for (const XmlElement& child : container.children) {
      if (child.name == "joint" || child.name == "freejoint")
        joints.push_back({document_.element(child, place.childclass), place.pose});
      if (child.name != "frame") continue;
      const std::vector<BodyJoint> inner = jointsOf(child, inFrame(child, place));
      joints.insert(joints.end(), inner.begin(), inner.end());
    }
    return joints;
  }

  void addBody(const XmlElement& body, const Place& outer) {
    checkMjcfAttributes(body, findings_);
    const std::string& name = frame_of_.at(&body);
    Place place;
    place.frame = place.body = name;
    place.childclass = childclassOf(body, outer.childclass);
    Pose pose = outer.pose * values_.pose(MjcfElement(body, {}));
    std::string parent = outer.frame;
    const std::vector<BodyJoint> joints = jointsOf(body, place);
    std::optional<FrameAttributes> own_joint;
    int moving = 0;
    for (std::size_t i = 0; i < joints.size(); ++i) {
      const bool last = i + 1 == joints.size();
      if (addJoint(joints[i], outer, last ? name : "", joints.size() == 1, parent, pose, own_joint)) ++moving;
    }
    place.on_world = outer.on_world && moving == 0;
    place.hangs_on_world = moving > 0 ? outer.on_world : outer.hangs_on_world;
    place.contact = place.hangs_on_world ? 1 : moving > 0 ? -moving : outer.contact;
    FrameAttributes attributes = own_joint ? std::move(*own_joint) : FrameAttributes(body.where);
    if (!own_joint) attributes.addPose(pose);
    const XmlElement* inertial = body.child("inertial");
    const MjcfSettings& settings = document_.settingsAt(body.where);
    place.with_mass = settings.masses_only_of_geoms || (settings.masses_of_geoms && !inertial);
    if (inertial && !settings.masses_only_of_geoms) addMjcfInertial(*inertial, values_, findings_, attributes);
    const double compensation = values_.number(MjcfElement(body, {}), "gravcomp", 0.);
    if (compensation != 0.) attributes.add("gravityCompensation", compensation);
    addFrame(name, parent, body.where, std::move(attributes));
    addExclusions(name, graph_.nodes.back());
    place.masses = masses_.addBody(graph_.nodes.size() - 1);
    masses_.addPart(*place.masses, graph_.nodes.size() - 1, std::get<Graph>(graph_.nodes.back().value.data), Pose());
    addShapes(body, place);
    addBodies(body, place);
  }

  /// Adds the frames of a joint below `parent` at `pose`, and updates both for the next element. A last joint without a
  /// name may be the frame `body` itself: `own` then gets its attributes. Returns whether the joint moves.
  bool addJoint(const BodyJoint& joint, const Place& outer, const std::string& body, bool alone, std::string& parent,
                Pose& pose, std::optional<FrameAttributes>& own) {
    const MjcfElement& element = joint.element;
    const std::string type = element.xml().name == "freejoint"
                                 ? "free"
                                 : values_.keyword(element, "type", {"hinge", "slide", "ball", "free"}, "hinge");
    FrameAttributes attributes(element.where());
    const std::string& name = frame_of_.at(&element.xml());
    joints_.push_back({name, type == "free" ? 7 : type == "ball" ? 4 : 1});
    const auto place = [&](const Pose& before, const Pose& behind) {
      if (!before.isIdentity(0.)) {
        FrameAttributes at(element.where());
        at.addPose(before);
        const std::string origin = unusedName(name + "_origin", "origin");
        addFrame(origin, parent, element.where(), std::move(at));
        parent = origin;
      }
      pose = behind;
      if ((element.name().empty() || element.name() == body) && !body.empty() && behind.isIdentity(0.)) {
        own = std::move(attributes);
        bodies_of_joints_[name] = body;
        return;
      }
      addFrame(name, parent, element.where(), std::move(attributes));
      parent = name;
    };
    if (type == "free") {
      if (outer.body != "world" || !alone) {
        findings_.error(element.where(), cat(element.describe(), ": a free joint must be the only one of its body, ",
                                             "and its body must be directly in <worldbody>"));
        return true;
      }
      const Vector7d start = pose.numbers();
      attributes.add("joint", std::string("free"));
      attributes.addNumbers("q", {start.begin(), start.end()});
      place(Pose(), Pose());
      return true;
    }
    const Pose anchor(joint.frame.p + joint.frame.q * values_.vector(element, "pos", Vector3d::Zero()),
                      Quaterniond::Identity());
    if (type == "ball") {
      attributes.add("joint", std::string("quatBall"));
      if (element.attribute("range"))
        findings_.warn(element.where(), cat(element.describe(), ": the range of a ball joint is not kept"));
      addDynamics(element, attributes);
      place(pose * anchor, anchor.inverse());
      return true;
    }
    return addAxisJoint(joint, type, anchor, pose, attributes, place);
  }

  template <class PlaceJoint>
  bool addAxisJoint(const BodyJoint& joint, const std::string& type, const Pose& given_anchor, const Pose& pose,
                    FrameAttributes& attributes, const PlaceJoint& place) {
    const MjcfElement& element = joint.element;
    Vector3d axis = joint.frame.q * values_.vector(element, "axis", Vector3d::UnitZ());
    if (!(axis.norm() > 1e-10)) {
      findings_.error(element.attribute("axis")->where, cat(element.describe(), ": its axis is zero"));
      return true;
    }
    axis.normalize();
    const bool slides = type == "slide";
    const Pose anchor = slides ? Pose() : given_anchor;
    const AxisMotion motion = slides ? translationAlong(axis) : rotationAbout(axis);
    const double reference = mjcfReference(element, values_);
    const auto coupling = couplings_.find(element.name());
    const bool coupled = !element.name().empty() && coupling != couplings_.end();
    const double offset = (coupled ? coupling->second.offset : 0.) - reference;
    Pose before = pose * anchor;
    if (offset != 0.)
      before = before * (slides ? Pose(offset * axis, Quaterniond::Identity())
                                : Pose(Vector3d::Zero(), Quaterniond(Eigen::AngleAxisd(offset, axis))));
    if (coupled && coupling->second.source.empty()) {
      attributes.addPose(before);
      place(Pose(), anchor.inverse());
      return false;
    }
    const Pose rotation(Vector3d::Zero(), motion.rotation);
    attributes.add("joint", std::string(motion.type));
    if (std::string_view(motion.type) == "hinge") attributes.addNumbers("axis", {axis.begin(), axis.end()});
    double scale = motion.scale;
    if (coupled) {  // multiplies the source's motion, including the source's own scale
      const MjcfElement& source = named_joints_.at(coupling->second.source);
      scale *= coupling->second.factor * scaleOf(source);
      attributes.add("mimic", frame_of_.at(&source.xml()));
    }
    if (scale != 1.) attributes.add("joint_scale", scale);
    addLimits(element, slides, attributes);
    addDynamics(element, attributes);
    if (!coupled && reference != 0.) attributes.addNumbers("q", {reference});
    place(before * rotation, rotation.inverse() * anchor.inverse());
    return true;
  }

  /// 1, or -1 for a slide against a coordinate axis.
  double scaleOf(const MjcfElement& joint) {
    const Vector3d axis = values_.vector(joint, "axis", Vector3d::UnitZ());
    const bool slides = values_.keyword(joint, "type", {"hinge", "slide", "ball", "free"}, "hinge") == "slide";
    return slides && axis.norm() > 0. ? translationAlong(axis.normalized()).scale : 1.;
  }

  void addDynamics(const MjcfElement& element, FrameAttributes& attributes) {
    const auto motor = motors_.find(element.name());
    const bool has_motor = motor != motors_.end() && !element.name().empty();
    addMjcfJointDynamics(element, has_motor ? &motor->second : nullptr, values_, attributes);
  }

  void addLimits(const MjcfElement& element, bool slides, FrameAttributes& attributes) {
    const std::string limited = values_.keyword(element, "limited", {"auto", "true", "false"}, "auto");
    const std::vector<double> range = values_.limits(element, "range");
    const bool by_range = document_.settingsAt(element.where()).limited_by_range && !range.empty();
    if (limited == "false" || (limited == "auto" && !by_range) || range.empty()) return;
    if (!(range[0] < range[1])) {
      return findings_.warn(element.attribute("range")->where,
                            cat(element.describe(), ": its lower limit ", range[0], " is not below its upper limit ",
                                range[1], "; it is read as unlimited"));
    }
    const bool degrees = !slides && document_.settingsAt(element.where()).degrees;
    if (!slides) values_.angleUnits().addRange(element.attribute("range")->where, range, degrees);
    const auto internal = [&](double value) { return degrees ? value / 180. * M_PI : value; };
    attributes.addNumbers("limits", {internal(range[0]), internal(range[1])});
  }

  MjcfDocument& document_;
  Findings& findings_;
  MjcfValues values_;
  MjcfShapes shapes_;
  Graph graph_;
  std::set<std::string> names_;         ///< names of frames
  std::map<std::string, int> numbers_;  ///< last number appended to each name
  std::map<const XmlElement*, std::string> frame_of_;
  std::map<std::pair<std::string, std::string>, const XmlElement*> elements_;  ///< by kind and name
  std::map<std::string, std::string> bodies_of_joints_;  ///< joints that are the frames of their bodies
  std::vector<MjcfJointPlace> joints_;                   ///< in the order of qpos
  std::map<std::string, MjcfElement> named_joints_;
  std::map<std::string, MjcfCoupling> couplings_;
  std::map<std::string, std::vector<std::string>> excluded_;  ///< frames, by frame; from <exclude>
  MjcfContacts contacts_;
  std::map<std::string, MjcfMotor> motors_;  ///< by joint
  MjcfBodyMasses masses_;
};

}  // namespace

ParseResult readMjcf(std::string_view text, const std::string& file, const std::string& folder) {
  ParseResult result;
  Findings findings(result.diagnostics);
  MjcfDocument document(text, file, folder, findings);
  if (!findings.failed()) checkMjcfSections(document, findings);
  if (!findings.failed()) result.graph = MjcfReader(document, findings).read();
  if (findings.failed()) result.graph = {};
  result.included = std::move(document.included());
  return result;
}

}  // namespace kinegraph::inline parsers_internal
