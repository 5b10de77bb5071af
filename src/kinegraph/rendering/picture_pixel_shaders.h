#pragma once

/// The shaders (GLSL 3.30) that compute the pixels of a picture from its samples, see picture_shaders.h.
///
/// Software runs both sides of all branches, but skips pixels that fail the depth test. Therefore the depths of this
/// stage tell kinds of pixels apart, so that each shader runs for those that need it.
namespace kinegraph::shaders {

/// A rectangle in the picture's plane, at the depth of a kind of pixels.
inline constexpr const char* kScreenVertex = R"(#version 330
layout(location = 0) in vec3 position;  // corners of a square of half width 1
uniform float level;
void main() { gl_Position = vec4(position.xy, 2. * level - 1., 1.); }
)";

/// A part of the floor, at the depth of a kind of pixels.
inline constexpr const char* kFloorVertex = R"(#version 330
layout(location = 0) in vec3 position;  // corners of a square of half width 1
uniform mat4 to_image;
uniform vec3 center, half_x, half_y;
uniform float level;
void main() {
  vec4 at = to_image * vec4(center + position.x * half_x + position.y * half_y, 1.);
  gl_Position = vec4(at.xy, (2. * level - 1.) * at.w, at.w);
}
)";

inline constexpr const char* kFloorDepthVertex = R"(#version 330
layout(location = 0) in vec3 position;  // corners of a square of half width 1
uniform mat4 to_image;
uniform vec3 center, half_x, half_y;
void main() { gl_Position = to_image * vec4(center + position.x * half_x + position.y * half_y, 1.); }
)";

/// Precedes the fragment shaders: the places of a pixel's samples.
inline constexpr const char* kPixel = R"(
uniform usampler2D samples;  // colors, kinds and normals
uniform sampler2D depths;    // 1: the background
uniform vec3 eye, forward;
uniform vec3 to_right, to_bottom;  // from the center of the picture to its edges, at a depth of 1 m
uniform vec2 size;                 // samples of the picture
uniform vec2 range;                // m, the least and the largest depth
uniform float is_orthographic;

ivec2 firstSample() { return 2 * ivec2(gl_FragCoord.xy); }

// The four samples of a pixel: the first, the next to the right, the next upwards, and both.
vec4 depthsAt(ivec2 first) {
  return vec4(texelFetch(depths, first, 0).r, texelFetch(depths, first + ivec2(1, 0), 0).r,
              texelFetch(depths, first + ivec2(0, 1), 0).r, texelFetch(depths, first + ivec2(1, 1), 0).r);
}

vec3 normalOf(uint mark) { return vec3(uvec3(mark, mark >> 10, mark >> 20) & 1023u) / 511. - 1.; }

vec4 meters(vec4 depth) {
  return is_orthographic > 0. ? mix(vec4(range.x), vec4(range.y), depth)
                              : range.x * range.y / (range.y - depth * (range.y - range.x));
}

// From the center of the picture to a sample, at a depth of 1 m.
vec3 offsetOf(vec2 sample_at) {
  vec2 share = 2. * sample_at / size - 1.;
  return share.x * to_right - share.y * to_bottom;
}
vec3 stepRight() { return 2. / size.x * to_right; }
vec3 stepUp() { return -2. / size.y * to_bottom; }

vec3 placeAt(vec3 offset, float depth) {
  return eye + depth * forward + (is_orthographic > 0. ? 1. : depth) * offset;
}
)";

/// Tells kinds of pixels apart by their depth: samples that are alike, others, or no shape.
inline constexpr const char* kKindFragment = R"(
uniform float alike, mixed;  // depths
const float kTurned = .2;    // most difference of normals
void main() {
  ivec2 first = firstSample();
  uvec2 a = texelFetch(samples, first, 0).xy, b = texelFetch(samples, first + ivec2(1, 0), 0).xy,
        c = texelFetch(samples, first + ivec2(0, 1), 0).xy, d = texelFetch(samples, first + ivec2(1, 1), 0).xy;
  vec3 n = normalOf(a.y), turn = max(max(abs(normalOf(b.y) - n), abs(normalOf(c.y) - n)), abs(normalOf(d.y) - n));
  bool same = a.x == b.x && a.x == c.x && a.x == d.x;
  gl_FragDepth = same && max(turn.x, max(turn.y, turn.z)) < kTurned ? a.x == 0xff000000u ? 0. : alike : mixed;
}
)";

/// Precedes shaders with shadows.
inline constexpr const char* kSun = R"(
uniform sampler2DShadow shadow_map;
uniform mat4 to_shadow;       // from the world to the shadow map
uniform vec3 shade_from, shade_to;  // corners of a box around all shadows, on the map
uniform float softness;              // of the shadows' edges: a unit of the places below, on the map

