#include "io/summary.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "gear/friction.h"
#include "io/artifact_kinds.h"
#include "io/artifacts.h"
#include "io/study.h"
#include "io/summary_lines.h"
#include "signal/jump_words.h"
#include "signal/no_root_stress.h"
#include "signal/rms.h"

namespace whine {
namespace {

std::string contact_plane(const GearMeshSpec& mesh) {
  return mesh.contact_plane == ContactPlane::body ? "plane state of the bodies"
                                                  : text("plane ", mesh.contact_plane);
}

std::string corner_rule(const GearMeshSpec& mesh) {
  if (!mesh.corner.enabled) return "pairs on the line of action only";
  if (std::isinf(mesh.corner.largest_angle)) return "tip edges touch wherever they reach";
  return text("tip edges touch up to ", mesh.corner.largest_angle * 180 / std::numbers::pi,
              " deg between the normals");
}

// Nothing for flanks as they are designed.
void show_modification(SummaryLines& lines, const GearMeshSpec& mesh) {
  for (int g = 0; g < kSides; ++g)
    if (mesh.modification[g] != FlankModification{})
      add(lines, text(kGearName[g], "'s flanks"), in_words(mesh.modification[g]));
}

// Nothing for gears on rigid axes.
void show_bearings(SummaryLines& lines, const GearMeshSpec& mesh) {
  for (int g = 0; g < kSides; ++g)
    if (const Bearing& b = mesh.bearing[g]; b.elastic())
      add(lines, text("bearing of ", mesh.gear[g]), b.stiffness * 1e-6, " N/µm, ", b.damping, " N s/m, ",
          b.mass > 0 ? text(b.mass, " kg") : "mass as drawn");
}

// Nothing for teeth that are all alike.
void show_friction(SummaryLines& lines, const GearMeshSpec& mesh) {
  if (!mesh.friction.acts()) return;
  add(lines, "friction", in_words(mesh.friction),
      "; it bends no teeth here, which may change transmission errors as much as it does (common/system)");
}

void show_errors(SummaryLines& lines, const GearMeshSpec& mesh) {
  for (int g = 0; g < kSides; ++g)
    if (!mesh.errors[g].none()) add(lines, text(kGearName[g], "'s teeth"), words_of(mesh.errors[g]));
}

void show_gear(SummaryLines& lines, const GearDesign& gear, const BodyDiscretisation& body) {
  add(lines, "gear", gear.teeth, " teeth, module ", gear.module * 1e3, " mm, face width ",
      gear.face_width * 1e3, " mm, ", gear.internal ? "internal, rim held at " : "bore radius ",
      gear.clamped_radius() * 1e3, gear.internal ? " mm radius" : " mm");
  if (gear.crack.depth > 0)
    add(lines, "crack", "tooth ", gear.crack.tooth, ", a slit of ", gear.crack.depth * 1e3, " mm");
  add(lines, "elements", "order ", body.element_order, ", ", body.element_size * 1e3, " mm on the flank");
}

std::string near_field(const BodyDiscretisation& body) {
  return body.near_field == NearField::matching
             ? text("matching at ", body.matching_depth * 1e3, " mm below the flank")
             : name_of(body.near_field);
}

void show_discretisation(SummaryLines& lines, const GearPairParameters& a) {
  const auto elements = [](const BodyDiscretisation& b) {
    return text("order ", b.element_order, ", ", b.element_size * 1e3, " mm on the flank");
  };
  const auto both = [&](const char* name, const std::string& first, const std::string& second) {
    add(lines, name, first, first == second ? "" : "; driven gear: " + second);
  };
  const BodyDiscretisation &driver = a.gear[0].discretisation, &driven = a.gear[1].discretisation;
  both("elements", elements(driver), elements(driven));
  both("near field", near_field(driver), near_field(driven));
}

void show_damping(SummaryLines& lines, const Damping& damping) {
  add(lines, "damping", "eta ", damping.rayleigh_stiffness * 1e6, " µs, bearing ratio ",
      damping.bearing_ratio * 100, " %");
}

void show(SummaryLines& lines, const SectorGrid& a) {
  show_gear(lines, a.design, a.discretisation);
  add(lines, "sector", a.node_position.rows(), " nodes, ", a.element_node.rows(), " elements of ",
      a.element_node.cols(), " nodes");
  add(lines, "flank", a.flank_node.size(), " nodes on the driving flank");
}

void show(SummaryLines& lines, const ReducedBody& a) {
  show_gear(lines, a.design, a.discretisation);
  add(lines, "inertia of the body", a.inertia, " kg m2, mass ", a.mass, " kg");
  std::string modes;
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(a.eigenfrequency.size(), 8); ++i) {
    modes += text(i ? ", " : "", std::round(a.eigenfrequency[i]), " (", a.nodal_diameter[i], ")");
  }
  add(lines, "modes", a.eigenfrequency.size(), "; Hz (nodal diameters): ", modes,
      a.eigenfrequency.size() > 8 ? ", ..." : "");
  add(lines, "near field", near_field(a.discretisation));
  add(lines, "flank table", a.flank_position.size(), " points, tooth offsets 0 to ", a.offsets);
  if (const WidthTables& width = a.width; width.degree > 0)
    add(lines, "face width", "polynomials of degree ", width.degree, " over ", width.face_width * 1e3,
        " mm, section of elements of ", a.discretisation.width.section_size * 1e3, " mm, tooth offsets 0 to ",
        static_cast<int>(width.flexibility.size()) - 1);
  add(lines, "asymmetry", a.asymmetry,
      " relative, made symmetric; flexibility that the modes leave out, least ", a.least_eigenvalue * 1e6,
      " µm/N (round-off of the log of the contact below 0)");
}

}  // namespace

