// toml++ with two faults of version 3.3 kept out of the way: it has undefined behaviour for letters such as µ outside of
// texts and comments, and an assertion that does not hold for a section whose name a line break follows.
//
// Private to the layer io/.
#pragma once
#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <string>
#include <vector>

namespace whine {

// As toml::parse. Throws toml::parse_error, also for a file of more than `most` bytes and for a key of more than 32 parts: of
// such toml++ would take memory without limit, or all of the stack.
toml::table parse_toml(const std::string& bytes, std::size_t most = 1 << 20);

// The same of the bytes of a file. Error(input) for what is not valid TOML, "<path>:<line>: is not ...".
toml::table toml_of(const std::string& path, const std::string& bytes, std::size_t most = 1 << 20);
// The same of a file; `what` it is ("the study") stands in the advice of a file that cannot be read.
toml::table read_toml(const std::string& path, const std::string& what, std::size_t most = 1 << 20);

// Error(input), "<path>:<line>: <what>".
[[noreturn]] void reject_at(const std::string& path, const toml::node& at, const std::string& what);

// The tables of [[name]], each of which has nothing but `known` keys. Error(input) with the line, by the nearest known key.
std::vector<const toml::table*> rows_of(const toml::table& root, const std::string& path,
                                        const std::string& name, const std::vector<std::string>& known);
// The words of a list; "" for an item that is none.
std::vector<std::string> words_of(const toml::node& list);

}  // namespace whine
