#include "io/rexs/train.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/error.h"
#include "base/tool.h"

namespace whine {
namespace {

// What the model says of one member.
struct Member {
  std::vector<int> components;  // the gear or carrier, and its shafts
  std::optional<RexsNumber> speed, torque, power;
  std::optional<RexsNumber> reaction;  // torque of the gear on its shaft, against that of a load
  std::string held;                    // by what; empty: the model holds it nowhere
};

class TrainReader {
 public:
  TrainReader(RexsReader& reader, int stage) : reader_(reader) { train_.stage = stage; }

  RexsTrain read() {
    take_gears();
    for (const RexsMember member : kRexsMembers) take_member(member);
    take_held();
    take_input();
    take_torque();
    take_speed();
    take_positions();
    return train_;
  }

 private:
  template <class... Words>
  [[noreturn]] void reject(const Words&... words) const {
    fail(Failure::input, reader_.path(), ": ", quoted_name(reader_.component(train_.stage)), " ",
         text(words...));
  }
  std::string name(int id) const { return quoted_name(reader_.component(id)); }
  Member& of(RexsMember member) { return members_[static_cast<size_t>(member)]; }

  // Planets are the gears of two meshes of which one has the ring.
  void take_gears() {
    std::vector<RexsStage> meshes;
    for (const auto& [id, c] : reader_.model().components)
      if (c.type == "cylindrical_stage" && planetary_stage_of(reader_, id) == train_.stage)
        meshes.push_back(stage_of(reader_, id));
    std::set<int> rings, suns;
    std::map<int, RexsTrain::Planet> planets;
    for (const RexsStage& mesh : meshes)
      for (size_t g = 0; g < kSides; ++g)
        if (is_internal(reader_, mesh.gear[g])) {
          rings.insert(mesh.gear[g]);
          planets[mesh.gear[1 - g]].ring_mesh = mesh;
        }
    for (const RexsStage& mesh : meshes) {
      if (rings.contains(mesh.gear[0]) || rings.contains(mesh.gear[1])) continue;
      const size_t g = planets.contains(mesh.gear[0]) ? 0 : 1;
      if (!planets.contains(mesh.gear[g]) || planets.contains(mesh.gear[1 - g])) {
        suns.clear();
        break;
      }
      suns.insert(mesh.gear[1 - g]);
      planets[mesh.gear[g]].sun_mesh = mesh;
    }
    const bool both = std::all_of(planets.begin(), planets.end(),
                                  [](const auto& planet) { return planet.second.sun_mesh.id >= 0; });
    if (rings.size() != 1 || suns.size() != 1 || !both)
      reject(
          "has ", suns.size(), " suns, ", rings.size(), " ring gears and ", planets.size(), " planets in ",
          meshes.size(),
          " meshes; a scene has one sun, one ring and planets that mesh with both: import its meshes one by one (--stage)");
    train_.sun = *suns.begin();
    train_.ring = *rings.begin();
    train_.sun_teeth = teeth_of(reader_, train_.sun).value;
    train_.ring_teeth = teeth_of(reader_, train_.ring).value;
    for (auto& [gear, planet] : planets) {
      planet.gear = gear;
      train_.planets.push_back(planet);
    }
  }

  void take_member(RexsMember which) {
    Member& member = of(which);
    if (which == RexsMember::carrier) {
      for (const RexsRelation& relation : reader_.model().relations) {
        const int carrier = relation.in_role("part"), shaft = relation.in_role("shaft");
        if (relation.in_role("assembly") == train_.stage && carrier >= 0 &&
            reader_.component(carrier).type == "planet_carrier")
          member.components.push_back(carrier);
        if (relation.type == "planet_carrier_shaft" && relation.in_role("planetary_stage") == train_.stage &&
            shaft >= 0)
          member.components.push_back(shaft);
      }
    } else {
      const int gear = which == RexsMember::sun ? train_.sun : train_.ring;
      member.components.push_back(gear);
      for (const RexsComponent* c : reader_.related(gear))
        if (c->type == "shaft") member.components.push_back(c->id);
    }
    for (const int id : member.components) {
      take_number(member.speed, &reader_.component(id), "rotational_speed", kRexsPerMinute);
      if (which != RexsMember::carrier)
        take_number(member.reaction, &reader_.component(id), "torque_acting_on_shaft_u", kRexsNewtonMetre);
      for (const RexsComponent* c : reader_.related(id)) {
        if (c->type != "external_load") continue;
        take_number(member.torque, c, "torque_around_u_axis", kRexsNewtonMetre);
        take_number(member.power, c, "power", kRexsWatt);
      }
    }
    take_casing(member);
  }

