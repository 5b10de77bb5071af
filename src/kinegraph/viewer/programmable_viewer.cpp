#include "kinegraph/viewer/programmable_viewer.h"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/page_content.h"

namespace kinegraph {

namespace {

using Kind = PageControl::Kind;

PageControl controlOf(Kind kind, const std::string& label, const ControlOptions& options) {
  if (label.empty()) throw ValueError("viewer: the label of a control is empty");
  PageControl control;
  control.kind = kind;
  control.label = label;
  control.folder = options.folder;
  control.unit = options.unit;
  control.key = options.key;
  return control;
}

/// Throws ValueError unless the control may have this value.
void checkValue(const PageControl& control, double value) {
  if (control.kind == Kind::slider && !(value >= control.lower && value <= control.upper)) {
    throw ValueError(cat("slider '", control.name(), "': the value is ", value, "; expected ", control.lower, " to ",
                         control.upper));
  }
}
void checkValue(const PageControl& control, const std::string& value) {
  const auto& options = control.options;
  if (control.kind == Kind::choice && std::find(options.begin(), options.end(), value) == options.end()) {
    throw ValueError(
        cat("choice '", control.name(), "': there is no option '", value, "'; expected one of ", join(options, ", ")));
  }
}

void checkFinite(const std::string& call, const std::string& name, const std::vector<Vector3d>& points) {
  const auto broken = std::find_if_not(points.begin(), points.end(), [](const auto& p) { return p.allFinite(); });
  if (broken == points.end()) return;
  throw ValueError(cat(call, " '", name, "': point ", broken - points.begin(), " is (", broken->transpose(),
                       "); coordinates must be finite"));
}

void checkImage(const std::string& call, const std::string& name, const PageImage& image) {
  const bool valid = image.columns >= 0 && image.rows >= 0 &&
                     image.rgb.size() == 3 * std::size_t(image.columns) * std::size_t(image.rows);
  if (!valid) {
    throw ValueError(cat(call, " '", name, "': ", image.rgb.size(), " bytes; expected 3 for each of ", image.rows,
                         " x ", image.columns, " pixels"));
  }
}

std::array<std::uint8_t, 4> colorBytes(const Vector4d& color) {
  std::array<std::uint8_t, 4> bytes;
  for (int i = 0; i < 4; ++i) bytes[std::size_t(i)] = std::uint8_t(std::lround(255. * std::clamp(color[i], 0., 1.)));
  return bytes;
}

}  // namespace

bool ViewerButton::clicked() {
  content_->runCallbacks();
  return content_->read([&] { return std::exchange(control_->clicks, 0) > 0; });
}

void ViewerButton::onClick(std::function<void()> callback) {
  auto shared = callback ? std::make_shared<const std::function<void()>>(std::move(callback)) : nullptr;
  content_->read([&] { control_->callback.swap(shared); });
}

template <class T>
T ViewerValue<T>::value() const {
  return content_->read([&]() -> T {
    if constexpr (std::is_same_v<T, std::string>)
      return control_->text;
    else
      return T(control_->number);
  });
}

template <class T>
void ViewerValue<T>::set(const T& value) {
  content_->change([&] {
    if constexpr (std::is_same_v<T, double>) checkValue(*control_, value);
    if constexpr (std::is_same_v<T, std::string>) {
      checkValue(*control_, value);
      control_->text = value;
    } else {
      control_->number = double(value);
    }
  });
}

template <class T>
bool ViewerValue<T>::changed() {
  content_->runCallbacks();
  return content_->read([&] { return std::exchange(control_->changed, false); });
}

template <class T>
void ViewerValue<T>::onChange(std::function<void(T)> callback) {
  std::shared_ptr<const std::function<void()>> call;
  if (callback) {
    const auto changed = [content = std::weak_ptr(content_), control = std::weak_ptr(control_),
                          callback = std::move(callback)] {
      const auto c = content.lock();
      const auto k = control.lock();
      if (c && k) callback(ViewerValue(c, k).value());
    };
    call = std::make_shared<const std::function<void()>>(changed);
  }
  content_->read([&] { control_->callback.swap(call); });
}

template class ViewerValue<double>;
template class ViewerValue<bool>;
template class ViewerValue<std::string>;

ProgrammableViewer::ProgrammableViewer() : content_(std::make_shared<PageContent>()) {}

void ProgrammableViewer::onClick(std::function<void(const Hit&)> callback) { content_->onClick(std::move(callback)); }

void ProgrammableViewer::poll() { content_->runCallbacks(); }

template <class T>
ViewerValue<T> ProgrammableViewer::valueOf(PageControl control) {
  ViewerValue<T> value(content_, content_->add(std::move(control)));
  contentChanged();
  return value;
}

ViewerButton ProgrammableViewer::button(const std::string& label, const ControlOptions& options) {
  ViewerButton button(content_, content_->add(controlOf(Kind::button, label, options)));
  contentChanged();
  return button;
}

ViewerValue<double> ProgrammableViewer::slider(const std::string& label, std::array<double, 2> range, double value,
                                               const ControlOptions& options) {
  PageControl control = controlOf(Kind::slider, label, options);
  if (!(range[0] < range[1] && std::isfinite(range[0]) && std::isfinite(range[1]))) {
    throw ValueError(
        cat("slider '", control.name(), "': the range is ", range[0], " to ", range[1], "; expected lower < upper"));
  }
  control.lower = range[0];
  control.upper = range[1];
  checkValue(control, value);
  control.number = value;
  return valueOf<double>(std::move(control));
}

ViewerValue<bool> ProgrammableViewer::check(const std::string& label, bool value, const ControlOptions& options) {
  PageControl control = controlOf(Kind::check, label, options);
  control.number = value;
  return valueOf<bool>(std::move(control));
}

ViewerValue<std::string> ProgrammableViewer::choice(const std::string& label, const std::vector<std::string>& options,
                                                    const std::string& value, const ControlOptions& given) {
  PageControl control = controlOf(Kind::choice, label, given);
  if (options.empty()) throw ValueError(cat("choice '", control.name(), "': there are no options"));
  control.options = options;
  control.text = value.empty() ? options[0] : value;
  checkValue(control, control.text);
  return valueOf<std::string>(std::move(control));
}

ViewerValue<std::string> ProgrammableViewer::text(const std::string& label, const std::string& value,
                                                  const ControlOptions& options) {
  PageControl control = controlOf(Kind::text, label, options);
  control.text = value;
  return valueOf<std::string>(std::move(control));
}

void ProgrammableViewer::draw(PageDrawing drawing, const DrawOptions& options) {
  if (drawing.name.empty()) throw ValueError(cat(drawing.type, ": the name is empty"));
  checkFinite(drawing.type, drawing.name, drawing.points);
  if (!drawing.pose.numbers().allFinite())
    throw ValueError(cat(drawing.type, " '", drawing.name, "': the pose has numbers that are not finite"));
  if (!(std::isfinite(options.width) && options.width > 0. && std::isfinite(options.size) && options.size >= 0.)) {
    throw ValueError(cat(drawing.type, " '", drawing.name, "': width is ", options.width, " pixels and size ",
                         options.size, " m; expected positive numbers (size 0: the default)"));
  }
  const std::size_t colors = options.colors.size();
  if (colors > 1 && colors != drawing.points.size()) {
    throw ValueError(
        cat(drawing.type, " '", drawing.name, "': got ", colors, " colors for ", drawing.points.size(), " points"));
  }
  drawing.frame = options.frame;
  drawing.width = options.width;
  if (options.size > 0.) drawing.size = options.size;
  drawing.colors = options.colors;
  if (drawing.colors.empty()) drawing.colors = {colorBytes(options.color)};
  if (drawing.type != "label") drawing.text = options.label;
  content_->draw(std::move(drawing));
  contentChanged();
}

void ProgrammableViewer::arrow(const std::string& name, const Vector3d& at, const Vector3d& vector,
                               const DrawOptions& options) {
  draw({name, "arrow", {}, {}, {at, vector}, {}, 0., .04 * vector.norm()}, options);
}

void ProgrammableViewer::line(const std::string& name, const std::vector<Vector3d>& points,
                              const DrawOptions& options) {
  draw({name, "line", {}, {}, points}, options);
}

void ProgrammableViewer::label(const std::string& name, const Vector3d& at, const std::string& text,
                               const DrawOptions& options) {
  draw({name, "label", {}, text, {at}}, options);
}

void ProgrammableViewer::points(const std::string& name, const std::vector<Vector3d>& points,
                                const DrawOptions& options) {
  draw({name, "points", {}, {}, points}, options);
}

void ProgrammableViewer::frustum(const std::string& name, const Pose& pose, double focal_length, double aspect,
                                 const PageImage& image, const DrawOptions& options) {
  checkImage("frustum", name, image);
  if (!(std::isfinite(focal_length) && focal_length > 0. && std::isfinite(aspect) && aspect > 0.)) {
    throw ValueError(cat("frustum '", name, "': focal length is ", focal_length, " and aspect ", aspect,
                         "; expected positive numbers"));
  }
  draw({name, "frustum", {}, {}, {}, {}, 0., .2, pose, focal_length, aspect, image.columns, image.rows, image.rgb},
       options);
}

void ProgrammableViewer::axes(const std::string& name, const Pose& pose, const DrawOptions& options) {
  draw({name, "axes", {}, {}, {}, {}, 0., .2, pose}, options);
}

void ProgrammableViewer::image(const std::string& name, const PageImage& image, const Pose& pose,
                               const DrawOptions& options) {
  checkImage("image", name, image);
  if (image.rgb.empty()) throw ValueError(cat("image '", name, "': the image has no pixels"));
  draw({name,
        "image",
        {},
        {},
        {},
        {},
        0.,
        .4,
        pose,
        0.,
        double(image.columns) / image.rows,
        image.columns,
        image.rows,
        image.rgb},
       options);
}

void ProgrammableViewer::logImage(const std::string& name, const PageImage& image) {
  checkImage("log", name, image);
  if (image.rgb.empty()) throw ValueError(cat("log '", name, "': the image has no pixels"));
  PageDrawing drawing{name, "log"};
  drawing.columns = image.columns;
  drawing.rows = image.rows;
  drawing.rgb = image.rgb;
  draw(std::move(drawing), {});
}

void ProgrammableViewer::remove(const std::string& name) {
  content_->remove(name);
  contentChanged();
}

void ProgrammableViewer::notify(const std::string& text, const std::string& level) {
  if (level != "info" && level != "warning" && level != "error")
    throw ValueError(cat("notify: level is '", level, "'; expected info, warning or error"));
  content_->notify(text, level);
  contentChanged();
}

void ProgrammableViewer::log(const std::string& name, const std::vector<double>& values, std::optional<double> time,
                             const std::string& unit) {
  if (values.empty()) throw ValueError(cat("log: '", name, "' has no numbers"));
  if (time && !std::isfinite(*time)) throw ValueError(cat("log: the time of '", name, "' is ", *time));
  content_->log(name, time ? *time : content_->now(), values, unit);
  contentChanged();
}

}  // namespace kinegraph
