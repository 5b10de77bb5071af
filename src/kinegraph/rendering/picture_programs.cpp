#include "kinegraph/rendering/picture_programs.h"

#include "kinegraph/rendering/picture_pixel_shaders.h"
#include "kinegraph/rendering/picture_shaders.h"

namespace kinegraph::inline rendering_internal {

PictureProgram::PictureProgram(const char* vertex, std::initializer_list<std::string> fragment) : vertex_(vertex) {
  for (const std::string& part : fragment) fragment_ += part;
}

namespace {

/// Returns the shader of the lights for a number of them.
std::string lightsOf(int lights) {
  std::string others = "\n#define ADD_OTHER_LIGHTS";
  for (int i = 1; i < lights; ++i) others += " ADD_LIGHT(" + std::to_string(i) + ")";
  return others + shaders::kLights;
}

}  // namespace

PicturePrograms::PicturePrograms(int number_of_lights)
    : lights(number_of_lights),
      samples{{shaders::kSurfaceVertex, {shaders::kColors, shaders::kSamples, shaders::kSurfaceSample}},
              {shaders::kSurfaceVertex, {shaders::kColors, shaders::kSamples, shaders::kTexturedSample}},
              {shaders::kLineVertex, {shaders::kColors, shaders::kSamples, shaders::kRoundEnds, shaders::kTintSample}},
              {shaders::kPointVertex, {shaders::kColors, shaders::kSamples, shaders::kSquares, shaders::kTintSample}}},
      glass{{shaders::kSurfaceVertex, {shaders::kColors, lightsOf(number_of_lights), shaders::kGlassFragment}},
            {shaders::kSurfaceVertex, {shaders::kColors, lightsOf(number_of_lights), shaders::kGlassFragment}},
            {shaders::kLineVertex, {shaders::kColors, shaders::kRoundEnds, shaders::kTintFragment}},
            {shaders::kPointVertex, {shaders::kColors, shaders::kSquares, shaders::kTintFragment}}},
      kinds(shaders::kScreenVertex, {shaders::kColors, shaders::kPixel, shaders::kKindFragment}),
      alike_surface(shaders::kScreenVertex, {shaders::kColors, shaders::kPixel, shaders::kSun,
                                             lightsOf(number_of_lights), shaders::kSurface, shaders::kAlikeSurface}),
      mixed_surface(shaders::kScreenVertex, {shaders::kColors, shaders::kPixel, shaders::kSun, shaders::kFloor,
                                             lightsOf(number_of_lights), shaders::kSurface, shaders::kMixedSurface}),
      glass_pixel(shaders::kScreenVertex, {shaders::kColors, shaders::kPixel, shaders::kGlassPixel}),
      floor_lines(shaders::kFloorVertex, {shaders::kColors, shaders::kPixel, shaders::kSun, shaders::kFloor,
                                          shaders::kBeforeNothing, shaders::kFloorFragment}),
      floor_shadows(shaders::kFloorVertex, {shaders::kColors, shaders::kPixel, shaders::kSun, shaders::kFloor,
                                            shaders::kInShadows, shaders::kFloorFragment}),
      floor_before(shaders::kFloorVertex, {shaders::kColors, shaders::kPixel, shaders::kSun, shaders::kFloor,
                                           shaders::kBeforeSurfaces, shaders::kFloorFragment}),
      floor_depth(shaders::kFloorDepthVertex, {shaders::kDepthFragment}) {}

}  // namespace kinegraph::inline rendering_internal
