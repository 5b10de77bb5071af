#pragma once

#include <list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/parsers/xml/findings.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline parsers_internal {

/// An element of an MJCF file, with the elements of its default classes that supply missing attributes.
class MjcfElement {
 public:
  MjcfElement(const XmlElement& xml, std::vector<const XmlElement*> defaults)
      : xml_(&xml), defaults_(std::move(defaults)) {}

  const XmlElement& xml() const { return *xml_; }
  const SourcePosition& where() const { return xml_->where; }
  const XmlAttribute* own(std::string_view name) const { return xml_->attribute(name); }

  /// The element's own attribute, or that of the nearest default, or null.
  const XmlAttribute* attribute(std::string_view name) const;

  /// The attribute in all layers, the outermost default first.
  std::vector<const XmlAttribute*> layers(std::string_view name) const;

  /// Its name, or "".
  std::string name() const;

  /// `<geom name="x">`: for messages.
  std::string describe() const;

 private:
  const XmlElement* xml_;
  std::vector<const XmlElement*> defaults_;  ///< nearest first
};

/// Settings of the element <compiler>.
struct MjcfSettings {
  bool degrees = true;                            ///< angles
  std::string euler_order = "xyz";                ///< lower case: about the axes of the rotated frame
  bool limited_by_range = true;                   ///< a joint with a range is limited
  bool strip_mesh_path = false;                   ///< use only the file name of a mesh path
  bool masses_of_geoms = true;                    ///< bodies without <inertial> get the masses of their geoms
  bool masses_only_of_geoms = false;              ///< ignore <inertial>
  int first_mass_group = 0, last_mass_group = 5;  ///< groups of the geoms that have masses
  double total_mass = -1.;                        ///< kg; negative: as computed
  double bound_mass = 0., bound_inertia = 0.;     ///< least mass of a body, kg, and moment of inertia, kg m^2
  bool balance_inertia = false;                   ///< impossible moments of inertia become their mean
  bool fit_bounds = false;                        ///< primitives fit the bounding box of a mesh, not its inertia
  std::string mesh_folder;                        ///< as written
  std::string texture_folder;                     ///< as written
};

/// The rotation of Euler angles in the units and the order of the settings.
Quaterniond mjcfEuler(const std::vector<double>& angles, const MjcfSettings& settings);

/// An MJCF text with its included files, attached models, replicated parts and default classes.
class MjcfDocument {
 public:
  /// Reports errors to `findings`. Included files are relative to `folder`, or to the including file.
  /// `around` are the files of the models around an attached one.
  MjcfDocument(std::string_view text, const std::string& file, const std::string& folder, Findings& findings,
               std::vector<std::string> around = {});

  const XmlElement& root() const { return root_; }
  const MjcfSettings& settings() const { return settings_; }

  /// The settings of the model that an element or attribute at this place belongs to: an attached model has its own.
  const MjcfSettings& settingsAt(const SourcePosition& where) const;

  /// Finds the file of an asset as MuJoCo does: in the folder of the settings beside the main file, then beside the
  /// file that names it. `folder` is the folder of the settings, as written.
  LocatedFile locateAsset(const XmlAttribute& file, const std::string& folder) const;

  std::vector<SourceText>& included() { return included_; }

  /// All elements <section><name/></section>.
  std::vector<const XmlElement*> inSections(std::string_view section, std::string_view name) const;

  /// `xml` with its defaults: of its own class, of `childclass`, or of the outermost class.
  MjcfElement element(const XmlElement& xml, const std::string& childclass = {}) const;

  /// Returns whether a default class of that name exists, and reports an error if not.
  bool checkClass(const XmlAttribute& reference) const;

 private:
  struct Class {
    std::vector<const XmlElement*> elements;  ///< <default>
    const Class* outer = nullptr;
  };

  void expand(XmlElement& element, const std::string& folder, std::vector<std::string>& open);
  void include(const XmlElement& element, const std::string& folder, std::vector<std::string>& open,
               std::vector<XmlElement>& into);
  void attachModels(XmlElement& container);
  void attach(const XmlElement& element, std::vector<XmlElement>& into);
  bool leavesOut(const XmlAttribute& file);
  std::optional<XmlElement> loadModel(const XmlElement& asset, const XmlElement& attach);
  void readSettings();
  void collectClasses(const XmlElement& element, const Class* outer, bool attached = false);

  Findings& findings_;
  XmlElement root_;
  std::string main_folder_;
  std::vector<SourceText> included_;
  MjcfSettings settings_;
  std::map<std::string, Class> classes_;
  std::vector<std::string> around_;  ///< files of the models around this one, and its own
  std::map<std::string, std::pair<MjcfSettings, std::string>> other_;  ///< settings and main folder, by attached file
  std::vector<XmlElement> models_;                                     ///< <model> in <asset>
  std::vector<XmlElement> attached_parts_;                             ///< sections of attached models
  std::list<XmlElement> attached_defaults_;                            ///< <default> of attached models
};

}  // namespace kinegraph::inline parsers_internal
