#include "kinegraph/viewer/page_content.h"

#include <algorithm>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/messages/binary_messages.h"
#include "kinegraph/viewer/messages/commands.h"

namespace kinegraph::inline viewer_internal {

namespace {

constexpr int kMostCalls = 100;  ///< of a callback, and clicked points, that wait for the program
constexpr std::size_t kMostSamples = 100000;
constexpr std::size_t kMostNotifications = 20;
constexpr std::chrono::seconds kFresh(5);  ///< notifications that a new browser still shows

constexpr const char* kKinds[] = {"button", "slider", "check", "choice", "text"};

ControlMessage controlMessage(const PageControl& c) {
  return {c.id,     kKinds[int(c.kind)],
          c.label,  c.folder,
          c.unit,   c.key ? std::string(1, c.key) : "",
          c.lower,  c.upper,
          c.number, c.text,
          c.options};
}

Outgoing jsonMessage(const auto& message) { return {std::make_shared<std::string>(jsonText(message)), false}; }

std::vector<Outgoing> drawingMessages(const PageDrawing& d) {
  const Vector7d pose = d.pose.numbers();
  std::string data;
  appendBytes(data, BinaryKind::drawing);
  for (const std::size_t size : {d.points.size(), d.colors.size()}) appendBytes(data, std::uint32_t(size));
  appendBytes(data, std::int32_t(d.columns));
  appendBytes(data, std::int32_t(d.rows));
  for (const Vector3d& p : d.points) {
    for (int i = 0; i < 3; ++i) appendBytes(data, float(p[i]));
  }
  for (const auto& color : d.colors) appendBytes(data, color);
  data.append(reinterpret_cast<const char*>(d.rgb.data()), d.rgb.size());
  return {jsonMessage(DrawMessage{
              d.name, d.type, d.frame, d.text, d.width, d.size, {pose.begin(), pose.end()}, d.focal_length, d.aspect}),
          {std::make_shared<std::string>(std::move(data)), true}};
}

}  // namespace

std::shared_ptr<PageControl> PageContent::add(PageControl control) {
  const std::lock_guard lock(mutex_);
  for (auto& known : controls_) {
    if (known->name() != control.name()) continue;
    if (known->kind != control.kind) {
      throw ValueError(cat("viewer: '", control.name(), "' is a ", kKinds[int(known->kind)], " already; expected ",
                           "another label, or remove before"));
    }
    return known;
  }
  control.id = next_id_++;
  controls_.push_back(std::make_shared<PageControl>(std::move(control)));
  controls_revision_ = ++revision_;
  return controls_.back();
}

void PageContent::draw(PageDrawing drawing) {
  std::vector<Outgoing> messages = drawingMessages(drawing);
  auto shared = std::make_shared<const PageDrawing>(std::move(drawing));
  const std::lock_guard lock(mutex_);
  Drawn& drawn = drawings_[shared->name];
  drawn = {++revision_, std::move(shared), std::move(messages)};
}

std::vector<std::shared_ptr<const PageDrawing>> PageContent::drawings() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<const PageDrawing>> drawings;
  for (const auto& [name, drawn] : drawings_) {
    if (drawn.drawing) drawings.push_back(drawn.drawing);
  }
  return drawings;
}

double PageContent::now() {
  const std::lock_guard lock(mutex_);
  if (!start_) start_ = Clock::now();
  return std::chrono::duration<double>(Clock::now() - *start_).count();
}

void PageContent::log(const std::string& name, double time, const std::vector<double>& values,
                      const std::string& unit) {
  const std::lock_guard lock(mutex_);
  const auto [place, is_new] = series_.try_emplace(name, Series{int(next_id_), values.size(), unit});
  if (is_new) {
    ++next_id_;
    series_revision_ = ++revision_;
  }
  if (place->second.size != values.size()) {
    throw ValueError(
        cat("log: '", name, "' has ", values.size(), " numbers; expected ", place->second.size, " as before"));
  }
  samples_.push_back({place->second.id, time, values});
  ++revision_;
  if (samples_.size() <= kMostSamples) return;
  samples_.pop_front();
  ++dropped_;
}

void PageContent::notify(const std::string& text, const std::string& level) {
  const std::lock_guard lock(mutex_);
  notifications_.push_back({++revision_, Clock::now(), jsonMessage(NotifyMessage{text, level})});
  if (notifications_.size() > kMostNotifications) notifications_.pop_front();
}

std::vector<std::string> PageContent::names() const {
  std::vector<std::string> names;
  for (const auto& control : controls_) names.push_back(control->name());
  for (const auto& [name, drawn] : drawings_) {
    if (drawn.drawing) names.push_back(name);
  }
  for (const auto& [name, series] : series_) names.push_back(name);
  return names;
}

