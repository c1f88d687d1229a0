#include "report/animation.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "base/error.h"
#include "gear/drawing_quantities.h"
#include "gear/pair.h"
#include "model/capabilities.h"
#include "report/wireframe.h"
#include "signal/rms.h"

namespace whine {

using Eigen::Index;

namespace {

// The outline of a gear near the mesh under given tooth loads.
class ElasticOutline {
 public:
  ElasticOutline(const SectorGrid& mesh, const BodyParameters& gear, double contact_width,
                 FindBending bending)
      : mesh_(mesh),
        tooth_(mesh.design),
        contour_(Wireframe(mesh).contour()),
        bending_(bending(mesh, gear.material, contact_width, contour_)) {}

  // (x, y) m of the contour of tooth `j`, in the gear's frame: nodes moved by `magnified` times their displacement, those of
  // the back flank first by drawn_back (m) towards the tooth's middle; the tip leans by `lean` (m) away from the mating flank.
  std::vector<Vec2> tooth(int j, const std::vector<FlankForce>& forces, double magnified, double drawn_back,
                          double lean) const {
    const Eigen::VectorXd u = bending_(j, forces);
    const Eigen::Rotation2Dd turn(2 * std::numbers::pi * j / mesh_.design.teeth);
    std::vector<Vec2> out;
    for (size_t i = 0; i < contour_.size(); ++i) {
      const Vec2 p = mesh_.node_position.row(contour_[i]);
      const double high =
          std::max(0.0, (p.norm() - tooth_.root_radius()) / (tooth_.tip_radius() - tooth_.root_radius()));
      const Eigen::Rotation2Dd leaning(-lean * high / p.norm());
      out.push_back(turn *
                    (leaning * thinned(p, drawn_back) + magnified * u.segment<2>(2 * static_cast<Index>(i))));
    }
    return out;
  }

 private:
  // Nothing at the tooth's middle and in the middle of the space, all of it on the flank.
  Vec2 thinned(const Vec2& p, double by) const {
    const double angle = std::atan2(p.x(), p.y()), half_pitch = std::numbers::pi / mesh_.design.teeth;
    if (angle <= 0) return p;
    const double from_middle = std::min(1.0, angle * p.norm() / (0.25 * mesh_.design.module)),
                 from_space = std::min(1.0, (half_pitch - angle) * p.norm() / (0.4 * mesh_.design.module));
    return Eigen::Rotation2Dd(by / p.norm() * from_middle * std::max(0.0, from_space)) * p;
  }