  // The first that is not 0; a speed of 0 holds its member.
  void take_number(std::optional<RexsNumber>& into, const RexsComponent* c, const char* attribute,
                   const RexsUnit& unit) {
    const auto said = reader_.number(c, attribute, unit);
    if (said && (!into || into->value == 0)) into = said;
  }

  bool engaged(const RexsComponent& coupling) {
    const std::vector<std::string> states = reader_.words(&coupling, "is_engaged");
    if (states.empty()) return true;
    // Of the gear that is shifted; shifts count from 1.
    double shift = 1;
    for (const auto& [id, c] : reader_.model().components)
      if (c.type == "gear_unit")
        if (const auto said = reader_.number(&c, "gear_shift_index", kRexsNumber)) shift = said->value;
    const bool known = shift >= 1 && shift <= static_cast<double>(states.size());
    const std::string& state = states[known ? static_cast<size_t>(shift) - 1 : 0];
    return state == "true" || state == "1";
  }

  // Held by a coupling to the casing; a ring also by what joins the gear itself to it.
  void take_casing(Member& member) {
    for (const RexsRelation& relation : reader_.model().relations) {
      const RexsComponent *casing = nullptr, *coupling = nullptr, *own = nullptr;
      bool bearing = false;
      for (const RexsRelation::Reference& reference : relation.references) {
        const RexsComponent& c = reader_.component(reference.component);
        if (c.type == "gear_casing") casing = &c;
        if (c.type.find("coupling") != std::string::npos) coupling = &c;
        bearing = bearing || c.type.find("bearing") != std::string::npos;
        if (std::find(member.components.begin(), member.components.end(), c.id) != member.components.end())
          own = &c;
      }
      if (!casing || !own || bearing || !(coupling || own->id == train_.ring)) continue;
      if (coupling && !engaged(*coupling)) continue;
      member.held = coupling ? quoted_name(*coupling) + " holds it in " + quoted_name(*casing)
                             : quoted_name(*own) + " sits in " + quoted_name(*casing);
    }
    if (member.held.empty() && member.speed && member.speed->value == 0)
      member.held = member.speed->origin + " = 0";
  }

  void take_held() {
    std::vector<RexsMember> held;
    for (const RexsMember member : kRexsMembers)
      if (!of(member).held.empty()) held.push_back(member);
    if (held.size() > 1)
      reject("cannot turn: ", name_of(held[0]), ": ", of(held[0]).held, ", and ", name_of(held[1]), ": ",
             of(held[1]).held);
    if (held.size() == 1) {
      train_.held = held[0];
      train_.held_origin = of(held[0]).held;
      return;
    }
    std::string turning;
    size_t free = 0;
    for (const RexsMember member : kRexsMembers)
      if (of(member).speed) {
        ++free;
        turning += text(turning.empty() ? "" : ", ", name_of(member), " ", of(member).speed->value, " 1/min");
      }
    if (of(RexsMember::ring).speed || free > 1)
      reject("holds no member in its gear_casing (", turning,
             "); a scene is written where one of sun, ring and carrier is held: give that one the speed 0");
    train_.held = RexsMember::ring;
    train_.held_origin = "the model holds none of sun, ring and carrier in its gear_casing";
    train_.held_assumed = true;
  }

  // W, of a load on the shaft of a member with the sign of its speed; empty: not known.
  static std::optional<double> power_of(const Member& member) {
    if (member.power && member.power->value != 0) return member.power->value;
    if (member.torque && member.speed && member.torque->value * member.speed->value != 0)
      return member.torque->value * member.speed->value * kTwoPi / 60;
    return {};
  }

