// The readings of P2000 as a figure: agreeing claims against the level ratio of the mesh stiffness, and which sets of claims
// hold together.
#pragma once
#include "io/artifacts.h"
#include "io/readings_result.h"
#include "paper/consistency.h"
#include "report/figures.h"

namespace whine {

// Left: each reading by its level ratio and its agreeing claims, a colour for each rule of corner contact, with the ratios that
// Table 1 and Figure 15 of P2000 ask for. Right: of each set of claims the share that its closest reading satisfies.
Figure reading_figure(const ReadingsResult& readings, const Consistency& found);

}  // namespace whine
