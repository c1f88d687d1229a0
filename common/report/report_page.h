// What the pages of pairs and of systems have in common: sections, figures, remarks, provenance.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "report/report_content.h"

namespace whine {

struct ReportSection {
  std::string id, heading, inside;  // inside: marks
};

// A whole document: opening (marks), a list of contents, sections. scene: "file: title".
std::string report_page(const std::string& scene, const std::string& opening,
                        const std::vector<ReportSection>& sections);

// A figure with links to its files. words: marks; folder: of the figures, from the page, with its slash.
std::string picture_html(const ReportPicture& picture, const std::string& title, const std::string& words,
                         const std::string& folder = "");

// A figure that a page has words for. section: of the page.
template <class Content>
struct ExplainedFigure {
  const char *name, *section, *title;
  std::function<std::string(const Content&)> words;
};

template <class Content>
std::vector<std::string> names_of(const std::vector<ExplainedFigure<Content>>& figures) {
  std::vector<std::string> names;
  names.reserve(figures.size());
  for (const auto& kind : figures) names.emplace_back(kind.name);
  return names;
}

// Throws Error(input) for a picture that is not among the figures, or that is given twice. whose: " of a system", in the error.
void require_known_pictures(const std::vector<ReportPicture>& pictures,
                            const std::vector<std::string>& figures, const std::string& whose = "");

// Items of a list, at most a dozen of one place, speeds with the rotation of `member`; the list with what stands above it.
std::string remark_items(const std::string& where, const std::vector<Remark>& remarks,
                         const TurningMember& member);
std::string remark_list(const std::string& items, bool warned);

// A row of "What the numbers mean".
struct GuideRow {
  std::string figures;  // names of those that it is about, blank between
  std::string what, reading, trust, next;
};
// With links to the figures that are on the page.
std::string guide_table(const std::string& caption, const std::vector<GuideRow>& rows,
                        const std::vector<ReportPicture>& pictures);

std::string provenance_table(const std::vector<ReportSource>& sources);

}  // namespace whine
