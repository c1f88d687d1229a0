// toml++ with two faults of version 3.3 kept out of the way: it has undefined behaviour for letters such as µ outside of
// texts and comments, and an assertion that does not hold for a section whose name a line break follows.
//
// Private to the layer io/.
#pragma once
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <string>

namespace whine {

// As toml::parse. Throws toml::parse_error, also for a file of more than `most` bytes and for a key of more than 32 parts: of
// such toml++ would take memory without limit, or all of the stack.
toml::table parse_toml(const std::string& bytes, std::size_t most = 1 << 20);

}  // namespace whine
