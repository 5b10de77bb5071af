#pragma once

/// The shaders of pictures (GLSL 3.30). They compute what the page computes with three.js: its standard material under
/// a sky, a sun with soft shadows and further lights, its tone mapping, and the page's own floor.
///
/// A picture has 2 x 2 samples per pixel. What opaque shapes show at each sample is drawn first: a color, a normal and
/// a depth, without light. Then each pixel is lit: once if its samples are alike, else once per sample.
namespace kinegraph::shaders {

inline constexpr const char* kSurfaceVertex = R"(#version 330
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 place;
uniform mat4 to_image, pose;
out vec3 at, up;
out vec2 on_picture;
void main() {
  at = (pose * vec4(position, 1.)).xyz;
  up = mat3(pose) * normal;
  on_picture = place;
  gl_Position = to_image * vec4(at, 1.);
}
)";

inline constexpr const char* kShadowVertex = R"(#version 330
layout(location = 0) in vec3 position;
uniform mat4 to_map;
void main() { gl_Position = to_map * vec4(position, 1.); }
)";

inline constexpr const char* kDepthFragment = R"(#version 330
void main() {}
)";

/// Precedes all shaders of colors.
inline constexpr const char* kColors = R"(#version 330
const float kPi = 3.141592653589793;
uniform vec3 fog_color;
uniform vec2 fog;  // m, depths of its beginning and end

// From a linear scale to sRGB. A polynomial in the fourth root stands for the power 1 / 2.4; it is off by .0005 at most.
vec3 encoded(vec3 c) {
  vec3 u = sqrt(sqrt(max(c, 0.)));
  return mix(((-.133023 * u + .943858) * u + .261842) * u - .072998, 12.92 * c, vec3(lessThanEqual(c, vec3(.0031308))));
}

// Values above .8 bend towards white.
vec3 bent(vec3 c) {
  float peak = max(c.r, max(c.g, c.b));
  return peak < .8 ? c : c * (1. - .04 / (peak - .6)) / peak;
}

vec3 fogged(vec3 c, float depth) { return mix(c, fog_color, smoothstep(fog.x, fog.y, depth)); }
)";

/// Samples of surfaces and lines: a color, which the lights shine on or not, and a normal.
inline constexpr const char* kSamples = R"(
uniform int kind;      // 1: lit, 2: without fog
uniform int shading;   // 0: the color itself, 1: as a symbol, 2: by the lights
out uvec2 sampled;     // 8 bits each of red, green, blue and the kind; 10 bits each of the normal

// Lit colors are stored as square roots, other ones as they are shown.
vec3 stored(vec3 c) { return shading == 2 ? sqrt(c) : encoded(shading == 0 ? c : bent(c)); }

uint packedColor(vec3 c) {
  uvec3 u = uvec3(255. * clamp(c, 0., 1.) + .5);
  return u.r | u.g << 8 | u.b << 16 | uint(kind) << 24;
}

uint packedNormal(vec3 n) {
  uvec3 u = uvec3(511. * n + 511.5);
  return u.x | u.y << 10 | u.z << 20;
}
)";

inline constexpr const char* kSurfaceSample = R"(
in vec3 at, up;
in vec2 on_picture;
uniform vec4 stored_color;
void main() { sampled = uvec2(packedColor(stored_color.rgb), packedNormal(normalize(up))); }
)";

inline constexpr const char* kTexturedSample = R"(
in vec3 at, up;
in vec2 on_picture;
uniform sampler2D picture;
void main() { sampled = uvec2(packedColor(stored(texture(picture, on_picture).rgb)), packedNormal(normalize(up))); }
)";

inline constexpr const char* kTintSample = R"(
in vec3 tint;
uniform vec4 color;  // linear
void main() {
  cutEnds();
  sampled = uvec2(packedColor(stored(tint * color.rgb)), packedNormal(vec3(0., 0., 1.)));
}
)";

/// How the lights shine on a surface; precedes shaders of surfaces. ADD_OTHER_LIGHTS is ADD_LIGHT(1)
/// ADD_LIGHT(2) ..., because software is slow at indices that are no constants.
inline constexpr const char* kLights = R"(
const float kMetalness = .05, kRoughness = .55;
uniform vec3 sky, ground;
uniform vec3 towards[8], strength[8];  // of the lights; the first is the sun
out vec4 painted;

vec3 schlick(vec3 f0, float cosine) {
  float share = exp2((-5.55473 * cosine - 6.98316) * cosine);
  return f0 * (1. - share) + share;
}

struct Finish {
  vec3 diffuse, f0, compensation;
  float a2, nv;
};

// `l`, `n`, `v`: towards the light, away from the surface, towards the eye
vec3 shone(Finish finish, vec3 l, vec3 n, vec3 v) {
  vec3 h = normalize(l + v);
  float nl = clamp(dot(n, l), 0., 1.), nh = clamp(dot(n, h), 0., 1.), vh = clamp(dot(v, h), 0., 1.);
  float a2 = finish.a2, nv = finish.nv;
  float visibility = .5 / max(nl * sqrt(a2 + (1. - a2) * nv * nv) + nv * sqrt(a2 + (1. - a2) * nl * nl), 1e-6);
  float spread = nh * nh * (a2 - 1.) + 1., density = a2 / (kPi * spread * spread);
  vec3 gloss = schlick(finish.f0, vh) * visibility * density * finish.compensation;
  return nl * (gloss + finish.diffuse * (1. - schlick(vec3(.04), vh)));
}

