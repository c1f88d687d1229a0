// Words and tables as HTML.
#pragma once
#include <string>
#include <vector>

namespace whine::html {

using Rows = std::vector<std::vector<std::string>>;

inline constexpr const char* kNoValue = "–";  // a cell that has none

// Words without marks.
std::string escaped(const std::string& words);

// The same with a break at each '\n'.
std::string with_breaks(const std::string& words);

// "<p>inside</p>" of the tag "p"; tags may have attributes. `inside` stands as it is.
std::string tagged(const std::string& tag, const std::string& inside);

std::string paragraph(const std::string& words);

// Cells are words, not marks, '\n' a break in them; a column of numbers stands to the right. kind: classes of the table. caption: "" none.
std::string table(const std::string& caption, const std::vector<std::string>& head, const Rows& rows,
                  const std::string& kind = "");

// A PNG within the page, under its name. caption: marks, behind title and name.
std::string figure(const std::string& name, const std::string& png, const std::string& title,
                   const std::string& caption);

// A whole document. header: marks below the title; main: marks.
std::string page(const std::string& title, const std::string& header, const std::string& main);

}  // namespace whine::html
