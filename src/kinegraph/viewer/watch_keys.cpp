#include "kinegraph/viewer/watch_keys.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/exporters/writers.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/scene_items.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph::inline viewer_internal {

std::string WatchKeys::help() {
  return "h: this help\na: moves every joint through its limits; any key stops it\ni: content of the scene and "
         "the camera\nc: collisions\n"
         "r: random joints\nx: write z.g, z.urdf, z.ply, z.dae\nspace: frame under the pointer\n6: log mouse and keys, "
         "or stop it\n"
         "1, 2, 3, 4, 7: shapes, markers, axes, distances, names on or off\n"
         "Enter: load again\nq, Escape: quit";
}

void WatchKeys::report(const std::string& text) {
  viewer_.setMessage(text);
  report_(text);
}

bool WatchKeys::press(int key) {
  try {
    switch (key) {
      case 'h':
        report(help());
        return true;
      case 'i':
        reportScene();
        return true;
      case 'c':
        reportCollisions();
        return true;
      case 'x':
        writeFiles();
        return true;
      case ' ':
        reportPicked();
        return true;
      case 'a':
        viewer_.showMotion(config_, jointSweep(config_), false, "every joint through its limits [any key stops it]",
                           cancellation_);
        viewer_.update(config_);
        report("the joints are back at their values");
        return true;
      case 'r':
        config_.setJointState(randomJointState(config_, random_));
        viewer_.update(config_);
        return true;
      case '6':
        logs_ = !logs_;
        viewer_.server().requestEvents(false);
        viewer_.server().takeEvents();
        report(logs_ ? "mouse and keys are logged" : "mouse and keys are not logged");
        return true;
      default:
        return false;
    }
  } catch (const Error& error) {
    report(error.what());
    return true;
  }
}

void WatchKeys::logEvents() {
  if (!logs_) return;
  for (const std::string& event : viewer_.server().takeEvents()) report_(event);
}

void WatchKeys::reportScene() {
  std::string text = cat(config_.report(), "\njoints:");
  for (const std::string& name : config_.getJointNames()) text += " " + name;
  if (const std::optional<PageCamera> camera = viewer_.server().camera()) {
    text += cat("\nthe camera of the page\ncamera_init: { X: [", camera->pose.numbers().transpose(), "]");
    if (camera->ortho_height > 0.)
      text += cat(", orthoAbsHeight: ", camera->ortho_height);
    else if (camera->focal_length > 0.)
      text += cat(", focalLength: ", camera->focal_length);
    text += " }";
  }
  report(text);
}

void WatchKeys::reportCollisions() {
  constexpr double kMargin = .05;
  const std::vector<NearLine> lines = nearLines(config_, kMargin);
  std::string text = cat(lines.size(), " pairs nearer than 5 cm");
  for (const NearLine& line : lines) text += cat("\n", line.names, "  ", line.distance, " m");
  viewer_.server().setNear(lines);
  report(text);
}

void WatchKeys::writeFiles() {
  std::vector<std::string> warnings;
  saveScene(config_, "z.g", &warnings);
  saveUrdf(config_, "z.urdf", &warnings);
  saveWorldMesh(config_, "z.ply");
  saveCollada(config_, "z.dae");
  for (const std::string& warning : warnings) report_(warning);
  report("written: z.g, z.urdf, z.ply, z.dae");
}

void WatchKeys::reportPicked() {
  const std::optional<Cursor> cursor = viewer_.server().cursor();
  if (!cursor || cursor->frame < 0 || cursor->frame >= config_.getFrameDimension()) {
    return report("there is no shape under the pointer; move it and press space again");
  }
  const FrameData& frame = *config_.scene()->frames()[std::size_t(cursor->frame)];
  const Vector3d& p = cursor->point;
  report(cat(frame.name, " (", frame.id, ") at ", p.x(), " ", p.y(), " ", p.z(), "\n{ ", detailsOf(frame), " }"));
}

}  // namespace kinegraph::inline viewer_internal