// `change`: of the normal from one sample to the next, `sun`: share of its light
vec3 shaded(vec3 albedo, vec3 n, vec3 v, vec3 change, float sun) {
  float roughness = min(kRoughness + max(change.x, max(change.y, change.z)), 1.), a2 = roughness * roughness;
  vec3 diffuse = albedo * (1. - kMetalness) / kPi, f0 = mix(vec3(.04), albedo, kMetalness);
  float nv = clamp(dot(n, v), 0., 1.);

  // the share of light that surfaces of this roughness reflect without scattering (Karis' approximation)
  vec4 r = roughness * vec4(-1., -.0275, -.572, .022) + vec4(1., .0425, 1.04, -.04);
  vec2 dfg = vec2(-1.04, 1.04) * (min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y) + r.zw;
  float single = .04 * dfg.x + dfg.y, rest = 1. - dfg.x - dfg.y, mean = .04 + .96 / 21.;
  float multiple = single * mean / (1. - rest * mean) * rest;

  Finish finish = Finish(diffuse, f0, 1. + f0 * (1. / (dfg.x + dfg.y) - 1.), a2 * a2, nv);
  vec3 sum = mix(ground, sky, .5 * n.z + .5) * diffuse * (1. - single - multiple);
  sum += sun * strength[0] * shone(finish, towards[0], n, v);
#define ADD_LIGHT(i) sum += strength[i] * shone(finish, towards[i], n, v);
  ADD_OTHER_LIGHTS
  return sum;
}
)";

/// The fragments of transparent surfaces, which receive no shadows.
inline constexpr const char* kGlassFragment = R"(
in vec3 at, up;
in vec2 on_picture;
uniform sampler2D picture;
uniform vec4 color;  // linear
uniform vec3 eye, forward;
uniform float has_picture, is_orthographic;
uniform int shading;  // 0: the color itself, 1: as a symbol, 2: by the lights
void main() {
  vec3 albedo = has_picture > 0. ? texture(picture, on_picture).rgb : color.rgb, n = normalize(up);
  vec3 v = is_orthographic > 0. ? -forward : normalize(eye - at), seen = albedo;
  if (shading == 2) seen = shaded(albedo, n, v, max(abs(dFdx(n)), abs(dFdy(n))), 1.);
  painted = vec4(fogged(encoded(shading == 0 ? seen : bent(seen)), dot(at - eye, forward)), color.a);
}
)";

/// Transparent lines and points.
inline constexpr const char* kTintFragment = R"(
in vec3 tint;
uniform vec4 color;  // linear
uniform int shading;
out vec4 painted;
void main() {
  cutEnds();
  vec3 seen = tint * color.rgb;
  painted = vec4(encoded(shading == 0 ? seen : bent(seen)), color.a);
}
)";

inline constexpr const char* kLineVertex = R"(#version 330
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec2 corner;  // end and side
layout(location = 3) in vec3 own_color;
uniform mat4 to_image, pose;
uniform vec2 size;    // samples of the picture
uniform float width;  // samples
out vec3 tint;
noperspective out vec2 on_line;  // along and across, in halves of the width
flat out float line_length;
void main() {
  vec4 a = to_image * pose * vec4(from, 1.), b = to_image * pose * vec4(to, 1.);
  const float kNear = 1e-4;
  if (a.w < kNear && b.w > kNear) a = mix(a, b, (kNear - a.w) / (b.w - a.w));
  if (b.w < kNear && a.w > kNear) b = mix(b, a, (kNear - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  vec2 direction = length(along) > 0. ? normalize(along) : vec2(1., 0.), across = vec2(-direction.y, direction.x);
  vec4 p = corner.x == 0. ? a : b;
  tint = own_color;
  line_length = length(along) / width;
  on_line = vec2(corner.x == 0. ? -1. : line_length + 1., corner.y);
  vec2 away = corner.y * across + (2. * corner.x - 1.) * direction;
  gl_Position = p + vec4(away * width / size * p.w, 0., 0.);
}
)";

/// Precedes fragments of lines: their ends are round.
inline constexpr const char* kRoundEnds = R"(
noperspective in vec2 on_line;
flat in float line_length;
void cutEnds() {
  float beyond = max(-on_line.x, on_line.x - line_length);
  if (beyond > 0. && beyond * beyond + on_line.y * on_line.y > 1.) discard;
}
)";

/// Precedes fragments of points, which are squares.
inline constexpr const char* kSquares = R"(
void cutEnds() {}
)";

inline constexpr const char* kPointVertex = R"(#version 330
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 own_color;
uniform mat4 to_image, pose;
uniform float width;        // samples
uniform float wider_at_1m;  // samples: the share of the size that depends on the depth
out vec3 tint;
void main() {
  tint = own_color;
  gl_Position = to_image * pose * vec4(position, 1.);
  gl_PointSize = width + wider_at_1m / max(gl_Position.w, 1e-4);
}
)";

}  // namespace kinegraph::shaders
