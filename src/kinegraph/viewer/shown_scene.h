#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/viewer/server.h"

namespace kinegraph {

struct FrameMessage;
struct JointsMessage;
struct LookMessage;

/// A message for a browser. Large ones are shared by all browsers.
struct Outgoing {
  std::shared_ptr<const std::string> data;
  bool binary;
};

/// What is shown at present, and what of it has changed since any earlier revision. Not synchronized.
class ShownScene {
 public:
  /// What one browser has got so far.
  struct Seen {
    std::uint64_t revision = 0;
    std::set<int> meshes;  ///< those in use at that revision; a browser forgets the others
    std::set<int> images;  ///< the same, of the pictures on them
  };

  /// True if anything differs from before.
  bool update(std::span<const ViewItem> items);
  bool setJoints(int structure, const std::vector<ShownJoint>& joints, const VectorXd& q);

  /// New poses of all items, and joint values.
  void setEdited(const EditedScene& edited);

  /// Browsers show this frame with handles to move it.
  void select(int frame);

  void setMotion(const ShownMotion& motion);
  bool endMotion();
  void setRun(const ShownRun& run);
  bool endRun();
  bool setNear(const std::vector<NearLine>& lines);
  bool setNotes(const std::vector<SceneNote>& notes);
  void setQuad(const Quad& quad);
  bool setLook(const Look& look);
  bool requestEvents(int kind);  ///< 1: browsers send events; 2: and do nothing else with mouse and keys
  bool requestCursor();
  bool requestDigits(bool yes);  ///< 1, 2, 3, 4 and 7 switch what browsers draw
  bool setText(std::string ShownScene::*field, const std::string& text);
  void setCamera(const PageCamera& camera);

  std::string title, message, error;

  /// The messages that bring a browser from `seen` to the present; `seen` is updated.
  std::vector<Outgoing> messagesSince(Seen& seen) const;

 private:
  /// A picture or a mesh as it is sent, under a number that is never used again.
  struct SentImage {
    int number;
    std::shared_ptr<const std::string> data;
  };
  struct SentMesh {
    int number;
    std::shared_ptr<const std::string> data;
    std::vector<std::shared_ptr<const SentImage>> images = {};  ///< on its textured triangles
  };
  struct Shown {
    ViewItem item;
    std::shared_ptr<const SentMesh> mesh;
    std::uint64_t look_revision = 0, pose_revision = 0;
  };
  struct LessBytes {  // equal pictures are one
    bool operator()(const std::shared_ptr<const Image>& a, const std::shared_ptr<const Image>& b) const {
      return a->bytes < b->bytes;
    }
  };
  std::shared_ptr<const SentMesh> meshOf(const ViewItem& item);
  std::shared_ptr<const SentImage> sentImage(const std::shared_ptr<const Image>& image);
  FrameMessage frameMessage(std::size_t index) const;
  JointsMessage jointsMessage() const;
  LookMessage lookMessage() const;
  void addFrames(Seen& seen, std::vector<Outgoing>& out) const;

  std::uint64_t revision_ = 1, count_revision_ = 1, text_revision_ = 1, camera_revision_ = 0;
  std::vector<Shown> frames_;
  std::map<std::shared_ptr<const Geometry>, std::shared_ptr<const SentMesh>> meshes_;  ///< those that frames show
  std::map<std::shared_ptr<const Image>, std::shared_ptr<const SentImage>, LessBytes>
      images_;  ///< those on these meshes
  int next_mesh_ = 0, next_image_ = 0;
  int structure_ = 0;
  std::vector<ShownJoint> joints_;
  VectorXd q_;
  std::uint64_t joints_revision_ = 0, q_revision_ = 0, motion_revision_ = 0, select_revision_ = 0;
  int selected_ = -1;
  std::vector<Outgoing> motion_;  ///< as it is sent; empty: there is none
  std::optional<ShownRun> run_;
  std::uint64_t run_revision_ = 0;
  PageCamera camera_;
  Look look_;
  int events_ = 0;
  bool cursor_ = false, digits_ = false;
  std::shared_ptr<const std::string> near_;                  ///< as it is sent
  std::map<int, std::pair<std::uint64_t, Outgoing>> quads_;  ///< by id: since when, and as it is sent
  std::vector<SceneNote> notes_;
  std::uint64_t look_revision_ = 0, near_revision_ = 0, notes_revision_ = 0;
};

}  // namespace kinegraph
