#include "io/printed_claims.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.h"
#include "io/toml.h"

namespace whine {
namespace {

const std::map<std::string, Scale> kKinds{{"number", Scale::number},
                                          {"statement", Scale::statement},
                                          {"choice", Scale::choice},
                                          {"misprint", Scale::misprint},
                                          {"incomparable", Scale::incomparable}};

// One [[claim]] of the file; what is wrong with it is said with its line.
class Row {
 public:
  Row(const std::string& path, const toml::table& table) : path_(path), table_(table) {}
  PrintedClaim claim() const;

 private:
  [[noreturn]] void reject(const std::string& what) const { reject_at(path_, table_, what); }
  std::string where(const toml::node& node) const { return text(path_, ":", node.source().begin.line); }
  bool has(const char* key) const { return table_.contains(key); }

  // The value of a key, `otherwise` if it is not there.
  template <class T>
  T get(const char* key, const char* type, T otherwise) const {
    const toml::node* node = table_.get(key);
    if (!node) return otherwise;
    const auto value = node->value<T>();
    if (!value) reject_at(path_, *node, text("'", key, "' must be ", type));
    return *value;
  }
  std::string words(const char* key) const {
    return get<std::string>(key, "a text between quotation marks", "");
  }
  double number(const char* key, double otherwise) const {
    const double value = get<double>(key, "a number", otherwise);
    if (has(key) && !std::isfinite(value))
      reject_at(path_, *table_.get(key), text("'", key, "' = ", value, ": a finite number is needed"));
    return value;
  }

  std::string path_;
  const toml::table& table_;
};

PrintedClaim Row::claim() const {
  PrintedClaim c;
  c.where = where(table_);
  for (const char* key : {"id", "place", "says", "kind", "basis"})
    if (words(key).empty()) reject(text("[[claim]] needs '", key, "'"));
  c.id = words("id");
  c.place = words("place");
  c.text = words("says");
  c.basis = words("basis");
  const auto kind = kKinds.find(words("kind"));
  if (kind == kKinds.end())
    reject("kind = '" + words("kind") + "': known are number, statement, choice, misprint and incomparable");
  c.scale = kind->second;
  const bool statement = c.scale == Scale::statement, compared = !statement && c.scale != Scale::incomparable;
  for (const char* key : {"unit", "printed", "tolerance"}) {
    const bool tolerance = key == std::string("tolerance");
    if (statement && has(key)) reject(text("claim '", c.id, "': a statement has no '", key, "'"));
    if (compared && !has(key)) reject(text("claim '", c.id, "': a ", kind->first, " needs '", key, "'"));
    if (c.scale == Scale::incomparable && tolerance && has(key))
      reject(text("claim '", c.id, "': what cannot be compared has no 'tolerance'"));
  }
  c.unit = statement ? "yes/no" : words("unit");
  if (c.unit.empty()) reject(text("claim '", c.id, "' needs 'unit'"));
  c.printed = statement ? 1 : number("printed", c.printed);
  c.tolerance = number("tolerance", 0);
  if (c.tolerance < 0)
    reject(text("claim '", c.id, "': tolerance = ", c.tolerance, ", at least 0 is needed"));
  c.given = get<bool>("given", "true or false", false);
  c.value = has("value") ? words("value") : c.id;
  c.torque = get<int>("torque_Nm", "a whole number", 0);
  c.mesh_frequency = number("mesh_frequency_Hz", 0);
  c.order = get<int>("order", "a whole number", 0);
  c.contact = words("contact");
  return c;
}

}  // namespace

std::vector<PrintedClaim> read_printed_claims(const std::string& path) {
  const toml::table root = read_toml(path, "the table of P2000's claims");
  for (const auto& [label, value] : root)
    if (label.str() != "claim")
      fail(Failure::input, path, ":", value.source().begin.line, ": unknown key '", label.str(),
           "'; known is [[claim]]");
  const std::vector<std::string> known{"id",    "place",   "says",      "kind",
                                       "unit",  "printed", "tolerance", "basis",
                                       "given", "value",   "torque_Nm", "mesh_frequency_Hz",
                                       "order", "contact"};
  std::vector<PrintedClaim> claims;
  for (const toml::table* row : rows_of(root, path, "claim", known)) {
    PrintedClaim claim = Row(path, *row).claim();
    for (const PrintedClaim& other : claims)
      if (other.id == claim.id)
        fail(Failure::input, claim.where, ": a claim '", claim.id, "' stands at ", other.where, " already");
    claims.push_back(std::move(claim));
  }
  return claims;
}

}  // namespace whine
