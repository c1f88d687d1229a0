#include "report/study_axes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>

#include "base/error.h"
#include "report/figure_words.h"

namespace whine {

using Eigen::Index;

AxisUnits axis_units(const VariedKey& key, double largest) {
  if (!key.number) return {"", 1};
  const std::string unit = key.scene_units == "1" ? "" : key.scene_units;
  if (!(largest > 0 && largest < 1e-2)) return {unit, 1};
  const int power = 3 * static_cast<int>(std::floor(std::log10(largest) / 3));
  return {text("10^{", power, "} ", unit), std::pow(10, -power)};
}

std::string axis_name(const VariedKey& key) {
  static const std::map<std::string, std::string> known{{"rayleigh stiffness", "Rayleigh stiffness damping"},
                                                        {"rayleigh mass", "Rayleigh mass damping"},
                                                        {"bearing ratio", "damping ratio of the bearings"},
                                                        {"youngs modulus", "Young's modulus"},
                                                        {"poisson ratio", "Poisson's ratio"}};
  const size_t comma = key.label.find(", ");  // after the gear or the material
  const size_t at = comma == std::string::npos ? 0 : comma + 2;
  const auto found = known.find(key.label.substr(at));
  return found == known.end() ? key.label : key.label.substr(0, at) + found->second;
}

std::string with_unit(const std::string& name, const std::string& units) {
  return units.empty() || units == "1" ? name : name + " (" + units + ")";
}

std::string label_of(const std::string& quantity) {
  if (const size_t dot = quantity.find('.'); dot != std::string::npos)
    return label_of(quantity.substr(0, dot)) + ", " + without_markup(quantity.substr(dot + 1));
  static const std::map<std::string, std::string> known{
      {"te_mean", "mean static TE"},
      {"te_peak_to_peak", "static TE, peak to peak"},
      {"te_peak_to_peak_mesh", "static TE, peak to peak in a mesh period"},
      {"te_harmonic_1", "static TE, harm. 1"},
      {"te_harmonic_2", "static TE, harm. 2"},
      {"te_harmonic_3", "static TE, harm. 3"},
      {"tooth_load_static", "largest static tooth load"},
      {"load_sharing_factor", "load sharing factor K_γ"},
      {"load_sharing_peak", "largest momentary load sharing"},
      {"load_share_mean", "mean load share"},
      {"mesh_force_static", "largest static mesh force"},
      {"bearing_force_static", "largest static bearing force"},
      {"rms_max", "largest RMS of DTE"},
      {"rms_max_speed", "its mesh frequency"},
      {"rayleigh_damping_ratio", "Rayleigh damping ratio"},
      {"tooth_load_max", "largest tooth load"},
      {"separation_max", "largest contact loss"},
      {"load_share_max", "largest load share"},
      {"bearing_force_max", "largest bearing force"},
      {"bearing_force_rms_max", "largest RMS of bearing force"},
      {"loss_from", "contact lost from"},
      {"loss_to", "contact lost to"},
      {"jump_frequency", "highest jump"},
      {"unsteady", "unsteady speeds"}};
  for (const char* end : {"_up", "_down"})
    if (quantity.ends_with(end)) {
      const std::string base = quantity.substr(0, quantity.size() - std::string(end).size());
      const auto found = known.find(base);
      return (found == known.end() ? base : found->second) + ", " + (end + 1);
    }
  const auto found = known.find(quantity);
  if (found != known.end()) return found->second;
  std::string words = quantity;
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

bool absent(const std::string& quantity, double value) {
  return value == 0 && (quantity.starts_with("jump_frequency_") || quantity.starts_with("loss_"));
}

StudyAxis axis_of(const StudyResult& a, size_t k) {
  StudyAxis axis;
  const bool number = a.plan.keys[k].number;
  for (const GatheredVariant& v : a.variants) {
    const std::string& value = v.values[k];
    auto found = std::find(axis.levels.begin(), axis.levels.end(), value);
    if (found == axis.levels.end()) found = axis.levels.insert(axis.levels.end(), value);
    axis.at.push_back(number ? std::strtod(value.c_str(), nullptr)
                             : static_cast<double>(found - axis.levels.begin()) + 1);
  }
  if (number)
    std::sort(axis.levels.begin(), axis.levels.end(), [](const std::string& x, const std::string& y) {
      return std::strtod(x.c_str(), nullptr) < std::strtod(y.c_str(), nullptr);
    });
  return axis;
}

size_t key_of(const StudyResult& a, const std::string& name) {
  for (size_t k = 0; k < a.plan.keys.size(); ++k)
    if (a.plan.keys[k].name == name) return k;
  fail(Failure::input, "the study varies no key '", name, "'");
}

Index quantity_of(const StudyResult& a, const std::string& name) {
  const auto found = std::find(a.plan.quantities.begin(), a.plan.quantities.end(), name);
  if (found == a.plan.quantities.end())
    fail(Failure::input, "the study gathers no response quantity '", name, "'");
  return found - a.plan.quantities.begin();
}

ResponseQuantity kind_of(const StudyResult& a, const std::string& name) {
  for (const ResponseQuantity& kind : response_quantities(a.plan.directions, a.plan.train))
    if (kind.name == name) return kind;
  fail(Failure::input, "there is no response quantity '", name, "'");
}

}  // namespace whine
