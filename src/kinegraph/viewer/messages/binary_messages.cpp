#include "kinegraph/viewer/messages/binary_messages.h"

#include <algorithm>
#include <array>
#include <bit>

#include "kinegraph/viewer/messages/packed_mesh.h"

namespace kinegraph::inline viewer_internal {

namespace {

bool isPlainSurface(const Mesh& mesh, const std::vector<int>& images) {
  return images.empty() && !mesh.triangles.empty() &&
         std::all_of(mesh.vertices.begin(), mesh.vertices.end(), [](const Vector3d& p) { return p.allFinite(); });
}

/// Appends the differences of words from those `stride` before, z(x) = 2x or -2x - 1, in 4 planes of bytes (all lowest
/// ones first): a motion has small ones, which compress well.
void appendDifferences(std::string& data, const std::vector<std::uint32_t>& words, std::size_t stride) {
  std::vector<std::uint32_t> codes(words.size());
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::uint32_t change = words[i] - (i < stride ? 0u : words[i - stride]);
    codes[i] = change << 1 ^ (change >> 31 ? ~0u : 0u);
  }
  for (int shift = 0; shift < 32; shift += 8) {
    for (const std::uint32_t code : codes) data += char(code >> shift & 0xff);
  }
}

std::uint32_t wordOf(double number) { return std::bit_cast<std::uint32_t>(float(number)); }

}  // namespace

std::string encodeMesh(int number, const Mesh& mesh, const std::vector<int>& images, double cell) {
  if (isPlainSurface(mesh, images)) return packMesh(number, mesh, cell);
  std::string data;
  const std::size_t vertices = mesh.vertices.size();
  const std::size_t colors = mesh.colors.size() == vertices || mesh.colors.size() == 1 ? mesh.colors.size() : 0;
  appendBytes(data, BinaryKind::mesh);
  appendBytes(data, std::uint32_t(number));
  appendBytes(data, std::uint32_t(vertices));
  appendBytes(data, std::uint32_t(mesh.triangles.size()));
  appendBytes(data, std::uint32_t(colors));
  appendBytes(data, std::uint32_t(images.empty() ? 0 : vertices));
  appendBytes(data, std::uint32_t(images.size()));
  for (const Vector3d& p : mesh.vertices) {
    for (int i = 0; i < 3; ++i) appendBytes(data, float(p[i]));
  }
  for (const auto& triangle : mesh.triangles) appendBytes(data, triangle);
  if (!images.empty()) {
    for (const auto& place : mesh.texcoords) appendBytes(data, place);
  }
  for (std::size_t i = 0; i < images.size(); ++i) {
    appendBytes(data, std::array{mesh.textures[i].first, mesh.textures[i].count, std::uint32_t(images[i])});
  }
  for (std::size_t i = 0; i < colors; ++i) appendBytes(data, mesh.colors[i]);
  return data;
}

void appendPose(std::string& data, const Pose& pose) {
  const Vector7d numbers = pose.numbers();
  for (int k = 0; k < 7; ++k) appendBytes(data, float(numbers[k]));
}

std::string encodeMotion(const ShownMotion& motion) {
  std::string data;
  appendBytes(data, BinaryKind::motion);
  appendBytes(data, std::uint32_t(motion.poses.size()));
  appendBytes(data, std::uint32_t(motion.poses.empty() ? 0 : motion.poses[0].size()));
  appendBytes(data, std::uint32_t(motion.q.cols()));
  std::vector<std::uint32_t> words;
  for (const auto& slice : motion.poses) {
    for (const Pose& pose : slice) {
      for (const double number : pose.numbers()) words.push_back(wordOf(number));
    }
  }
  appendDifferences(data, words, motion.poses.empty() ? 1 : 7 * motion.poses[0].size());
  words.clear();
  for (Eigen::Index t = 0; t < motion.q.rows(); ++t) {
    for (Eigen::Index i = 0; i < motion.q.cols(); ++i) words.push_back(wordOf(motion.q(t, i)));
  }
  appendDifferences(data, words, std::size_t(motion.q.cols()));
  return data;
}

std::string encodeQuad(const Quad& quad) {
  std::string data;
  appendBytes(data, BinaryKind::quad);
  for (const int number : {quad.id, quad.columns, quad.rows}) appendBytes(data, std::int32_t(number));
  for (const double number : {quad.x, quad.y, quad.height, quad.zoom}) appendBytes(data, float(number));
  data.append(reinterpret_cast<const char*>(quad.rgb.data()), quad.rgb.size());
  return data;
}

std::string encodeJoints(const VectorXd& q) {
  std::string data;
  appendBytes(data, BinaryKind::joints);
  appendBytes(data, std::uint32_t(q.size()));
  for (const double value : q) appendBytes(data, value);
  return data;
}

}  // namespace kinegraph::inline viewer_internal
