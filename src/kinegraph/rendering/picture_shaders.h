#pragma once

/// The shaders of pictures (GLSL 3.30). They compute what the page computes with three.js: its standard material under
/// a sky, a sun with soft shadows and further lights, its tone mapping, and the page's own floor.
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

inline constexpr const char* kShadowFragment = R"(#version 330
void main() {}
)";

/// Precedes the other fragment shaders.
inline constexpr const char* kCommon = R"(#version 330
const float kPi = 3.141592653589793;
uniform sampler2DShadow shadow_map;
uniform mat4 to_shadow;       // from the world to the shadow map
uniform float shadow_pixels;  // across the map; 0: no shadows
uniform vec3 fog_color;
uniform vec2 fog;             // m, depths of its beginning and end
out vec4 painted;

// Places in a disk with a radius of 5 pixels of the shadow map, in golden angles.
const vec2 kPlaces[6] = vec2[](
    vec2(1.443376, 0.000000),
    vec2(-1.843422, 1.688726),
    vec2(0.282165, -3.215128),
    vec2(2.323514, 3.030613),
    vec2(-4.263934, -0.754230),
    vec2(4.039171, -2.569390));

// Returns the share of the sun's light at a place, averaged over the disk, which each pixel rotates differently.
float sunlight(vec3 place) {
  const float kBias = .0002;  // share of the depth
  if (shadow_pixels == 0.) return 1.;
  vec3 p = (to_shadow * vec4(place, 1.)).xyz;
  if (any(lessThan(p, vec3(0.))) || any(greaterThan(p, vec3(1.)))) return 1.;
  float angle = 2. * kPi * fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(.06711056, .00583715))));
  float c = cos(angle) / shadow_pixels, s = sin(angle) / shadow_pixels;
  mat2 turn = mat2(c, s, -s, c);
  float sum = 0.;
  for (int i = 0; i < 6; ++i) sum += texture(shadow_map, vec3(p.xy + turn * kPlaces[i], p.z - kBias));
  return sum / 6.;
}

vec3 encoded(vec3 c) {
  return mix(1.055 * pow(max(c, 0.), vec3(1. / 2.4)) - .055, 12.92 * c, vec3(lessThanEqual(c, vec3(.0031308))));
}

// Values above .8 bend towards white.
vec3 bent(vec3 c) {
  float peak = max(c.r, max(c.g, c.b));
  return peak < .8 ? c : c * (1. - .04 / (peak - .6)) / peak;
}

vec3 fogged(vec3 c, float depth) { return mix(c, fog_color, smoothstep(fog.x, fog.y, depth)); }
)";

inline constexpr const char* kSurfaceFragment = R"(
const float kMetalness = .05, kRoughness = .55;
in vec3 at, up;
in vec2 on_picture;
uniform sampler2D picture;
uniform vec4 color;  // linear
uniform vec3 eye, forward;
uniform vec3 sky, ground;
uniform vec3 towards[8], strength[8];  // of the lights; the first is the sun
uniform int lights;
uniform float has_picture, is_orthographic, normal_bias, receives;
uniform int shading;  // 0: the color itself, 1: as a symbol, 2: by the lights

vec3 schlick(vec3 f0, float cosine) {
  float share = exp2((-5.55473 * cosine - 6.98316) * cosine);
  return f0 * (1. - share) + share;
}

vec3 shaded(vec3 albedo) {
  vec3 n = normalize(up), v = is_orthographic > 0. ? -forward : normalize(eye - at);
  vec3 change = max(abs(dFdx(n)), abs(dFdy(n)));
  float roughness = min(kRoughness + max(change.x, max(change.y, change.z)), 1.), a2 = pow(roughness, 4.);
  vec3 diffuse = albedo * (1. - kMetalness) / kPi, f0 = mix(vec3(.04), albedo, kMetalness);
  float nv = clamp(dot(n, v), 0., 1.);

  // the share of light that surfaces of this roughness reflect without scattering (Karis' approximation)
  vec4 r = roughness * vec4(-1., -.0275, -.572, .022) + vec4(1., .0425, 1.04, -.04);
  vec2 dfg = vec2(-1.04, 1.04) * (min(r.x * r.x, exp2(-9.28 * nv)) * r.x + r.y) + r.zw;
  float single = .04 * dfg.x + dfg.y, rest = 1. - dfg.x - dfg.y, mean = .04 + .96 / 21.;
  float multiple = single * mean / (1. - rest * mean) * rest;

  vec3 sum = mix(ground, sky, .5 * n.z + .5) * diffuse * (1. - single - multiple);
  for (int i = 0; i < lights; ++i) {
    vec3 l = towards[i], h = normalize(l + v);
    float nl = clamp(dot(n, l), 0., 1.), nh = clamp(dot(n, h), 0., 1.), vh = clamp(dot(v, h), 0., 1.);
    if (nl == 0.) continue;
    float visibility = .5 / max(nl * sqrt(a2 + (1. - a2) * nv * nv) + nv * sqrt(a2 + (1. - a2) * nl * nl), 1e-6);
    float spread = nh * nh * (a2 - 1.) + 1., density = a2 / (kPi * spread * spread);
    vec3 gloss = schlick(f0, vh) * visibility * density * (1. + f0 * (1. / (dfg.x + dfg.y) - 1.));
    vec3 light = nl * strength[i];
    if (i == 0 && receives > 0.) light *= sunlight(at + normal_bias * n);
    sum += light * (gloss + diffuse * (1. - schlick(vec3(.04), vh)));
  }
  return sum;
}

