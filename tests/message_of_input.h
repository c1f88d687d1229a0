// The message of the input error that a call ends with; "" if it ends without an error.
#pragma once
#include <doctest/doctest.h>

#include <string>

#include "base/error.h"

namespace whine {

inline std::string message_of_input(const auto& f) {
  try {
    f();
  } catch (const Error& error) {
    CHECK(error.kind() == Failure::input);
    return error.what();
  }
  return "";
}

}  // namespace whine
