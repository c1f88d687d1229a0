#include "io/rexs/stage.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/tool.h"
#include "gear/involute.h"

namespace whine {
namespace {

// Signs of torque and speed do not tell: they follow the axes of the shafts, which are not read.
void put_driver_first(RexsReader& reader, RexsStage& stage) {
  const auto one = reader.flag(reader.stage_gear_data(stage.id, stage.gear[0]), "is_driving_gear"),
             two = reader.flag(reader.stage_gear_data(stage.id, stage.gear[1]), "is_driving_gear");
  if (one == true && two == true)
    fail(Failure::input, reader.path(), ": is_driving_gear is true of both gears of ",
         quoted_name(reader.component(stage.id)), "; a stage has one driver");
  // A gear that is said not to drive leaves the other.
  const bool first = one == true || (!one && two == false), second = two == true || (!two && one == false);
  if (second) std::swap(stage.gear[0], stage.gear[1]);
  if (first || second) return;
  stage.driver_assumed = one ? "gear_1 of the stage: is_driving_gear is false of both gears"
                             : "gear_1 of the stage: the model has no is_driving_gear";
}

std::string list_of(const std::vector<const RexsComponent*>& components) {
  std::string list;
  for (const RexsComponent* c : components) list += (list.empty() ? "" : "; ") + quoted_name(*c);
  return list;
}

}  // namespace

int chosen_stage(const RexsReader& reader, const std::string& wanted) {
  std::vector<const RexsComponent*> found, all, alone;
  for (const auto& [id, c] : reader.model().components) {
    const bool mesh = c.type == "cylindrical_stage";
    if (!mesh && c.type != "planetary_stage") continue;
    all.push_back(&c);
    if (!mesh || planetary_stage_of(reader, id) < 0) alone.push_back(&c);
    if (wanted == std::to_string(id) || wanted == c.name) found.push_back(&c);
  }
  if (wanted.empty()) found = alone;
  if (found.size() == 1) return found[0]->id;
  if (all.empty()) fail(Failure::input, reader.path(), ": holds no cylindrical_stage and no planetary_stage");
  if (wanted.empty())
    fail(Failure::input, reader.path(), ": holds ", all.size(),
         " stages; name one with --stage: ", list_of(all));
  fail(Failure::input, reader.path(), ": ", found.empty() ? "no stage" : "more than one stage",
       " is called '", printable(wanted, 80), "'; there are ", list_of(all));
}

RexsStage stage_of(RexsReader& reader, int id) {
  RexsStage stage;
  stage.id = id;
  for (const RexsRelation& relation : reader.model().relations)
    if (relation.type == "stage" && relation.in_role("stage") == id)
      stage.gear = {relation.in_role("gear_1"), relation.in_role("gear_2")};
  for (const int gear : stage.gear)
    if (gear < 0)
      fail(Failure::input, reader.path(), ": ", quoted_name(reader.component(id)),
           " has no relation 'stage' with gear_1 and gear_2");
  put_driver_first(reader, stage);
  return stage;
}

int planetary_stage_of(const RexsReader& reader, int stage) {
  for (const RexsRelation& relation : reader.model().relations) {
    const int whole = relation.in_role("assembly");
    if (relation.type == "assembly" && relation.in_role("part") == stage && whole >= 0 &&
        reader.component(whole).type == "planetary_stage")
      return whole;
  }
  return -1;
}

bool is_internal(RexsReader& reader, int gear) {
  const RexsComponent& c = reader.component(gear);
  return c.type == "ring_gear" || reader.required(c, "number_of_teeth", kRexsNumber).value < 0;
}

RexsNumber teeth_of(RexsReader& reader, int gear) {
  RexsNumber teeth = reader.required(reader.component(gear), "number_of_teeth", kRexsNumber);
  teeth.value = std::abs(teeth.value);
  if (teeth.value != std::round(teeth.value) || teeth.value > 1e6 || teeth.value < 1)
    fail(Failure::input, reader.path(), ": ", teeth.origin, " = ", teeth.value, " is no number of teeth");
  return teeth;
}

std::optional<RexsPlace> place_of(RexsReader& reader, int gear) {
  for (const RexsComponent* c : {&reader.component(gear), reader.beside(gear, "shaft")}) {
    const auto at = reader.vector(c, "support_vector", kRexsMillimetre),
               axis = reader.vector(c, "u_axis_vector", kRexsMillimetre);
    if (!at) continue;
    const std::array<double, 3> u = axis.value_or(std::array{1.0, 0.0, 0.0});
    const double length = std::hypot(u[0], u[1], u[2]);
    if (!(length > 0)) continue;
    return RexsPlace{*at,
                     {u[0] / length, u[1] / length, u[2] / length},
                     reader.word(c, "reference_component_for_position"),
                     quoted_name(*c) + ", support_vector"};
  }
  return {};
}

RexsNumber centre_distance(RexsReader& reader, const RexsStage& stage) {
  const RexsComponent& c = reader.component(stage.id);
  if (auto said = reader.number(&c, "center_distance", kRexsMillimetre)) {
    said->value = std::abs(said->value);  // of internal pairs also written below 0
    return *said;
  }
  const auto one = place_of(reader, stage.gear[0]), two = place_of(reader, stage.gear[1]);
  if (one && two && one->reference == two->reference) {
    const auto& u = one->axis;
    const std::array d{two->at[0] - one->at[0], two->at[1] - one->at[1], two->at[2] - one->at[2]};
    const double along = d[0] * u[0] + d[1] * u[1] + d[2] * u[2],
                 apart = std::hypot(d[0] - along * u[0], d[1] - along * u[1], d[2] - along * u[2]);
    constexpr double kRounded = 1e6;  // mm: without what coordinates of a metre leave
    if (apart > 0)
      return {std::round(apart * kRounded) / kRounded,
              "the model has no center_distance; from " + one->origin + " and " + two->origin, true};
  }
  fail(
      Failure::input, reader.path(), ": ", quoted_name(c),
      " has no 'center_distance', and its gears have no support_vector in the same coordinates; add it to the model");
}

std::optional<RexsNumber> shift_of(RexsReader& reader, int gear) {
  return reader.of_flanks(gear, "addendum_modification_coefficient", kRexsNumber);
}

RexsNumber pressure_angle_of(RexsReader& reader, int gear) {
  if (const auto said = reader.of_flanks(gear, "normal_pressure_angle", kRexsDegree)) return *said;
  fail(Failure::input, reader.path(), ": the flanks of ", quoted_name(reader.component(gear)),
       " have no 'normal_pressure_angle', which a scene cannot do without; add it to the model");
}

RexsNumber helix_of(RexsReader& reader, int gear) {
  return reader.number(&reader.component(gear), "helix_angle_reference_diameter", kRexsDegree)
      .value_or(RexsNumber{0, "", false});
}

RexsNumber shift_sum(RexsReader& reader, const RexsStage& stage) {
  const auto signed_teeth = [&](int gear) {
    return teeth_of(reader, gear).value * (is_internal(reader, gear) ? -1 : 1);
  };
  const double teeth = signed_teeth(stage.gear[0]) + signed_teeth(stage.gear[1]),
               module =
                   reader.required(reader.component(stage.gear[0]), "normal_module", kRexsMillimetre).value,
               normal = pressure_angle_of(reader, stage.gear[0]).value * kOneDegree,
               of_helix = std::cos(helix_of(reader, stage.gear[0]).value * kOneDegree),
               angle = std::atan(std::tan(normal) / of_helix);
  const RexsNumber distance = centre_distance(reader, stage);
  const double cosine = std::abs(teeth) * module / of_helix * std::cos(angle) / (2 * distance.value);
  if (!(cosine > 0 && cosine <= 1))
    fail(Failure::input, reader.path(), ": at ", distance.value, " mm (", distance.origin,
         ") the base circles of ", quoted_name(reader.component(stage.gear[0])), " and ",
         quoted_name(reader.component(stage.gear[1])), " do not leave a line of action");
  constexpr double kRounded = 1e9;
  const double sum =
      teeth * (involute_function(std::acos(cosine)) - involute_function(angle)) / (2 * std::tan(normal));
  return {std::round(sum * kRounded) / kRounded + 0.0, distance.origin, true};  // no -0
}

std::array<RexsNumber, kSides> profile_shifts(RexsReader& reader, const RexsStage& stage) {
  std::array said{shift_of(reader, stage.gear[0]), shift_of(reader, stage.gear[1])};
  std::array<RexsNumber, kSides> out;
  if (said[0] && said[1]) {
    out = {*said[0], *said[1]};
    for (size_t g = 0; g < kSides; ++g) {
      if (!is_internal(reader, stage.gear[g]) || out[g].value == 0) continue;
      // Where the other sign fits the centre distance and this one does not.
      constexpr double kFits = 0.02, kOff = 0.1;
      const double sum = shift_sum(reader, stage).value, other = out[1 - g].value;
      if (std::abs(other + out[g].value - sum) > kOff && std::abs(other - out[g].value - sum) < kFits)
        out[g] = {-out[g].value, out[g].origin + " with the other sign, which the centre distance needs",
                  true};
    }
    return out;
  }
  const RexsNumber sum = shift_sum(reader, stage);
  for (size_t g = 0; g < kSides; ++g) {
    if (said[g])
      out[g] = *said[g];
    else if (said[1 - g])
      out[g] = {with_digits(sum.value - said[1 - g]->value, 12), "without backlash by " + sum.origin, true};
    else
      out[g] = {sum.value / 2,
                "the model has no profile shifts; half of the sum without backlash by " + sum.origin, true};
  }
  return out;
}

}  // namespace whine
