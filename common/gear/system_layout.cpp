#include "gear/system_layout.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "base/format.h"
#include "base/units.h"
#include "gear/remedy.h"

namespace whine {
namespace {

template <class... Parts>
[[noreturn]] void reject(const char* section, size_t number, const Parts&... parts) {
  throw SectionError(section, number, text(parts...));
}

// rad, 0 to 2 pi, ascending.
std::vector<double> wanted_positions(const Scene::Carrier& carrier, size_t number) {
  std::vector<double> out;
  out.reserve(carrier.positions.size() + static_cast<size_t>(std::max(carrier.planets, 0)));
  if ((carrier.planets > 0) == !carrier.positions.empty())
    reject("carrier", number, "carrier '", carrier.name,
           "' needs either 'planets', their number at equal spacing, or 'positions_deg', a list");
  for (int n = 0; n < carrier.planets; ++n) out.push_back(2 * kPi * n / carrier.planets);
  for (const double angle : carrier.positions) out.push_back(angle - 2 * kPi * std::floor(angle / (2 * kPi)));
  std::sort(out.begin(), out.end());
  return out;
}

// A step midway between two positions is rounded down, whatever its round-off, so that planets opposite each other stay so.
double nearest_step(double step) {
  return std::ceil(step - 0.5 - 1e-6);
}

// Whether a name is one of those that the planets of a gear have: <gear>1, <gear>2, ...
bool called_like_planet(const std::string& name, const std::string& planet) {
  return name.size() > planet.size() && name.starts_with(planet) &&
         name.find_first_not_of("0123456789", planet.size()) == std::string::npos;
}

class Layout {
 public:
  explicit Layout(const Scene& scene) : scene_(scene) {}

  System make() {
    if (scene_.meshes.empty()) reject("mesh", 0, "a system needs one [[mesh]] at least");
    for (size_t c = 0; c < scene_.carriers.size(); ++c) check_carrier(c);
    std::vector<std::array<std::string, 2>> meshes;
    for (size_t m = 0; m < scene_.meshes.size(); ++m) {
      meshes.push_back(scene_.meshes[m].spec.gear);
      for (const std::string& name : meshes.back()) gear_called(name, m);
    }
    require_joined(meshes);
    // Before remedies are looked for, which see each mesh by itself.
    for (size_t c = 0; c < scene_.carriers.size(); ++c) check_axis(c);
    for (size_t m = 0; m < scene_.meshes.size(); ++m) {
      check_new(m);
      try {
        take_mesh(m);
      } catch (const SectionError&) {
        throw;
      } catch (const Error& error) {
        const auto& gear = scene_.meshes[m].spec.gear;
        reject("mesh", m, "[[mesh]] of '", gear[0], "' and '", gear[1],
               "': ", with_remedy(error.what(), drawn_gears(scene_)));
      }
    }
    take_carriers();
    take_pins();
    take_drives();
    system_.load = System::Load::drives;
    check_room();
    return std::move(system_);
  }

 private:
  const SceneGear& gear_called(const std::string& name, size_t mesh) const {
    for (const SceneGear& gear : scene_.gears)
      if (gear.name == name) return gear;
    reject("mesh", mesh, "[[mesh]] names '", name, "', and there is no [gear.", name, "] section");
  }

  // Two meshes of the same bodies would share the load twice.
  void check_new(size_t m) const {
    const auto& [driver, driven] = scene_.meshes[m].spec.gear;
    for (size_t n = 0; n < m; ++n) {
      const auto& [first, second] = scene_.meshes[n].spec.gear;
      if ((first == driver && second == driven) || (first == driven && second == driver))
        reject("mesh", m, "a second [[mesh]] of '", driver, "' and '", driven,
               "'; two gears have one mesh, that of a planet stands for all planets: take one out");
    }
  }

  // The carrier whose planets a gear is; -1: none.
  int carrier_of(const std::string& gear) const {
    for (size_t c = 0; c < scene_.carriers.size(); ++c)
      if (scene_.carriers[c].planet == gear) return static_cast<int>(c);
    return -1;
  }

