// toml++ with two faults of version 3.3 kept out of the way: it has undefined behaviour for letters such as µ outside of
// texts and comments, and an assertion that does not hold for a section whose name a line break follows.
//
// Private to the room files/.
#pragma once
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <string>

namespace whine {

// As toml::parse. Throws toml::parse_error.
toml::table parse_toml(const std::string& bytes);

}  // namespace whine
