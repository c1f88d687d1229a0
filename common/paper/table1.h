// Table 1 of P2000: natural frequencies by ring-down beside the printed ones.
#pragma once
#include "io/printed_claims.h"
#include "report/figures.h"
#include "results/impact.h"

namespace whine {

// Natural frequencies by ring-down with few and with many pairs in contact and on the mean, a row for each torque
// (ascending). The mean stands there twice: over the phases of a mesh period, and over the two states, weighted by the
// shares of the period that the contact ratio gives them. printed: claims, of which those of the value `natural-frequency` are
// printed frequencies; deviations from them in percent; none: no such columns. Throws Error(input) for no artifact, two of one
// torque, or a state or a printed value that is missing.
Figure natural_frequency_table(std::vector<ImpactResult> impacts, const std::vector<PrintedClaim>& printed);

// The same as lines for a terminal.
std::string natural_frequency_text(const Figure& table);

}  // namespace whine