  void check_carrier(size_t c) {
    const Scene::Carrier& carrier = scene_.carriers[c];
    const auto names_gear = [](const std::string& name) {
      return [name](const SceneGear& gear) { return gear.name == name; };
    };
    if (std::any_of(scene_.gears.begin(), scene_.gears.end(), names_gear(carrier.name)))
      reject("carrier", c, "carrier '", carrier.name, "' is called like a gear; give it a name of its own");
    for (size_t other = 0; other < c; ++other)
      if (scene_.carriers[other].name == carrier.name)
        reject("carrier", c, "two carriers are called '", carrier.name, "'; give each a name of its own");
    for (const Scene::Carrier& other : scene_.carriers)
      if (called_like_planet(carrier.name, other.planet))
        reject("carrier", c, "carrier '", carrier.name, "' is called like one of the planets of carrier '",
               other.name, "' (", other.planet, "1, ", other.planet, "2, ...); rename it");
    for (const SceneGear& gear : scene_.gears)
      if (called_like_planet(gear.name, carrier.planet))
        reject("carrier", c, "[gear.", gear.name, "] is called like one of the planets of carrier '",
               carrier.name, "' (", carrier.planet, "1, ", carrier.planet, "2, ...); rename it");
    if (std::none_of(scene_.gears.begin(), scene_.gears.end(), names_gear(carrier.planet)))
      reject("carrier", c, "'planet' of carrier '", carrier.name, "' = '", carrier.planet,
             "' names no [gear.<name>] section");
    if (carrier_of(carrier.planet) != static_cast<int>(c))
      reject("carrier", c, "two carriers have the planet '", carrier.planet,
             "'; give each a gear of its own");
    positions_.push_back(wanted_positions(carrier, c));
    take_assembly(c);
  }

  // Teeth of the sun and of the ring that mesh with the planets of a carrier; 0: there is none.
  std::array<int, 2> central_teeth(size_t c) const {
    std::array<int, 2> teeth{};
    for (size_t m = 0; m < scene_.meshes.size(); ++m)
      for (int s = 0; s < kSides; ++s)
        if (scene_.meshes[m].spec.gear[static_cast<size_t>(s)] == scene_.carriers[c].planet) {
          const GearDesign& other =
              gear_called(scene_.meshes[m].spec.gear[static_cast<size_t>(1 - s)], m).design;
          teeth[other.internal ? 1 : 0] = other.teeth;
        }
    return teeth;
  }

  void take_assembly(size_t c) {
    const Scene::Carrier& carrier = scene_.carriers[c];
    const auto [sun, ring] = central_teeth(c);
    if (sun == 0 || ring == 0) return;
    const int steps = sun + ring;
    std::string nearest;
    bool fits = true;
    const double first = positions_[c][0];
    for (double& position : positions_[c]) {
      const double step = (position - first) * steps / (2 * kPi), whole = nearest_step(step);
      const double assembled = first + whole * 2 * kPi / steps;
      nearest += text(nearest.empty() ? "" : ", ", std::round(assembled * kInDegrees * 1e4) / 1e4);
      fits = fits && std::abs(step - whole) <= (carrier.planets > 0 ? 1e-9 : kPositionDigits);
      position = assembled;
    }
    if (fits) return;
    if (carrier.planets > 0)
      reject("carrier", c, "'planets' of carrier '", carrier.name, "' = ", carrier.planets,
             ": they cannot be assembled at equal spacing: sun and ring have ", sun, " + ", ring, " = ",
             steps, " teeth, which ", carrier.planets, " does not divide. Nearest: positions_deg = [",
             nearest, "]");
    reject("carrier", c, "'positions_deg' of carrier '", carrier.name,
           "': planets cannot be assembled there: sun and ring have ", sun, " + ", ring, " = ", steps,
           " teeth, so that positions are ", 360.0 / steps, " degrees apart or multiples of it. Nearest: [",
           nearest, "]");
  }

  // Number of the body that stands for a gear, or for its planet n; -1: not placed.
  int placed(const std::string& name) const {
    for (size_t b = 0; b < system_.bodies.size(); ++b)
      if (system_.bodies[b].name == name) return static_cast<int>(b);
    return -1;
  }

