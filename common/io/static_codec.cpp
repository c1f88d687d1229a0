#include "io/static_codec.h"

#include "base/error.h"
#include "io/codec.h"

namespace whine {
namespace {

using namespace ranges;

constexpr Schema kStaticSchema{"static", 5};

void describe_curves(Codec& c, StaticResult& a) {
  const char* const without = a.mesh.on_bearings() ? ", without the bearings" : "";
  c.dataset({"/mesh_phase", "1", "mesh phase; 0: reference pair at the pitch point, 1: one mesh period",
             "mesh_phase", kPhase},
            &a.mesh_phase);
  c.dataset({"/transmission_error", "m",
             "transmission error along the line of action, positive when the driver is ahead", "mesh_phase",
             kLength, "r1 theta1 + r2 theta2"},
            &a.transmission_error);
  c.dataset({"/unloaded_transmission_error", "m",
             "transmission error without load: of what flanks deviate by", "mesh_phase", kLength},
            &a.unloaded_error);
  c.dataset({"/mesh_stiffness_secant", "N m-1", text("secant mesh stiffness", without), "mesh_phase", kSpring,
             "(T / r1) / (transmission_error - unloaded_transmission_error)"},
            &a.stiffness_secant);
  c.dataset({"/mesh_stiffness_tangent", "N m-1",
             text("tangent mesh stiffness at fixed phase, contact changes included", without), "mesh_phase",
             kSpring, "d(T / r1) / d transmission_error"},
            &a.stiffness_tangent);
  c.dataset(
      {"/pair", "1", "number of the tooth pair: -1 following, 0 reference, +1 preceding", "pair", kPair},
      &a.pair);
  c.dataset({"/tooth_load", "N", "normal force of each tooth pair", "mesh_phase pair", kForce},
            &a.tooth_load);
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.lists() || a.mesh.bearing[g].elastic())
      c.dataset(
          {of_body(c, a.mesh, g, "bearing_force"), "N",
           "force of the gear on its bearing; x, y: the driven gear stands above the driver, which turns counter-clockwise",
           "mesh_phase xy", kForce},
          &a.bearing_force[g]);
  c.dataset(
      {"/contact_pressure", "Pa",
       "largest contact pressure of each pair inside its flanks; 0 where nothing touches (tooth_load is 0) and where a tip edge does (tooth_load is not), whose pressure is singular",
       "mesh_phase pair", kPressure},
      &a.contact_pressure);
  c.dataset({"/contact_half_width", "m",
             "half width of each contact inside the flanks, twice the standard deviation of its pressure",
             "mesh_phase pair", kSize},
            &a.contact_half_width);
}

void describe_root_stress(Codec& c, StaticResult& a) {
  const bool there = a.root_stress[0].size() > 0;
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    if (c.optional(of_body(c, a.mesh, g, "root_stress"), there))
      c.dataset(
          {of_body(c, a.mesh, g, "root_stress"), "Pa",
           "largest tangential stress along the root beside the loaded flank of each pair's tooth, tension positive",
           "mesh_phase pair", kStress,
           "sum over the pairs of root_stress/per_force of body.h5, and of root_stress/crack, times force"},
          &a.root_stress[g]);
  if (c.optional("/root_stress_max", there)) {
    c.dataset({"/root_stress_max", "Pa", "largest root stress over the mesh cycle, beside the loaded flanks",
               "gear", kStress},
              &a.root_stress_max);
    c.dataset({"/root_stress_angle", "1",
               "angle (rad) of the root's tangent there against the centre line of the tooth", "gear", kRoll},
              &a.root_stress_angle);
    c.dataset({"/root_stress_phase", "1", "mesh phase of the tooth's pair then, 0 at the pitch point", "gear",
               kPlace},
              &a.root_stress_phase);
    if (c.optional("/root_stress_tooth", a.root_stress_tooth.size() > 0))
      c.dataset({"/root_stress_tooth", "1",
                 "number of that tooth, counter-clockwise from tooth 0, where teeth differ or one is cracked",
                 "gear", kTooth},
                &a.root_stress_tooth);
  }
  c.dataset({"/loss_factor", "1",
             "mean power lost by sliding over the power carried, per unit coefficient of friction", "",
             kPositive, "H_V = mean of sum F |sliding per angle| / T"},
            &a.loss_factor);
}

constexpr Range kLost{0, 1e7};  // N m

// Left out of flanks without friction.
void describe_static_friction(Codec& c, StaticResult& a) {
  if (!c.lists() && !a.mesh.friction.acts()) return;
  c.dataset({"/friction_coefficient", "1", "coefficient of friction", "", kShare}, &a.friction_coefficient);
  c.dataset({"/certificate/friction_coupling", "m",
             "largest change of a gap by what friction of the last forces moves, over all positions", "",
             kSize, "iteration for d = (A + E) p + e, E of friction: E times the last change of p"},
            &a.friction_coupling);
  c.dataset({"/friction_loss", "N m", "work that friction takes per angle (rad) of the driver", "mesh_phase",
             kLost, "sum of mu s F (t1 - t2 z1 / z2)"},
            &a.friction_loss);
  for (int g = 0; g < (c.lists() ? 1 : 2); ++g)
    c.dataset(
        {of_body(c, a.mesh, g, "friction_moment"), "N m",
         "moment of friction about the axis of the gear, positive where it has the sense of the moment of the normal force, which brakes the driver and drives the driven gear",
         "mesh_phase", kMoment, "sum of mu s F t"},
        &a.friction_moment[g]);
  c.dataset({"/efficiency",
             "1",
             "of the mesh at rest: work given by the driven gear over that put into the driver",
             "",
             {0, 1},
             "1 - mean friction_loss / torque"},
            &a.efficiency);
}

}  // namespace

