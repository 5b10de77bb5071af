#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

#include "kinegraph/common/errors.h"

namespace kinegraph {

/// `call` must throw `Thrown`, or a subclass of it, whose message contains every one of `parts`.
template <class Thrown = Error, class Call>
void expectError(const Call& call, std::initializer_list<const char*> parts) {
  try {
    call();
    ADD_FAILURE() << "no error; expected one with '" << (parts.size() > 0 ? *parts.begin() : "") << "'";
  } catch (const Thrown& error) {
    for (const char* part : parts) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << "no '" << part << "' in: " << error.what();
    }
  }
}

}  // namespace kinegraph