void PageContent::remove(const std::string& name) {
  std::vector<std::shared_ptr<PageControl>> ended;  // destroyed without the lock
  const std::lock_guard lock(mutex_);
  const std::vector<std::string> known = names();
  bool found = false;
  if (const auto drawn = drawings_.find(name); drawn != drawings_.end() && drawn->second.drawing) {
    drawn->second = {++revision_};
    found = true;
  }
  if (const auto series = series_.find(name); series != series_.end()) {
    for (Sample& sample : samples_) {  // keeps the numbering of samples
      if (sample.series == series->second.id) sample = {0, 0., {}};
    }
    series_.erase(series);
    series_revision_ = ++revision_;
    found = true;
  }
  std::erase_if(controls_, [&](const auto& control) {
    const bool ends = control->name() == name || control->folder == name || control->folder.starts_with(name + "/");
    if (ends) ended.push_back(control);
    return ends;
  });
  if (!ended.empty()) controls_revision_ = ++revision_;
  if (!found && ended.empty()) throw ValueError(cat("remove: nothing is named '", name, "'", similarHint(name, known)));
}

bool PageContent::apply(const ControlCommand& command) {
  const std::lock_guard lock(mutex_);
  const auto place =
      std::find_if(controls_.begin(), controls_.end(), [&](const auto& control) { return control->id == command.id; });
  if (place == controls_.end()) return false;
  PageControl& control = **place;
  using Kind = PageControl::Kind;
  switch (control.kind) {
    case Kind::button:
      control.clicks = std::min(control.clicks + 1, kMostCalls);
      if (control.callback) control.calls = std::min(control.calls + 1, kMostCalls);
      return false;
    case Kind::slider:
      if (!(command.number >= control.lower && command.number <= control.upper)) return false;
      control.number = command.number;
      break;
    case Kind::check:
      control.number = command.number != 0. ? 1. : 0.;
      break;
    case Kind::choice:
      if (std::find(control.options.begin(), control.options.end(), command.text) == control.options.end())
        return false;
      [[fallthrough]];
    case Kind::text:
      control.text = command.text;
  }
  control.changed = true;
  if (control.callback) control.calls = 1;
  controls_revision_ = ++revision_;
  return true;
}

void PageContent::click(const Hit& hit) {
  const std::lock_guard lock(mutex_);
  if (on_click_ && hits_.size() < std::size_t(kMostCalls)) hits_.push_back(hit);
}

void PageContent::onClick(std::function<void(const Hit&)> callback) {
  auto shared = callback ? std::make_shared<const std::function<void(const Hit&)>>(std::move(callback)) : nullptr;
  const std::lock_guard lock(mutex_);
  on_click_.swap(shared);
}

void PageContent::onChange(std::function<void()> update) {
  const std::lock_guard lock(mutex_);
  on_change_ = std::move(update);
}

void PageContent::runCallbacks() {
  std::vector<std::shared_ptr<const std::function<void()>>> due;
  std::shared_ptr<const std::function<void(const Hit&)>> on_click;
  std::deque<Hit> hits;
  {
    const std::lock_guard lock(mutex_);
    for (const auto& control : controls_) {
      for (; control->calls > 0; --control->calls) {
        if (control->callback) due.push_back(control->callback);
      }
    }
    on_click = on_click_;
    hits.swap(hits_);
  }
  for (const auto& call : due) (*call)();
  if (!on_click) return;
  for (const Hit& hit : hits) (*on_click)(hit);
}

void PageContent::addMessages(Seen& seen, std::vector<Outgoing>& out) const {
  const std::lock_guard lock(mutex_);
  if (controls_revision_ > seen.revision) {
    ControlsMessage message;
    for (const auto& control : controls_) message.controls.push_back(controlMessage(*control));
    out.push_back(jsonMessage(message));
  }
  for (const auto& [name, drawn] : drawings_) {
    if (drawn.revision <= seen.revision) continue;
    out.insert(out.end(), drawn.messages.begin(), drawn.messages.end());
    if (!drawn.drawing && seen.revision > 0) out.push_back(jsonMessage(UndrawMessage{name}));
  }
  if (series_revision_ > seen.revision) {
    PlotsMessage message;
    for (const auto& [name, series] : series_)
      message.series.push_back({series.id, name, series.unit, int(series.size)});
    out.push_back(jsonMessage(message));
  }
  std::string data;
  std::uint32_t count = 0;
  for (std::size_t i = std::size_t(std::max(seen.samples, dropped_) - dropped_); i < samples_.size(); ++i) {
    const Sample& sample = samples_[i];
    if (sample.values.empty()) continue;
    appendBytes(data, std::int32_t(sample.series));
    appendBytes(data, std::uint32_t(sample.values.size()));
    appendBytes(data, sample.time);
    for (const double value : sample.values) appendBytes(data, value);
    ++count;
  }
  if (count > 0) {
    std::string head;
    appendBytes(head, BinaryKind::samples);
    appendBytes(head, count);
    out.push_back({std::make_shared<std::string>(head + data), true});
  }
  for (const Notification& note : notifications_) {
    if (note.revision > seen.revision && (seen.revision > 0 || Clock::now() - note.time < kFresh))
      out.push_back(note.message);
  }
  seen = {revision_, dropped_ + samples_.size()};
}

}  // namespace kinegraph::inline viewer_internal
