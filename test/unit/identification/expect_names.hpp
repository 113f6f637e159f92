// What an error has to say, for the tests of whatever refuses.
#pragma once

#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace otter_nav::identification::testing {

inline void expectNames(const std::string& message, const std::string& part) {
  EXPECT_NE(message.find(part), std::string::npos) << "'" << message << "' lacks " << part;
}

inline void expectNames(const std::string& message, std::initializer_list<const char*> parts) {
  for (const char* part : parts) {
    expectNames(message, part);
  }
}

}  // namespace otter_nav::identification::testing
