// The kind of the error that a call ends with; a kind that no error has if it ends without one.
#pragma once
#include "base/error.h"

namespace whine {

inline Failure failure_of(const auto& f) {
  try {
    f();
  } catch (const Error& e) {
    return e.kind();
  }
  return static_cast<Failure>(0);
}

}  // namespace whine
