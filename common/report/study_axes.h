// Keys and response quantities of a study as the axes of its figures show them.
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "io/study_result.h"

namespace whine {

// Key values as an axis shows them: powers of ten of small numbers stand at the unit.
struct AxisUnits {
  std::string words;
  double scale;
};
AxisUnits axis_units(const VariedKey& key, double largest);

// What an engineer calls a key, where its name in a scene is not that.
std::string axis_name(const VariedKey& key);

// "face width (mm)"; the name alone where there is no unit.
std::string with_unit(const std::string& name, const std::string& units);

// "largest RMS, up" of rms_max_up; of a train with the mesh or body behind it.
std::string label_of(const std::string& quantity);

// Response quantities whose 0 says that there is none.
bool absent(const std::string& quantity, double value);

// A number for each value of a key: itself, or the place of a word among the words, from 1.
struct StudyAxis {
  std::vector<double> at;           // (variant)
  std::vector<std::string> levels;  // ascending, or in order of the study
};
StudyAxis axis_of(const StudyResult& a, size_t k);

// Place among the keys, column of StudyResult::quantity, unit and meaning. Throw Error(input) for a name that the study does not have.
size_t key_of(const StudyResult& a, const std::string& name);
Eigen::Index quantity_of(const StudyResult& a, const std::string& name);
ResponseQuantity kind_of(const StudyResult& a, const std::string& name);

// What stands beside each other in the columns of a study's figure: `quantities` as cells over the two of StudyPlan::figure_map.
void add_study_map(const StudyResult& a, const std::vector<std::string>& quantities, struct Figure& figure);

}  // namespace whine