void main() {
  vec3 albedo = has_picture > 0. ? texture(picture, on_picture).rgb : color.rgb;
  vec3 seen = shading == 0 ? albedo : bent(shading == 1 ? albedo : shaded(albedo));
  painted = vec4(fogged(encoded(seen), dot(at - eye, forward)), color.a);
}
)";

/// Lines and points.
inline constexpr const char* kLineVertex = R"(#version 330
layout(location = 0) in vec3 from;
layout(location = 1) in vec3 to;
layout(location = 2) in vec2 corner;  // end and side
layout(location = 3) in vec3 own_color;
uniform mat4 to_image, pose;
uniform vec2 size;    // pixels of the image
uniform float width;  // pixels
out vec3 tint;
void main() {
  vec4 a = to_image * pose * vec4(from, 1.), b = to_image * pose * vec4(to, 1.);
  const float kNear = 1e-4;
  if (a.w < kNear && b.w > kNear) a = mix(a, b, (kNear - a.w) / (b.w - a.w));
  if (b.w < kNear && a.w > kNear) b = mix(b, a, (kNear - b.w) / (a.w - b.w));
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  vec2 across = length(along) > 0. ? normalize(vec2(-along.y, along.x)) : vec2(0.);
  vec4 p = corner.x == 0. ? a : b;
  tint = own_color;
  gl_Position = p + vec4(corner.y * across * width / size * p.w, 0., 0.);
}
)";

inline constexpr const char* kPointVertex = R"(#version 330
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 own_color;
uniform mat4 to_image, pose;
uniform float width;  // pixels
out vec3 tint;
void main() {
  tint = own_color;
  gl_PointSize = width;
  gl_Position = to_image * pose * vec4(position, 1.);
}
)";

inline constexpr const char* kTintFragment = R"(
in vec3 tint;
uniform vec4 color;
uniform int shading;
void main() {
  vec3 seen = tint * color.rgb;
  painted = vec4(encoded(shading == 0 ? seen : bent(seen)), color.a);
}
)";

inline constexpr const char* kFloorVertex = R"(#version 330
layout(location = 0) in vec3 position;  // corners of a square of half width 1
uniform mat4 to_image;
uniform vec3 center;
uniform float half_width;
out vec3 at;
void main() {
  at = center + half_width * position;
  gl_Position = to_image * vec4(at, 1.);
}
)";

/// The shadows on the floor, lines around large squares and five by five small ones in each, x red, y green.
inline constexpr const char* kFloorFragment = R"(
in vec3 at;
uniform vec3 eye, forward, ink;
uniform float square;  // m
float gridLine(float spacing) {
  vec2 cell = at.xy / spacing, width = fwidth(cell);
  vec2 away = abs(fract(cell - .5) - .5) / max(width, vec2(1e-6));
  return (1. - min(min(away.x, away.y), 1.)) * (1. - smoothstep(.15, .5, max(width.x, width.y)));
}
float axisLine(float across) { return 1. - min(abs(across) / max(1.5 * fwidth(across), 1e-6), 1.); }
void main() {
  float reach = 1. - smoothstep(3., 14., length(at.xy - eye.xy) / square);
  float line = max(.16 * gridLine(.2 * square), .42 * gridLine(square)) * reach;
  float along_x = axisLine(at.y) * reach, along_y = axisLine(at.x) * reach;
  float night = step(.35, ink.g);
  vec3 red = mix(vec3(.45, .05, .05), vec3(.8, .2, .18), night);
  vec3 green = mix(vec3(.05, .28, .08), vec3(.12, .6, .22), night);
  vec3 colored = mix(mix(ink, green, along_y), red, along_x);
  float drawn = max(line, .6 * max(along_x, along_y));
  float shade = .26 * (1. - sunlight(at));
  float covered = shade + drawn * (1. - shade);
  vec3 seen = colored * drawn * (1. - shade) / max(covered, 1e-4);
  painted = vec4(fogged(encoded(bent(seen)), dot(at - eye, forward)), covered);
}
)";

}  // namespace kinegraph::shaders