// Returns the share of light at six places in a disk with a radius of 5, in golden angles.
float lightInDisk(vec3 p, mat2 turn) {
#define LIGHT_AT(x, y) texture(shadow_map, vec3(p.xy + turn * vec2(x, y), p.z))
  return (LIGHT_AT(1.443376, 0.) + LIGHT_AT(-1.843422, 1.688726) + LIGHT_AT(.282165, -3.215128) +
          LIGHT_AT(2.323514, 3.030613) + LIGHT_AT(-4.263934, -.754230) + LIGHT_AT(4.039171, -2.569390)) / 6.;
}

// Returns the share of the sun's light at the samples from `from` to `until` of a pixel, averaged over the disk, which
// each sample rotates differently. One sample is enough if its disk is all in light or all in shadow.
float sunlight(vec3 place, vec3 right, vec3 up, int from, int until) {
  const float kBias = .0002;  // share of the depth
  vec3 p = (to_shadow * vec4(place, 1.)).xyz, p_right = mat3(to_shadow) * right, p_up = mat3(to_shadow) * up;
  p.z -= kBias;
  if (any(lessThan(p, shade_from)) || any(greaterThan(p, shade_to))) until = -1;
  float sum = 0., count = 0.;
  for (int i = from; i <= until; ++i) {
    vec2 sample_at = vec2(firstSample() + ivec2(i & 1, i >> 1)) + .5;
    float angle = 2. * kPi * fract(52.9829189 * fract(dot(sample_at, vec2(.06711056, .00583715))));
    float c = cos(angle) * softness, s = sin(angle) * softness;
    vec3 at = p + float(i & 1) * p_right + float(i >> 1) * p_up;
    float share = lightInDisk(at, mat2(c, s, -s, c));
    sum += share;
    count += 1.;
    if (i == from && (share == 0. || share > .999)) break;
  }
  return count > 0. ? sum / count : 1.;
}
)";

/// Precedes shaders of the floor: its shadows, lines around large squares and five by five small ones in each, x red, y
/// green.
inline constexpr const char* kFloor = R"(
uniform float square, floor_height;  // m
uniform vec3 ink;

// Depths of the floor at offsets with these heights.
vec4 floorDepths(vec4 rise) {
  return is_orthographic > 0. ? (floor_height - eye.z - rise) / forward.z : (floor_height - eye.z) / (forward.z + rise);
}

// Returns the share of each sample that the floor covers, before surfaces at these depths, and its color.
vec4 floorCover(vec3 offset, vec4 behind, bool has_shadows, out vec3 color) {
  vec3 right = stepRight(), up = stepUp();
  vec4 away = floorDepths(offset.z + vec4(0., right.z, up.z, right.z + up.z));
  vec4 seen = vec4(lessThan(away, min(behind, vec4(range.y)))) * vec4(greaterThan(away, vec4(range.x)));
  away = clamp(away, -1e6, 1e6);
  vec3 at = placeAt(offset, away.x);
  vec3 to_x = placeAt(offset + right, away.y) - at, to_y = placeAt(offset + up, away.z) - at;

  float reach = 1. - smoothstep(3., 14., length(at.xy - eye.xy) / square);
  vec2 width = (abs(to_x.xy) + abs(to_y.xy)) / square, per_width = 1. / max(width, vec2(1e-6));
  vec2 per_axis = 1. / max(1.5 * square * width.yx, vec2(1e-6));
  vec2 fade = 1. - smoothstep(vec2(.15), vec2(.5), vec2(5., 1.) * max(width.x, width.y));
  float night = step(.35, ink.g);
  vec3 red = mix(vec3(.45, .05, .05), vec3(.8, .2, .18), night);
  vec3 green = mix(vec3(.05, .28, .08), vec3(.12, .6, .22), night);
  vec4 drawn;
  vec3 sum = vec3(0.);
  for (int i = 0; i < 4; ++i) {
    vec2 p = at.xy + float(i & 1) * to_x.xy + float(i >> 1) * to_y.xy, cell = p / square;
    vec2 small = abs(fract(5. * cell - .5) - .5) * .2 * per_width, large = abs(fract(cell - .5) - .5) * per_width;
    vec2 line = fade * (1. - min(vec2(min(small.x, small.y), min(large.x, large.y)), 1.));
    vec2 axis = (1. - min(abs(p.yx) * per_axis, 1.)) * reach;
    drawn[i] = max(reach * max(.16 * line.x, .42 * line.y), .6 * max(axis.x, axis.y));
    sum += drawn[i] * mix(mix(ink, green, axis.y), red, axis.x);
  }
  float shade = has_shadows ? .26 * (1. - sunlight(at, to_x, to_y, 0, 3)) : 0.;
  vec4 covered = shade + drawn * (1. - shade);
  color = fogged(encoded(bent(sum * (1. - shade) / max(dot(covered, vec4(1.)), 1e-4))), away.x);
  return covered * seen;
}
)";

