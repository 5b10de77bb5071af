#include "kinegraph/viewer/messages/scene_warnings.h"

#include "kinegraph/scene/tree/contact_warnings.h"

namespace kinegraph::inline viewer_internal {

std::vector<SceneWarning> sceneWarnings(const Config& config) {
  const std::shared_ptr<SceneTree> scene = config.scene();
  const ContactWarnings warnings = contactWarnings(*scene);
  std::vector<SceneWarning> sentences;
  if (!warnings.passed_through.empty()) {
    const ContactWarnings ignored{{}, warnings.passed_through};
    sentences.push_back({describe(ignored, *scene).front(), warnings.passed_through, true});
  }
  if (!warnings.resting.empty()) {
    SceneWarning& warning = sentences.emplace_back();
    warning.text = describe({warnings.resting, {}}, *scene).front();
    for (const auto& [a, b] : warnings.resting) warning.frames.insert(warning.frames.end(), {a, b});
  }
  return sentences;
}

}  // namespace kinegraph::inline viewer_internal