  void take_mesh(size_t m) {
    const Scene::Mesh& mesh = scene_.meshes[m];
    const SceneGear *first = &gear_called(mesh.spec.gear[0], m), *second = &gear_called(mesh.spec.gear[1], m);
    const int c_first = carrier_of(first->name), c_second = carrier_of(second->name);
    if (c_first >= 0 && c_second >= 0)
      reject("mesh", m, "[[mesh]] of '", first->name, "' and '", second->name,
             "': both are planets; meshes between planets are not in the model");
    const int carrier = std::max(c_first, c_second);
    if (system_.bodies.empty()) {
      if (c_first >= 0)
        reject("mesh", m, "the first [[mesh]] is driven by the planet '", first->name,
               "'; begin with the central gear that drives the planets");
      add_input_gear(system_, first->name, first->design, first->bearing);
      system_.bodies.back().inertia = inertia_of(*first);
    }
    const size_t planets = carrier < 0 ? 1 : positions_[static_cast<size_t>(carrier)].size();
    for (size_t n = 0; n < planets; ++n) {
      const auto called = [&](const SceneGear& gear) {
        return carrier_of(gear.name) >= 0 ? gear.name + std::to_string(n + 1) : gear.name;
      };
      double direction = mesh.direction;
      if (c_second >= 0) direction = positions_[static_cast<size_t>(carrier)][n];
      if (c_first >= 0)
        direction = positions_[static_cast<size_t>(carrier)][n] + (second->design.internal ? 0 : kPi);
      take_one(m, *first, called(*first), *second, called(*second), direction);
    }
    if (carrier >= 0) check_neighbours(static_cast<size_t>(carrier));
  }

  // Sun, ring and carrier have one axis, so all meshes of a planet have one centre distance.
  void check_axis(size_t c) const {
    double other = 0;
    for (size_t m = 0; m < scene_.meshes.size(); ++m) {
      const auto& [gear, distance] =
          std::pair{scene_.meshes[m].spec.gear, scene_.meshes[m].spec.centre_distance};
      if (gear[0] != scene_.carriers[c].planet && gear[1] != scene_.carriers[c].planet) continue;
      if (other > 0 && !(std::abs(other - distance) < 1e-6 * distance))
        reject("mesh", m, "[[mesh]] of '", gear[0], "' and '", gear[1],
               "': centre_distance_mm = ", distance * 1e3, ", and ", other * 1e3,
               " in the other [[mesh]] of the planets of carrier '", scene_.carriers[c].name,
               "': central gears have one axis; give both meshes of a planet one centre distance");
      other = distance;
    }
  }

  void take_one(size_t m, const SceneGear& first, const std::string& on, const SceneGear& second,
                const std::string& to, double direction) {
    const double distance = scene_.meshes[m].spec.centre_distance;
    const int a = placed(on), b = placed(to);
    if (a < 0)
      reject("mesh", m, "[[mesh]] of '", first.name, "' and '", second.name, "': '", first.name,
             "' is driven by no mesh before it; name the gears in the order of the flow of power");
    if (b < 0) {
      add_driven_gear(system_, a, first.design, to, second.design, distance, direction, second.bearing);
      system_.bodies.back().inertia = inertia_of(second);
    } else {
      const auto &at = system_.bodies[static_cast<size_t>(a)].centre,
                 &other = system_.bodies[static_cast<size_t>(b)].centre;
      const double stands = std::hypot(other[0] - at[0], other[1] - at[1]);
      if (!(std::abs(stands - distance) < 1e-6 * distance))
        reject("mesh", m, "[[mesh]] of '", first.name, "' and '", second.name,
               "': centre_distance_mm = ", distance * 1e3, ", but by the other meshes their axes stand ",
               stands * 1e3, " mm apart; give both meshes of a planet one centre distance");
      const double miss = add_mesh(system_, a, first.design, b, second.design);
      if (!(std::abs(miss) < 1e-6))
        reject("mesh", m, "[[mesh]] of '", first.name, "' and '", second.name,
               "': cannot be assembled: the teeth of '", to, "' miss the spaces by ", miss, " of a pitch");
    }
    system_.meshes.back().stiffness = scene_.meshes[m].stiffness;
    section_.push_back(m);
  }

