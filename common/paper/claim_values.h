// How the value that a claim names is read from a scene's results.
#pragma once
#include <functional>
#include <map>
#include <string>

#include "paper/claims.h"

namespace whine::paper {

// What a claim has to say, besides its name, about where a value is taken.
struct Needs {
  bool torque = false, mesh_frequency = false, order = false, contact = false;
};

struct ClaimValue {
  Needs needs;
  std::function<Finding(const SceneResults&, const PrintedClaim&)> find;
};

// By the name that claims give.
const std::map<std::string, ClaimValue>& claim_values();

}  // namespace whine::paper
