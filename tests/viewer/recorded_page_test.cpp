#include "kinegraph/viewer/recorded_page.h"

#include <gtest/gtest.h>

#include "kinegraph/viewer/client_page.h"

using namespace kinegraph;

namespace {

Outgoing message(const std::string& data, bool binary) { return {std::make_shared<std::string>(data), binary}; }

/// Returns the content of the recording's script element.
std::string recordingOf(const std::vector<Outgoing>& messages) {
  const std::string page = recordedPage(messages), start = "id=\"recording\">";
  const std::size_t first = page.find(start) + start.size();
  return page.substr(first, page.find("</script", first) - first);
}

}  // namespace

TEST(RecordedPage, IsTheClientWithTheMessagesInside) {
  EXPECT_EQ(recordingOf({message("{\"a\":1}", false)}), R"([{"text":"{\"a\":1}"}])");
  const std::string page = recordedPage({});
  EXPECT_TRUE(page.starts_with("<!doctype html>"));
  EXPECT_GT(page.size(), clientPage().size());
}

TEST(RecordedPage, HasBytesInBase64) {
  for (const auto& [bytes, text] :
       std::vector<std::pair<std::string, std::string>>{{"", ""},
                                                        {"f", "Zg=="},
                                                        {"fo", "Zm8="},
                                                        {"foo", "Zm9v"},
                                                        {"foob", "Zm9vYg=="},
                                                        {"fooba", "Zm9vYmE="},
                                                        {"foobar", "Zm9vYmFy"},
                                                        {std::string("\xff\0\xfe", 3), "/wD+"}}) {
    EXPECT_EQ(recordingOf({message(bytes, true)}), "[{\"binary\":\"" + text + "\"}]");  // RFC 4648, section 10
  }
}

TEST(RecordedPage, NamesCannotEndTheScript) {
  EXPECT_EQ(recordingOf({message("</script><b>", false)}), R"([{"text":"\u003c/script>\u003cb>"}])");
}