  static double inertia_of(const SceneGear& gear) {
    const double base = ToothGeometry(gear.design).base_radius();
    return gear.equivalent_mass > 0 ? gear.equivalent_mass * base * base : gear.total_inertia;
  }

  // Planets run into each other where their tip circles overlap.
  void check_neighbours(size_t c) {
    const Scene::Carrier& carrier = scene_.carriers[c];
    const std::vector<double>& at = positions_[c];
    double tip = 0;
    for (const SceneGear& gear : scene_.gears)
      if (gear.name == carrier.planet) tip = ToothGeometry(gear.design).tip_radius();
    const double radius = pin_radius(c);
    for (size_t n = 0; n < at.size() && at.size() > 1; ++n) {
      const double apart = n + 1 < at.size() ? at[n + 1] - at[n] : at[0] + 2 * kPi - at[n];
      const double room = 2 * radius * std::sin(std::min(apart, 2 * kPi - apart) / 2);
      if (room <= 2 * tip)
        reject("carrier", c, "planets ", n + 1, " and ", (n + 1) % at.size() + 1, " of carrier '",
               carrier.name, "' run into each other: their axes are ", millimetres(room),
               " apart, their tip diameter is ", millimetres(2 * tip), "; ",
               tip < radius
                   ? text("give positions more than ", shown_number(2 * std::asin(tip / radius) * kInDegrees),
                          " degrees apart, or take fewer planets")
                   : "take one planet");
    }
  }

  // m: from the axis of the carrier to those of the planets.
  double pin_radius(size_t c) const {
    const int planet = placed(scene_.carriers[c].planet + "1");
    for (const System::Mesh& mesh : system_.meshes)
      if (planet >= 0 && (mesh.side[0].body == planet || mesh.side[1].body == planet))
        return mesh.centre_distance;
    return 0;
  }

  void take_carriers() {
    for (size_t c = 0; c < scene_.carriers.size(); ++c) {
      const Scene::Carrier& carrier = scene_.carriers[c];
      const double radius = pin_radius(c);
      if (radius == 0)
        reject("carrier", c, "the planets '", carrier.planet, "' of carrier '", carrier.name,
               "' are in no [[mesh]]");
      System::Body body;
      body.name = carrier.name;
      body.kind = System::BodyKind::carrier;
      body.bearing = carrier.bearing;
      body.radius = radius;
      body.inertia =
          carrier.equivalent_mass > 0 ? carrier.equivalent_mass * radius * radius : carrier.inertia;
      const auto number = static_cast<int>(system_.bodies.size());
      for (size_t n = 0; n < positions_[c].size(); ++n) {
        System::Body& planet =
            system_.bodies[static_cast<size_t>(placed(carrier.planet + std::to_string(n + 1)))];
        planet.on = number;
        if (n > 0) continue;
        // It follows the central gear that drives the planets.
        for (const System::Mesh& mesh : system_.meshes)
          if (mesh.side[1].body == placed(planet.name))
            body.sense = system_.bodies[static_cast<size_t>(mesh.side[0].body)].sense;
        body.centre = {planet.centre[0] - radius * std::cos(positions_[c][0]),
                       planet.centre[1] - radius * std::sin(positions_[c][0])};
      }
      system_.bodies.push_back(body);
    }
    for (const SceneGear& gear : scene_.gears)
      if (placed(gear.name) < 0 && carrier_of(gear.name) < 0)
        reject("mesh", 0, "[gear.", gear.name,
               "] is in no [[mesh]]; take it out, or give its mesh: ", kOneShaft);
  }