  const SectorGrid& mesh_;
  ToothGeometry tooth_;
  std::vector<int> contour_;
  ToothBending bending_;  // of the contour's nodes
};

// The largest of 1, 2, 5, 10 .. that is not above x.
double round_down(double x) {
  const double power = std::pow(10, std::floor(std::log10(x)));
  return power * (x >= 5 * power ? 5 : x >= 2 * power ? 2 : 1);
}

std::string frame_name(int frame) {
  char name[16];
  std::snprintf(name, sizeof name, "%03d", frame);
  return name;
}

double half_window_of(const SweepResult& s) {
  return 1.75 * std::numbers::pi * s.gear[0].design.module;
}

void check_inputs(const SectorGrid& driver, const SectorGrid& driven, const SweepResult& s, int frames) {
  if (frames < 2 || frames > 1000)
    fail(Failure::input, "an animation of ", frames, " frames; from 2 to 1000 are possible");
  if (!elastic(s))
    fail(Failure::input, "the sweep is of the lumped model ", s.model, ": it has no teeth to show");
  if (s.hunting_periods > 1)
    fail(Failure::input, "the teeth of this pair differ: its motion repeats after ", s.hunting_periods,
         " mesh periods; one mesh period does not show it");
  require_able("animation", traits(s.mesh, s.gear[0].design, s.gear[1].design));
  for (int g = 0; g < kSides; ++g) {
    const GearDesign &found = (g == 0 ? driver : driven).design, &wanted = s.gear[g].design;
    if (found.teeth != wanted.teeth || found.module != wanted.module ||
        found.bore_radius != wanted.bore_radius)
      fail(Failure::input, "the mesh.h5 of the ", kGearName[g], " (", found.teeth, " teeth, module ",
           found.module * kMilli, " mm) is not of the sweep's gear (", wanted.teeth, " teeth, module ",
           wanted.module * kMilli, " mm)");
  }
}

// The motion that is shown: one orbit.
struct ShownMotion {
  double speed;  // Hz
  int periods, per_period;
  Index samples;
  Eigen::VectorXd error, force;  // (sample) m, N
  const MatrixRM& loads;         // (sample, pair) N; more samples than those of the orbit
};

// At the mesh frequency, Hz; 0: where the transmission error oscillates most.
ShownMotion motion_of(const SweepResult& s, double mesh_frequency) {
  const auto oscillation = [&s](Index row) {
    const Eigen::VectorXd x = s.transmission_error[static_cast<size_t>(row)].col(0);
    return oscillating_rms({x});
  };
  Index row = 0;
  for (Index i = 0; i < s.mesh_frequency.size(); ++i)
    if (mesh_frequency > 0 ? std::abs(s.mesh_frequency[i] - mesh_frequency) <
                                 std::abs(s.mesh_frequency[row] - mesh_frequency)
                           : oscillation(i) > oscillation(row))
      row = i;
  const double speed = s.mesh_frequency[row];
  if (mesh_frequency > 0 && std::abs(speed - mesh_frequency) > 1e-6 * mesh_frequency)
    fail(Failure::input, "the sweep holds no speed of ", mesh_frequency, " Hz; the nearest is ", speed,
         " Hz");
  const int periods = std::max(1, s.period_multiple[row]), per_period = s.time.steps_per_period;
  const Index samples = std::min<Index>(static_cast<Index>(periods) * per_period, s.samples());
  return {speed,
          periods,
          per_period,
          samples,
          s.transmission_error[static_cast<size_t>(row)].col(0).head(samples),
          s.mesh_force[static_cast<size_t>(row)].col(0).head(samples),
          s.tooth_load[static_cast<size_t>(row)]};
}

// Columns of pairs that carry load at all: from the first to the last of them.
struct LoadedPairs {
  Index first, last = -1;
};

// What is below the teeth in every picture: the history, and the intervals without contact.
LoadedPairs add_history(const SweepResult& s, const ShownMotion& m, Figure& figure) {
  LoadedPairs pairs{m.loads.cols()};
  Index &first = pairs.first, &last = pairs.last;
  for (Index j = 0; j < m.loads.cols(); ++j)
    if (m.loads.col(j).head(m.samples).maxCoeff() > 0) {
      first = std::min(first, j);
      last = j;
    }
  FigureBlock history{"history", {"mesh period [1]", "dte [µm]", "mesh force [N]"}, {}};
  for (Index j = first; j <= last; ++j) history.columns.push_back(text("pair ", s.pair[j], " [N]"));
  FigureBlock lost{"contact lost", {"from [1]", "to [1]"}, {}};
  for (Index k = 0; k <= m.samples; ++k) {
    const Index at = k % m.samples;
    std::vector<double> values{static_cast<double>(k) / m.per_period, m.error[at] * kMicro, m.force[at]};
    // A mesh period later every pair is one place further.
    for (Index j = first; j <= last; ++j) {
      const Index column = k == m.samples ? j + m.periods : j;
      values.push_back(column < m.loads.cols() ? m.loads(at, column) : 0.0);
    }
    history.rows.push_back(values);
    if (k == m.samples || m.force[at] > 0) continue;
    const double from = (k - 0.5) / m.per_period, to = (k + 0.5) / m.per_period;
    if (!lost.rows.empty() && lost.rows.back()[1] >= from - 1e-9)
      lost.rows.back()[1] = to;
    else
      lost.rows.push_back({from, to});
  }
  figure.blocks = {history, lost};
  return pairs;
}

// The teeth of one picture after the other.
class Pictures {
 public:
  // drawn_back: m, by which back flanks are drawn thinner.
  Pictures(const SectorGrid& driver, const SectorGrid& driven, const SweepResult& s, const ShownMotion& m,
           FindBending bending, double magnified, double drawn_back)
      : s_(s),
        motion_(m),
        pair_(s),
        outline_{ElasticOutline(driver, s.gear[0], s.face_width(), bending),
                 ElasticOutline(driven, s.gear[1], s.face_width(), bending)},
        pitch_point_(0, pair_.gear(0).base_radius() / std::cos(pair_.working_pressure_angle())),
        inverse_mass_{std::pow(pair_.gear(0).base_radius(), 2) / s.inertia[0],
                      std::pow(pair_.gear(1).base_radius(), 2) / s.inertia[1]},
        magnified_(magnified),
        drawn_back_(drawn_back) {}

