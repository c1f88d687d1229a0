// error_budget.h5: discretisation errors of the pair at rest.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/error_budget.h"

namespace whine {

class Codec;

void describe(Codec& codec, ErrorBudgetResult& a);
void write(const std::string& path, const ErrorBudgetResult& a, const Provenance& provenance);
ErrorBudgetResult read_error_budget(const std::string& path);

}  // namespace whine
