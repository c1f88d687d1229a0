// Parts of a page: sections, figures, provenance.
#pragma once
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

// Throws Error(input) for a picture that is not among the figures, or that is given twice.
void require_known_pictures(const std::vector<ReportPicture>& pictures,
                            const std::vector<std::string>& figures);

std::string provenance_table(const std::vector<ReportSource>& sources);

}  // namespace whine