  void take_pins() {
    for (size_t p = 0; p < scene_.pins.size(); ++p) {
      const Scene::Pin& pin = scene_.pins[p];
      std::string planets;
      for (const System::Body& body : system_.bodies)
        if (body.on != System::kGround) planets += (planets.empty() ? "" : ", ") + body.name;
      const int number = placed(pin.planet);
      if (number < 0 || system_.bodies[static_cast<size_t>(number)].on == System::kGround)
        reject("pin", p, "'planet' in [[pin]] = '", pin.planet, "' names no planet",
               planets.empty() ? "; the scene has none" : "; there are " + planets);
      for (size_t other = 0; other < p; ++other)
        if (scene_.pins[other].planet == pin.planet)
          reject("pin", p, "'", pin.planet, "' has a [[pin]] already; give each planet one");
      System::Body& planet = system_.bodies[static_cast<size_t>(number)];
      const System::Body& carrier = system_.bodies[static_cast<size_t>(planet.on)];
      const double x = (planet.centre[0] - carrier.centre[0]) / carrier.radius,
                   y = (planet.centre[1] - carrier.centre[1]) / carrier.radius;
      planet.offset = {x * pin.radial - y * pin.tangential, y * pin.radial + x * pin.tangential};
    }
  }

  void take_drives() {
    for (size_t d = 0; d < scene_.drives.size(); ++d) {
      const Scene::Drive& drive = scene_.drives[d];
      const int body = placed(drive.gear);
      if (body < 0 || system_.bodies[static_cast<size_t>(body)].on != System::kGround)
        reject("drive", d, "'gear' in [drive] = '", drive.gear,
               "' names no gear and no carrier that stands alone; planets have no drives");
      for (const System::Drive& other : system_.drives)
        if (other.body == body)
          reject("drive", d, "'", drive.gear, "' has a drive already; give each body one");
      system_.drives.push_back({body, drive.kind, drive.torque, drive.stiffness});
    }
  }

  // Where an axis may stand: on a circle, which a planet goes round whose carrier is free; of all others a point.
  struct Path {
    std::array<double, 2> centre;
    double radius;
  };
  Path path_of(const System::Body& body) const {
    if (body.on == System::kGround || system_.held(body.on)) return {body.centre, 0};
    const System::Body& carrier = system_.bodies[static_cast<size_t>(body.on)];
    return {carrier.centre, carrier.radius};
  }

  // Gears without a mesh with each other do not share a place: the middles of all faces stand in one plane. Planets of one carrier:
  // check_neighbours().
  void check_room() const {
    const std::vector<std::string> gears = gears_of(scene_, system_);
    std::vector<const GearDesign*> design(gears.size());
    for (size_t b = 0; b < gears.size(); ++b)
      for (const SceneGear& gear : scene_.gears)
        if (gear.name == gears[b]) design[b] = &gear.design;
    for (size_t b = 0; b < gears.size(); ++b)
      for (size_t a = 0; a < b; ++a)
        if (design[a] && design[b] && !meet(a, b) &&
            (system_.bodies[a].on == System::kGround || system_.bodies[a].on != system_.bodies[b].on))
          check_apart(a, *design[a], b, *design[b]);
  }

  bool meet(size_t a, size_t b) const {
    return std::any_of(system_.meshes.begin(), system_.meshes.end(), [&](const System::Mesh& mesh) {
      const auto first = static_cast<size_t>(mesh.side[0].body),
                 second = static_cast<size_t>(mesh.side[1].body);
      return (first == a && second == b) || (first == b && second == a);
    });
  }

  void check_apart(size_t a, const GearDesign& of_a, size_t b, const GearDesign& of_b) const {
    if (of_a.internal && of_b.internal) return;
    const size_t ring = of_a.internal ? a : b, gear = ring == a ? b : a;
    const GearDesign &around = ring == a ? of_a : of_b, &inside = ring == a ? of_b : of_a;
    const Path one = path_of(system_.bodies[a]), other = path_of(system_.bodies[b]);
    const double between = std::hypot(other.centre[0] - one.centre[0], other.centre[1] - one.centre[1]),
                 most = between + one.radius + other.radius,
                 least = std::max({between - one.radius - other.radius,
                                   std::abs(one.radius - other.radius) - between, 0.0}),
                 tips = ToothGeometry(around).tip_radius(), reach = ToothGeometry(inside).tip_radius();
    const bool internal = around.internal;
    const double room = internal ? tips - reach : tips + reach, beyond = around.rim_outer_radius + reach;
    if (internal ? most <= room || least >= beyond : least >= room) return;
    // The mesh that placed it.
    size_t m = 0;
    while (m + 1 < section_.size() && system_.meshes[m].side[1].body != static_cast<int>(b)) ++m;
    const std::string names = text("'", system_.bodies[ring].name, "' and '", system_.bodies[gear].name,
                                   "', which have no mesh, run into each other: their axes are ",
                                   millimetres(internal && most < beyond ? most : least), " apart"),
                      remedy = "; change direction_deg of a [[mesh]], positions of planets or teeth";
    if (internal)
      reject("mesh", section_[m], names, ", inside of the ring there is room up to ", millimetres(room),
             ", beyond its rim from ", millimetres(beyond), remedy);
    reject("mesh", section_[m], names, ", their tip circles reach ", millimetres(room), remedy);
  }

