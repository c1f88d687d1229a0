#include "io/layout_codec.h"

#include <algorithm>
#include <optional>
#include <type_traits>

#include "base/error.h"
#include "io/codec.h"
#include "io/keys.h"

namespace whine {
namespace {

using namespace ranges;

// Key number k of each item as one dataset. The first of a list says how many items there are.
template <class Column, class Item>
void describe_column(Codec& c, const Dataset& d, std::vector<Item>& items, size_t k) {
  using Number = typename Column::value_type;
  Column values(items.size());
  for (size_t i = 0; i < items.size(); ++i) values[i] = std::get<Number>(keys(items[i])[k].value());
  c.dataset(d, &values);
  if (!c.in()) return;
  items.resize(static_cast<size_t>(values.size()));
  for (size_t i = 0; i < items.size(); ++i)
    std::visit(Overloaded{[&](Number* held) { *held = values[i]; },
                          [&](const ChoiceSlot& choice) {
                            if constexpr (std::is_same_v<Number, int>) choice.assign(choice.value, values[i]);
                          },
                          [](const auto&) {}},
               keys(items[i])[k].slot);
}

// Datasets /<list>/<key> of these keys of the items.
template <class Item>
void describe_columns(Codec& c, const LayoutPlace& place, const std::string& list, std::vector<Item>& items,
                      std::initializer_list<const char*> names) {
  Item any;
  const KeyList all = keys(any);
  for (const char* name : names)
    for (size_t k = 0; k < all.size(); ++k) {
      const Key& key = all[k];
      if (!key.called(name)) continue;
      const std::string own = key.called("bearing_mass") ? "mass" : name;
      const Dataset d{place.group + "/" + list + "/" + own, key.unit.si, key.meaning, list + place.axis_end,
                      Range{key.limits.least, key.limits.most}};
      std::visit(Overloaded{[&](int) { describe_column<Eigen::VectorXi>(c, d, items, k); },
                            [&](double) { describe_column<Eigen::VectorXd>(c, d, items, k); },
                            [&](const auto&) { describe_column<std::vector<std::string>>(c, d, items, k); }},
                 key.value());
    }
}

// Two numbers of each item, by references that `member` gives.
template <class Matrix, class Item, class Member>
void describe_two(Codec& c, const Dataset& d, std::vector<Item>& items, const Member& member) {
  Matrix values(static_cast<Eigen::Index>(items.size()), 2);
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (const size_t k : {0, 1}) values(i, k) = member(items[static_cast<size_t>(i)], k);
  c.dataset(d, &values);
  if (!c.in()) return;
  items.resize(static_cast<size_t>(values.rows()));
  for (Eigen::Index i = 0; i < values.rows(); ++i)
    for (const size_t k : {0, 1}) member(items[static_cast<size_t>(i)], k) = values(i, k);
}

// Of drives what they hold.
void describe_holds(Codec& c, const LayoutPlace& place, System& s) {
  const std::string body = place.group + "/body/", axis = "body" + place.axis_end;
  Eigen::VectorXi held = Eigen::VectorXi::Zero(static_cast<Eigen::Index>(s.bodies.size()));
  Eigen::VectorXd stiffness = Eigen::VectorXd::Zero(held.size());
  for (const System::Drive& drive : s.drives)
    if (drive.kind == System::DriveKind::held) {
      held[drive.body] = 1;
      stiffness[drive.body] = drive.stiffness;
    }
  c(held, body + "held", "1", kFlag, axis, "1: a drive holds the rotation");
  c(stiffness, body + "hold_stiffness", "N m-1", kStiff, axis,
    "stiffness of what holds it, at the radius; 0: rigid");
  for (int b = 0; c.in() && b < held.size(); ++b)
    if (held[b]) s.drives.push_back({b, System::DriveKind::held, 0, stiffness[b]});
}

}  // namespace

void describe_layout(Codec& c, System& s, const LayoutPlace& place) {
  if (c.in()) s = {};
  const bool one_torque = c.optional("/parameters/operation/torque", s.load == System::Load::torque);
  const std::string body = "body" + place.axis_end, mesh = "mesh" + place.axis_end;
  if (c.in()) {
    s.load = one_torque ? System::Load::torque : System::Load::drives;
    if (one_torque) {
      c.axis(body, kSides);
      c.axis(mesh, 1);
    }
  }
  describe_columns(c, place, "body", s.bodies, {"name", "is_carrier", "teeth", "sense", "stands_on"});
  describe_two<MatrixRM>(c, {place.group + "/body/centre", "m", "place of the axis", body + " xy", kPlace},
                         s.bodies, [](System::Body& body, size_t k) -> double& { return body.centre[k]; });
  const bool off = std::any_of(s.bodies.begin(), s.bodies.end(), [](const System::Body& own) {
    return own.offset != std::array{0.0, 0.0};
  });
  if (c.optional(place.group + "/body/offset", off))
    describe_two<MatrixRM>(c,
                           {place.group + "/body/offset",
                            "m",
                            "position error of the axis, left out where there are none",
                            body + " xy",
                            {-1e-3, 1e-3}},
                           s.bodies, [](System::Body& own, size_t k) -> double& { return own.offset[k]; });
  describe_columns(c, place, "body", s.bodies,
                   {"angle", "radius", "inertia", "bearing_mass", "bearing_stiffness", "bearing_damping"});
  describe_holds(c, place, s);
  describe_two<MatrixRMi>(c,
                          {place.group + "/mesh/body_number",
                           "1",
                           "numbers of the driving and the driven body",
                           mesh + " gear",
                           {0, 10000}},
                          s.meshes, [](System::Mesh& mesh, size_t k) -> int& { return mesh.side[k].body; });
  describe_columns(c, place, "mesh", s.meshes,
                   {"ring_drives", "centre_distance", "direction", "phase", "pressure_angle", "stiffness"});
  if (!c.in()) return;
  if (const auto fault = layout_fault(s))
    c.in()->reject(text("dataset ", place.group, "/", fault->list, "/", fault->key, " holds ", fault->value,
                        " of ", fault->list, " ", fault->number, fault->allowed));
  for (System::Mesh& mesh : s.meshes)
    for (System::Side& own : mesh.side) own.sense = s.bodies[static_cast<size_t>(own.body)].sense;
}

void describe_sections(Codec& c, std::vector<int>& section, const LayoutPlace& place) {
  constexpr Range kSection{0, 10000};
  Eigen::VectorXi numbers =
      Eigen::Map<const Eigen::VectorXi>(section.data(), static_cast<Eigen::Index>(section.size()));
  c(numbers, place.group + "/mesh/section", "1", kSection, "mesh" + place.axis_end,
    "number of the [[mesh]] of the scene");
  if (c.in()) section.assign(numbers.begin(), numbers.end());
}

void describe_errors(Codec& c, System& s, std::vector<ToothErrors>& of_body, const LayoutPlace& place) {
  of_body.resize(s.bodies.size());
  bool differ = false;
  for (size_t b = 0; !c.lists() && b < s.bodies.size(); ++b) {
    const std::string section = "error_" + s.bodies[b].name;
    if (!c.optional("/parameters/" + section + "/iso_class", !of_body[b].none())) continue;
    differ = true;
    c.parameters(section, keys(of_body[b]));
  }
  if (!differ && !c.lists()) return;
  describe_two<MatrixRMi>(
      c,
      {place.group + "/mesh/first_tooth",
       "1",
       "where teeth differ: tooth of each side in the reference pair of mesh period 0, counter-clockwise; in mesh period k pair p is that of first_tooth + sense (p - k)",
       "mesh" + place.axis_end + " side",
       {-(1 << 20), 1 << 20}},
      s.meshes, [](System::Mesh& mesh, size_t k) -> int& { return mesh.side[k].first_tooth; });
}

}  // namespace whine