void describe(Codec& c, StaticResult& a) {
  describe_pair(c, a);
  describe_torque(c, a.torque);
  c.dataset({"/contact_ratio", "1", "profile contact ratio of the unloaded gears", "", {0, 100, true}},
            &a.contact_ratio);
  describe_curves(c, a);
  describe_root_stress(c, a);
  describe_static_friction(c, a);
  c.dataset({"/transmission_error_harmonic", "m",
             "mean, then amplitudes of the harmonics of the mesh frequency", "harmonic", kLength},
            &a.transmission_error_harmonic);
  c.dataset({"/mesh_stiffness_harmonic", "N m-1",
             "mean, then amplitudes of the harmonics of the secant stiffness", "harmonic", kSpring},
            &a.stiffness_harmonic);
  c.numbers("harmonic", 0, "number of the harmonic of the mesh frequency; 0: the mean");
  describe_hunting(c, a.hunting_periods);
  if (c.lists() || (c.in() ? a.hunting_periods > 1 : a.transmission_error_order.size() > 0)) {
    c.dataset({"/transmission_error_order", "m",
               "mean, then amplitudes of the harmonics of the hunting frequency", "order", kLength},
              &a.transmission_error_order);
    c.numbers("order", 0, "number of the harmonic of the hunting frequency; 0: the mean");
  }
  c.dataset({"/mean_stiffness", "N m-1", "mean of the secant stiffness over a mesh period", "", kStiff},
            &a.mean_stiffness);
  c.dataset({"/certificate/least_gap", "m", "least gap of a strip without force, over all positions", "",
             kLength, "d >= 0 where p = 0 (with Eq. 18, 20)"},
            &a.least_gap);
  c.dataset({"/certificate/least_force", "N", "least force of a strip in contact, over all positions", "",
             kForce, "p >= 0 where d = 0 (with Eq. 18, 20)"},
            &a.least_force);
  c.dataset(
      {"/certificate/torque_residual", "1", "largest relative residual of the torque, over all positions", "",
       kPositive, "|sum a p - T| / T"},
      &a.torque_residual);
  describe_backlash(c, a.backlash_margin);
}

void write(const std::string& path, const StaticResult& a, const Provenance& provenance) {
  write_artifact(path, kStaticSchema, "Static transmission error: " + pair_title(a.mesh, a.torque), a,
                 provenance);
}

StaticResult read_static(const std::string& path) {
  return read_artifact<StaticResult>(path, kStaticSchema);
}

}  // namespace whine
