// Text that came from a file, as people see it.
#pragma once
#include <string>

namespace whine {

// UTF-8 in which characters that a terminal obeys (control characters), that turn the order of letters (U+202E and its kin) or that
// show nothing (U+200B, U+FEFF, ...) are written as <U+202E>, and bytes that are no UTF-8 as '?'. Line ends and tabs stay. All texts
// of files go through here on their way to terminals, pages and figures.
std::string visible(const std::string& text);

}  // namespace whine