void show(SummaryLines& lines, const StaticResult& a) {
  add(lines, "operating point", a.torque, " N m on ", a.mesh.gear[0], ", centre distance ",
      a.mesh.centre_distance * 1e3, " mm");
  add(lines, "corner contact", corner_rule(a.mesh));
  add(lines, "state of the contact", contact_plane(a.mesh));
  show_modification(lines, a.mesh);
  show_friction(lines, a.mesh);
  show_errors(lines, a.mesh);
  show_bearings(lines, a.mesh);
  show_discretisation(lines, a);
  add(lines, "contact", a.fidelity.contact,
      a.fidelity.contact == ContactModel::strips
          ? text(", ", a.contact.strips, " across the contact width at the mean load")
          : "");
  add(lines, "contact ratio", a.contact_ratio);
  add(lines, "mean stiffness", a.mean_stiffness * 1e-6, " N/µm (secant)");
  if (a.transmission_error.size() > 0) {
    const auto& te = a.transmission_error;
    add(lines, "transmission error", te.mean() * 1e6, " µm mean, ", (te.maxCoeff() - te.minCoeff()) * 1e6,
        " µm peak to peak");
    add(lines, "largest tooth load", a.tooth_load.size() ? a.tooth_load.maxCoeff() : 0.0, " N");
  }
  if (a.hunting_periods > 1)
    add(lines, "hunting period", a.hunting_periods, " mesh periods, after which the same teeth meet");
  if (a.contact_pressure.size() > 0) {
    Eigen::Index i = 0, j = 0;
    const double peak = a.contact_pressure.maxCoeff(&i, &j);
    add(lines, "peak pressure", peak * 1e-6, " MPa inside a flank, half-width there ",
        a.contact_half_width(i, j) * 1e3, " mm, at mesh phase ", a.mesh_phase[i]);
  }
  for (int g = 0; g < a.root_stress_max.size(); ++g)
    add(lines, "root stress of " + a.mesh.gear[g], a.root_stress_max[g] * 1e-6, " MPa at a tangent of ",
        a.root_stress_angle[g] * 180 / std::numbers::pi, " deg, phase of its pair ", a.root_stress_phase[g],
        a.root_stress_tooth.size() > 0 ? text(", tooth ", a.root_stress_tooth[g]) : "");
  if (const std::string why = why_no_root_stress(a); !why.empty()) add(lines, "root stress", why);
  add(lines, "loss factor", a.loss_factor,
      a.friction_loss.size() > 0 ? text("; efficiency ", a.efficiency * 100,
                                        " % at a coefficient of friction of ", a.friction_coefficient)
                                 : "");
  add(lines, "certificate", a.mesh_phase.size(), " positions; least gap ", a.least_gap * 1e6,
      " µm, least force ", a.least_force, " N, torque residual ", a.torque_residual);
  if (!std::isinf(a.backlash_margin)) add(lines, "least backlash", a.backlash_margin * 1e6, " µm");
}

