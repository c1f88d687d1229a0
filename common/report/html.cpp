#include "report/html.h"

#include <algorithm>

namespace whine::html {
namespace {

bool is_number(const std::string& cell) {
  const std::string start = "+-0123456789";
  return !cell.empty() && start.find(cell[0]) != std::string::npos;
}

}  // namespace

std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : words) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string tagged(const std::string& tag, const std::string& inside) {
  return "<" + tag + ">" + inside + "</" + tag.substr(0, tag.find(' ')) + ">";
}

std::string table(const std::string& caption, const std::vector<std::string>& head, const Rows& rows,
                  const std::string& kind) {
  std::vector<std::string> open(head.size());
  for (size_t c = 0; c < head.size(); ++c) {
    const auto count = [&](const auto& of) {
      return std::count_if(rows.begin(), rows.end(), [&](const auto& row) { return of(row[c]); });
    };
    const auto filled = count([](const std::string& cell) { return !cell.empty(); });
    if (2 * count(is_number) > filled) open[c] = " class=\"number\"";
  }
  std::string out = "<div class=\"wide\"><table" + (kind.empty() ? "" : " class=\"" + kind + "\"") +
                    ">\n<caption>" + escaped(caption) + "</caption>\n<thead><tr>";
  for (size_t c = 0; c < head.size(); ++c) out += tagged("th" + open[c], escaped(head[c]));
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (size_t c = 0; c < head.size(); ++c) out += tagged("td" + open[c], escaped(row[c]));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string paragraph(const std::string& words) {
  return tagged("p", escaped(words)) + "\n";
}

}  // namespace whine::html
