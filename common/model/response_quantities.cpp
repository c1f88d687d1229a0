#include "model/response_quantities.h"

#include <algorithm>
#include <span>

namespace whine {

namespace {

// What a quantity is of, and who has it: all gears together or each mesh, of pairs and trains; the rest of one of them alone.
enum class Of { all, mesh, pair, train_mesh, shared, body };
struct QuantityRow {
  Of of;
  const char *name, *units, *meaning;
};
constexpr QuantityRow kAtRest[] = {
    {Of::pair, "contact_ratio", "1", "contact ratio of the unloaded pair"},
    {Of::pair, "overlap_ratio", "1", "overlap ratio, 0 of spur gears"},
    {Of::shared, "load_sharing_factor", "1",
     "K_gamma: largest of the mean mesh forces over the mean of all planets"},
    {Of::shared, "load_sharing_peak", "1", "largest momentary mesh force over the mean of all planets then"},
    {Of::mesh, "mean_stiffness", "N m-1", "mean of the secant mesh stiffness"},
    {Of::mesh, "te_mean", "m", "mean of the static transmission error"},
    {Of::mesh, "te_peak_to_peak", "m",
     "static transmission error, peak to peak, over the whole hunting period"},
    {Of::pair, "te_peak_to_peak_mesh", "m", "the same within one mesh period, largest of the hunting period"},
    {Of::mesh, "te_harmonic_1", "m", "amplitude of harmonic 1 of the static transmission error"},
    {Of::mesh, "te_harmonic_2", "m", "amplitude of harmonic 2 of the static transmission error"},
    {Of::mesh, "te_harmonic_3", "m", "amplitude of harmonic 3 of the static transmission error"},
    {Of::train_mesh, "load_share_mean", "1", "mean mesh force over the sum of those of its [[mesh]]"},
    {Of::train_mesh, "mesh_force_static", "N", "largest mesh force at rest"},
    {Of::mesh, "tooth_load_static", "N", "largest tooth load at rest"},
    {Of::body, "bearing_force_static", "N", "largest force on bearing or pin at rest"}};
constexpr QuantityRow kMoving[] = {
    {Of::pair, "natural_frequency", "Hz", "mean over the period, contact frozen under the static load"},
    {Of::pair, "rayleigh_damping_ratio", "1", "damping ratio of Eq. 21 at the natural frequency"}};
constexpr QuantityRow kSwept[] = {
    {Of::shared, "load_share_max_", "1",
     "largest momentary share of a planet in the mesh force, over all speeds"},
    {Of::mesh, "rms_max_", "m", "largest RMS of the dynamic transmission error"},
    {Of::mesh, "rms_max_speed_", "Hz", "mesh frequency at which it is largest"},
    {Of::mesh, "tooth_load_max_", "N", "largest tooth load of all speeds"},
    {Of::mesh, "separation_max_", "1", "largest share of a period without contact"},
    {Of::mesh, "loss_from_", "Hz", "least speed that loses contact, 0: none does"},
    {Of::mesh, "loss_to_", "Hz", "largest speed that loses contact, 0: none does"},
    {Of::all, "jumps_", "1", "number of jumps"},
    {Of::all, "jump_frequency_", "Hz", "jump of the highest frequency, 0: there is none"},
    {Of::all, "unsteady_", "1", "speeds at which no periodic motion was found"},
    {Of::body, "bearing_force_max_", "N", "largest force on bearing or pin of all speeds"},
    {Of::body, "bearing_force_rms_max_", "N", "largest RMS of what of that force oscillates, of all speeds"}};

// end, words: of a direction.
void add_rows(std::span<const QuantityRow> rows, const TrainNames& train, const std::string& end,
              const std::string& words, std::vector<ResponseQuantity>& out) {
  const bool pair = train.empty();
  for (const QuantityRow& row : rows) {
    const ResponseQuantity kind{row.name + end, row.units, row.meaning + words};
    if (row.of == Of::all || (pair && (row.of == Of::mesh || row.of == Of::pair))) out.push_back(kind);
    if (pair || row.of == Of::all || row.of == Of::pair) continue;
    for (const std::string& name : row.of == Of::shared ? train.shared
                                   : row.of == Of::body ? train.bodies
                                                        : train.meshes)
      out.push_back({kind.name + "." + name, kind.units, kind.meaning + ", of " + name});
  }
}

}  // namespace

TrainNames train_names(const SystemStaticParameters& train) {
  TrainNames out;
  out.meshes = mesh_names_of(train.layout);
  out.bodies = body_names_of(train.layout);
  for (size_t s = 0; s < train.mesh.size(); ++s)
    if (std::count(train.section.begin(), train.section.end(), static_cast<int>(s)) > 1)
      out.shared.push_back(train.mesh[s].gear[0] + "-" + train.mesh[s].gear[1]);
  return out;
}

std::vector<ResponseQuantity> response_quantities(const std::vector<Direction>& directions,
                                                  const TrainNames& train) {
  std::vector<ResponseQuantity> out;
  add_rows(kAtRest, train, "", "", out);
  if (!directions.empty()) add_rows(kMoving, train, "", "", out);
  for (const Direction direction : directions)
    add_rows(kSwept, train, name_of(direction),
             direction == Direction::up ? ", speed rising" : ", speed falling", out);
  return out;
}

bool of_motion(const std::string& quantity) {
  const std::string base = quantity.substr(0, quantity.find('.'));
  return base.ends_with("_up") || base.ends_with("_down");
}

}  // namespace whine
