#include "report/html.h"

#include <algorithm>

#include "base/error.h"
#include "base/tool.h"
#include "base/visible.h"
#include "io/publish.h"
#include "report/report_style.h"

namespace whine::html {
namespace {

bool is_number(const std::string& cell) {
  const std::string start = "+-0123456789";
  return !cell.empty() && start.find(cell[0]) != std::string::npos;
}

}  // namespace

std::string with_breaks(const std::string& words) {
  const size_t end = words.find('\n');
  return end == std::string::npos
             ? escaped(words)
             : escaped(words.substr(0, end)) + "<br>" + with_breaks(words.substr(end + 1));
}

std::string escaped(const std::string& words) {
  std::string out;
  for (const char c : visible(words)) {
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
  constexpr size_t kBroad = 8;  // columns from which letters and distances are smaller
  const std::string classes =
      kind + (kind.empty() || head.size() < kBroad ? "" : " ") + (head.size() < kBroad ? "" : "broad");
  std::string out = "<div class=\"wide\"><table" + (classes.empty() ? "" : " class=\"" + classes + "\"") +
                    ">\n" + (caption.empty() ? "" : tagged("caption", escaped(caption)) + "\n") +
                    "<thead><tr>";
  for (size_t c = 0; c < head.size(); ++c) out += tagged("th" + open[c], escaped(head[c]));
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : rows) {
    out += "<tr>";
    for (size_t c = 0; c < head.size(); ++c) out += tagged("td" + open[c], with_breaks(row[c]));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string paragraph(const std::string& words) {
  return tagged("p", escaped(words)) + "\n";
}

std::string figure(const std::string& name, const std::string& png, const std::string& title,
                   const std::string& caption) {
  return text("<figure id=\"", escaped(name), "\">\n<img alt=\"", escaped(name),
              "\" src=\"data:image/png;base64,", base64(png), "\">\n<figcaption><strong>", escaped(title),
              " (", escaped(name), ").</strong> ", caption, "</figcaption>\n</figure>\n");
}

std::string page(const std::string& title, const std::string& header, const std::string& main) {
  return text(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>",
      escaped(title), "</title>\n<style>", kStyle, "</style>\n</head>\n<body>\n<header>\n<h1>",
      escaped(title), "</h1>\n", header, "</header>\n<main>\n", main, "</main>\n<footer><p>Whine ", kVersion,
      ", gear whine from elastic teeth that touch, part and touch again.</p></footer>\n</body>\n</html>\n");
}

}  // namespace whine::html
