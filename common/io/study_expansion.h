// What a study computes: its variants, the bodies and stage parameters that they need, and afterwards what they answered.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "io/artifacts.h"
#include "io/study_result.h"

namespace whine {

struct ExpandedStudy {
  Study study;
  std::vector<GatheredVariant> variants;
  std::map<std::string, std::string> bodies, parameters;    // by hash
  std::map<std::string, std::vector<std::string>> of_pair;  // bodies "driver_driven" -> variants, each once
  std::string gears;                                        // whose bodies these are, in this order
};

// Reads a study and checks it whole. home: folder of the study's stage parameters, where one that is there has been checked
// before. Throws Error(input) as read_study, for a variant whose gears cannot mesh, and for a study that varies nothing or
// which gear drives.
ExpandedStudy expand_study(const std::string& path, const std::string& home);

// The make fragment of a study S: STUDY_S_PAIRS (hashes of the bodies of all gears, joined by _), STUDY_S_<pair> (variants), STUDY_S_GEARS (names of
// the gears in that order), STUDY_S_OPTIONS, BODIES, a rule for the variants of each pair. stem: name of the study's file without folder and extension.
std::string study_fragment(const ExpandedStudy& plan, const std::string& path, const std::string& stem);

// Keys that change nothing that the study computes, as far as its variants, and for a sample some more, show.
std::vector<std::string> idle_keys(const ExpandedStudy& plan);

struct GatheredStudy {
  StudyResult study;
  std::vector<std::string> rejected;  // "variant 3 (...) lies outside the model's range: ..."
  long unsteady = 0;                  // variants with speeds at which no periodic motion was found
};

// The quantities of the variants of a plan, which lie beside it. path: plan.toml. Throws Error(input) for a variant of another
// stage, and for one that was rejected unless the study marks errors.
GatheredStudy gather_study(const std::string& path);

}  // namespace whine