  void take_input() {
    std::vector<RexsMember> free;
    for (const RexsMember member : kRexsMembers)
      if (member != train_.held) free.push_back(member);
    const std::array power{power_of(of(free[0])), power_of(of(free[1]))};
    for (size_t i : {0, 1}) {
      const double drives = power[i] ? *power[i] : power[1 - i] ? -*power[1 - i] : 0;
      if (!(drives > 0)) continue;
      train_.input = free[i];
      train_.input_origin = "power goes in at its shaft: torque and speed have one sign";
      if (power[1 - i] && *power[1 - i] > 0)
        reject("has power going in at ", name_of(free[0]), " (", *power[0], " W) and ", name_of(free[1]),
               " (", *power[1], " W)");
      return;
    }
    train_.input_assumed = true;
    const auto loaded = [&](RexsMember member) {
      return (of(member).torque && of(member).torque->value != 0) || of(member).power;
    };
    const bool second = !loaded(free[0]) && loaded(free[1]);
    train_.input = free[second ? 1 : 0];
    train_.input_origin =
        loaded(train_.input) ? "its shaft has the load" : "the model has no load of this stage";
  }

  // teeth, of a member: what its torque is proportional to.
  double teeth(RexsMember member) const {
    return member == RexsMember::sun    ? train_.sun_teeth
           : member == RexsMember::ring ? train_.ring_teeth
                                        : train_.sun_teeth + train_.ring_teeth;
  }

  // N m; empty: the model says nothing of this member.
  std::optional<RexsNumber> torque(RexsMember which) {
    const Member& member = of(which);
    for (const auto& said : {member.torque, member.reaction})
      if (said && said->value != 0)
        return RexsNumber{std::abs(said->value), text(said->value, " N m: ", said->origin)};
    if (!member.power || member.power->value == 0) return {};
    const auto speed = speed_of(which);
    if (!speed || *speed == 0) return {};
    const double turned = std::abs(member.power->value / (*speed * kTwoPi / 60));
    return RexsNumber{turned, text(with_digits(turned, 6), " N m: ", member.power->origin, " = ",
                                   member.power->value * 1e-3, " kW at ", with_digits(*speed, 6), " 1/min")};
  }

  void take_torque() {
    std::vector<RexsMember> order{train_.input, train_.output(), train_.held};
    std::optional<RexsMember> from;
    for (const RexsMember member : order) {
      const auto said = torque(member);
      if (!said) continue;
      const double on_sun = said->value * train_.sun_teeth / teeth(member);
      if (!from) {
        from = member;
        train_.sun_torque = {on_sun, std::string(name_of(member)) + ", " + said->origin};
      } else if (constexpr double kSame = 0.01;
                 std::abs(on_sun - train_.sun_torque.value) > kSame * train_.sun_torque.value) {
        train_.remarks.push_back(text(name_of(member), ", ", said->origin, ": the torque of ", name_of(*from),
                                      " makes it ", train_.torque_of(member), " N m without losses"));
      }
    }
    if (!from) train_.sun_torque = {100, "the model has no torque of this stage", true};
  }

  // 1/min; relative speed of the sun times its teeth (F) gives all of them once the held one is 0.
  double speed_for(RexsMember member, double F) const {
    const double zs = train_.sun_teeth, zr = train_.ring_teeth;
    const double carrier = train_.held == RexsMember::ring  ? F / zr
                           : train_.held == RexsMember::sun ? -F / zs
                                                            : 0;
    return member == RexsMember::sun    ? carrier + F / zs
           : member == RexsMember::ring ? carrier - F / zr
                                        : carrier;
  }

  // Of any member whose speed is known: F in teeth per minute.
  std::optional<std::pair<double, RexsMember>> teeth_per_minute() {
    for (const RexsMember member : {train_.input, train_.output()})
      if (of(member).speed && of(member).speed->value != 0)
        return std::pair{of(member).speed->value / speed_for(member, 1), member};
    return {};
  }
  std::optional<double> speed_of(RexsMember member) {
    const auto F = teeth_per_minute();
    return F ? std::optional(speed_for(member, F->first)) : std::nullopt;
  }