namespace {

void show(SummaryLines& lines, const LoadedResult& a) {
  add(lines, "operating point", a.torque, " N m on ", a.mesh.gear[0], ", mesh phase ", a.mesh_phase);
  show_modification(lines, a.mesh);
  show_discretisation(lines, a);
  add(lines, "transmission error", a.transmission_error * 1e6, " µm");
  for (Eigen::Index i = 0; i < a.pair.size(); ++i)
    add(lines, text("pair ", a.pair[i]), a.tooth_load[i], " N on tooth ", a.tooth(i, 0), " of the driver, ",
        a.tooth(i, 1), " of the driven gear; largest root stress ", a.root_stress(i, 0) * 1e-6, " MPa of ",
        a.mesh.gear[0], ", ", a.root_stress(i, 1) * 1e-6, " MPa of ", a.mesh.gear[1]);
  if (a.strip_pressure.size() > 0)
    add(lines, "contact", (a.strip_force.array() > 0).count(), " strips with force, largest pressure ",
        a.strip_pressure.maxCoeff() * 1e-6, " MPa");
  for (int g = 0; g < kSides; ++g)
    add(lines, text("certificate, ", kGearName[g]), "hub holds ", a.hub_torque[g], " N m of ",
        a.contact_torque[g], ", strain energy over work ", a.strain_energy[g] / a.contact_work[g]);
}

void show(SummaryLines& lines, const ErrorBudgetResult& a) {
  add(lines, "operating point", a.torque, " N m on ", a.mesh.gear[0], ", contact ", a.fidelity.contact);
  const auto rows = [&](const StaticChanges& changes, const std::string& before) {
    std::string rest = changes.entry;
    for (Eigen::Index i = 0; i < changes.mean_stiffness_change.size(); ++i) {
      const auto comma = rest.find(", ");
      add(lines, before + rest.substr(0, comma), "mean stiffness ", changes.mean_stiffness_change[i] * 100,
          " %, peak to peak ", changes.peak_to_peak_change[i] * 100, " %, first harmonic ",
          changes.harmonic_change(i, 0) * 100, " %");
      rest = comma == std::string::npos ? "" : rest.substr(comma + 2);
    }
  };
  rows(a.refinement, "");
  add(lines, "error", a.refinement.error(&StaticChanges::mean_stiffness_change) * 100,
      " % of the mean stiffness");
  const RootConvergence root = convergence(a.root);
  for (Eigen::Index g = 0; root.order.rows() > 0 && g < root.order.cols(); ++g) {
    std::string changes;
    for (Eigen::Index k = 0; k < root.change.rows(); ++k)
      changes += text(k ? ", " : "", std::round(root.change(k, g) * 1e5) / 1e3 + 0.0, " % from ",
                      std::round(a.root.element_size[k] * 1e6) / 1e3, " to ",
                      std::round(a.root.element_size[k + 1] * 1e6) / 1e3, " mm");
    const double order = resolved_order(root, root.order.rows() - 1, g);
    add(lines, "root stress of " + a.gear_names[static_cast<size_t>(g)], changes,
        std::isfinite(order) ? text(", order ", std::round(order * 100) / 100) : "");
  }
  rows(a.choice, "or ");
  if (!a.choice_missing.empty()) add(lines, "not computed", a.choice_missing);
}

void show(SummaryLines& lines, const ImpactResult& a) {
  if (a.of_train()) {
    show_model(lines, a);
  } else {
    if (a.mesh.friction.acts())
      add(lines, "friction", "left out of ring-downs: teeth do not slide at a fixed mesh phase");
    add(lines, "operating point", a.torque, " N m on ", a.mesh.gear[0], ", ", a.torque_step * 100,
        " % let go");
    show_damping(lines, a.damping);
  }
  const ContactStateDecays& s = a.states;
  for (Eigen::Index i = 0; i < s.natural_frequency.size(); ++i)
    add(lines,
        i < s.mesh_phase.size() ? text("loaded pairs: ", s.contact_state[i]) : name_of(s.contact_state[i]),
        s.natural_frequency[i], " Hz, damping ratio ", s.damping_ratio[i] * 100, " %; undamped ",
        s.undamped_frequency[i], " Hz");
  add(lines, "ring-down", a.mesh_phase.size(), " mesh phases, ", a.damping_ratio.cols(), " modes");
  for (Eigen::Index k = 0; k < a.damping_ratio.cols(); ++k)
    add(lines, text("mode ", k + 1), a.natural_frequency.col(k).minCoeff(), " to ",
        a.natural_frequency.col(k).maxCoeff(), " Hz, damping ratio ", a.damping_ratio.col(k).minCoeff() * 100,
        " to ", a.damping_ratio.col(k).maxCoeff() * 100, " %, by eigenvalues ",
        a.eigen_damping_ratio.col(k).minCoeff() * 100, " to ", a.eigen_damping_ratio.col(k).maxCoeff() * 100,
        " %");
  if (a.fit_residual.size() > 0)
    add(lines, "residual of the fits", a.fit_residual.maxCoeff(), " of the decay");
  if (!a.of_train()) add(lines, "least mesh force", a.least_mesh_force * 100, " % of the static one");
}

// Which pair moves, by which model.
void show_pair(SummaryLines& lines, const SweepResult& a) {
  const LumpedParameters& l = a.lumped;
  if (l.cell_end.size() > 0) {
    add(lines, "model", a.model, ", one degree of freedom, ", l.cell_end.size(), " cells of ",
        l.stiffness.cols(), l.stiffness.cols() == 1 ? " spring" : " springs", ", mean stiffness ",
        a.mean_stiffness * 1e-6, " N/µm, mass ", l.mass, " kg, integrator ", a.fidelity.integrator);
    add(lines, "damping", "ratio ", l.damping_ratio * 100, " %, c = ", l.damper, " N s/m, acts ",
        l.damper_acts == DamperActs::contact ? "in contact" : "always");
  } else {
    add(lines, "model", "body ", a.fidelity.body, ", contact ", a.fidelity.contact, ", integrator ",
        a.fidelity.integrator);
    show_damping(lines, a.damping);
  }
  add(lines, "corner contact", corner_rule(a.mesh));
  add(lines, "state of the contact", contact_plane(a.mesh));
  show_modification(lines, a.mesh);
  show_friction(lines, a.mesh);
  show_errors(lines, a.mesh);
  show_bearings(lines, a.mesh);
}

// "150 N m on pinion, "; of a train nothing, whose drives stand with its bodies.
std::string pair_torque(const MotionSource& a) {
  return a.of_train() ? "" : text(a.torque, " N m on ", a.mesh.gear[0], ", ");
}

// Of the mesh that moves most.
void show_motions(SummaryLines& lines, const SweepResult& a) {
  double peak = 0;
  Eigen::Index worst = 0, mesh = 0;
  for (Eigen::Index f = 0; f < a.mesh_frequency.size(); ++f)
    for (Eigen::Index m = 0; m < a.meshes(); ++m)
      if (const double rms = oscillating_rms({a.transmission_error[static_cast<size_t>(f)].col(m)});
          rms > peak) {
        peak = rms;
        worst = f;
        mesh = m;
      }
  add(lines, "largest DTE", peak * 1e6, " µm RMS at ", a.mesh_frequency[worst], " Hz", a.of_mesh(mesh));
  add(lines, "steady state", a.periods.sum(), " periods run, largest residual ", a.residual.maxCoeff(),
      ", energy imbalance ", a.energy_imbalance.cwiseAbs().maxCoeff());
  if (a.lumped.cell_end.size() == 0) {
    const auto line = [&a](Eigen::Index of) { return Eigen::ArrayXd(a.energy.col(of)); };
    const Eigen::ArrayXd damped = line(energy_line("modal_damping")) + line(energy_line("bearing_damping")) +
                                  line(energy_line("relaxation_damping"));
    add(lines, "energy", "at most ", damped.maxCoeff(),
        " J damped in the stored periods; of that the scheme's own work, ", "strips that switch ",
        (line(energy_line("switching")) / damped).abs().maxCoeff() * 100, " %, averaging ",
        (line(energy_line("averaging")) / damped).abs().maxCoeff() * 100, " %");
  }
  const Eigen::Index open = (a.period_multiple.array() == 0).count();
  if (open > 0) add(lines, "not periodic", open, " of ", a.period_multiple.size(), " speeds");
  add(lines, "mean speed held by", "at most ", a.drift_force.maxCoeff(), " N from the output");
}

void show(SummaryLines& lines, const SweepErrorsResult& a) {
  add(lines, "operating point", pair_torque(a), a.direction, ", ", range_of(a.mesh_frequency));
  for (size_t e = 0; e < a.entry.size(); ++e) {
    const double order = a.order[static_cast<Eigen::Index>(e)];
    add(lines, a.entry[e], "RMS ", a.dte_rms.change[e].cwiseAbs().maxCoeff() * 100, " % at most, tooth load ",
        a.tooth_load_max.change[e].cwiseAbs().maxCoeff() * 100, " %",
        order > 0 ? text(", order ", std::round(order * 100) / 100) : "");
  }
  add(lines, "error in all", "RMS ", a.dte_rms.error.maxCoeff() * 100, " % at most, tooth load ",
      a.tooth_load_max.error.maxCoeff() * 100, " %");
  for (Eigen::Index j = 0; j < a.jump_frequency.size(); ++j)
    add(lines, "jump", a.jump_frequency[j], " Hz, to ", a.jump_error[j], " Hz");
}

void show(SummaryLines& lines, const SweepResult& a) {
  add(lines, "operating point", pair_torque(a), a.direction, ", ", range_of(a.mesh_frequency));
  if (a.of_train()) {
    show_model(lines, a);
    show_differing_teeth(lines, a.layout, a.errors, a.hunting_periods);
  } else {
    show_pair(lines, a);
  }
  if (a.mesh_frequency.size() > 0) show_motions(lines, a);
  add(lines, "certificate", "least gap ", a.least_gap * 1e6, " µm, least force ", a.least_force, " N, ",
      a.fallbacks, " solutions by Lawson and Hanson");
  if (!a.of_train() && !std::isinf(a.backlash_margin))
    add(lines, "least backlash", a.backlash_margin * 1e6, " µm");
  add(lines, "jumps", jump_words(a.jump_frequency, a.jump_width));
}

// Operating point and model of a pair or a train. over: speeds, or what varies.
void show_motion(SummaryLines& lines, const MotionSource& a, const std::string& over) {
  add(lines, "operating point", pair_torque(a), over);
  if (a.of_train()) return show_model(lines, a);
  show_friction(lines, a.mesh);
  add(lines, "model", "body ", a.fidelity.body, ", contact ", a.fidelity.contact, ", integrator ",
      a.fidelity.integrator);
  show_damping(lines, a.damping);
}

void show(SummaryLines& lines, const BranchResult& a) {
  show_motion(lines, a, range_of(a.mesh_frequency));
  const Eigen::Index points = a.mesh_frequency.size();
  if (points > 0) {
    Eigen::Index worst = 0, mesh = 0;
    const double peak = a.dte_rms.maxCoeff(&worst, &mesh);
    add(lines, "largest DTE", peak * 1e6, " µm RMS at ", a.mesh_frequency[worst], " Hz", a.of_mesh(mesh));
    add(lines, "orbits", points, ", of them ", points - a.stable.sum(), " unstable; largest residual ",
        a.residual.maxCoeff());
    for (const int periods : {2, 4, 8})
      if (const auto many = (a.period_multiple.array() == periods).count(); many > 0)
        add(lines, "subharmonic", many, " orbits of ", periods, " mesh periods");
  }
  for (Eigen::Index i = 0; i < a.fold_frequency.size(); ++i)
    add(lines, "fold", jump_words(a.fold_frequency.segment(i, 1), a.fold_width.segment(i, 1)), ", ",
        a.fold_smooth[i] ? "smooth" : "at a kink", ", multiplier ", text(a.fold_multiplier(i, 0)),
        " before and ", text(a.fold_multiplier(i, 1)), " after, of this map ", text(a.fold_frequency[i]),
        " Hz");
  if (a.flip_frequency.size() > 0) add(lines, "period doubling", jump_words(a.flip_frequency, a.flip_width));
  if (a.torus_frequency.size() > 0) add(lines, "torus", jump_words(a.torus_frequency, a.torus_width));
  if (a.grazing_frequency.size() > 0)
    add(lines, "grazing", a.grazing_frequency.size(), " places from ", a.grazing_frequency.minCoeff(), " to ",
        a.grazing_frequency.maxCoeff(), " Hz");
  add(lines, "end", a.end);
}

void show(SummaryLines& lines, const FoldCurvesResult& a) {
  show_motion(lines, a, text("over ", a.quantity));
  if (a.value.size() > 0)
    add(lines, "folds", a.value.size(), " on ", a.curve.maxCoeff() + 1, " curves, ",
        a.fold_frequency.minCoeff(), " to ", a.fold_frequency.maxCoeff(), " Hz");
  for (Eigen::Index i = 0; i < a.cusp_value.size(); ++i)
    add(lines, "cusp", "value ", a.cusp_value[i], ", damping ratio ", a.cusp_damping_ratio[i], ", ",
        a.cusp_frequency[i], " Hz");
  add(lines, "end", a.end);
}

void show(SummaryLines& lines, const RunupResult& a) {
  if (!a.of_train()) show_friction(lines, a.mesh);
  add(lines, "operating point", a.of_train() ? "" : text(a.torque, " N m, "), a.ramp.from, " to ", a.ramp.to,
      " Hz at ", a.ramp.rate, " rpm/s of ", a.input);
  add(lines, "record", a.samples.size(), " samples at ", a.sample_rate, " Hz, ", a.periods.size(),
      " mesh periods");
  for (Eigen::Index m = 0; m < a.meshes(); ++m) {
    Eigen::Index worst = 0;
    const double most = a.periods.dte_rms.col(m).maxCoeff(&worst);
    add(lines, "largest RMS of the DTE of " + a.mesh_names[static_cast<size_t>(m)], most * 1e6,
        " µm in the mesh period at ", a.periods.mesh_frequency[worst], " Hz");
  }
}

void show(SummaryLines& lines, const ResponseResult& a) {
  if (a.of_train()) {
    add(lines, "operating point", a.direction, ", ", range_of(a.mesh_frequency));
    show_model(lines, a);
  } else {
    show_friction(lines, a.mesh);
    add(lines, "operating point", a.torque, " N m, ", a.direction, ", ", range_of(a.mesh_frequency));
    add(lines, "model", a.model);
  }
  if (a.mesh_frequency.size() > 0) {
    Eigen::Index worst = 0, mesh = 0;
    const double peak = a.dte_rms.maxCoeff(&worst, &mesh);
    add(lines, "largest DTE", peak * 1e6, " µm RMS", a.of_mesh(mesh), " at ", a.mesh_frequency[worst], " Hz");
    const double load = a.tooth_load_max.maxCoeff(&worst, &mesh);
    add(lines, "largest tooth load", load, " N", a.of_mesh(mesh), ", all pairs ", a.mesh_force_max.maxCoeff(),
        " N");
    for (Eigen::Index b = 0; b < a.bearing_force_max.cols(); ++b)
      if (known_of(a.bearing_force_max, b))
        add(lines, "bearing of " + a.body_names[static_cast<size_t>(b)], "force at most ",
            a.bearing_force_max.col(b).maxCoeff(), " N, its oscillation at most ",
            a.bearing_force_rms.col(b).maxCoeff(), " N RMS");
    for (Eigen::Index side = 0; side < a.root_stress_max.cols(); ++side)
      if (known_of(a.root_stress_max, side)) {
        const double stress = a.root_stress_sustained.col(side).maxCoeff(&worst);
        add(lines, text("root stress of ", a.name_of_side(side), a.of_mesh(side / kSides)), stress * 1e-6,
            " MPa sustained at ", a.mesh_frequency[worst], " Hz, at a tangent of ",
            a.root_stress_angle(worst, side) * 180 / std::numbers::pi, " deg, phase of its pair ",
            a.root_stress_phase(worst, side));
      }
    if (const Eigen::VectorXd& left = a.friction.efficiency; left.size() > 0) {
      const double least = left.minCoeff(&worst);
      add(lines, "efficiency", least * 100, " % at least, friction between the flanks alone, at ",
          a.mesh_frequency[worst], " Hz, where friction takes ", a.friction.power[worst], " W");
    }
    add(lines, "contact lost", (a.separation_fraction.rowwise().maxCoeff().array() > 0).count(),
        " speeds, at most ", a.separation_fraction.maxCoeff() * 100, " % of the period");
    if (a.of_train()) {
      add(lines, "not periodic", (a.period_multiple.array() == 0).count(), " speeds");
      add(lines, "energy imbalance", a.energy_imbalance.cwiseAbs().maxCoeff(), " of the throughput");
    }
  }
  if (!a.of_train())
    add(lines, "natural frequency", a.natural_frequency,
        " Hz (mean over the period, contact frozen under the static load)");
  add(lines, "jumps", jump_words(a.jump_frequency, a.jump_width));
}

void show(SummaryLines& lines, const JumpMapResult& a) {
  add(lines, "operating point", a.torque, " N m, ", range_of(a.mesh_frequency));
  add(lines, "model", name_of(a.model, a.damper_acts));
  add(lines, "stiffness", "mean ", a.mean_stiffness * 1e-6, " N/µm, first harmonic ",
      a.first_harmonic / a.mean_stiffness * 100, " % of it");
  for (Eigen::Index i = 0; i < a.damping_ratio.size(); ++i) {
    const bool two = a.two_branches[i], lost = a.loss_to[i] > 0;
    add(lines, text(a.damping_ratio[i] * 100, " %"), two ? "two branches from " : "one branch",
        two ? text(a.branches_from[i], a.open_below[i] ? " or less" : "", " to ", a.branches_to[i], " Hz")
            : "",
        lost ? text(", contact lost from ", a.loss_from[i], " to ", a.loss_to[i], " Hz") : ", contact kept",
        ", peak tooth load ", a.peak_tooth_load.row(i).maxCoeff(), " N, sustained ",
        a.sustained_tooth_load.row(i).maxCoeff(), " N");
  }
}

}  // namespace