  const Scene& scene_;
  System system_;
  std::vector<size_t> section_;                 // [mesh] of the scene
  std::vector<std::vector<double>> positions_;  // [carrier] rad
};

}  // namespace

void require_joined(const std::vector<std::array<std::string, 2>>& meshes) {
  if (meshes.empty()) return;
  std::set<std::string> reached(meshes[0].begin(), meshes[0].end());
  for (size_t before = 0; before != reached.size();) {
    before = reached.size();
    for (const auto& [first, second] : meshes)
      if (reached.contains(first) || reached.contains(second)) reached.insert({first, second});
  }
  for (size_t m = 1; m < meshes.size(); ++m)
    if (!reached.contains(meshes[m][0]))
      reject("mesh", m, "no [[mesh]] joins '", meshes[m][0], "' and '", meshes[m][1], "' to '", meshes[0][0],
             "': ", kOneShaft);
}

System layout_of(const Scene& scene) {
  return Layout(scene).make();
}

std::vector<std::string> gears_of(const Scene& scene, const System& layout) {
  std::vector<std::string> out;
  for (const System::Body& body : layout.bodies) {
    out.emplace_back();
    if (body.kind == System::BodyKind::carrier) continue;
    for (const SceneGear& gear : scene.gears)
      if (gear.name == body.name) out.back() = gear.name;
    for (const Scene::Carrier& carrier : scene.carriers)
      if (body.on != System::kGround && layout.bodies[static_cast<size_t>(body.on)].name == carrier.name)
        out.back() = carrier.planet;
  }
  return out;
}

std::vector<int> sections_of(const std::vector<GearMeshSpec>& meshes, const std::vector<std::string>& gears,
                             const System& layout) {
  std::vector<int> out;
  for (const System::Mesh& mesh : layout.meshes) {
    out.push_back(-1);
    for (size_t m = 0; m < meshes.size(); ++m)
      if (meshes[m].gear[0] == gears[static_cast<size_t>(mesh.side[0].body)] &&
          meshes[m].gear[1] == gears[static_cast<size_t>(mesh.side[1].body)])
        out.back() = static_cast<int>(m);
    if (out.back() < 0)
      fail(Failure::input, "no [[mesh]] joins '", layout.bodies[static_cast<size_t>(mesh.side[0].body)].name,
           "' and '", layout.bodies[static_cast<size_t>(mesh.side[1].body)].name, "'");
  }
  return out;
}

bool is_ring(const System& system, int body) {
  for (const System::Mesh& mesh : system.meshes)
    for (size_t s = 0; s < 2; ++s) {
      const auto other = static_cast<size_t>(mesh.side[1 - s].body);
      if (mesh.side[s].body == body && mesh.side[0].sense == mesh.side[1].sense &&
          system.bodies[static_cast<size_t>(body)].teeth > system.bodies[other].teeth)
        return true;
    }
  return false;
}

int held_by_planets(const System& system, int carrier) {
  int held = -1;
  for (const System::Mesh& mesh : system.meshes)
    for (size_t s = 0; s < 2; ++s) {
      const int body = mesh.side[s].body, planet = mesh.side[1 - s].body;
      if (system.bodies[static_cast<size_t>(planet)].on == carrier && system.held(body) &&
          system.bodies[static_cast<size_t>(body)].on != carrier)
        held = body;
    }
  return held;
}

TrainSpeeds train_speeds(const System& system) {
  TrainSpeeds out;
  const auto of_gear = [](const System::Body& body) {
    return body.teeth > 0 ? static_cast<double>(body.sense) / body.teeth : 0;
  };
  double frame = 0;
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) {
    const System::Body& carrier = system.bodies[static_cast<size_t>(b)];
    if (carrier.kind != System::BodyKind::carrier) continue;
    const int still = system.held(b) ? b : held_by_planets(system, b);
    if (still < 0)
      fail(
          Failure::input, "how fast '", carrier.name,
          "' turns does not follow from the scene: neither it nor a gear that meshes with its planets is held; give one of them a [[drive]] with kind = \"held\"");
    const System::Body& at_rest = system.bodies[static_cast<size_t>(still)];
    const double turns = -of_gear(at_rest);
    if (!out.at_rest.empty() && turns != frame)
      fail(Failure::input, "how fast '", carrier.name, "' turns does not follow from the scene: with '",
           out.at_rest, "' and '", at_rest.name, "' at rest carriers would turn at two speeds");
    frame = turns;
    if (out.at_rest.find(at_rest.name) == std::string::npos)
      out.at_rest += (out.at_rest.empty() ? "" : ", ") + at_rest.name;
  }
  for (const System::Body& body : system.bodies)
    out.turns.push_back(of_gear(body) + (body.on == System::kGround ? frame : 0));
  return out;
}

