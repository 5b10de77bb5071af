#include <nanobind/stl/function.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "scene/point_arguments.h"
#include "viewer/image_argument.h"
#include "viewer/page_content_docs.h"
#include "viewer/py_viewer.h"

namespace kinegraph::python {

namespace {

using OptionalText = std::optional<std::string>;

ControlOptions controlOptions(const PyViewer& viewer, const std::string& unit = "", const OptionalText& key = {}) {
  if (key && (key->size() != 1 || *key == " "))
    throw ValueError(cat("button: key is '", *key, "'; expected one letter, digit or sign"));
  return {join(viewer.folders, "/"), unit, key ? (*key)[0] : '\0'};
}

/// `with viewer.folder(...)`: controls made inside belong to the folder.
struct PyFolder {
  std::shared_ptr<PyViewer> viewer;
  std::string name;

  PyFolder& enter() {
    viewer->folders.push_back(name);
    return *this;
  }
  void leave() { viewer->folders.pop_back(); }
};

PyFolder folderOf(std::shared_ptr<PyViewer> viewer, const std::string& name) {
  if (name.empty()) throw ValueError("folder: the name is empty");
  return {std::move(viewer), name};
}

ViewerValue<double> slider(PyViewer& v, const std::string& label, double lower, double upper,
                           std::optional<double> value, const std::string& unit) {
  return v.slider(label, {lower, upper}, value.value_or(lower), controlOptions(v, unit));
}

Vector3d pointOf(const Numbers& numbers, const char* what) {
  if (numbers.values.size() != 3) throw ValueError(cat(what, " has ", numbers.values.size(), " numbers; expected 3"));
  return Vector3d(numbers.values);
}

Pose poseOf(const Numbers& numbers, const char* call) {
  const VectorXd& x = numbers.values;
  if (x.size() != 3 && x.size() != 7)
    throw ValueError(cat(call, ": the pose has ", x.size(), " numbers; expected 3 (x y z) or 7 (x y z, qw qx qy qz)"));
  Pose pose;
  pose.p = x.head<3>();
  if (x.size() == 3) return pose;
  const Quaterniond q(x[3], x[4], x[5], x[6]);
  if (!(q.norm() > 1e-6)) throw ValueError(cat(call, ": the quaternion of the pose has no length"));
  pose.q = q.normalized();
  return pose;
}

/// The arguments that drawings share.
struct Look {
  OptionalText frame{};
  std::optional<Numbers> color{};
  std::optional<Numbers> colors{};
  double width = 3.;
  double size = 0.;
  std::string label{};
};

DrawOptions optionsOf(PyViewer& viewer, const char* call, const Look& look, std::size_t points = 0) {
  DrawOptions options;
  if (look.frame) {
    if (viewer.scene) (void)Config(viewer.scene).getFrame(*look.frame);  // throws FrameNotFound
    options.frame = *look.frame;
  }
  if (look.color) {
    const VectorXd& c = look.color->values;
    if ((c.size() != 3 && c.size() != 4) || c.minCoeff() < 0. || c.maxCoeff() > 1.)
      throw ValueError(cat(call, ": color is (", c.transpose(), "); expected 3 or 4 numbers in 0..1"));
    options.color.head(c.size()) = c;
  }
  options.colors = colorsOf(look.colors, points);
  options.width = look.width;
  options.size = look.size;
  options.label = look.label;
  return options;
}

using Rgb = Image<std::uint8_t>;

PageImage imageOf(const std::optional<Rgb>& rgb, const char* call) {
  if (!rgb) return {};
  Quad quad = quadOf(*rgb, call);
  return {quad.columns, quad.rows, std::move(quad.rgb)};
}

void drawFrustum(PyViewer& v, const std::string& name, const std::variant<std::string, Numbers>& camera,
                 const std::optional<Rgb>& rgb, std::optional<double> focal_length, double size,
                 const std::optional<Numbers>& color) {
  Look look{.color = color, .size = size};
  Camera seen;
  if (const auto* frame = std::get_if<std::string>(&camera)) {
    if (!v.scene) throw ValueError(cat("frustum: there is no scene with a frame '", *frame, "'; call view() before"));
    seen = cameraOf(Config(v.scene).getFrame(*frame));
    seen.pose = Pose();
    look.frame = *frame;
  } else {
    seen.pose = poseOf(std::get<Numbers>(camera), "frustum");
  }
  const PageImage image = imageOf(rgb, "frustum");
  const double aspect = image.rows > 0 ? double(image.columns) / image.rows : double(seen.width) / seen.height;
  v.frustum(name, seen.pose, focal_length.value_or(seen.focal_length), aspect, image, optionsOf(v, "frustum", look));
}

/// Rows and columns of rgb bytes, also parts and mirror images of arrays.
using LoggedImage = nb::ndarray<const std::uint8_t, nb::shape<-1, -1, 3>, nb::device::cpu>;

using Logged = std::variant<LoggedImage, Numbers>;

PageImage pageImage(const LoggedImage& from) {
  PageImage image{int(from.shape(1)), int(from.shape(0)), {}};
  for (std::size_t row = 0; row < from.shape(0); ++row) {
    for (std::size_t column = 0; column < from.shape(1); ++column)
      for (std::size_t k = 0; k < 3; ++k) image.rgb.push_back(from(row, column, k));
  }
  return image;
}

/// Images have no times.
void logAt(PyViewer& v, const std::string& name, const Logged& value, std::optional<double> time,
           const std::string& unit) {
  const auto* numbers = std::get_if<Numbers>(&value);
  if (!numbers) return v.log(name, pageImage(std::get<LoggedImage>(value)));
  if (numbers->rank > 1) {
    throw ValueError(cat("log '", name, "': the value has ", numbers->rank,
                         " dimensions; expected a number, a vector, or an image, uint8 (height, width, 3)"));
  }
  v.log(name, numbers->list(), time, unit);
}

void logOne(PyViewer& v, const std::string& name, const Logged& value, std::optional<double> time,
            const std::string& unit) {
  if (!std::holds_alternative<Numbers>(value) && (time || !unit.empty()))
    throw ValueError(cat("log '", name, "': an image has no time and no unit; expected none, or numbers"));
  logAt(v, name, value, time, unit);
}

void logAll(PyViewer& v, const std::map<std::string, Logged>& values, std::optional<double> time) {
  for (const auto& [name, value] : values) logAt(v, name, value, time, "");
}

template <class T>
void bindValue(nb::module_& m, const char* name, const char* doc) {
  nb::class_<ViewerValue<T>>(m, name, doc)
      .def_prop_rw("value", &ViewerValue<T>::value, &ViewerValue<T>::set, nb::for_setter(nb::arg("value")),
                   docs::content::value)
      .def("changed", &ViewerValue<T>::changed, docs::content::changed)
      .def("onChange", &ViewerValue<T>::onChange, "function"_a.none(), docs::content::onChange);
}

void bindControls(nb::module_& m, nb::class_<PyViewer>& viewer) {
  nb::class_<ViewerButton>(m, "ViewerButton", "A button on the page.")
      .def("clicked", &ViewerButton::clicked, docs::content::clicked)
      .def("onClick", &ViewerButton::onClick, "function"_a.none(), docs::content::onClickButton);
  bindValue<double>(m, "ViewerSlider", "A slider on the page; its value is a number.");
  bindValue<bool>(m, "ViewerCheck", "A check box on the page; its value is True or False.");
  bindValue<std::string>(m, "ViewerText", "A text field or a choice on the page; its value is a text.");
  nb::class_<PyFolder>(m, "ViewerFolder", "A folder of controls on the page, for a with statement.")
      .def("__enter__", &PyFolder::enter, nb::rv_policy::reference, "Starts the folder.")
      .def(
          "__exit__", [](PyFolder& folder, nb::args) { folder.leave(); }, "Ends the folder.");

  viewer
      .def(
          "button",
          [](PyViewer& v, const std::string& label, const OptionalText& key) {
            return v.button(label, controlOptions(v, "", key));
          },
          "label"_a, "key"_a = nb::none(), docs::content::button)
      .def("slider", slider, "label"_a, "lower"_a, "upper"_a, "value"_a = nb::none(), "unit"_a = "",
           docs::content::slider)
      .def(
          "check",
          [](PyViewer& v, const std::string& label, bool value) { return v.check(label, value, controlOptions(v)); },
          "label"_a, "value"_a = false, docs::content::check)
      .def(
          "choice",
          [](PyViewer& v, const std::string& label, const std::vector<std::string>& options,
             const OptionalText& value) { return v.choice(label, options, value.value_or(""), controlOptions(v)); },
          "label"_a, "options"_a, "value"_a = nb::none(), docs::content::choice)
      .def(
          "text",
          [](PyViewer& v, const std::string& label, const std::string& value) {
            return v.text(label, value, controlOptions(v));
          },
          "label"_a, "value"_a = "", docs::content::text)
      .def("folder", folderOf, "name"_a, docs::content::folder)
      .def("poll", &PyViewer::poll, docs::content::poll);
}

void bindDrawings(nb::class_<PyViewer>& viewer) {
  viewer
      .def(
          "arrow",
          [](PyViewer& v, const std::string& name, const Numbers& at, const Numbers& vector, const std::string& label,
             const std::optional<Numbers>& color, double size, const OptionalText& frame) {
            v.arrow(name, pointOf(at, "arrow: at"), pointOf(vector, "arrow: vector"),
                    optionsOf(v, "arrow", {.frame = frame, .color = color, .size = size, .label = label}));
          },
          "name"_a, "at"_a, "vector"_a, "label"_a = "", "color"_a = nb::none(), "size"_a = 0., "frame"_a = nb::none(),
          docs::content::arrow)
      .def(
          "line",
          [](PyViewer& v, const std::string& name, const Numbers& path, double width,
             const std::optional<Numbers>& color, const std::optional<Numbers>& colors, const OptionalText& frame) {
            const std::vector<Vector3d> list = pointList(path, "line: points");
            v.line(name, list, optionsOf(v, "line", {frame, color, colors, width}, list.size()));
          },
          "name"_a, "points"_a, "width"_a = 3., "color"_a = nb::none(), "colors"_a = nb::none(), "frame"_a = nb::none(),
          docs::content::line)
      .def(
          "label",
          [](PyViewer& v, const std::string& name, const Numbers& at, const std::string& text,
             const OptionalText& frame) {
            v.label(name, pointOf(at, "label: at"), text, optionsOf(v, "label", {frame}));
          },
          "name"_a, "at"_a, "text"_a, "frame"_a = nb::none(), docs::content::label)
      .def(
          "points",
          [](PyViewer& v, const std::string& name, const Numbers& cloud, const std::optional<Numbers>& colors,
             double size, const std::optional<Numbers>& color, const OptionalText& frame) {
            const std::vector<Vector3d> list = pointList(cloud, "points: points");
            v.points(
                name, list,
                optionsOf(v, "points", {.frame = frame, .color = color, .colors = colors, .size = size}, list.size()));
          },
          "name"_a, "points"_a, "colors"_a = nb::none(), "size"_a = 0., "color"_a = nb::none(), "frame"_a = nb::none(),
          docs::content::points)
      .def("frustum", drawFrustum, "name"_a, "camera"_a, "image"_a = nb::none(), "focal_length"_a = nb::none(),
           "size"_a = .2, "color"_a = nb::none(), docs::content::frustum)
      .def(
          "axes",
          [](PyViewer& v, const std::string& name, const Numbers& pose, double size, const std::string& label,
             const OptionalText& frame) {
            v.axes(name, poseOf(pose, "axes"), optionsOf(v, "axes", {.frame = frame, .size = size, .label = label}));
          },
          "name"_a, "pose"_a, "size"_a = .2, "label"_a = "", "frame"_a = nb::none(), docs::content::axes)
      .def(
          "image",
          [](PyViewer& v, const std::string& name, const Rgb& rgb, const Numbers& pose, double size,
             const OptionalText& frame) {
            v.image(name, imageOf(rgb, "image"), poseOf(pose, "image"),
                    optionsOf(v, "image", {.frame = frame, .size = size}));
          },
          "name"_a, "rgb"_a, "pose"_a, "size"_a = .4, "frame"_a = nb::none(), docs::content::image)
      .def(
          "remove", [](PyViewer& v, const std::string& name) { v.remove(name); }, "name"_a, docs::content::remove);
}

}  // namespace

void bindPageContent(nb::module_& m, nb::class_<PyViewer>& viewer) {
  nb::class_<Hit>(m, "Hit", "A clicked point of the scene.")
      .def_ro("frame", &Hit::frame, "The name of the clicked frame.")
      .def_prop_ro(
          "point", [](const Hit& hit) { return toNumpy(VectorXd(hit.point)); },
          "The point, m in the world, shape (3,).")
      .def_prop_ro(
          "normal", [](const Hit& hit) { return toNumpy(VectorXd(hit.normal)); },
          "The surface normal, of length 1, shape (3,).")
      .def("__repr__", [](const Hit& hit) {
        return cat("Hit(frame='", hit.frame, "', point=[", hit.point[0], ", ", hit.point[1], ", ", hit.point[2], "])");
      });
  bindControls(m, viewer);
  bindDrawings(viewer);
  viewer
      .def(
          "notify", [](PyViewer& v, const std::string& text, const std::string& level) { v.notify(text, level); },
          "text"_a, "level"_a = "info", docs::content::notify)
      .def("log", logOne, "name"_a, "value"_a, "time"_a = nb::none(), "unit"_a = "", docs::content::log)
      .def("log", logAll, "values"_a, "time"_a = nb::none(), docs::content::logAll)
      .def(
          "onClick", [](PyViewer& v, std::function<void(const Hit&)> function) { v.onClick(std::move(function)); },
          "function"_a.none(), docs::content::onClick);
}

}  // namespace kinegraph::python
