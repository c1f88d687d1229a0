#include "model/response_quantities.h"

namespace whine {

std::vector<ResponseQuantity> response_quantities(const std::vector<Direction>& directions) {
  std::vector<ResponseQuantity> kinds{
      {"contact_ratio", "1", "contact ratio of the unloaded pair"},
      {"mean_stiffness", "N m-1", "mean of the secant mesh stiffness"},
      {"te_mean", "m", "mean of the static transmission error"},
      {"te_peak_to_peak", "m", "static transmission error, peak to peak, over the whole hunting period"},
      {"te_peak_to_peak_mesh", "m", "the same within one mesh period, largest of the hunting period"},
      {"te_harmonic_1", "m", "amplitude of harmonic 1 of the static transmission error"},
      {"te_harmonic_2", "m", "amplitude of harmonic 2 of the static transmission error"},
      {"te_harmonic_3", "m", "amplitude of harmonic 3 of the static transmission error"},
      {"tooth_load_static", "N", "largest tooth load at rest"}};
  if (!directions.empty())
    kinds.push_back(
        {"natural_frequency", "Hz", "mean over the period, contact frozen under the static load"});
  for (const Direction direction : directions) {
    const std::string d = name_of(direction),
                      sweep = direction == Direction::up ? ", speed rising" : ", speed falling";
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

}  // namespace whine