  void take_speed() {
    const auto F = teeth_per_minute();
    if (!F) return;
    for (const RexsMember member : kRexsMembers) {
      const auto& said = of(member).speed;
      const double follows = speed_for(member, F->first);
      constexpr double kSame = 5e-3;
      if (said && std::abs(said->value - follows) > kSame * std::abs(F->first / train_.sun_teeth))
        reject("has ", of(F->second).speed->origin, " = ", of(F->second).speed->value, " 1/min and ",
               said->origin, " = ", said->value, " 1/min, which would be ", follows, " 1/min");
    }
    train_.mesh_frequency =
        RexsNumber{std::abs(F->first) / 60,
                   text(of(F->second).speed->origin, " = ", of(F->second).speed->value, " 1/min; sun ",
                        with_digits(speed_for(RexsMember::sun, F->first), 6), ", ring ",
                        with_digits(speed_for(RexsMember::ring, F->first), 6), ", carrier ",
                        with_digits(speed_for(RexsMember::carrier, F->first), 6), " 1/min"),
                   train_.held_assumed};
    turns_ = F->first * (train_.sun_drives() ? 1 : -1) < 0 ? -1 : 1;
  }

  // deg of a planet about the axis of the sun; empty: not known.
  std::optional<double> angle_of(const RexsTrain::Planet& planet) {
    const auto at = place_of(reader_, planet.gear), centre = place_of(reader_, train_.sun);
    if (at && centre && at->reference == centre->reference) {
      const auto& u = centre->axis;
      // w: any direction across the axis; v completes v, w, u to a right-handed frame.
      std::array<double, 3> w{0, 0, 1};
      if (std::abs(u[2]) > 0.9) w = {1, 0, 0};
      const std::array v{w[1] * u[2] - w[2] * u[1], w[2] * u[0] - w[0] * u[2], w[0] * u[1] - w[1] * u[0]};
      const std::array across{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                              u[0] * v[1] - u[1] * v[0]};
      double x = 0, y = 0;
      for (size_t i = 0; i < 3; ++i) {
        x += (at->at[i] - centre->at[i]) * v[i];
        y += (at->at[i] - centre->at[i]) * across[i];
      }
      if (std::hypot(x, y) > 0) {
        train_.positions = "support_vector of the planets";
        return std::atan2(y, x) * kInDegrees;
      }
    }
    const auto said = reader_.number(&reader_.component(planet.sun_mesh.id),
                                     "rotating_angle_around_neg_u_axis", kRexsDegree);
    if (!said) return {};
    train_.positions = "rotating_angle_around_neg_u_axis of the meshes";
    return -said->value;
  }

  void take_positions() {
    const auto turn = [](double angle) { return angle - 360 * std::floor(angle / 360); };
    const auto count = static_cast<double>(train_.planets.size());
    bool known = true;
    for (RexsTrain::Planet& planet : train_.planets) {
      const auto angle = angle_of(planet);
      known = known && angle;
      planet.angle = angle ? turn(turns_ * *angle) : 0;
    }
    std::sort(train_.planets.begin(), train_.planets.end(),
              [](const auto& a, const auto& b) { return a.angle < b.angle; });
    const double first = train_.planets[0].angle;
    for (size_t n = 0; n < train_.planets.size(); ++n)
      train_.planets[n].angle =
          known ? train_.planets[n].angle - first : 360 * static_cast<double>(n) / count;
    if (known) return;
    train_.positions_assumed = true;
    train_.positions = "the model does not say where the planets stand: equal spacing";
  }

  RexsReader& reader_;
  RexsTrain train_;
  std::array<Member, 3> members_;
  int turns_ = 1;  // of the first driver against the carrier, about its u axis
};

}  // namespace

const char* name_of(RexsMember member) {
  constexpr std::array kNames{"sun", "ring", "carrier"};
  return kNames[static_cast<size_t>(member)];
}

bool RexsTrain::sun_drives() const {
  if (held == RexsMember::carrier) return input == RexsMember::sun;
  // The held central gear is the one that is left behind by the carrier where the other one drives.
  const bool carrier_drives = input == RexsMember::carrier;
  return (held == RexsMember::ring) != carrier_drives;
}

RexsMember RexsTrain::output() const {
  for (const RexsMember member : kRexsMembers)
    if (member != held && member != input) return member;
  return held;
}

double RexsTrain::torque_of(RexsMember member) const {
  return sun_torque.value * (member == RexsMember::sun    ? 1
                             : member == RexsMember::ring ? ring_teeth / sun_teeth
                                                          : 1 + ring_teeth / sun_teeth);
}

RexsTrain train_of(RexsReader& reader, int planetary_stage) {
  return TrainReader(reader, planetary_stage).read();
}

}  // namespace whine
