#include "model/response_quantities.h"

#include <algorithm>

namespace whine {

namespace {

std::string speed_words(Direction direction) {
  return direction == Direction::up ? ", speed rising" : ", speed falling";
}

std::vector<ResponseQuantity> quantities_of_pair(const std::vector<Direction>& directions) {
  std::vector<ResponseQuantity> kinds{
      {"contact_ratio", "1", "contact ratio of the unloaded pair"},
      {"overlap_ratio", "1", "overlap ratio, 0 of spur gears"},
      {"mean_stiffness", "N m-1", "mean of the secant mesh stiffness"},
      {"te_mean", "m", "mean of the static transmission error"},
      {"te_peak_to_peak", "m", "static transmission error, peak to peak, over the whole hunting period"},
      {"te_peak_to_peak_mesh", "m", "the same within one mesh period, largest of the hunting period"},
      {"te_harmonic_1", "m", "amplitude of harmonic 1 of the static transmission error"},
      {"te_harmonic_2", "m", "amplitude of harmonic 2 of the static transmission error"},
      {"te_harmonic_3", "m", "amplitude of harmonic 3 of the static transmission error"},
      {"tooth_load_static", "N", "largest tooth load at rest"}};
  if (!directions.empty()) {
    kinds.push_back(
        {"natural_frequency", "Hz", "mean over the period, contact frozen under the static load"});
    kinds.push_back({"rayleigh_damping_ratio", "1", "damping ratio of Eq. 21 at the natural frequency"});
  }
  for (const Direction direction : directions) {
    const std::string d = name_of(direction), sweep = speed_words(direction);
    kinds.push_back({"rms_max_" + d, "m", "largest RMS of the dynamic transmission error" + sweep});
    kinds.push_back({"rms_max_speed_" + d, "Hz", "mesh frequency at which it is largest" + sweep});
    kinds.push_back({"tooth_load_max_" + d, "N", "largest tooth load of all speeds" + sweep});
    kinds.push_back({"separation_max_" + d, "1", "largest share of a period without contact" + sweep});
    kinds.push_back({"loss_from_" + d, "Hz", "least speed that loses contact, 0: none does" + sweep});
    kinds.push_back({"loss_to_" + d, "Hz", "largest speed that loses contact, 0: none does" + sweep});
    kinds.push_back({"jumps_" + d, "1", "number of jumps" + sweep});
    kinds.push_back({"jump_frequency_" + d, "Hz", "jump of the highest frequency, 0: there is none" + sweep});
    kinds.push_back({"unsteady_" + d, "1", "speeds at which no periodic motion was found" + sweep});
  }
  return kinds;
}

// For each name one of these: "te_mean.sun-planet1".
void add_each(const std::vector<std::string>& names, const std::vector<ResponseQuantity>& kinds,
              std::vector<ResponseQuantity>& out) {
  for (const ResponseQuantity& kind : kinds)
    for (const std::string& name : names)
      out.push_back({kind.name + "." + name, kind.units, kind.meaning + ", of " + name});
}

std::vector<ResponseQuantity> quantities_of_train(const std::vector<Direction>& directions,
                                                  const TrainNames& train) {
  std::vector<ResponseQuantity> out;
  add_each(
      train.shared,
      {{"load_sharing_factor", "1", "K_gamma: largest of the mean mesh forces over the mean of all planets"},
       {"load_sharing_peak", "1", "largest momentary mesh force over the mean of all planets then"}},
      out);
  add_each(
      train.meshes,
      {{"mean_stiffness", "N m-1", "mean of the mesh stiffness, contact frozen"},
       {"te_mean", "m", "mean of the static transmission error"},
       {"te_peak_to_peak", "m", "static transmission error, peak to peak, over the whole hunting period"},
       {"te_harmonic_1", "m", "amplitude of harmonic 1 of the static transmission error"},
       {"te_harmonic_2", "m", "amplitude of harmonic 2 of the static transmission error"},
       {"te_harmonic_3", "m", "amplitude of harmonic 3 of the static transmission error"},
       {"load_share_mean", "1", "mean mesh force over the sum of those of its [[mesh]]"},
       {"mesh_force_static", "N", "largest mesh force at rest"},
       {"tooth_load_static", "N", "largest tooth load at rest"}},
      out);
  add_each(train.bodies, {{"bearing_force_static", "N", "largest force on bearing or pin at rest"}}, out);
  for (const Direction direction : directions) {
    const std::string d = name_of(direction), sweep = speed_words(direction);
    out.push_back({"jumps_" + d, "1", "number of jumps" + sweep});
    out.push_back({"jump_frequency_" + d, "Hz", "jump of the highest frequency, 0: there is none" + sweep});
    out.push_back({"unsteady_" + d, "1", "speeds at which no periodic motion was found" + sweep});
    add_each(train.shared,
             {{"load_share_max_" + d, "1",
               "largest momentary share of a planet in the mesh force, over all speeds" + sweep}},
             out);
    add_each(train.meshes,
             {{"rms_max_" + d, "m", "largest RMS of the dynamic transmission error" + sweep},
              {"rms_max_speed_" + d, "Hz", "mesh frequency at which it is largest" + sweep},
              {"tooth_load_max_" + d, "N", "largest tooth load of all speeds" + sweep},
              {"separation_max_" + d, "1", "largest share of a period without contact" + sweep},
              {"loss_from_" + d, "Hz", "least speed that loses contact, 0: none does" + sweep},
              {"loss_to_" + d, "Hz", "largest speed that loses contact, 0: none does" + sweep}},
             out);
    add_each(train.bodies,
             {{"bearing_force_max_" + d, "N", "largest force on bearing or pin of all speeds" + sweep},
              {"bearing_force_rms_max_" + d, "N",
               "largest RMS of what of that force oscillates, of all speeds" + sweep}},
             out);
  }
  return out;
}

}  // namespace

TrainNames train_names(const SystemStaticParameters& train) {
  TrainNames out;
  for (size_t m = 0; m < train.layout.meshes.size(); ++m) out.meshes.push_back(mesh_name(train.layout, m));
  for (const System::Body& body : train.layout.bodies) out.bodies.push_back(body.name);
  for (size_t s = 0; s < train.mesh.size(); ++s)
    if (std::count(train.section.begin(), train.section.end(), static_cast<int>(s)) > 1)
      out.shared.push_back(train.mesh[s].gear[0] + "-" + train.mesh[s].gear[1]);
  return out;
}

std::vector<ResponseQuantity> response_quantities(const std::vector<Direction>& directions,
                                                  const TrainNames& train) {
  return train.empty() ? quantities_of_pair(directions) : quantities_of_train(directions, train);
}

bool of_motion(const std::string& quantity) {
  const std::string base = quantity.substr(0, quantity.find('.'));
  return base.ends_with("_up") || base.ends_with("_down");
}

}  // namespace whine
