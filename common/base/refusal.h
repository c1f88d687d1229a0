// What the model of a pair says no to, apart from what the program could not compute: load under which contact leaves the flanks
// or Hertz's law, a tip edge that would touch below the involute. Studies mark such variants; memory, settings, solvers and files
// are errors in them, too.
#pragma once
#include "base/error.h"

namespace whine {

class Refusal : public Error {
 public:
  using Error::Error;
};

// As fail().
template <class... Parts>
[[noreturn]] void refuse(Failure kind, const Parts&... parts) {
  throw Refusal(kind, text(parts...));
}

// `error` again in other words: of its kind, and a refusal if it is one.
template <class... Parts>
[[noreturn]] void fail_as(const Error& error, const Parts&... parts) {
  if (dynamic_cast<const Refusal*>(&error)) refuse(error.kind(), parts...);
  fail(error.kind(), parts...);
}

}  // namespace whine
