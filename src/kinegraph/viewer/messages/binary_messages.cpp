#include "kinegraph/viewer/messages/binary_messages.h"

#include <array>

namespace kinegraph {

std::string encodeMesh(int number, const Mesh& mesh, const std::vector<int>& images) {
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
  for (const auto& slice : motion.poses) {
    for (const Pose& pose : slice) appendPose(data, pose);
  }
  for (Eigen::Index t = 0; t < motion.q.rows(); ++t) {
    for (Eigen::Index i = 0; i < motion.q.cols(); ++i) appendBytes(data, float(motion.q(t, i)));
  }
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

}  // namespace kinegraph
