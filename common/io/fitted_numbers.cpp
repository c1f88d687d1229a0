#include "io/fitted_numbers.h"

#include "io/toml.h"

namespace whine {

std::vector<FittedNumber> read_fitted_numbers(const std::string& path) {
  const toml::table root = read_toml(path, "the table of fitted numbers");
  std::vector<FittedNumber> out;
  for (const toml::table* row : rows_of(root, path, "fitted", {"scene", "number", "to"})) {
    FittedNumber number{
        (*row)["scene"].value_or(std::string()), (*row)["number"].value_or(std::string()), {}};
    if (const toml::node* claims = row->get("to")) {
      if (!claims->is_array()) reject_at(path, *claims, "'to' must be a list of claims");
      number.claims = words_of(*claims);
    }
    if (number.scene.empty() || number.number.empty())
      reject_at(path, *row, "[[fitted]] needs 'scene' and 'number' as text");
    out.push_back(number);
  }
  return out;
}

}  // namespace whine
