#include "paper/claims.h"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "base/error.h"
#include "paper/claim_values.h"

namespace whine {

std::string digits(double value, int count) {
  std::ostringstream out;
  // Whole numbers stay whole: 1.23e+04 is no way to write 12345.
  if (std::abs(value) >= std::pow(10.0, count))
    out << std::fixed << std::setprecision(0) << value;
  else
    out << std::setprecision(count) << value;
  return out.str();
}

std::vector<Claim> read_claims(const std::string& path) {
  std::vector<Claim> claims;
  const auto& values = paper::claim_values();
  for (PrintedClaim& printed : read_printed_claims(path)) {
    const auto found = values.find(printed.value);
    if (found == values.end()) {
      std::string known;
      for (const auto& [name, value] : values) known += (known.empty() ? "" : ", ") + name;
      fail(Failure::input, printed.where, ": claim '", printed.id, "': there is no value '", printed.value,
           "'; known are ", known);
    }
    const auto check = [&](const char* key, bool needed, bool there) {
      if (needed != there)
        fail(Failure::input, printed.where, ": claim '", printed.id, "': the value '", printed.value, "' ",
             needed ? "needs '" : "has no '", key, "'");
    };
    const paper::Needs& needs = found->second.needs;
    check("torque_Nm", needs.torque, printed.torque != 0);
    check("mesh_frequency_Hz", needs.mesh_frequency, printed.mesh_frequency != 0);
    check("order", needs.order, printed.order != 0);
    check("contact", needs.contact, !printed.contact.empty());
    claims.push_back({std::move(printed), {}});
    claims.back().find = [value = found->second.find,
                          of = PrintedClaim(claims.back())](const SceneResults& s) { return value(s, of); };
  }
  return claims;
}

}  // namespace whine
