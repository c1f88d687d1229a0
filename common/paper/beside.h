// What P2000 prints of its own pair, handed to figures and reports of that pair.
#pragma once
#include <string>

#include "report/printed_jumps.h"
#include "report/report_content.h"

namespace whine {

PrintedJumps jumps_of_paper();

// What P2000 shows as figures of the same: "Figure 7" of a figure named fig07 or fig07-600, "" of one that is not the paper's.
std::string paper_figure(const std::string& name);

// Names at the pictures of P2000's own gears what the paper shows of the same.
void name_figures_of_paper(ReportContent& content);

}  // namespace whine
