#include "kinegraph/viewer/messages/scene_notes.h"

#include "kinegraph/scene/tree/contact_warnings.h"

namespace kinegraph {

std::vector<SceneNote> sceneNotes(const Config& config) {
  const std::shared_ptr<SceneTree> scene = config.scene();
  const ContactWarnings notes = contactWarnings(*scene);
  std::vector<SceneNote> sentences;
  if (!notes.passed_through.empty()) {
    const ContactWarnings ignored{{}, notes.passed_through};
    sentences.push_back({describe(ignored, *scene).front(), notes.passed_through, true});
  }
  if (!notes.resting.empty()) {
    SceneNote& note = sentences.emplace_back();
    note.text = describe({notes.resting, {}}, *scene).front();
    for (const auto& [a, b] : notes.resting) note.frames.insert(note.frames.end(), {a, b});
  }
  return sentences;
}

}  // namespace kinegraph
