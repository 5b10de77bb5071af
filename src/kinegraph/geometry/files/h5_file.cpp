#include "kinegraph/geometry/files/h5_file.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr std::size_t kMaxEntries = 4096;  // of one group, of its tree, and of one object header

enum MessageType { kDataspace = 0x01, kDatatype = 0x03, kLayout = 0x08, kContinuation = 0x10, kSymbolTable = 0x11 };

}  // namespace

H5File::H5File(std::string path) : path_(std::move(path)) {
  std::ifstream stream(path_, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  if (!stream) throw FileError(cat("HDF5 file '", path_, "' cannot be read"));
  bytes_ = bytes.str();
  expectMark(0, "\x89HDF\r\n\x1a\n");
  const std::uint64_t version = number(8, 1);
  if (version > 1) fail(cat("superblock version ", version, " (written with libver='latest') is not supported"));
  if (number(13, 1) != 8 || number(14, 1) != 8) fail("addresses that are not 8 bytes long are not supported");
  const std::uint64_t addresses = version == 0 ? 24 : 28;
  if (number(addresses, 8) != 0) fail("a base address other than 0 is not supported");
  root_ = number(addresses + 4 * 8 + 8, 8);
}

void H5File::fail(const std::string& what) const { throw FileError(cat("HDF5 file '", path_, "': ", what)); }

std::uint64_t H5File::number(std::uint64_t at, int bytes) const {
  if (at > bytes_.size() || bytes_.size() - at < std::uint64_t(bytes))
    fail("an address beyond the end; the file is damaged");
  std::uint64_t value = 0;
  for (int i = bytes - 1; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes_[at + i]);
  return value;
}

double H5File::element(std::uint64_t at, int bytes, bool floating, bool is_signed) const {
  const std::uint64_t bits = number(at, bytes);
  if (floating) return bytes == 4 ? std::bit_cast<float>(std::uint32_t(bits)) : std::bit_cast<double>(bits);
  if (!is_signed) return double(bits);
  const int unused = 64 - 8 * bytes;
  return double(std::int64_t(bits << unused) >> unused);
}

void H5File::expectMark(std::uint64_t at, std::string_view mark) const {
  number(at, 1);
  if (bytes_.compare(at, mark.size(), mark) != 0)
    fail(at == 0 ? "not an HDF5 file" : cat("no '", mark, "' at ", at, "; the file is damaged"));
}

std::vector<H5File::Message> H5File::messages(std::uint64_t header) const {
  if (number(header, 1) != 1) fail("object headers of version 2 are not supported");
  const std::uint64_t count = number(header + 2, 2);
  struct Block {
    std::uint64_t at, end;
  };
  std::vector<Block> blocks = {{header + 16, header + 16 + number(header + 8, 4)}};
  std::vector<Message> messages;
  for (std::size_t b = 0; b < blocks.size() && blocks.size() < kMaxEntries; ++b) {
    auto [at, end] = blocks[b];
    while (at + 8 <= end && messages.size() < std::min<std::uint64_t>(count, kMaxEntries)) {
      const Message message{int(number(at, 2)), at + 8, number(at + 2, 2)};
      messages.push_back(message);
      if (message.type == kContinuation) {
        const std::uint64_t next = number(message.at, 8), length = number(message.at + 8, 8);
        if (length > bytes_.size()) fail("a header longer than the file; the file is damaged");
        blocks.push_back({next, next + length});
      }
      at = message.at + message.size;
    }
  }
  return messages;
}

std::vector<H5File::Link> H5File::links(std::uint64_t header) const {
  std::vector<Link> links;
  std::size_t visits = 0;
  for (const Message& message : messages(header)) {
    if (message.type != kSymbolTable) continue;
    const std::uint64_t heap = number(message.at + 8, 8);
    expectMark(heap, "HEAP");
    collectLinks(number(message.at, 8), number(heap + 24, 8), visits, links);
  }
  return links;
}

void H5File::collectLinks(std::uint64_t node, std::uint64_t names, std::size_t& visits,
                          std::vector<Link>& links) const {
  if (++visits > kMaxEntries) fail(cat("a group of more than ", kMaxEntries, " nodes"));
  if (number(node, 4) == 0x45455254) {  // "TREE"
    const std::uint64_t count = number(node + 6, 2);
    for (std::uint64_t i = 0; i < count; ++i) collectLinks(number(node + 24 + 8 + 16 * i, 8), names, visits, links);
    return;
  }
  expectMark(node, "SNOD");
  const std::uint64_t count = number(node + 6, 2);
  for (std::uint64_t i = 0; i < count; ++i) {
    if (links.size() >= kMaxEntries) fail(cat("a group of more than ", kMaxEntries, " entries"));
    const std::uint64_t entry = node + 8 + 40 * i, name = names + number(entry, 8);
    number(name, 1);
    links.push_back({bytes_.substr(name, bytes_.find('\0', name) - name), number(entry + 8, 8)});
  }
}

std::uint64_t H5File::find(std::string_view name) const {
  std::uint64_t header = root_;
  while (!name.empty()) {
    const std::string_view part = name.substr(0, name.find('/'));
    name.remove_prefix(std::min(name.size(), part.size() + 1));
    if (part.empty()) continue;
    std::uint64_t next = 0;
    for (const Link& link : links(header)) {
      if (link.name == part) next = link.header;
    }
    if (next == 0) return 0;
    header = next;
  }
  return header;
}

bool H5File::contains(std::string_view name) const { return find(name) != 0; }

std::vector<std::string> H5File::entries(std::string_view group) const {
  const std::uint64_t header = find(group);
  std::vector<std::string> names;
  if (header == 0) return names;
  for (const Link& link : links(header)) names.push_back(group.empty() ? link.name : cat(group, "/", link.name));
  return names;
}

H5Dataset H5File::dataset(std::string_view name) const {
  const std::uint64_t header = find(name);
  if (header == 0) {
    const std::string_view group = name.substr(0, std::min(name.rfind('/'), name.size()));
    fail(cat("no object '", name, "'; available: ", join(entries(contains(group) ? group : ""))));
  }
  H5Dataset data;
  std::uint64_t count = 1, at = 0, length = 0;
  int bytes = 0;
  bool floating = false, is_signed = false, placed = false;
  for (const Message& message : messages(header)) {
    if (message.type == kDataspace) {
      const std::uint64_t first = message.at + (number(message.at, 1) == 1 ? 8 : 4);
      for (std::uint64_t i = 0; i < number(message.at + 1, 1); ++i) {
        data.dims.push_back(number(first + 8 * i, 8));
        if (data.dims.back() > bytes_.size()) fail(cat("'", name, "' has a size larger than the file"));
        count = count * data.dims.back();
        if (count > bytes_.size()) fail(cat("'", name, "' has a size larger than the file"));
      }
    } else if (message.type == kDatatype) {
      const std::uint64_t kind = number(message.at, 1) & 15, flags = number(message.at + 1, 3);
      bytes = int(number(message.at + 4, 4));
      floating = kind == 1;
      is_signed = flags & 8;
      const bool known =
          floating ? bytes == 4 || bytes == 8 : kind == 0 && (bytes == 1 || bytes == 2 || bytes == 4 || bytes == 8);
      if (!known || (flags & 1))
        fail(cat("'", name, "' does not contain little-endian integers or 32- or 64-bit floats"));
    } else if (message.type == kLayout) {
      const std::uint64_t version = number(message.at, 1), kind = number(message.at + 1, 1);
      if (version < 3 || version > 4 || kind > 1)
        fail(cat("'", name, "' is stored in chunks or compressed, which is not supported"));
      at = kind == 0 ? message.at + 4 : number(message.at + 2, 8);
      length = kind == 0 ? number(message.at + 2, 2) : number(message.at + 10, 8);
      placed = true;
    }
  }
  if (!placed || bytes == 0) fail(cat("'", name, "' is not a dataset"));
  if (count == 0) return data;
  if (length < count * std::uint64_t(bytes)) fail(cat("'", name, "' is shorter than its stated size"));
  number(at, 1);
  number(at + count * std::uint64_t(bytes) - 1, 1);
  data.numbers.reserve(count);
  for (std::uint64_t i = 0; i < count; ++i)
    data.numbers.push_back(element(at + i * std::uint64_t(bytes), bytes, floating, is_signed));
  return data;
}

}  // namespace kinegraph::inline geometry_internal
