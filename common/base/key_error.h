// Errors about the value of one key of a scene: who catches one need not read its words.
#pragma once
#include <string>
#include <utility>

#include "base/error.h"

namespace whine {

class KeyError : public Error {
 public:
  KeyError(Failure kind, std::string key, const std::string& message)
      : Error(kind, message), key_(std::move(key)) {}
  const std::string& key() const { return key_; }  // without its section: "centre_distance_mm"

 private:
  std::string key_;
};

}  // namespace whine
