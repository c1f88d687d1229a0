#include "model/capabilities.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <sstream>
#include <string_view>

#include "base/error.h"

namespace whine {
namespace {

struct TraitWords {
  Trait trait;
  const char *name, *remedy;
};
constexpr const char *
    kOneSlice = "take another goal, or spur gears under even load with width = \"one\" in [fidelity]",
   *kSlices = "write width = \"slices\" in [fidelity]", *kTakeOut = "take the section out",
   *kAsTrain =
       "tell the pair as a train, of a helical or misaligned one with width = \"slices\" in [fidelity]: in place of torque_Nm a [[drive]] for each gear with its torque_Nm, that of the driven gear negative";
// Goals of make, in the order in which messages offer them; then stages that have no goal of their own. "other": goals that are none of
// these.
constexpr std::string_view kGoals =
    "report mesh reduce static flank-load fig01 fig12 fig13 profile-chart error-budget load-sharing sweep motion-errors "
    "face-load fig05 fig07 fig14-elastic tooth-loads order-cuts waterfall histories sound runup branches "
    "fig05-branches fig07-branches multipliers fold-curves impact sidebands crack residual-signal efficiency bearing-forces teeth "
    "harris-map jump-map lumped loaded animation compare modes mode-shapes";
constexpr std::string_view kStages = "calibrate other one-slice motion width width-body";

// Features of a list do not take these traits, for this reason; a remedy of its own stands in place of those of the traits.
struct Row {
  std::string_view features;
  std::vector<Trait> traits;
  const char *reason, *remedy = nullptr;
};
const std::vector<Row>& rows() {
  using enum Trait;
  static const std::vector<Row> all{
      {"modes mode-shapes", {pair, pair_in_slices, pair_of_bodies}, "natural modes are of systems", kAsTrain},
      {"mesh reduce static flank-load fig01 fig12 fig13 profile-chart error-budget load-sharing sweep motion-errors "
       "face-load fig05 fig07 fig14-elastic tooth-loads order-cuts waterfall histories sound runup branches "
       "fig05-branches fig07-branches multipliers fold-curves impact sidebands crack residual-signal efficiency "
       "bearing-forces teeth harris-map jump-map lumped loaded animation compare calibrate motion other",
       {rigid_gears},
       "they have natural modes alone"},
      {"fig12 fig13", {train, train_in_slices}, "static draws them, of each mesh"},
      {"fig05 fig07 fig14-elastic efficiency bearing-forces",
       {train, train_in_slices},
       "sweep draws them, of each mesh and body"},
      {"fig05-branches fig07-branches", {train, train_in_slices}, "branches draws them, of each mesh"},
      {"waterfall",
       {train, train_in_slices},
       "order-cuts draws the first orders, of the meshes that vibrate most"},
      {"tooth-loads", {train, train_in_slices}, "report has them as numbers, of each mesh"},
      {"sidebands crack", {train, train_in_slices}, "residual-signal draws them, in motion"},
      {"jump-map lumped", {train, train_in_slices}, "one degree of freedom stands for one mesh"},
      {"fig01 profile-chart loaded animation", {train, train_in_slices}, "it draws the two gears of a pair"},
      {"face-load calibrate other", {train, train_in_slices}, "it is of one mesh"},
      {"flank-load face-load", {one_slice}, "it carries the same load all over the face"},
      {"efficiency", {no_friction}, "it loses nothing"},
      {"bearing-forces", {no_bearings}, "nothing gives way"},
      {"sidebands", {no_errors}, "all mesh periods are alike"},
      {"crack", {no_crack}, "it has nothing to show"},
      {"residual-signal", {like_teeth}, "all mesh periods are alike"},
      {"load-sharing", {no_planets}, "one mesh shares its load with none"},
      {"sweep motion-errors order-cuts histories sound runup branches multipliers fold-curves impact residual-signal",
       {no_speeds},
       "nothing moves"},
      {"sweep motion-errors order-cuts sound runup branches multipliers fold-curves motion",
       {pair_of_bodies},
       "what sections of a body hold each other by has no inertia yet"},
      {"face-load fig05 fig07 fig14-elastic tooth-loads waterfall histories fig05-branches fig07-branches",
       {pair_of_bodies},
       "what sections of a body hold each other by has no inertia yet"},
      {"width", {train_of_bodies}, "they are of one mesh alone"},
      {"impact calibrate",
       {pair_in_slices, pair_of_bodies},
       "ring-downs over the face are of trains, which show the damping ratio of a rayleigh_stiffness_s",
       kAsTrain},
      {"sidebands crack residual-signal efficiency bearing-forces harris-map jump-map lumped loaded animation "
       "one-slice other",
       {pair_in_slices, pair_of_bodies},
       "it is of spur gears under even load"},
      {"harris-map", {train_in_slices}, "it is of spur gears under even load"},
      {"residual-signal", {train_in_slices}, "all teeth have one table"},
      {"teeth",
       {pair_in_slices, train_in_slices, pair_of_bodies},
       "load sharing, ISO 6336 and root stress in motion are of spur gears under even load; reports and static.h5 of bodies in three dimensions have the root stress over the face"},
      {"error-budget", {differing, cracked}, "errors at rest are of teeth that are all alike"},
      {"teeth", {unlike_pair}, "load sharing and error budget are of intact, equal teeth"},
      {"impact branches fig05-branches fig07-branches multipliers fold-curves harris-map jump-map lumped width",
       {differing, cracked},
       "all teeth have one table"},
      {"width harris-map lumped loaded", {friction}, "forces are along the normals alone"},
      {"harris-map lumped loaded", {bearings}, "its gears are on rigid axes"},
      {"harris-map loaded animation width-body", {internal}, "it is of external gears"},
      {"width width-body", {plane_stress}, "sections hold each other"},
      {"impact", {full_body}, "eigenvalues beside ring-downs are those of dense matrices"},
      {"motion", {full_body}, "trains step on the modes that are kept"},
      {"impact", {lines}, "ring-downs hold a fixed phase on strips"}};
  return all;
}

bool lists(std::string_view words, std::string_view word) {
  for (size_t at = words.find(word); at != std::string_view::npos; at = words.find(word, at + 1)) {
    const size_t end = at + word.size();
    if ((at == 0 || words[at - 1] == ' ') && (end == words.size() || words[end] == ' ')) return true;
  }
  return false;
}

const TraitWords& words_of(Trait trait) {
  using enum Trait;
  static constexpr std::array kTraits{
      TraitWords{pair, "a pair", "take a scene of several meshes, carriers or drives"},
      TraitWords{train, "a system of several meshes, carriers or drives", "take a scene of a pair"},
      TraitWords{pair_in_slices, "a pair in slices over the face", kOneSlice},
      TraitWords{train_in_slices, "a train in slices over the face", kOneSlice},
      TraitWords{pair_of_bodies, "a pair of bodies in three dimensions", kSlices},
      TraitWords{train_of_bodies, "a train of bodies in three dimensions", kSlices},
      TraitWords{rigid_gears, "rigid gears", "write another body in [fidelity]"},
      TraitWords{no_speeds, "a scene without speeds", "write [operation]"},
      TraitWords{one_slice, "one slice over the face", kSlices},
      TraitWords{no_friction, "a scene without friction", "write [friction] with a coefficient"},
      TraitWords{no_bearings, "a scene without elastic bearings", "write a [[bearing]]"},
      TraitWords{no_errors, "teeth without errors", "write a [gear.<name>.error]"},
      TraitWords{no_crack, "teeth without a crack", "write a [gear.<name>.crack]"},
      TraitWords{like_teeth, "teeth that are all alike",
                 "write a [gear.<name>.error] or a [gear.<name>.crack]"},
      TraitWords{no_planets, "a scene without planets", "take one with a [[carrier]]"},
      TraitWords{unlike_pair, "a pair whose teeth differ or are cracked", kTakeOut},
      TraitWords{differing, "teeth that differ",
                 "take the section out, or a sweep, which covers the hunting period"},
      TraitWords{cracked, "a cracked tooth",
                 "take the section out, or a sweep, which covers the turn of the gear"},
      TraitWords{friction, "friction", kTakeOut},
      TraitWords{bearings, "elastic bearings", "take a scene without [[bearing]]"},
      TraitWords{internal, "an internal gear", "take a scene without internal gears"},
      TraitWords{plane_stress, "a body in plane stress", "write plane = \"strain\" in its [material]"},
      TraitWords{full_body, "body = \"full\" in [fidelity]",
                 "write body = \"modal\", \"relaxed\" or \"quasi-static\""},
      TraitWords{lines, "contact = \"line\" in [fidelity]", "write contact = \"strips\""}};
  static_assert(kTraits.size() == static_cast<size_t>(lines) + 1, "words of each trait");
  return *std::find_if(kTraits.begin(), kTraits.end(), [&](const TraitWords& t) { return t.trait == trait; });
}

// Of a feature and a trait; nullptr: taken.
const Row* row_of(std::string_view feature, Trait trait) {
  for (const Row& row : rows())
    if (lists(row.features, feature) &&
        std::find(row.traits.begin(), row.traits.end(), trait) != row.traits.end())
      return &row;
  return nullptr;
}

std::string_view known(const std::string& feature) {
  return lists(kGoals, feature) || lists(kStages, feature) ? std::string_view(feature) : "other";
}

std::vector<std::string> words_in(std::string_view words) {
  std::istringstream in{std::string(words)};
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace

std::string not_taken(const std::string& feature, const Traits& of) {
  for (const auto& [trait, where] : of)
    if (const Row* row = row_of(known(feature), trait))
      return text(words_of(trait).name, where.empty() ? "" : " (" + where + ")", ": ", row->reason);
  return "";
}

std::string refusal(const std::string& feature, const Traits& of) {
  for (const auto& fact : of)
    if (const Row* row = row_of(known(feature), fact.first))
      return text(feature, " does not take ", not_taken(feature, {fact}), "; ",
                  row->remedy ? row->remedy : words_of(fact.first).remedy);
  return "";
}

void require_able(const std::string& feature, const Traits& of) {
  if (const std::string words = refusal(feature, of); !words.empty()) fail(Failure::input, words);
}

bool has(const Traits& of, Trait trait) {
  return std::any_of(of.begin(), of.end(), [&](const auto& fact) { return fact.first == trait; });
}

const std::vector<std::string>& known_goals() {
  static const std::vector<std::string> goals = words_in(kGoals);
  return goals;
}

std::string face_words(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven) {
  for (int g = 0; g < kSides; ++g)
    if (const GearDesign& design = g ? driven : driver; design.helical())
      return text("[gear.", mesh.gear[g],
                  "] is helical (helix_angle_deg = ", design.helix_angle * 180 / std::numbers::pi, ")");
  if (mesh.misalignment != 0) return text("[[mesh]] has misalignment_um = ", mesh.misalignment * 1e6);
  if (mesh.face_offset != 0) return text("[[mesh]] has face_offset_mm = ", mesh.face_offset * 1e3);
  for (int g = 0; g < kSides; ++g)
    if (!mesh.modification[g].lead.none())
      return text("[gear.", mesh.gear[g], ".modification] takes material off along the face");
  return "";
}

Traits traits(const GearMeshSpec& mesh, const GearDesign& driver, const GearDesign& driven,
              WidthModel level) {
  using enum Trait;
  std::string words = face_words(mesh, driver, driven);
  if (level != WidthModel::one && words.empty()) words = text("[fidelity] has width = \"", level, "\"");
  Traits out{{level == WidthModel::body                       ? pair_of_bodies
              : level == WidthModel::slices || !words.empty() ? pair_in_slices
                                                              : pair,
              words}};
  for (int g = 0; g < kSides; ++g) {
    const GearDesign& design = g ? driven : driver;
    const std::string gear = "[gear." + mesh.gear[g];
    if (design.crack.depth > 0) out.emplace_back(cracked, gear + ".crack]");
    if (!mesh.errors[g].none()) out.emplace_back(differing, gear + ".error]");
    if (mesh.bearing[g].elastic()) out.emplace_back(bearings, gear + "]");
    if (design.internal) out.emplace_back(internal, gear + "]");
  }
  if (mesh.friction.acts()) out.emplace_back(friction, "[friction]");
  return out;
}

Traits traits(const Fidelity& fidelity) {
  using enum Trait;
  Traits out;
  if (fidelity.body == BodyModel::full) out.emplace_back(full_body, "");
  if (fidelity.contact == ContactModel::line) out.emplace_back(lines, "");
  if (fidelity.width != WidthModel::one)
    out.emplace_back(fidelity.width == WidthModel::body ? pair_of_bodies : pair_in_slices,
                     text("[fidelity] has width = \"", fidelity.width, "\""));
  return out;
}

std::string capability_table() {
  const auto code = [](const std::vector<std::string>& words) {
    std::string out;
    for (const std::string& word : words) out += (out.empty() ? "`" : ", `") + word + "`";
    return out;
  };
  std::ostringstream out;
  out << "| not taken | by goals and stages | why | instead |\n|---|---|---|---|\n";
  for (const Row& row : rows()) {
    std::vector<std::string> features = words_in(row.features), rest;
    for (const std::string& goal : known_goals())
      if (!lists(row.features, goal)) rest.push_back(goal);
    std::string traits, remedies = row.remedy ? row.remedy : "";
    for (const Trait trait : row.traits) {
      const TraitWords& words = words_of(trait);
      traits += (traits.empty() ? "" : ", ") + std::string(words.name);
      if (!row.remedy && remedies.find(words.remedy) == std::string::npos)
        remedies += (remedies.empty() ? "" : "; ") + std::string(words.remedy);
    }
    out << "| " << traits << " | "
        << (rest.size() < features.size() ? "all but " + code(rest) : code(features)) << " | " << row.reason
        << " | " << remedies << " |\n";
  }
  return out.str();
}

}  // namespace whine
