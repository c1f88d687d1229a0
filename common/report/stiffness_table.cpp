#include "report/stiffness_table.h"

#include "base/error.h"
#include "gear/iso6336.h"
#include "report/figures.h"

namespace whine {

WordTable compliance_table(const StaticResult& s) {
  const ComplianceSplit& split = s.compliance;
  const double width = s.face_width();
  WordTable out{
      "Where the compliance of the mesh comes from, mean over the period at " + torque_words(s.torque) + ".",
      {"", "µm mm/N", "share (%)", "mesh stiffness with a bore 10 % larger, at least"},
      {}};
  const auto add = [&](const std::string& what, double compliance, const std::string& wider) {
    out.rows.push_back(
        {what, fixed(compliance * width * 1e9, 5), fixed(compliance / split.whole * kPercent, 1), wider});
  };
  const auto wider = [&](size_t g) { return "+" + fixed(split.with_wider_bore(g) * kPercent, 1) + " %"; };
  for (size_t g = 0; g < kSides; ++g)
    add("twist of " + s.mesh.gear[g] + " between bore and root circle", split.body[g], wider(g));
  add("contact (Hertz)", split.contact, "");
  add("teeth, the rest (with gaps of a relief)", split.teeth(), "");
  add("whole", split.whole, "");
  return out;
}

WordTable iso_table(const StaticResult& s) {
  const ComplianceSplit& split = s.compliance;
  const IsoStiffness by_iso = iso_6336_stiffness(s.gear[0].design, s.gear[0].material, s.gear[1].design,
                                                 s.gear[1].material, s.torque, s.contact_ratio);
  const double width = s.face_width();
  const auto per_width = [&](double stiffness) {
    return stiffness > 0 ? fixed(stiffness / width * 1e-9, 2) : std::string("–");
  };
  const auto iso = [](double value) { return fixed(value * 1e-9, 2); };
  return {
      text("Stiffness per face width at ", torque_words(s.torque), " (", fixed(by_iso.line_load * 1e-3, 0),
           " N/mm) beside ISO 6336-1, method B, which is for solid discs and knows of no bore",
           by_iso.in_range ? "."
           : s.gear[0].design.internal || s.gear[1].design.internal
               ? "; of the internal gear it makes a rack."
               : "; profile shifts or contact ratio lie outside what its formula is for."),
      {"", "N/µm per mm of face width", "bodies not twisting", "ISO 6336-1 B"},
      {{"c', one pair, largest", per_width(split.single), per_width(split.single_teeth()),
        iso(by_iso.single)},
       {"c_γα, mean over the period", per_width(s.mean_stiffness), per_width(split.mean_teeth()),
        iso(by_iso.mesh)}}};
}

}  // namespace whine
