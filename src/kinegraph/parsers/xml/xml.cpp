#include "kinegraph/parsers/xml/xml.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/gfile/parser.h"

namespace kinegraph::inline parsers_internal {

namespace {

bool isSpace(char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; }

/// Positions of the start tags and attributes of a well-formed XML text, in order; tinyxml2 records only lines.
class TagPlaces {
 public:
  struct Tag {
    std::size_t at;
    std::vector<std::size_t> attributes;
  };

  explicit TagPlaces(std::string_view text) : text_(text) {
    while ((at_ = text_.find('<', at_)) != std::string_view::npos) {
      if (skip("<!--", "-->") || skip("<![CDATA[", "]]>") || skip("<?", "?>") || skip("<!", ">") || skip("</", ">"))
        continue;
      readTag();
    }
  }

  const std::vector<Tag>& tags() const { return tags_; }

 private:
  bool skip(std::string_view start, std::string_view end) {
    if (!text_.substr(at_).starts_with(start)) return false;
    const std::size_t found = text_.find(end, at_ + start.size());
    at_ = found == std::string_view::npos ? text_.size() : found + end.size();
    return true;
  }

  void readTag() {
    Tag tag{at_, {}};
    while (at_ < text_.size() && !isSpace(text_[at_]) && text_[at_] != '>' && text_[at_] != '/') ++at_;
    while (at_ < text_.size() && text_[at_] != '>') {
      if (isSpace(text_[at_]) || text_[at_] == '/') {
        ++at_;
        continue;
      }
      tag.attributes.push_back(at_);
      const std::size_t quote = text_.find_first_of("\"'", at_);
      const std::size_t end = quote == std::string_view::npos ? quote : text_.find(text_[quote], quote + 1);
      at_ = end == std::string_view::npos ? text_.size() : end + 1;
    }
    tags_.push_back(std::move(tag));
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::vector<Tag> tags_;
};

/// Converts tinyxml2's document to XmlElements.
class Converter {
 public:
  Converter(std::string_view text, const std::string& file) : file_(file), places_(text) {
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text.size(); ++i) {
      if (text[i] == '\n') line_starts_.push_back(i + 1);
    }
  }

  XmlElement convert(const tinyxml2::XMLElement& source) {
    const TagPlaces::Tag* tag = next_ < places_.tags().size() ? &places_.tags()[next_] : nullptr;
    ++next_;
    XmlElement element;
    element.name = source.Name();
    element.where = tag ? position(tag->at) : SourcePosition{file_, source.GetLineNum(), 1};
    std::size_t i = 0;
    for (const auto* attribute = source.FirstAttribute(); attribute; attribute = attribute->Next(), ++i) {
      const bool placed = tag && i < tag->attributes.size();
      element.attributes.push_back(
          {attribute->Name(), attribute->Value(), placed ? position(tag->attributes[i]) : element.where});
    }
    for (const auto* child = source.FirstChildElement(); child; child = child->NextSiblingElement()) {
      element.children.push_back(convert(*child));
    }
    return element;
  }

 private:
  SourcePosition position(std::size_t at) const {
    const auto line = std::upper_bound(line_starts_.begin(), line_starts_.end(), at) - line_starts_.begin();
    return {file_, int(line), int(at - line_starts_[line - 1]) + 1};
  }

  const std::string& file_;
  TagPlaces places_;
  std::vector<std::size_t> line_starts_;
  std::size_t next_ = 0;
};

std::string explain(tinyxml2::XMLError error) {
  switch (error) {
    case tinyxml2::XML_ERROR_EMPTY_DOCUMENT:
      return "the text contains no XML element";
    case tinyxml2::XML_ERROR_MISMATCHED_ELEMENT:
      return "the element is not closed by a tag of the same name";
    case tinyxml2::XML_ERROR_PARSING_ATTRIBUTE:
      return "an attribute is not of the form name=\"value\"";
    case tinyxml2::XML_ERROR_PARSING_ELEMENT:
      return "a tag is not of the form <name ...>, <name ... /> or </name>";
    case tinyxml2::XML_ERROR_PARSING_COMMENT:
      return "a comment is not closed by -->";
    case tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED:
      return "elements are nested too deeply";
    default:
      return "the text is not well-formed XML";
  }
}

}  // namespace

const XmlAttribute* XmlElement::attribute(std::string_view wanted) const {
  for (const XmlAttribute& attribute : attributes) {
    if (attribute.name == wanted) return &attribute;
  }
  return nullptr;
}

const XmlElement* XmlElement::child(std::string_view wanted) const {
  for (const XmlElement& element : children) {
    if (element.name == wanted) return &element;
  }
  return nullptr;
}

std::vector<const XmlElement*> XmlElement::all(std::string_view wanted) const {
  std::vector<const XmlElement*> found;
  for (const XmlElement& element : children) {
    if (element.name == wanted) found.push_back(&element);
  }
  return found;
}

XmlElement parseXml(std::string_view text, const std::string& file) {
  tinyxml2::XMLDocument document;
  document.Parse(text.data(), text.size());
  const tinyxml2::XMLElement* root = document.RootElement();
  if (document.Error() || !root) {
    const tinyxml2::XMLError error = document.Error() ? document.ErrorID() : tinyxml2::XML_ERROR_EMPTY_DOCUMENT;
    SourcePosition where{file, std::max(document.ErrorLineNum(), 1), 1};
    const std::string line = excerpt(text, where);
    const std::size_t first = line.find_first_not_of(" \t", 4);
    if (first != std::string::npos && line[first] != '\n') where.column = int(first) - 3;
    throw ParseError(where, explain(error));
  }
  return Converter(text, file).convert(*root);
}

std::string xmlRootName(std::string_view text) {
  std::size_t at = 0;
  while ((at = text.find('<', at)) != std::string_view::npos) {
    const std::string_view rest = text.substr(at);
    const char* const end = rest.starts_with("<!--") ? "-->" : rest.starts_with("<?") ? "?>" : nullptr;
    if (!end && !rest.starts_with("<!")) return std::string(rest.substr(1, rest.find_first_of(" \t\r\n/>", 1) - 1));
    const std::size_t behind = text.find(end ? end : ">", at);
    if (behind == std::string_view::npos) return "";
    at = behind;
  }
  return "";
}

std::optional<std::vector<double>> limitsIn(std::string_view text) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* end = at + text.size();
  for (;;) {
    while (at != end && std::string_view(" \t\r\n").find(*at) != std::string_view::npos) ++at;
    if (at == end) return numbers;
    if (*at == '+') ++at;
    double number = 0.;
    const auto [behind, error] = std::from_chars(at, end, number);  // reads inf and nan, too
    if (error == std::errc::invalid_argument || std::isnan(number)) return std::nullopt;
    if (error != std::errc{}) number = readNumber(std::string(at, behind).c_str());  // out of range
    if (behind != end && std::string_view(" \t\r\n").find(*behind) == std::string_view::npos) return std::nullopt;
    numbers.push_back(number);
    at = behind;
  }
}

std::optional<std::vector<double>> numbersIn(std::string_view text) {
  auto numbers = limitsIn(text);
  if (numbers && !std::ranges::all_of(*numbers, [](double x) { return std::isfinite(x); })) return std::nullopt;
  return numbers;
}

std::optional<std::vector<double>> numbersBetweenCommas(std::string_view text) {
  if (text.find(',') == std::string_view::npos) return std::nullopt;
  std::string blanks(text);
  std::ranges::replace(blanks, ',', ' ');
  return numbersIn(blanks);
}

std::string xmlEscaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

}  // namespace kinegraph::inline parsers_internal
