#include "io/rexs/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/error.h"
#include "base/tool.h"
#include "gear/helix.h"
#include "io/rexs/gear.h"
#include "io/rexs/stage.h"
#include "io/rexs/train.h"
#include "io/variant.h"

namespace whine {
namespace {

// The folder of a torque has its six digits.
constexpr int kTorqueDigits = 6;
constexpr const char *kStiffnessDamping = "3.0e-6", *kOperation = "operation.",
                     *kSpeeds = "{ from = 500, to = 5000, step = 25 }";

// Letters, digits and '_' of a component's name, as sections of a scene are called.
std::string section_name(const RexsComponent& c) {
  std::string out;
  for (const char x : c.name) {
    const bool plain = (x >= 'a' && x <= 'z') || (x >= 'A' && x <= 'Z') || (x >= '0' && x <= '9');
    if (plain)
      out += static_cast<char>(x >= 'A' && x <= 'Z' ? x - 'A' + 'a' : x);
    else if (!out.empty() && out.back() != '_')
      out += '_';
  }
  while (!out.empty() && out.back() == '_') out.pop_back();
  return out.empty() || out.size() > 40 || is_folder_of_results(out) ? text("gear_", c.id) : out;
}

RexsNumber torque_in_digits(RexsNumber torque) {
  const double all = torque.value;
  torque.value = with_digits(all, kTorqueDigits);
  if (torque.value != all) torque.origin += "; six digits of " + all_digits(all);
  return torque;
}

// From a fifth of the operating speed to half beyond it, in steps of a hundredth. frequency: Hz, with its words.
void write_speeds(const std::optional<RexsNumber>& frequency, RexsWriter& out) {
  const char* key = "mesh_frequency_Hz";
  if (!frequency || frequency->value == 0) {
    out.assumed(key, kOperation, kSpeeds, "the model has no speed of the driver");
    return;
  }
  const double mesh = std::max(10.0, frequency->value), step = std::ceil(mesh / 100);
  const std::string range = text("{ from = ", std::ceil(mesh / 5), ", to = ", std::ceil(1.5 * mesh),
                                 ", step = ", step, " }"),
                    words = text("about ", with_digits(mesh, 6), " Hz: ", frequency->origin);
  if (frequency->assumed)
    out.assumed(key, kOperation, range, words);
  else
    out.value(key, range, words);
}

// --- A pair on fixed axes

// Of the loads on a shaft the torque, or its power at the speed of the shaft; N m, above 0.
std::optional<RexsNumber> load_of(RexsReader& reader, const RexsComponent* shaft,
                                  const std::optional<RexsNumber>& speed) {
  std::optional<RexsNumber> out;
  if (!shaft) return out;
  std::string first;
  for (const RexsComponent* c : reader.related(shaft->id)) {
    if (c->type != "external_load") continue;
    std::optional<RexsNumber> torque = reader.number(c, "torque_around_u_axis", kRexsNewtonMetre);
    const auto power = reader.number(c, "power", kRexsWatt);
    if ((!torque || torque->value == 0) && power && speed && speed->value != 0)
      torque = RexsNumber{power->value / (speed->value * kTwoPi / 60),
                          text(power->origin, " = ", power->value * 1e-3, " kW at ", speed->value, " 1/min")};
    if (!torque || torque->value == 0) continue;
    torque->value = std::abs(torque->value);
    if (!out) {
      out = torque;
      first = quoted_name(*c);
    } else if (quoted_name(*c) != first) {
      out->origin +=
          text("; one of several loads of the shaft, ", torque->origin, " = ", torque->value, " N m");
      out->assumed = true;
    }
  }
  return out;
}

size_t stages_with(const RexsModel& model, int gear) {
  return static_cast<size_t>(
      std::count_if(model.relations.begin(), model.relations.end(), [&](const auto& r) {
        return r.type == "stage" && (r.in_role("gear_1") == gear || r.in_role("gear_2") == gear);
      }));
}

void write_load(RexsReader& reader, const RexsStage& stage, double teeth, RexsWriter& out) {
  const RexsComponent &driver = reader.component(stage.gear[0]), *shaft = reader.beside(driver.id, "shaft");
  std::optional<RexsNumber> speed = reader.number(&driver, "rotational_speed", kRexsPerMinute);
  if (!speed) speed = reader.number(shaft, "rotational_speed", kRexsPerMinute);
  std::optional<RexsNumber> torque =
      reader.number(reader.stage_gear_data(stage.id, driver.id), "torque", kRexsNewtonMetre);
  if (!torque) {
    torque = reader.number(&driver, "torque_acting_on_shaft_u", kRexsNewtonMetre);
    if (!torque || torque->value == 0) torque = load_of(reader, shaft, speed);
    if (const size_t meshes = stages_with(reader.model(), driver.id); torque && meshes > 1) {
      torque->origin = text("the whole torque, and ", quoted_name(driver), " takes part in ", meshes,
                            " stages; ", torque->origin);
      torque->assumed = true;
    }
  }
  if (torque && torque->value != 0) {
    torque->value = std::abs(torque->value);
    out.value("torque_Nm", kOperation, torque_in_digits(*torque));
  } else {
    out.assumed("torque_Nm", kOperation, "100.0", "the model has no torque of the driver");
  }
  if (speed) speed->value = std::abs(speed->value) / 60 * teeth;  // 1/min -> Hz
  write_speeds(speed, out);
}

// A mesh of a planetary stage.
struct MeshOfTrain {
  int stage = -1;
  std::optional<RexsTrain> train;
  std::string unknown;  // why there is no train
};

MeshOfTrain mesh_of_train(RexsReader& reader, int planetary_stage) {
  MeshOfTrain out{planetary_stage, {}, ""};
  try {
    out.train = train_of(reader, planetary_stage);
  } catch (const Error& error) {
    out.unknown = error.what();
  }
  return out;
}

// Where the model does not say which gear drives, the flow of power through the train does.
void drive_by_train(const RexsTrain& train, RexsStage& stage) {
  if (stage.driver_assumed.empty()) return;
  const bool of_sun = stage.gear[0] == train.sun || stage.gear[1] == train.sun;
  const int central = of_sun ? train.sun : train.ring;
  if ((stage.gear[0] == central) != (of_sun == train.sun_drives())) std::swap(stage.gear[0], stage.gear[1]);
  stage.driver_assumed = text(name_of(train.input), " drives the planetary stage: ", train.input_origin);
}

// Its share of the torque, and the speed of its teeth against the carrier.
void write_share(RexsReader& reader, const RexsStage& stage, const RexsTrain& train, double teeth,
                 RexsWriter& out) {
  const auto planets = static_cast<double>(train.planets.size());
  RexsNumber torque{train.sun_torque.value / planets * teeth / train.sun_teeth, "", true};
  torque.origin = text("of ", planets, " planets that share ",
                       with_digits(train.sun_torque.value, kTorqueDigits), " N m on the sun equally one, at ",
                       quoted_name(reader.component(stage.gear[0])), " (", train.sun_torque.origin, ")");
  out.value("torque_Nm", kOperation, torque_in_digits(torque));
  std::optional<RexsNumber> frequency = train.mesh_frequency;
  if (frequency) frequency->origin = "against the carrier: " + frequency->origin;
  write_speeds(frequency, out);
}

void write_pair(RexsReader& reader, RexsStage stage, const MeshOfTrain& mesh, RexsScene& scene) {
  const std::optional<RexsTrain>& train = mesh.train;
  if (train) drive_by_train(*train, stage);
  const std::array<RexsNumber, kSides> shift = profile_shifts(reader, stage);
  const RexsNumber distance = centre_distance(reader, stage);
  std::array gear{read_gear(reader, stage.gear[0], shift[0]), read_gear(reader, stage.gear[1], shift[1])};
  if (gear[0].helix.value * gear[1].helix.value > 0) {  // some programs write the angle without its hand
    gear[1].helix.value = -gear[1].helix.value;
    gear[1].helix.assumed = true;
  }
  if (const std::string fault = helix_fault(gear[0].design(), gear[1].design()); !fault.empty())
    fail(Failure::input, reader.path(), ": ", quoted_name(reader.component(stage.id)), ": ", fault);
  fit_tips(gear[0], gear[1], distance.value);
  RexsScene gears, materials;
  RexsWriter of_gears(gears), of_materials(materials), out(scene);
  std::array<std::string, kSides> name{section_name(reader.component(stage.gear[0])),
                                       section_name(reader.component(stage.gear[1]))};
  if (name[0] == name[1]) name[1] += "_2";
  RexsMaterials material(reader);
  for (size_t g = 0; g < kSides; ++g)
    write_gear(reader, gear[g], name[g], material.of(gear[g], of_materials),
               {{reader.stage_gear_data(stage.id, stage.gear[g])}, false}, of_gears, gears);
  if (mesh.stage >= 0)
    out.line(text(
        "# One mesh of ", quoted_name(reader.component(mesh.stage)),
        ", as a pair in the frame of its carrier: axes at rest, share of the torque, speed against the carrier"));
  out.line(text("title = \"", gear[0].teeth.value, "/", gear[1].teeth.value, " teeth, module ",
                gear[0].module.value, " mm\""));
  scene.text += gears.text + materials.text;
  out.section("[[mesh]]");
  if (stage.driver_assumed.empty())
    out.value("driver", "\"" + name[0] + "\"", quoted_name(reader.component(stage.gear[0])));
  else
    out.assumed("driver", "mesh.", "\"" + name[0] + "\"", stage.driver_assumed);
  out.value("driven", "\"" + name[1] + "\"", quoted_name(reader.component(stage.gear[1])));
  out.value("centre_distance_mm", "mesh.", distance);
  out.section("[damping]");
  const bool helical = gear[0].design().helical();
  out.assumed("rayleigh_stiffness_s", "damping.", kStiffnessDamping,
              helical ? "pi times the natural frequency times this is about the damping ratio"
                      : "make calibrate DAMPING=0.05 finds it");
  if (helical)
    out.line(
        "\n# [fidelity]\n# width = \"slices\"  # for vibration over speed; without it bodies in three dimensions, at rest alone");
  out.section("[operation]");
  if (train) {
    write_share(reader, stage, *train, gear[0].teeth.value, out);
  } else if (mesh.stage >= 0) {
    const std::string why = "its share of the torque and its speed are not known: " + mesh.unknown;
    out.assumed("torque_Nm", kOperation, "100.0", why);
    out.assumed("mesh_frequency_Hz", kOperation, kSpeeds, why);
  } else {
    write_load(reader, stage, gear[0].teeth.value, out);
  }
  for (RexsScene* part : {&gears, &materials}) {
    scene.assumed.insert(scene.assumed.end(), part->assumed.begin(), part->assumed.end());
    scene.ignored.insert(scene.ignored.end(), part->ignored.begin(), part->ignored.end());
  }
}

// --- A planetary stage

// [sun, planet, ring]
struct TrainGears {
  std::array<RexsGear, 3> gear;
  RexsNumber distance;
};

// What is not said of sun and ring follows from the planet, and of the planet from the sun.
TrainGears gears_of(RexsReader& reader, const RexsTrain& train, const RexsTrain::Planet& planet) {
  const RexsNumber of_sun = shift_sum(reader, planet.sun_mesh), of_ring = shift_sum(reader, planet.ring_mesh);
  const auto at = [&](const RexsStage& mesh, int gear) {
    return profile_shifts(reader, mesh)[mesh.gear[0] == gear ? 0 : 1];
  };
  const auto from = [&](const RexsNumber& sum, double other) {
    return RexsNumber{with_digits(sum.value - other, 12), "without backlash by " + sum.origin, true};
  };
  RexsNumber sun = at(planet.sun_mesh, train.sun), own = at(planet.sun_mesh, planet.gear),
             ring = at(planet.ring_mesh, train.ring);
  const auto said = shift_of(reader, planet.gear);
  if (!said && !shift_of(reader, train.sun)) {
    // Neither of them: that of the ring decides, else the planet has none.
    own = shift_of(reader, train.ring) ? from(of_ring, ring.value)
                                       : RexsNumber{0, "the model has no profile shifts", true};
    sun = from(of_sun, own.value);
  }
  if (!said && !shift_of(reader, train.ring)) ring = from(of_ring, own.value);
  TrainGears out{{read_gear(reader, train.sun, sun), read_gear(reader, planet.gear, own),
                  read_gear(reader, train.ring, ring)},
                 centre_distance(reader, planet.sun_mesh)};
  for (const RexsGear& gear : out.gear)
    if (gear.helix.value != 0)
      fail(Failure::input, reader.path(), ": ", quoted_name(reader.component(gear.id)), " is helical (",
           gear.helix.origin, " = ", gear.helix.value,
           " degrees); of helical gears a cylindrical_stage is imported, as a pair");
  const RexsNumber other = centre_distance(reader, planet.ring_mesh);
  if (std::abs(other.value - out.distance.value) > 1e-6 * out.distance.value)
    fail(Failure::input, reader.path(), ": the axes of ", quoted_name(reader.component(planet.gear)), " are ",
         out.distance.value, " mm from the sun (", out.distance.origin, ") and ", other.value,
         " mm from the ring (", other.origin, "); both have one axis");
  fit_tips(out.gear[0], out.gear[1], out.distance.value);
  fit_tips(out.gear[2], out.gear[1], out.distance.value);
  return out;
}

// All planets are one gear of a scene. Keys and values, without comments.
std::string keys_of(RexsReader& reader, const RexsGear& planet, const RexsFlanks& flanks) {
  RexsScene scene;
  RexsWriter out(scene);
  RexsMaterials material(reader);
  write_gear(reader, planet, "planet", "material", flanks, out, scene);
  material.of(planet, out);
  std::string keys, line;
  for (const char c : scene.text + "\n") {
    if (c != '\n') {
      line += c;
      continue;
    }
    if (!line.starts_with("#") && !line.starts_with("["))
      keys += line.substr(0, line.find_last_not_of(' ', line.find(" #")) + 1) + "\n";
    line.clear();
  }
  return keys;
}

void require_alike(RexsReader& reader, const RexsTrain& train, const RexsFlanks& flanks,
                   const std::vector<TrainGears>& all) {
  const std::string first = keys_of(reader, all[0].gear[1], flanks);
  for (size_t n = 1; n < all.size(); ++n) {
    const std::string other = keys_of(reader, all[n].gear[1], flanks);
    if (other == first && all[n].distance.value == all[0].distance.value) continue;
    const size_t at = static_cast<size_t>(
        std::mismatch(first.begin(), first.end(), other.begin(), other.end()).first - first.begin());
    const auto line = [&](const std::string& keys) {
      const size_t begin = keys.rfind('\n', std::min(at, keys.size()) - (at > 0)) + 1;
      return keys.substr(begin, keys.find('\n', begin) - begin);
    };
    fail(Failure::input, reader.path(), ": the planets differ, and a scene has one gear for all of them: ",
         quoted_name(reader.component(train.planets[0].gear)), " has ",
         other == first ? text(all[0].distance.value, " mm") : line(first), ", ",
         quoted_name(reader.component(train.planets[n].gear)), " has ",
         other == first ? text(all[n].distance.value, " mm") : line(other));
  }
}

// kg m2: two plates of 0.2 planet widths that reach over the planets, and the planets on their pins. A carrier is seldom drawn in a
// model, and statics do not depend on it.
double carrier_inertia(const TrainGears& of, size_t planets) {
  constexpr double kDensity = 7850, kPlates = 0.4;
  const GearDesign planet = of.gear[1].design();
  const double a = of.distance.value * 1e-3, r = 0.5 * planet.module * planet.teeth, outside = a + r,
               plates = 0.5 * kPi * kDensity * kPlates * planet.face_width * std::pow(outside, 4),
               disc = kPi * kDensity * planet.face_width * (r * r - planet.bore_radius * planet.bore_radius);
  return plates + static_cast<double>(planets) * disc * a * a;
}

void write_carrier(const RexsTrain& train, const TrainGears& of, RexsWriter& out) {
  out.section("[[carrier]]");
  out.line("name = \"carrier\"");
  out.line("planet = \"planet\"");
  const auto count = static_cast<double>(train.planets.size());
  bool equal = std::fmod(train.sun_teeth + train.ring_teeth, count) == 0;
  std::string list;
  for (size_t n = 0; n < train.planets.size(); ++n) {
    constexpr double kSame = 0.01;  // deg
    equal = equal && std::abs(train.planets[n].angle - 360 * static_cast<double>(n) / count) < kSame;
    list += (n == 0 ? "" : ", ") + all_digits(std::round(train.planets[n].angle * 1e4) / 1e4);
  }
  const std::string key = equal ? "planets" : "positions_deg",
                    value = equal ? std::to_string(train.planets.size()) : "[" + list + "]";
  if (train.positions_assumed)
    out.assumed(key, "carrier.", value, train.positions);
  else
    out.value(key, value, train.positions);
  if (train.held != RexsMember::carrier)
    out.value(
        "inertia_kgm2", "carrier.",
        {with_digits(carrier_inertia(of, train.planets.size()), 4),
         "two plates of 0.2 planet widths over the planets, and the planets; statics do not depend on it",
         true});
}

// Torques in the frame of the carrier, each in the sense in which its body turns there: the first driver's above 0.
void write_drives(const RexsTrain& train, RexsWriter& out) {
  const RexsMember first = train.sun_drives() ? RexsMember::sun : RexsMember::ring;
  RexsTrain rounded = train;
  rounded.sun_torque.value = with_digits(train.sun_torque.value, kTorqueDigits);
  for (const RexsMember member :
       {first, first == RexsMember::sun ? RexsMember::ring : RexsMember::sun, RexsMember::carrier}) {
    out.section("[[drive]]");
    out.line(text("gear = \"", name_of(member), "\""));
    if (member == train.held) {
      if (train.held_assumed)
        out.assumed("kind", text("drive.", name_of(member), "."), "\"held\"", train.held_origin);
      else
        out.value("kind", "\"held\"", train.held_origin);
      continue;
    }
    const bool input = member == train.input;
    const std::string of = text("drive.", name_of(member), ".");
    if (input && train.input_assumed)
      out.assumed("kind", of, "\"torque\"", "the input: " + train.input_origin);
    else
      out.value("kind", "\"torque\"", input ? "the input: " + train.input_origin : "the output");
    RexsNumber torque{(member == first ? 1 : -1) * with_digits(rounded.torque_of(member), 12), "",
                      train.sun_torque.assumed};
    torque.origin = text(member == RexsMember::sun ? "" : "from that of the sun; ", train.sun_torque.origin,
                         "; in the frame of the carrier ", name_of(first), " drives");
    out.value("torque_Nm", of, torque);
    const auto planets = static_cast<double>(train.planets.size());
    if (member == RexsMember::sun)
      out.line(text("# of it ", with_digits(train.sun_torque.value / planets, kTorqueDigits),
                    " N m in each of ", planets, " meshes, with equal shares"));
  }
}

void write_train(RexsReader& reader, const RexsTrain& train, RexsScene& scene) {
  std::vector<TrainGears> all;
  for (const RexsTrain::Planet& planet : train.planets) all.push_back(gears_of(reader, train, planet));
  const TrainGears& of = all[0];
  const RexsTrain::Planet& planet = train.planets[0];
  const auto data = [&](const RexsStage& mesh, int gear) { return reader.stage_gear_data(mesh.id, gear); };
  const std::array<RexsFlanks, 3> flanks{
      RexsFlanks{{data(planet.sun_mesh, train.sun)}, false},
      RexsFlanks{{data(planet.sun_mesh, planet.gear), data(planet.ring_mesh, planet.gear)}, true},
      RexsFlanks{{data(planet.ring_mesh, train.ring)}, false}};
  require_alike(reader, train, flanks[1], all);

  RexsWriter out(scene);
  RexsScene materials;
  RexsWriter of_materials(materials);
  RexsMaterials material(reader);
  out.line(text("title = \"", train.planets.size(), " planets of ", of.gear[1].teeth.value, " between ",
                train.sun_teeth, " and ", train.ring_teeth, " teeth, module ", of.gear[0].module.value,
                " mm\""));
  const std::array name{"sun", "planet", "ring"};
  for (size_t g = 0; g < name.size(); ++g)
    write_gear(reader, of.gear[g], name[g], material.of(of.gear[g], of_materials), flanks[g], out, scene);
  scene.text += materials.text;
  scene.assumed.insert(scene.assumed.end(), materials.assumed.begin(), materials.assumed.end());
  write_carrier(train, of, out);
  const bool sun = train.sun_drives();
  for (const auto& [driver, driven] :
       {std::pair{sun ? "sun" : "ring", "planet"}, std::pair{"planet", sun ? "ring" : "sun"}}) {
    out.section("[[mesh]]");
    out.line(text("driver = \"", driver, "\""));
    out.line(text("driven = \"", driven, "\""));
    out.value("centre_distance_mm", "mesh.", of.distance);
  }
  write_drives(train, out);
  out.section("[damping]");
  out.assumed("rayleigh_mass_per_s", "damping.", "200.0", "make impact shows the damping ratios");
  out.assumed("rayleigh_stiffness_s", "damping.", "2.0e-6", "make impact shows the damping ratios");
  out.section("[operation]");
  write_speeds(train.mesh_frequency, out);
  scene.ignored.insert(scene.ignored.end(), train.remarks.begin(), train.remarks.end());
  scene.ignored.emplace_back("bearings: all axes of the scene are rigid; [[bearing]] gives them a stiffness");
}

}  // namespace

RexsScene scene_of_rexs(const RexsModel& model, const std::string& wanted, int load_case) {
  RexsReader reader(model, load_case);
  const int id = chosen_stage(reader, wanted), whole = planetary_stage_of(reader, id);
  RexsScene scene;
  RexsWriter out(scene);
  scene.stage = quoted_name(reader.component(id));
  out.line("# Imported from a REXS model of version " + printable(model.version, 10) + ": " + scene.stage);
  if (reader.component(id).type == "planetary_stage")
    write_train(reader, train_of(reader, id), scene);
  else
    write_pair(reader, stage_of(reader, id), whole < 0 ? MeshOfTrain{} : mesh_of_train(reader, whole), scene);
  for (const std::string& unread : reader.unread()) scene.ignored.push_back(unread);
  if (!scene.ignored.empty()) out.line("\n# In the model and not in this scene:");
  for (const std::string& ignored : scene.ignored) out.line("# - " + ignored);
  return scene;
}

}  // namespace whine
