#pragma once

#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/rendering/letters.h"
#include "kinegraph/rendering/picture_drawings.h"
#include "kinegraph/viewer/page_content.h"

namespace kinegraph::inline api_internal {

/// Converts what programs draw on a viewer's page for pictures. Meshes and letters are kept for the next picture.
class PageDrawings {
 public:
  using Listed = std::vector<std::shared_ptr<const PageDrawing>>;

  /// Returns the shapes of drawings, at the present poses of their frames. As on the page, drawings of frames that the
  /// scene does not have are omitted.
  std::vector<PictureDrawing> shapes(const Listed& drawings, SceneTree& scene);

  /// Writes the texts of drawings on an image of `camera`. Of overlapping ones, only the nearest is shown, as on pages.
  void write(const Listed& drawings, SceneTree& scene, const Camera& camera, CameraRenderer& writer,
             CameraImage& image);

 private:
  std::map<std::shared_ptr<const PageDrawing>, std::vector<PictureDrawing>> known_;
  std::map<std::tuple<std::string, int, int>, Letters> letters_;  ///< by text, width and height of the image
};

}  // namespace kinegraph::inline api_internal
