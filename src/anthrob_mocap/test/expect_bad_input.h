#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace mocap {
namespace test {

/// `act` refuses its input with one line that holds `part`.
inline void expect_bad_input(const std::function<void()>& act, const std::string& part) {
  try {
    act();
    FAIL() << "accepted; expected: " << part;
  } catch (const BadInput& error) {
    const std::string what = error.what();
    EXPECT_NE(what.find(part), std::string::npos) << what << "\nexpected: " << part;
    EXPECT_EQ(what.find('\n'), std::string::npos) << what;
  }
}

}  // namespace test
}  // namespace mocap
}  // namespace anthrob