namespace {

void show(SummaryLines& lines, const HarrisMapResult& a) {
  show_gear(lines, a.gear[0].design, a.gear[0].discretisation);
  show_modification(lines, a.mesh);
  show_errors(lines, a.mesh);
  show_bearings(lines, a.mesh);
  add(lines, "torque", a.torque.size(), " from ", a.torque[0], " to ", a.torque[a.torque.size() - 1], " N m");
  add(lines, "tip relief", a.relief.size(), " from ", a.relief[0] * 1e6, " to ",
      a.relief[a.relief.size() - 1] * 1e6, " µm, ", a.shape, ", on ",
      a.relieved == Relieved::both ? "both gears" : text("the ", kGearName[static_cast<size_t>(a.relieved)]));
  for (Eigen::Index s = 0; s < a.length.size(); ++s)
    add(lines, text("start ", a.start_roll(s, 0) * 180 / std::numbers::pi, " deg"), "at ", a.design_torque,
        " N m ", a.optimum_relief[s] * 1e6, " µm leave ", a.optimum_peak_to_peak[s] * 1e6,
        " µm peak to peak");
  if (a.checked > 0)
    add(lines, "finer solution", a.checked, " points differ by ", a.largest_error * 100, " % at most");
  for (Eigen::Index s = 0; s < static_cast<Eigen::Index>(a.dynamic_rms.size()); ++s)
    add(lines, "RMS at worst speed", a.dynamic_rms[s].minCoeff() * 1e6, " to ",
        a.dynamic_rms[s].maxCoeff() * 1e6, " µm");
}

void show(SummaryLines& lines, const VariantResult& a) {
  if (a.of_train()) {
    add(lines, "train", a.names.bodies.size(), " bodies, ", a.names.meshes.size(), " meshes");
  } else {
    show_gear(lines, a.gear[0].design, a.gear[0].discretisation);
    show_modification(lines, a.mesh);
    show_friction(lines, a.mesh);
    add(lines, "torque", a.torque, " N m");
  }
  if (!a.directions.empty())
    add(lines, "speeds", a.frequency_from, " to ", a.frequency_to, " Hz, ", a.directions.size(),
        a.directions.size() == 1 ? " direction" : " directions");
  if (!a.rejection.empty()) add(lines, "outside the model's range", a.rejection);
  const std::vector<ResponseQuantity> kinds = response_quantities(a.directions, a.names);
  for (Eigen::Index i = 0; i < a.quantity.size(); ++i)
    add(lines, kinds[i].name, a.quantity[i], " ", kinds[i].units == "1" ? "" : kinds[i].units);
}

void show(SummaryLines& lines, const StudyResult& a) {
  std::string keys;
  for (const VariedKey& key : a.plan.keys) keys += (keys.empty() ? "" : ", ") + key.name;
  const auto rejected =
      a.rejection.size() - static_cast<size_t>(std::count(a.rejection.begin(), a.rejection.end(), ""));
  add(lines, "study", a.variants.size(), " variants of ", a.plan.scene,
      a.plan.random ? ", drawn at random" : ", all combinations", ", ", rejected, " rejected, ",
      (a.unsteady.array() > 0).count(), " with speeds without a periodic motion");
  add(lines, "keys", keys);
  for (const ResponseQuantity& kind : response_quantities(a.plan.directions, a.plan.train)) {
    const auto found = std::find(a.plan.quantities.begin(), a.plan.quantities.end(), kind.name);
    if (found == a.plan.quantities.end()) continue;
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (size_t v = 0; v < a.rejection.size(); ++v)
      if (a.rejection[v].empty()) {
        const double value = a.quantity(static_cast<Eigen::Index>(v), found - a.plan.quantities.begin());
        least = std::min(least, value);
        most = std::max(most, value);
      }
    if (least <= most) add(lines, kind.name, least, " to ", most, " ", kind.units == "1" ? "" : kind.units);
  }
}

}  // namespace

