#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/viewer/page_content.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph::inline viewer_internal {

struct FrameMessage;
struct JointsMessage;
struct AppearanceMessage;

/// The shown scene, with the changes since any earlier revision. Not synchronized.
class ShownScene {
 public:
  /// The content of one browser.
  struct Seen {
    std::uint64_t revision = 0;
    std::set<int> meshes;  ///< meshes in use at that revision; a browser drops all others
    std::set<int> images;  ///< the same for images on them
    PageContent::Seen content;
  };

  /// Updates the items. Returns whether anything differs.
  bool update(std::span<const ViewItem> items);

  /// Updates items of which only those with the indices `changed` may differ from the last call; far cheaper if most of
  /// a large scene rests.
  bool update(std::span<const ViewItem> items, std::span<const int> changed);
  bool setJoints(int structure, const ShownJoints& joints, const VectorXd& q);

  /// Sets new poses of all items, and joint values.
  void setEdited(const EditedScene& edited);

  /// Lets browsers show this frame with handles to move it.
  void select(int frame);

  void setMotion(const ShownMotion& motion);
  bool endMotion();
  void setRun(const ShownRun& run);
  bool endRun();
  bool setNear(const std::vector<NearLine>& lines);
  bool setWarnings(const std::vector<SceneWarning>& warnings);
  void setQuad(const Quad& quad);
  bool setAppearance(const Appearance& appearance);
  bool requestEvents(int kind);  ///< 1: browsers send events; 2: mouse and keys have no other effect
  bool requestCursor();
  bool requestDigits(bool yes);  ///< the keys 1, 2, 3, 4 and 7 toggle parts of the picture
  bool setText(std::string ShownScene::*field, const std::string& text);
  void setCamera(const PageCamera& camera);

  /// Returns the time of the shown simulation, s; nothing without one.
  std::optional<double> runTime() const { return run_ ? std::optional(run_->time) : std::nullopt; }

  /// Returns the name of an item, or "".
  std::string nameOf(int item) const;

  std::string title, message, error;
  std::shared_ptr<PageContent> content;  ///< what the program adds to the page; null: nothing

  /// Returns the messages that update a browser from `seen` to the present, and updates `seen`.
  std::vector<Outgoing> messagesSince(Seen& seen) const { return messagesSince(seen, 0.); }

  /// Returns the messages for a browser that has seen nothing. `cell`: as in packMesh.
  std::vector<Outgoing> messages(double cell = 0.) const;

  /// Returns the largest diameter of a mesh's box, m; 0 without meshes.
  double largestMesh() const;

 private:
  /// An encoded image or mesh, with a number that is never reused.
  struct SentImage {
    int number;
    std::shared_ptr<const std::string> data;
  };
  struct SentMesh {
    int number;
    std::shared_ptr<const std::string> data;
    std::vector<std::shared_ptr<const SentImage>> images = {};  ///< of its textured triangles
  };
  struct Shown {
    ViewItem item;
    std::shared_ptr<const SentMesh> mesh;
    std::uint64_t appearance_revision = 0, pose_revision = 0;
  };
  struct LessBytes {  // equal images are stored once
    bool operator()(const std::shared_ptr<const Image>& a, const std::shared_ptr<const Image>& b) const {
      return a->bytes < b->bytes;
    }
  };
  std::shared_ptr<const SentMesh> meshOf(const ViewItem& item);
  std::shared_ptr<const SentImage> sentImage(const std::shared_ptr<const Image>& image);
  std::shared_ptr<const std::string> meshData(const Shown& shown, double cell) const;
  FrameMessage frameMessage(std::size_t index) const;
  JointsMessage jointsMessage() const;
  AppearanceMessage appearanceMessage() const;
  void take(std::size_t index, const ViewItem& item, std::uint64_t next, bool& changed, bool& looks_different);
  std::vector<Outgoing> messagesSince(Seen& seen, double cell) const;
  void addFrames(Seen& seen, double cell, std::vector<Outgoing>& out) const;

  std::uint64_t revision_ = 1, count_revision_ = 1, text_revision_ = 1, camera_revision_ = 0;
  std::vector<Shown> frames_;
  std::vector<int> edited_;  ///< frames with other poses than in the last update
  std::map<std::shared_ptr<const Geometry>, std::shared_ptr<const SentMesh>> meshes_;  ///< meshes of the shown frames
  std::map<std::shared_ptr<const Image>, std::shared_ptr<const SentImage>, LessBytes>
      images_;  ///< images on these meshes
  int next_mesh_ = 0, next_image_ = 0;
  int structure_ = 0;
  ShownJoints joints_;
  VectorXd q_;
  std::uint64_t joints_revision_ = 0, q_revision_ = 0, motion_revision_ = 0, select_revision_ = 0;
  int selected_ = -1;
  std::vector<Outgoing> motion_;  ///< encoded; empty: no motion
  std::optional<ShownRun> run_;
  std::uint64_t run_revision_ = 0;
  PageCamera camera_;
  Appearance appearance_;
  int events_ = 0;
  bool cursor_ = false, digits_ = false;
  std::shared_ptr<const std::string> near_;                  ///< encoded
  std::map<int, std::pair<std::uint64_t, Outgoing>> quads_;  ///< by id: revision and encoded message
  std::vector<SceneWarning> warnings_;
  std::uint64_t appearance_revision_ = 0, near_revision_ = 0, warnings_revision_ = 0;
};

}  // namespace kinegraph::inline viewer_internal
