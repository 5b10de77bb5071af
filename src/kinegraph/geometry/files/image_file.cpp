#include "kinegraph/geometry/files/image_file.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/image_decoders.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr char kPngMark[] = "\x89PNG\r\n\x1a\n";

bool isPng(const std::string& bytes) { return bytes.starts_with(kPngMark); }
bool isJpeg(const std::string& bytes) { return bytes.starts_with("\xff\xd8\xff"); }

void appendBigEndian(std::string& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char(word >> shift & 255);
}

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = ~0u;
  for (const char c : bytes) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xedb88320u : 0u);
  }
  return ~crc;
}

void appendChunk(std::string& file, const std::string& kind, const std::string& data) {
  appendBigEndian(file, std::uint32_t(data.size()));
  file += kind + data;
  appendBigEndian(file, crc32(kind + data));
}

}  // namespace

bool isImage(const std::string& bytes) { return isPng(bytes) || isJpeg(bytes); }

std::string mediaType(const Image& image) { return isPng(image.bytes) ? "image/png" : "image/jpeg"; }

std::shared_ptr<const Image> readImageFile(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) throw FileError(cat("image '", path, "' does not exist"));
  std::ifstream stream(path, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) throw FileError(cat("image '", path, "' cannot be read"));
  auto image = std::make_shared<Image>(Image{bytes.str(), path});
  if (!isImage(image->bytes)) throw FileError(cat("image '", path, "' is neither a PNG nor a JPEG file"));
  return image;
}

Pixels decodeImage(const Image& image) {
  try {
    return isPng(image.bytes) ? decodePng(image.bytes) : decodeJpeg(image.bytes);
  } catch (const FileError& error) {
    throw FileError(
        cat("image '", image.path.empty() ? "inside a mesh file" : image.path, "' cannot be read: ", error.what()));
  }
}

Image encodePng(const Pixels& pixels) {
  std::string raw;
  for (int row = 0; row < pixels.height; ++row) {
    raw += '\0';  // no filter
    const std::size_t width = 3 * std::size_t(pixels.width);
    raw.append(reinterpret_cast<const char*>(&pixels.rgb[width * std::size_t(row)]), width);
  }
  std::string stored = "\x78\x01";
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : raw) {
    a = (a + static_cast<unsigned char>(c)) % 65521;
    b = (b + a) % 65521;
  }
  constexpr std::size_t kBlock = 65535;
  for (std::size_t at = 0; at < raw.size(); at += kBlock) {
    const std::size_t size = std::min(kBlock, raw.size() - at);
    stored += char(at + size == raw.size());
    for (const std::size_t number : {size, ~size}) stored += {char(number & 255), char(number >> 8 & 255)};
    stored.append(raw, at, size);
  }
  appendBigEndian(stored, b << 16 | a);
  Image image{kPngMark};
  std::string header;
  appendBigEndian(header, std::uint32_t(pixels.width));
  appendBigEndian(header, std::uint32_t(pixels.height));
  header += {8, 2, 0, 0, 0};  // bits, rgb, deflate, filters, not interlaced
  appendChunk(image.bytes, "IHDR", header);
  appendChunk(image.bytes, "IDAT", stored);
  appendChunk(image.bytes, "IEND", "");
  return image;
}

}  // namespace kinegraph::inline geometry_internal
