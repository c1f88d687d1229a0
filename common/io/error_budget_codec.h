// error_budget.h5: discretisation errors of the pair at rest.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/error_budget_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, ErrorBudgetArtifact& a);
void write(const std::string& path, const ErrorBudgetArtifact& a, const Provenance& provenance);
ErrorBudgetArtifact read_error_budget(const std::string& path);

}  // namespace whine
