#include <bit>
#include <cstdint>
#include <cstring>

#include "kinegraph/common/text.h"
#include "kinegraph/gfile/typed_array.h"

namespace kinegraph::inline gfile_internal {

namespace {

std::vector<unsigned char> decodeBase64(const std::string& text) {
  std::vector<unsigned char> bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    static constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    if (c == '=' || c == '\n' || c == '\r' || c == ' ') continue;
    const std::size_t value = kLetters.find(c);
    if (value == std::string_view::npos) throw ValueError(cat("'", c, "' in the base64 data of an array"));
    bits = bits << 6 | std::uint32_t(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<unsigned char>(bits >> count));
  }
  return bytes;
}

template <class T>
std::vector<double> numbersOf(const std::vector<unsigned char>& bytes) {
  std::vector<double> numbers(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    numbers[i] = double(value);
  }
  return numbers;
}

using Decoder = std::vector<double> (*)(const std::vector<unsigned char>&);

Decoder decoderOf(std::string_view type) {
  struct Entry {
    const char* type;
    Decoder decoder;
  };
  static constexpr Entry kEntries[] = {
      {"float64", numbersOf<double>},       {"double", numbersOf<double>},        {"float32", numbersOf<float>},
      {"float", numbersOf<float>},          {"uint8", numbersOf<std::uint8_t>},   {"int8", numbersOf<std::int8_t>},
      {"uint16", numbersOf<std::uint16_t>}, {"int16", numbersOf<std::int16_t>},   {"uint32", numbersOf<std::uint32_t>},
      {"int32", numbersOf<std::int32_t>},   {"uint64", numbersOf<std::uint64_t>}, {"int64", numbersOf<std::int64_t>}};
  for (const Entry& entry : kEntries) {
    if (type == entry.type) return entry.decoder;
  }
  return nullptr;
}

}  // namespace

void decodeTypedArray(Value& value) {
  static_assert(std::endian::native == std::endian::little);
  const ValueList* list = value.as<ValueList>();
  if (!list || list->size() != 3) return;
  const std::string* type = (*list)[0].as<std::string>();
  const NumberArray* dims = (*list)[1].as<NumberArray>();
  const Decoder decode = type ? decoderOf(*type) : nullptr;
  if (!decode || !dims) return;
  NumberArray array;
  if (const std::string* text = (*list)[2].as<std::string>()) {
    array.numbers = decode(decodeBase64(*text));
  } else if (const NumberArray* numbers = (*list)[2].as<NumberArray>()) {
    array.numbers = numbers->numbers;
  } else {
    return;
  }
  double count = 1.;
  std::string shape;
  for (double dim : dims->numbers) {
    count *= dim;
    shape += (shape.empty() ? "" : " x ") + exact(dim);
  }
  if (count != double(array.numbers.size())) {
    throw ValueError(cat("an array of ", shape, " entries has data for ", array.numbers.size()));
  }
  if (dims->numbers.size() == 2) array.rows = int(dims->numbers[0]);
  value.data = std::move(array);
}

}  // namespace kinegraph::inline gfile_internal
