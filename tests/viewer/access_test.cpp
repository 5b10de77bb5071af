#include "kinegraph/viewer/access.h"

#include <gtest/gtest.h>

using namespace kinegraph;

TEST(Access, OnThisMachineOnlyItsOwnNames) {
  const Access access;
  for (const char* host : {"localhost", "localhost:7000", "127.0.0.1:7000", "[::1]:7000"}) {
    EXPECT_TRUE(access.allows({.host = host})) << host;
  }
  for (const char* host : {"example.com", "localhost.example.com:7000", ""}) {
    EXPECT_FALSE(access.allows({.host = host})) << host;
  }
}

TEST(Access, PagesOfItsOwnWithOrWithoutTls) {
  const Access access;
  EXPECT_TRUE(access.allows({.host = "localhost:7000", .origin = "http://localhost:7000"}));
  EXPECT_TRUE(access.allows({.host = "localhost:7000", .origin = "https://localhost:7000"}));
  EXPECT_FALSE(access.allows({.host = "localhost:7000", .origin = "https://localhost"}));
  EXPECT_FALSE(access.allows({.host = "localhost:7000", .origin = "ftp://localhost:7000"}));
  EXPECT_FALSE(access.allows({.host = "localhost:7000", .origin = "null"}));
}

TEST(Access, AProxyThatRenamesTheHostSaysSo) {
  const Access access;
  RequestedAccess request{.host = "localhost:7000", .origin = "https://robots.example.com"};
  EXPECT_FALSE(access.allows(request));
  request.forwarded_host = "robots.example.com";
  EXPECT_TRUE(access.allows(request));
  request.origin = "https://other.example.com";
  EXPECT_FALSE(access.allows(request));
}

TEST(Access, WithATokenAnyHost) {
  const Access access{.loopback_only = true, .token = "secret"};
  RequestedAccess request{.host = "robots.example.com", .origin = "https://robots.example.com", .target = "/"};
  EXPECT_FALSE(access.allows(request));
  request.target = "/?token=secret";
  EXPECT_TRUE(access.allows(request));
  request.target = "/?token=secreT";
  EXPECT_FALSE(access.allows(request));
  request = {.host = "robots.example.com", .origin = "https://evil.example.com", .target = "/?token=secret"};
  EXPECT_FALSE(access.allows(request));
}