double frame_turns(const System& system) {
  int carrier = System::kGround;
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b)
    if (system.bodies[static_cast<size_t>(b)].kind == System::BodyKind::carrier) {
      if (carrier != System::kGround) return 0;
      carrier = b;
    }
  if (carrier == System::kGround || system.held(carrier)) return 0;
  const System::Body& own = system.bodies[static_cast<size_t>(carrier)];
  int still = -1;
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) {
    const System::Body& body = system.bodies[static_cast<size_t>(b)];
    if (body.on != System::kGround) continue;
    if (std::hypot(body.centre[0] - own.centre[0], body.centre[1] - own.centre[1]) > 1e-6 * own.radius)
      return 0;
    if (!system.held(b)) continue;
    if (still >= 0) return 0;
    still = b;
  }
  if (still < 0 || held_by_planets(system, carrier) != still) return 0;
  const System::Body& at_rest = system.bodies[static_cast<size_t>(still)];
  return -static_cast<double>(at_rest.sense) / at_rest.teeth;
}

double ground_turns(const System& system, int b) {
  const System::Body& body = system.bodies[static_cast<size_t>(b)];
  return (body.teeth > 0 ? 1.0 / body.teeth : 0.0) + body.sense * frame_turns(system);
}

int input_of(const System& system) {
  const TrainSpeeds speeds = train_speeds(system);
  for (const System::Drive& drive : system.drives)
    if (drive.kind == System::DriveKind::torque && drive.torque > 0 &&
        speeds.turns[static_cast<size_t>(drive.body)] != 0)
      return drive.body;
  for (size_t b = 0; b < speeds.turns.size(); ++b)
    if (speeds.turns[b] != 0) return static_cast<int>(b);
  fail(Failure::input,
       "no body of the train turns, so it has no speed to change; give a drive its torque_Nm");
}

int output_of(const System& system) {
  int out = -1;
  double most = 0;
  for (int b = 0; b < static_cast<int>(system.bodies.size()); ++b) {
    if (system.bodies[static_cast<size_t>(b)].on != System::kGround || system.held(b)) continue;
    const double given = -system.torque(b) * ground_turns(system, b);
    if (given > most) most = given, out = b;
  }
  return out;
}

double working_radius(const System& system, int body) {
  const double radius = system.bodies[static_cast<size_t>(body)].radius;
  for (const System::Mesh& mesh : system.meshes)
    for (const System::Side& side : mesh.side)
      if (side.body == body) return radius / std::cos(mesh.pressure_angle);
  return radius;
}

}  // namespace whine