std::string in_words(const FlankModification& m) {
  std::string out;
  const auto part = [&](const std::string& words) { out += (out.empty() ? "" : ", ") + words; };
  const double degree = std::numbers::pi / 180;
  for (const auto& [end, relief] : {std::pair{"tip", m.tip}, std::pair{"root", m.root}})
    if (relief.amount > 0)
      part(text(relief.shape == ReliefShape::linear ? "" : name_of(relief.shape) + " ", end, " relief ",
                relief.amount * 1e6, " µm ",
                relief.start_radius > 0 ? text("from radius ", relief.start_radius * 1e3, " mm")
                : relief.length > 0     ? text("over ", relief.length * 1e3, " mm of roll")
                                        : text("from ", relief.start_roll / degree, " deg")));
  if (m.crowning != 0) part(text("crowning ", m.crowning * 1e6, " µm"));
  if (m.slope != 0) part(text("slope ", m.slope * 1e6, " µm"));
  if (!m.points.empty()) part(text(m.points.size(), " points"));
  return out.empty() ? "as designed" : out;
}

std::vector<std::pair<std::string, std::string>> summary(const std::string& path, const std::string& schema) {
  SummaryLines lines;
  for_each_kind([&]<class A>(const ArtifactKind<A>& kind) {
    if constexpr (requires(const A& a) { show(lines, a); })
      if (schema == kind.schema()) show(lines, read<A>(path));
  });
  if (lines.empty())
    add(lines, "key numbers", "unknown to this version for ", schema, "; h5dump shows the file");
  return lines;
}

}  // namespace whine