  // At sample k: both gears and the forces between them.
  void add(const std::string& name, Index k, Figure& figure) const;

 private:
  using Presses = std::vector<FlankForce>;
  // m, by which the tooth of a pair leans away from the other gear's at a mesh phase.
  double lean(double phase, int number) const;
  FigureBlock teeth(const std::string& name, int g, Index k, double phase, const Presses& presses,
                    FigureBlock& pressing) const;

  const SweepResult& s_;
  const ShownMotion& motion_;
  GearPair pair_;
  ElasticOutline outline_[2];
  Vec2 pitch_point_;
  double inverse_mass_[2];
  double magnified_, drawn_back_;
};

// Only displacements are magnified. A pair that is micrometres apart would be drawn as if it had run into each other: its
// gap is magnified, too, as far as that takes.
double Pictures::lean(double phase, int number) const {
  if (!pair_.in_reach(phase + number)) return 0.0;
  const PairContact contact = pair_.contact(phase + number);
  if (!(contact.gap > 0) || !contact.on_flank) return 0.0;
  return 0.5 * std::min((magnified_ - 1) * contact.gap,
                        std::max(0.0, magnified_ * motion_.error.maxCoeff() - contact.gap));
}

FigureBlock Pictures::teeth(const std::string& name, int g, Index k, double phase, const Presses& presses,
                            FigureBlock& pressing) const {
  const double half_zone = half_window_of(s_);
  Placement at = placed(pair_, g, phase);
  const double share = inverse_mass_[g] / (inverse_mass_[0] + inverse_mass_[1]);
  at.angle += magnified_ * motion_.error[k] * share / pair_.gear(g).base_radius();
  const double pitch = 2 * std::numbers::pi / pair_.gear(g).design().teeth;
  // Tooth 0 stands at `upright`; the mesh is above the driver's centre and below the driven gear's.
  const double upright = std::remainder(at.angle - (g == 0 ? 0.0 : std::numbers::pi), 2 * std::numbers::pi);
  const int middle = static_cast<int>(std::lround(-upright / pitch));
  FigureBlock block{name + text(" ", kRole[g]), {"x [mm]", "y [mm]"}, {}, "", "", true};
  // A contour goes from the clockwise side of its sector to the other: so do the teeth, in one closed line.
  const auto add = [&](const Vec2& p) {
    // micrometres are enough for the eye and keep the file small
    block.rows.push_back({std::round(p.x() * 1e6) * 1e-3, std::round(p.y() * 1e6) * 1e-3});
  };
  const double deep = g == 0 ? -3 * half_zone : 3 * half_zone;
  std::vector<Vec2> line;
  for (int j = middle - 3; j <= middle + 3; ++j)
    for (const Vec2& p : outline_[g].tooth(j, presses, magnified_, drawn_back_, lean(phase, g == 0 ? j : -j)))
      line.push_back(at(p) - pitch_point_);
  add({line.front().x(), deep});
  for (const Vec2& p : line) add(p);
  add({line.back().x(), deep});
  add({line.front().x(), deep});
  if (g == 0)
    for (const FlankForce& press : presses) {
      const Eigen::Rotation2Dd turn(pitch * press.tooth);
      const Vec2 p = at(turn * pair_.gear(0).flank_point(press.roll)) - pitch_point_;
      pressing.rows.push_back(
          {p.x() * kMilli, p.y() * kMilli, press.force, static_cast<double>(press.tooth)});
    }
  return block;
}

void Pictures::add(const std::string& name, Index k, Figure& figure) const {
  const double phase =
      static_cast<double>(k) / motion_.per_period - std::floor(static_cast<double>(k) / motion_.per_period);
  Presses presses[2];
  FigureBlock pressing{name + " force", {"x [mm]", "y [mm]", "load [N]", "pair [1]"}, {}, "", "", true};
  for (Index j = 0; j < motion_.loads.cols(); ++j) {
    if (!(motion_.loads(k, j) > 0)) continue;
    const int number = s_.pair[j];
    const PairContact contact = pair_.contact(phase + number);
    if (!contact.on_flank) continue;
    for (int g = 0; g < kSides; ++g)
      presses[g].push_back(
          {g == 0 ? number : -number, contact.roll[static_cast<size_t>(g)], motion_.loads(k, j)});
  }
  for (int g = 0; g < kSides; ++g) figure.blocks.push_back(teeth(name, g, k, phase, presses[g], pressing));
  if (pressing.rows.empty()) pressing.rows.push_back({0, 0, 0, 0});
  figure.blocks.push_back(pressing);
}

}  // namespace

Figure animation_figure(const SectorGrid& driver, const SectorGrid& driven, const SweepResult& s,
                        FindBending bending, double mesh_frequency, int frames) {
  check_inputs(driver, driven, s, frames);
  // 1. The motion.
  const ShownMotion m = motion_of(s, mesh_frequency);
  const GearPair pair(s);
  const double static_force = normal_force(s.gear[0].design, s.torque);
  const double magnified = round_down(0.3 * s.gear[0].design.module / m.error.cwiseAbs().maxCoeff());
  const double drawn_back = std::max(0.0, (1.1 * magnified * std::max(0.0, -m.error.minCoeff()) +
                                           0.04 * s.gear[0].design.module - pair.backlash()) /
                                              2);

  Figure figure;
  figure.height = 1200;
  // 2. What is below the teeth in every picture.
  const auto [first, last] = add_history(s, m, figure);

  // 3. The teeth, picture by picture.
  const Pictures pictures(driver, driven, s, m, bending, magnified, drawn_back);
  FigureBlock state{"frames", {"mesh period [1]", "dte [µm]", "mesh force [N]"}, {}};
  for (int frame = 0; frame < frames; ++frame) {
    const Index k = static_cast<Index>(frame) * m.samples / frames;
    state.rows.push_back({static_cast<double>(k) / m.per_period, m.error[k] * kMicro, m.force[k]});
    pictures.add(frame_name(frame), k, figure);
  }
  figure.blocks.push_back(state);

  const Vec2 along(-std::cos(pair.working_pressure_angle()), std::sin(pair.working_pressure_angle()));
  figure.title = text("Gears at ", m.speed, " Hz mesh frequency, ", s.torque, " N m, speed ",
                      s.direction == Direction::up ? "rising" : "falling");
  figure.notes = {
      text(
          "Vibration and deflection magnified ", magnified,
          " times; teeth bend as at rest under the loads of the moment; gaps are drawn wider than at scale as far as teeth would overlap"),
      text("Arrows: force of each pair on the driven gear; DTE: dynamic transmission error",
           drawn_back > 0 ? text("; back flanks are drawn ", std::round(drawn_back * 1e5) / 1e2,
                                 " mm thinner, the model has none")
                          : "")};
  figure.numbers = {{"frames", frames},
                    {"periods", m.periods},
                    {"magnified", magnified},
                    {"drawn_back", drawn_back * kMilli},
                    {"half_window", half_window_of(s) * kMilli},
                    {"along_x", along.x()},
                    {"along_y", along.y()},
                    {"static_force", static_force},
                    {"largest_force", m.force.maxCoeff()},
                    {"least_error", m.error.minCoeff() * kMicro},
                    {"largest_error", m.error.maxCoeff() * kMicro},
                    {"pairs", static_cast<double>(std::max<Index>(0, last - first + 1))},
                    {"first_pair", first < m.loads.cols() ? s.pair[first] : 0.0},
                    {"losses", static_cast<double>(figure.blocks[1].rows.size())}};
  return figure;
}

}  // namespace whine