/// Three kinds of floors: not in the shade, with shadows, and before surfaces.
inline constexpr const char* kBeforeNothing = R"(
const float kReceives = 0.;
vec4 surfaces(ivec2 first) { return vec4(1e30); }
)";
inline constexpr const char* kInShadows = R"(
const float kReceives = 1.;
vec4 surfaces(ivec2 first) { return vec4(1e30); }
)";
inline constexpr const char* kBeforeSurfaces = R"(
const float kReceives = 1.;
vec4 surfaces(ivec2 first) { return meters(depthsAt(first)); }
)";

inline constexpr const char* kFloorFragment = R"(
out vec4 painted;
void main() {
  ivec2 first = firstSample();
  vec3 color;
  vec4 covered = floorCover(offsetOf(vec2(first) + .5), surfaces(first), kReceives > 0., color);
  painted = vec4(color, dot(covered, vec4(.25)));
}
)";

/// Precedes shaders of surfaces.
inline constexpr const char* kSurface = R"(
uniform float normal_bias;  // m, against shadows of a surface on itself

// Returns what is seen of a surface. `color`: of its sample, `depth`: m; see shaded() and sunlight() for the others.
vec3 seenSurface(uint color, float depth, vec3 n, vec3 v, vec3 change, vec3 place, vec3 right, vec3 up, int from,
                 int until) {
  vec3 stored = vec3(uvec3(color, color >> 8, color >> 16) & 255u) / 255.;
  uint kind = color >> 24;
  float sun = sunlight(place + normal_bias * n, right, up, from, dot(n, towards[0]) > 0. ? until : -1);
  vec3 seen = (kind & 1u) == 0u ? stored : encoded(bent(shaded(stored * stored, n, v, change, sun)));
  return kind < 2u ? fogged(seen, depth) : seen;
}

vec3 towardsEye(vec3 place) { return is_orthographic > 0. ? -forward : normalize(eye - place); }
)";

/// Pixels whose samples are alike. Their surface is nearly flat, and three samples give its place and normal.
inline constexpr const char* kAlikeSurface = R"(
void main() {
  ivec2 first = firstSample();
  uvec2 mark = texelFetch(samples, first, 0).xy;
  vec3 a = normalOf(mark.y), b = normalOf(texelFetch(samples, first + ivec2(1, 0), 0).y),
       c = normalOf(texelFetch(samples, first + ivec2(0, 1), 0).y);
  vec3 depth = vec3(texelFetch(depths, first, 0).r, texelFetch(depths, first + ivec2(1, 0), 0).r,
                    texelFetch(depths, first + ivec2(0, 1), 0).r);
  vec4 away = meters(vec4(depth, .5 * (depth.y + depth.z)));  // the last one in the middle of the pixel
  vec3 offset = offsetOf(vec2(first) + .5), right = stepRight(), up = stepUp(), place = placeAt(offset, away.x);
  vec3 v = towardsEye(placeAt(offset + .5 * (right + up), away.w));
  painted = vec4(seenSurface(mark.x, away.w, normalize(b + c), v, max(abs(b - a), abs(c - a)), place,
                             placeAt(offset + right, away.y) - place, placeAt(offset + up, away.z) - place, 0, 3), 1.);
}
)";

/// Other pixels with shapes: before the floor and behind transparent shapes.
inline constexpr const char* kMixedSurface = R"(
uniform sampler2D glass;  // colors times their alpha, alpha
uniform float has_floor, has_glass;
void main() {
  ivec2 first = firstSample();
  vec4 depth = depthsAt(first), away = meters(depth);
  vec3 offset = offsetOf(vec2(first) + .5), floor_color, sum = vec3(0.);
  vec4 covered = has_floor * floorCover(offset, away, true, floor_color);
  for (int i = 0; i < 4; ++i) {
    ivec2 step = ivec2(i & 1, i >> 1);
    uvec2 mark = texelFetch(samples, first + step, 0).xy;
    vec3 place = placeAt(offset + float(step.x) * stepRight() + float(step.y) * stepUp(), away[i]), no = vec3(0.);
    vec3 seen = seenSurface(mark.x, away[i], normalize(normalOf(mark.y)), towardsEye(place), no, place, no, no, i, i);
    vec4 before = has_glass * texelFetch(glass, first + step, 0);
    seen = mix(depth[i] < 1. ? seen : fog_color, floor_color, covered[i]);
    sum += seen * (1. - before.a) + before.rgb;
  }
  painted = vec4(.25 * sum, 1.);
}
)";

/// Transparent shapes before all other pixels.
inline constexpr const char* kGlassPixel = R"(
uniform sampler2D glass;  // colors times their alpha, alpha
out vec4 painted;
void main() {
  ivec2 first = firstSample();
  painted = .25 * (texelFetch(glass, first, 0) + texelFetch(glass, first + ivec2(1, 0), 0) +
                   texelFetch(glass, first + ivec2(0, 1), 0) + texelFetch(glass, first + ivec2(1, 1), 0));
}
)";

}  // namespace kinegraph::shaders
