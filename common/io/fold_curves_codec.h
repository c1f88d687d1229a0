// fold_curves.h5: folds over a second quantity.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/fold_curves.h"

namespace whine {

class Codec;

void describe(Codec& codec, FoldCurvesResult& a);
void write(const std::string& path, const FoldCurvesResult& a, const Provenance& provenance);
FoldCurvesResult read_fold_curves(const std::string& path);

}  // namespace whine
