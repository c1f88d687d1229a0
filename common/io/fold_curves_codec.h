// fold_curves.h5: folds over a second quantity.
#pragma once
#include <string>

#include "io/provenance.h"
#include "studies/fold_curves_result.h"

namespace whine {

class Codec;

void describe(Codec& codec, FoldCurvesArtifact& a);
void write(const std::string& path, const FoldCurvesArtifact& a, const Provenance& provenance);
FoldCurvesArtifact read_fold_curves(const std::string& path);

}  // namespace whine
