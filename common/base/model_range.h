// What the model of a pair says no to, apart from what the program could not compute: load under which contact leaves the
// flanks or Hertz's law, a tip edge that would touch below the involute. Studies mark such variants; memory, settings, solvers
// and files are errors in them, too.
#pragma once
#include "base/error.h"

namespace whine {

class ModelRangeError : public Error {
 public:
  using Error::Error;
};

// As fail().
template <class... Parts>
[[noreturn]] void fail_outside_range(Failure kind, const Parts&... parts) {
  throw ModelRangeError(kind, text(parts...));
}

// `error` again in other words: of its kind, and a ModelRangeError if it is one.
template <class... Parts>
[[noreturn]] void fail_as(const Error& error, const Parts&... parts) {
  if (dynamic_cast<const ModelRangeError*>(&error)) fail_outside_range(error.kind(), parts...);
  fail(error.kind(), parts...);
}

}  // namespace whine
