#include "report/report_page.h"

#include <algorithm>

#include "base/error.h"
#include "base/tool.h"
#include "report/html.h"

namespace whine {

std::string report_page(const std::string& scene, const std::string& opening,
                        const std::vector<ReportSection>& sections) {
  const size_t colon = scene.find(": ");
  const std::string file = scene.substr(0, colon),
                    title = colon == std::string::npos ? scene : scene.substr(colon + 2);
  std::string contents, inside;
  for (const ReportSection& s : sections) {
    contents += text("<li><a href=\"#", s.id, "\">", html::escaped(s.heading), "</a></li>\n");
    inside += text("<section id=\"", s.id, "\">\n<h2>", html::escaped(s.heading), "</h2>\n", s.inside,
                   "</section>\n");
  }
  return html::page(
      title,
      "<p class=\"scene\">Gear whine report of the scene <code>" + html::escaped(file) + "</code></p>\n",
      "<section id=\"opening\" aria-label=\"In short\">\n" + opening +
          "</section>\n<nav aria-label=\"Contents\"><ol>\n" + contents + "</ol></nav>\n" + inside);
}

std::string picture_html(const ReportPicture& picture, const std::string& title, const std::string& words,
                         const std::string& folder) {
  std::string files;
  for (const auto& [end, what] :
       {std::pair{"tsv", "numbers"}, std::pair{"svg", "svg"}, std::pair{"png", "png"}})
    files += text(files.empty() ? "" : " ", "<a href=\"", html::escaped(folder + picture.name), ".", end,
                  "\">", what, "</a>");
  return html::figure(picture.name, picture.bytes, title,
                      words + " <span class=\"files\">" + files + "</span>");
}

void require_known_pictures(const std::vector<ReportPicture>& pictures,
                            const std::vector<std::string>& figures) {
  for (size_t i = 0; i < pictures.size(); ++i) {
    const std::string& name = pictures[i].name;
    if (std::find(figures.begin(), figures.end(), name) == figures.end())
      fail(Failure::input, "report: there are no words for a figure '", name, "'; known are ",
           listed(figures));
    for (size_t j = 0; j < i; ++j)
      if (pictures[j].name == name) fail(Failure::input, "report: figure ", name, " is given twice");
  }
}

std::string provenance_table(const std::vector<ReportSource>& sources) {
  html::Rows rows;
  std::vector<std::string> history;
  for (const ReportSource& source : sources) {
    std::string inputs;
    for (const InputRecord& input : source.origin.inputs)
      inputs += text(inputs.empty() ? "" : "; ", input.role, " ", input.path, " (",
                     input.sha256.substr(0, 12), ")");
    rows.push_back({source.path, source.sha256,
                    source.origin.tool + " " + source.origin.version + ": " + source.origin.command, inputs});
    for (const std::string& stage : source.origin.history)
      if (std::find(history.begin(), history.end(), stage) == history.end()) history.push_back(stage);
  }
  std::string out = html::table(
      "Artifacts, the SHA-256 of each file, the command that made it, and its inputs with the first digits of their SHA-256. `gear-inspect` says of each whether it is still what these inputs give.",
      {"artifact", "SHA-256", "made by", "from"}, rows, "small code");
  html::Rows earlier;
  for (const std::string& stage : history) earlier.push_back({stage});
  if (!earlier.empty()) out += html::table("Stages before these.", {"command"}, earlier, "small code");
  return out + html::paragraph(text("This page was written by gear-report ", kVersion, "."));
}

}  // namespace whine
