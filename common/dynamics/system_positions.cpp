// The positions of a mesh period of a system: contacts, what coordinates and relaxed loads move there, compliance.
#include "dynamics/system_dynamics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/dense.h"
#include "base/error.h"
#include "base/memory.h"
#include "base/progress.h"
#include "dynamics/relaxed_fields.h"
#include "gear/layout.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::RowVectorXd;
using Eigen::VectorXd;

namespace {

// The kind of flank of the body on one side, which differs from that on the other where one of them is internal.
ToothFlank flank_of(const SystemModel& system, const ContactSegment& segment, size_t side, int shift) {
  const System::Side& at = system.layout.meshes[static_cast<size_t>(segment.mesh)].side[side];
  return {segment.tooth[side] + shift * at.sense, at.flank};
}

}  // namespace

SystemPosition SystemDynamics::positioned(int i) const {
  const int steps = static_cast<int>(positions_.size()) - 1;
  const double phase = static_cast<double>(i) / steps;
  std::vector<MeshPosition> meshes;
  meshes.reserve(system_.mesh.size());
  for (int m = 0; m < this->meshes(); ++m) {
    const MeshInstant at = mesh_instant(system_, m, phase, 0);
    if (!system_.face.empty()) {
      meshes.push_back(face_mesh_position(*system_.face[static_cast<size_t>(m)], at.phase,
                                          corner_gap_[static_cast<size_t>(m)], load_of_mesh_[m]));
      continue;
    }
    meshes.push_back(make_line_position(system_.mesh[static_cast<size_t>(m)], at.phase,
                                        corner_gap_[static_cast<size_t>(m)], depth_,
                                        shared_force(load_of_mesh_[m]), at.period));
  }
  return join(system_, phase, 0, std::move(meshes));
}

// m N-1, inward: what the kept modes of a body leave between two of its flanks.
MatrixXd SystemDynamics::residual(int b, const ElasticGear& gear, const ToothFlank& read,
                                  const ToothFlank& loaded) const {
  const ReducedBody& body = gear.body();
  MatrixXd out = gear.compliance(read, loaded, depth_);
  // Shapes on the two teeth, of all modes in turn.
  const auto on = [&](const ToothFlank& flank, int column) -> VectorXd {
    const MatrixRM& shape = flank.side == FlankSide::leading ? body.flank_mode : body.back_flank_mode;
    const int partner = gear.partner(column);
    const double angle = gear.tooth_angle(column) * flank.tooth;
    if (partner == column) return std::cos(angle) * shape.col(column);
    const double sign = body.component[column] == 0 ? -1 : 1;
    return std::cos(angle) * shape.col(column) + sign * std::sin(angle) * shape.col(partner);
  };
  for (const int column : coordinates_.body[static_cast<size_t>(b)].kept) {
    const double w = 2 * std::numbers::pi * body.eigenfrequency[column];
    out -= on(read, column) * on(loaded, column).transpose() / (w * w);
  }
  return out;
}

// The pairs that may touch, numbered as in the first mesh period, at the end of it, too.
void SystemDynamics::find_slots(const std::vector<SystemPosition>& placed) {
  first_ = last_ = 0;
  most_contacts_ = 0;
  points_ = placed[0].mesh[0].face ? placed[0].mesh[0].face->points.per_line : 1;
  for (const SystemPosition& at : placed) {
    most_contacts_ = std::max(most_contacts_, static_cast<int>(at.segment.size()));
    for (const ContactSegment& segment : at.segment) {
      const int pair = segment.pair - mesh_instant(system_, segment.mesh, at.phase, 0).period;
      first_ = std::min(first_, pair - 1);
      last_ = std::max(last_, pair + 1);  // its relaxed loads after contact
    }
  }
  meshes_of_.assign(system_.body.size(), {});
  relaxed_first_ = {0};
  for (int b = 0; b < static_cast<int>(system_.body.size()); ++b) {
    for (int m = 0; m < meshes(); ++m)
      if (system_.side_of(b, m) >= 0) meshes_of_[static_cast<size_t>(b)].push_back(m);
    relaxed_first_.push_back(relaxed_first_.back() +
                             static_cast<int>(meshes_of_[static_cast<size_t>(b)].size()) * tooth_pairs() *
                                 kFields);
  }
}

// Fields of each body and what loads in them move: the same at all positions.
void SystemDynamics::couple() {
  fields_.clear();
  tables_.clear();
  coupling_.clear();
  for (int b = 0; b < static_cast<int>(system_.body.size()); ++b) {
    std::vector<ToothFlank> flank;         // of each slot
    std::vector<const ElasticGear*> gear;  // of each slot, as its mesh sees it
    flank.reserve(meshes_of_[static_cast<size_t>(b)].size() * static_cast<size_t>(tooth_pairs()));
    for (const int m : meshes_of_[static_cast<size_t>(b)]) {
      const auto s = static_cast<size_t>(system_.side_of(b, m));
      const System::Side& side = system_.layout.meshes[static_cast<size_t>(m)].side[s];
      for (int pair = first_; pair <= last_; ++pair) flank.push_back({side.tooth(pair), side.flank});
      gear.resize(flank.size(), &system_.mesh[static_cast<size_t>(m)].gear[s]);
    }
    const auto n = flank.size();
    std::vector<MatrixXd> table(n * n), others;
    for (size_t i = 0; i < n; ++i)
      for (size_t j = 0; j < n; ++j) {
        const ElasticGear& seen = i == j ? *gear[i] : *system_.body[static_cast<size_t>(b)];
        table[i * n + j] = residual(b, seen, flank[i], flank[j]);
        if (flank[i].tooth != flank[j].tooth || flank[i].side != flank[j].side)
          others.push_back(table[i * n + j]);
      }
    const MatrixXd v = relaxed_fields(table[0], others, kFields, kFields,
                                      "'" + system_.layout.bodies[static_cast<size_t>(b)].name + "'");
    MatrixXd c(static_cast<Index>(n) * kFields, static_cast<Index>(n) * kFields);
    for (size_t i = 0; i < n; ++i)
      for (size_t j = 0; j < n; ++j)
        c.block<kFields, kFields>(static_cast<Index>(i) * kFields, static_cast<Index>(j) * kFields) =
            v.transpose() * table[i * n + j] * v;
    fields_.push_back(v);
    tables_.push_back(std::move(table));
    coupling_.push_back(0.5 * (c + c.transpose()));
  }
}

void SystemDynamics::list_parts() {
  part_ = {{0, coordinates_.rigid, padded(coordinates_.rigid)}};
  for (size_t b = 0; b < system_.body.size(); ++b) {
    const SystemCoordinates::Share& own = coordinates_.body[b];
    part_.push_back({own.first, own.count, padded(own.torsional + own.swaying)});
  }
  for (const SystemCoordinates::Group& group : coordinates_.group)
    part_.push_back({group.first, group.count, padded(group.count)});
}

// Of stream_, at most: one row in each part of a contact and what relaxed loads of its bodies move it by.
double SystemDynamics::numbers(const std::vector<SystemPosition>& placed) const {
  const double rows = sliding_ ? 3 : 1;  // of each contact
  double most_group = 0, out = 0;
  for (size_t p = 1 + system_.body.size(); p < part_.size(); ++p)
    most_group = std::max<double>(most_group, part_[p].length());
  const auto count = [&](const SystemPosition& at) {
    for (const ContactSegment& segment : at.segment)
      for (const System::Side& side : system_.layout.meshes[static_cast<size_t>(segment.mesh)].side) {
        const auto b = static_cast<size_t>(side.body);
        out += rows * part_[1 + b].length() + kFields + relaxed_first_[b + 1] - relaxed_first_[b];
      }
    out += static_cast<double>(at.segment.size()) * rows * (part_[0].length() + most_group);
  };
  for (const SystemPosition& at : placed) count(at);
  count(placed[0]);
  return out;
}

size_t SystemDynamics::place(int numbers) {
  const size_t out = stream_.size();
  stream_.resize(out + static_cast<size_t>(padded(numbers)));
  return out;
}

// Contacts in the order of the segments, and their order in the parts. shift: as filled().
void SystemDynamics::put_contacts(const SystemPosition& at, int shift, Position& position) const {
  for (const ContactSegment& segment : at.segment) {
    const auto m = static_cast<size_t>(segment.mesh);
    const auto k = static_cast<Index>(position.contact.size());
    Contact& contact = position.contact.emplace_back();
    contact.mesh = segment.mesh;
    contact.normal = segment.normal;
    const int pair = segment.pair - mesh_instant(system_, segment.mesh, at.phase, 0).period - shift;
    contact.tooth = segment.mesh * tooth_pairs() + pair - first_;
    contact.slot = contact.tooth * points_ + segment.slice;
    contact.part = {0, 0, 0, -1};
    for (size_t s = 0; s < 2; ++s) {
      const int b = system_.layout.meshes[m].side[s].body;
      const auto own = static_cast<size_t>(b);
      const auto& list = meshes_of_[own];
      const auto place = static_cast<int>(std::find(list.begin(), list.end(), segment.mesh) - list.begin());
      contact.body[s] = b;
      contact.lever[s] = at.displacement.rotation(k, b);
      contact.load_at[s] = relaxed_first_[own] + (place * tooth_pairs() + pair - first_) * kFields;
      contact.part[1 + s] = 1 + b;
      if (const int group = coordinates_.body[own].group; group >= 0)
        contact.part[3] = 1 + static_cast<int>(system_.body.size()) + group;
    }
    if (const CarriedMesh& on = carried_[m]; on.carrier >= 0)
      contact.carrier_lever = at.displacement.rotation(k, on.carrier);
    if (!system_.mesh[m].friction.acts()) continue;
    contact.across = segment.sliding.direction * across(system_, segment);
    contact.loss = segment.sliding.loss();
    for (size_t s = 0; s < 2; ++s)
      contact.slide[s] = closing_sign(static_cast<int>(s)) * segment.sliding.direction *
                         segment.sliding.lever[s] / radius_[static_cast<size_t>(contact.body[s])];
    if (const CarriedMesh& on = carried_[m]; on.carrier >= 0)
      contact.carrier_slide =
          closing_sign(on.side) *
          contact.across.dot(pin_direction(
              system_.layout,
              system_.layout.bodies[static_cast<size_t>(contact.body[static_cast<size_t>(on.side)])]));
  }
  position.rows.resize(part_.size());
  for (size_t p = 0; p < part_.size(); ++p) {
    Rows& rows = position.rows[p];
    rows.begin = static_cast<int>(position.order.size());
    for (size_t k = 0; k < position.contact.size(); ++k)
      for (size_t which = 0; which < 4; ++which) {
        Contact& contact = position.contact[k];
        if (contact.part[which] != static_cast<int>(p)) continue;
        contact.in_part[which] = static_cast<int>(position.order.size()) - rows.begin;
        position.order.push_back(static_cast<int>(k));
      }
    rows.end = static_cast<int>(position.order.size());
  }
}

void SystemDynamics::put_rows(Position& position) {
  for (size_t p = 0; p < part_.size(); ++p) {
    Rows& rows = position.rows[p];
    const int size = rows.contacts() * part_[p].length();
    rows.row = place(size);
    if (!sliding_) continue;
    rows.push = place(size);
    rows.slide = place(size);
  }
  for (size_t b = 0; b < system_.body.size(); ++b) {
    Rows& rows = position.rows[1 + b];
    rows.field = place(rows.contacts() * kFields);
    rows.reading = place(rows.contacts() * (relaxed_first_[b + 1] - relaxed_first_[b]));
  }
}

// What friction moves of the coordinates, per mu: s T. Elastic modes have none of it but the motions of their hubs.
void SystemDynamics::put_slide(const ContactSegment& segment, const Contact& contact, Position& position) {
  const auto k = static_cast<Index>(&contact - position.contact.data());
  const auto row = [&](size_t which) {
    return Eigen::Map<VectorXd>(&stream_[row_place(position, contact, which, &Rows::slide)],
                                part_[static_cast<size_t>(contact.part[which])].count);
  };
  auto rigid = row(0);
  for (size_t s = 0; s < 2; ++s) {
    const int b = contact.body[s];
    const SystemCoordinates::Share& share = coordinates_.body[static_cast<size_t>(b)];
    const double arm = contact.slide[s] * radius_[static_cast<size_t>(b)];
    const Vec2 along = closing_sign(static_cast<int>(s)) * contact.across;
    rigid += arm * coordinates_.rotation.row(b).transpose();
    position.drift_slide.col(k) += contact.slide[s] * coordinates_.rolling.row(b).transpose();
    auto elastic = row(1 + s);
    elastic.head(share.torsional) = arm * share.hub;
    if (share.swaying > 0) elastic.segment(share.torsional, share.swaying) = share.shift.transpose() * along;
    if (share.group < 0) continue;
    const SystemCoordinates::Group& group = coordinates_.group[static_cast<size_t>(share.group)];
    row(3) = group.member[static_cast<size_t>(share.member)].shift.transpose() * along;
  }
  if (const CarriedMesh& on = carried_[static_cast<size_t>(segment.mesh)]; on.carrier >= 0) {
    rigid += contact.carrier_slide * radius_[static_cast<size_t>(on.carrier)] *
             coordinates_.rotation.row(on.carrier).transpose();
    position.drift_slide.col(k) += contact.carrier_slide * coordinates_.rolling.row(on.carrier).transpose();
  }
}

VectorXd SystemDynamics::friction_at(double mesh_frequency) const {
  VectorXd out = VectorXd::Zero(meshes());
  const VectorXd load = sliding_ ? mesh_loads(system_) : out;
  for (int m = 0; m < meshes(); ++m) {
    const GearMeshModel& mesh = system_.mesh[static_cast<size_t>(m)];
    if (load[m] > 0)
      out[m] = mesh.coefficient_of_friction(load[m] * mesh.kinematics.gear(0).base_radius(), mesh_frequency);
  }
  return out;
}

void SystemDynamics::set_friction(const VectorXd& coefficient) {
  if (coefficient == friction_) return;
  friction_ = coefficient;
  for (Position& position : positions_)
    for (size_t p = 0; p < part_.size(); ++p) {
      const Rows& rows = position.rows[p];
      const int length = part_[p].length();
      for (int c = 0; c < rows.contacts(); ++c) {
        const int k = position.order[static_cast<size_t>(rows.begin) + static_cast<size_t>(c)];
        const double share = friction_of(position.contact[static_cast<size_t>(k)]);
        for (int i = c * length; i < (c + 1) * length; i += kLanes)
          lanes(&stream_[rows.push] + i) =
              lanes(&stream_[rows.row] + i) + share * lanes(&stream_[rows.slide] + i);
      }
    }
}

// shift: 1 at the end of the mesh period, whose teeth are then one further than where `at` has them.
SystemDynamics::Position SystemDynamics::filled(const SystemPosition& at, int shift) {
  Position out;
  const auto n = static_cast<Index>(at.segment.size());
  const double phase = at.phase + shift;
  out.gap = at.gap;
  out.drift = out.drift_slide = MatrixXd::Zero(coordinates_.rolling.cols(), n);
  for (const MeshPosition& mesh : at.mesh) {
    out.law.insert(out.law.end(), mesh.law.begin(), mesh.law.end());
    for (const PairStrips& pair : mesh.pairs) out.facing.push_back(pair.contact.x_max - pair.contact.x_min);
    out.next_gap.push_back(mesh.next_corner_gap);
    out.lost_gap.push_back(mesh.lost_corner_gap);
  }
  for (size_t k = 0; k < out.law.size(); ++k)
    out.most.push_back(std::min(out.law[k].largest_force(), out.law[k].force(out.facing[k])));
  put_contacts(at, shift, out);
  put_rows(out);
  for (Index k = 0; k < n; ++k) {
    const ContactSegment& segment = at.segment[static_cast<size_t>(k)];
    const auto m = static_cast<size_t>(segment.mesh);
    const Contact& contact = out.contact[static_cast<size_t>(k)];
    const Index node = k - at.first_strip[m];
    const auto row = [&](size_t which) {
      return Eigen::Map<VectorXd>(&stream_[row_place(out, contact, which)],
                                  part_[static_cast<size_t>(contact.part[which])].count);
    };
    auto rigid = row(0);
    for (size_t s = 0; s < 2; ++s) {
      const int b = contact.body[s];
      const auto own = static_cast<size_t>(b);
      const SystemCoordinates::Share& share = coordinates_.body[own];
      const double arm = contact.lever[s] * system_.base_radius(b);
      rigid += arm * coordinates_.rotation.row(b).transpose();
      out.drift.col(k) += contact.lever[s] * coordinates_.rolling.row(b).transpose();
      const RowVectorXd weights = at.displacement.flank[m][s].row(node);
      const auto part =
          coordinates_.participation(system_, b, flank_of(system_, segment, s, -shift), phase, weights,
                                     closing_sign(static_cast<int>(s)) * segment.normal);
      auto elastic = row(1 + s);
      elastic = part.own;
      elastic.head(share.torsional) += arm * share.hub;
      if (share.group >= 0) row(3) = part.group;
      const VectorXd field = fields_[own].transpose() * weights.transpose();
      const MatrixXd& c = coupling_[own];
      const VectorXd reading = c.middleCols(contact.load_at[s] - relaxed_first_[own], field.size()) * field;
      const auto put = [&](const FieldRow& to, const double* from) {
        std::copy_n(from, kFields, &stream_[static_cast<size_t>(to.data() - stream_.data())]);
      };
      put(this->field(out, contact, s), field.data());
      for (int slot = 0; slot * kFields < c.rows(); ++slot)
        put(this->reading(out, contact, s, slot), reading.data() + slot * kFields);
    }
    if (const CarriedMesh& on = carried_[m]; on.carrier >= 0) {
      rigid += contact.carrier_lever * radius_[static_cast<size_t>(on.carrier)] *
               coordinates_.rotation.row(on.carrier).transpose();
      out.drift.col(k) += contact.carrier_lever * coordinates_.rolling.row(on.carrier).transpose();
    }
    if (sliding_) put_slide(segment, contact, out);
  }
  relate(out, at);
  if (points_ > 1) put_uneven(at, out);
  out.compliance = MatrixXd::Zero(padded(static_cast<int>(n)), n);
  out.followed.reserve(static_cast<int>(n));
  return out;
}

// What contacts move at each other by way of the bodies that they share.
void SystemDynamics::relate(Position& position, const SystemPosition& at) const {
  const Index n = position.size();
  position.instantaneous_compliance = position.relaxed = MatrixXd::Zero(n, n);
  for (Index k = 0; k < n; ++k)
    for (Index l = 0; l < n; ++l)
      for (size_t s = 0; s < 2; ++s)
        for (size_t t = 0; t < 2; ++t) {
          const Contact &read = position.contact[static_cast<size_t>(k)],
                        &loaded = position.contact[static_cast<size_t>(l)];
          if (read.body[s] != loaded.body[t]) continue;
          const int b = read.body[s], base = relaxed_first_[static_cast<size_t>(b)];
          const double soft = reading(position, read, s, (loaded.load_at[t] - base) / kFields)
                                  .dot(field(position, loaded, t));
          const auto weights = [&](const Contact& contact, size_t side, Index row) -> RowVectorXd {
            const auto m = static_cast<size_t>(contact.mesh);
            return at.displacement.flank[m][side].row(row - at.first_strip[m]);
          };
          const int slots = static_cast<int>(coupling_[static_cast<size_t>(b)].rows()) / kFields,
                    row = (read.load_at[s] - base) / kFields, column = (loaded.load_at[t] - base) / kFields;
          const double whole =
              weights(read, s, k)
                  .dot(tables_[static_cast<size_t>(b)][static_cast<size_t>(row) * static_cast<size_t>(slots) +
                                                       static_cast<size_t>(column)] *
                       weights(loaded, t, l).transpose());
          position.relaxed(k, l) += soft;
          position.instantaneous_compliance(k, l) += whole - soft;
        }
  position.instantaneous_compliance =
      (0.5 * (position.instantaneous_compliance + position.instantaneous_compliance.transpose())).eval();
  position.relaxed = (0.5 * (position.relaxed + position.relaxed.transpose())).eval();
}

// Gaps of all mesh periods of a hunting period; at the end of one they are those at the start of the next.
void SystemDynamics::set_hunting_gaps(const std::vector<SystemPosition>& placed) {
  hunting_gap_.clear();
  if (hunting_ == 1) return;
  hunting_place_ = {0};
  hunting_place_.reserve(placed.size() + 1);
  for (const SystemPosition& at : placed) hunting_place_.push_back(hunting_place_.back() + at.strips());
  const auto contacts = static_cast<size_t>(hunting_place_.back());
  constexpr double kMostMemory = 2e9;  // bytes
  const double memory = 8.0 * hunting_ * static_cast<double>(contacts);
  if (memory > kMostMemory)
    fail(Failure::input, "the same teeth meet again after ", hunting_, " mesh periods, whose gaps at ",
         placed.size(), " positions each need ", memory * 1e-9, " GB, at most ", kMostMemory * 1e-9,
         " are allowed; lower min_sample_rate_kHz and steps_per_period, or raise the lowest speed");
  log_memory(text("gaps of teeth that differ, over ", hunting_, " mesh periods,"), memory);
  hunting_gap_.resize(contacts * static_cast<size_t>(hunting_));
  double* to = hunting_gap_.data();
  for (int period = 0; period < hunting_; ++period)
    for (const SystemPosition& at : placed)
      for (int m = 0; m < meshes(); ++m) {
        const MeshPosition& position = at.mesh[static_cast<size_t>(m)];
        Eigen::Map<VectorXd>(to, position.strips()) =
            flank_gaps(system_.mesh[static_cast<size_t>(m)], position,
                       mesh_instant(system_, m, at.phase, period).period) +
            (at.gap(at.strips_of(m)) - position.gap);  // of position errors
        to += position.strips();
      }
}

void SystemDynamics::put_gap(int position, int period) {
  if (hunting_ == 1) return;
  const bool end = position + 1 == static_cast<int>(positions_.size());
  const int place = end ? 0 : position, in = end ? (period + 1) % hunting_ : period;
  VectorXd& gap = positions_[static_cast<size_t>(position)].gap;
  gap = Eigen::Map<const VectorXd>(
      &hunting_gap_[static_cast<size_t>(hunting_place_.back()) * static_cast<size_t>(in) +
                    static_cast<size_t>(hunting_place_[static_cast<size_t>(place)])],
      gap.size());
  if (!crack_.empty()) put_crack(positions_[static_cast<size_t>(position)], place, in);
}

void SystemDynamics::set_cracks(const std::vector<SystemPosition>& placed) {
  crack_.clear();
  if (!system_.cracked() || motion_.fidelity.body == BodyModel::rigid) return;
  for (int period = 0; period < hunting_; ++period)
    for (size_t i = 0; i < placed.size(); ++i) {
      MatrixXd adds = MatrixXd::Zero(placed[i].strips(), placed[i].strips());
      if (add_cracks(system_, placed[i], period, adds))
        crack_.emplace(std::pair{period, static_cast<int>(i)}, std::move(adds));
    }
}

void SystemDynamics::put_crack(Position& position, int place, int period) {
  const auto found = crack_.find({period, place});
  const bool adds = found != crack_.end();
  if (!adds && position.crack.size() == 0) return;
  auto whole = position.compliance.topRows(position.size());
  if (position.crack.size() == 0) position.intact = whole;
  position.crack = adds ? found->second : MatrixXd();
  whole = position.intact;
  if (adds) whole += position.crack;
  position.followed.forget();
}

MatrixXd SystemDynamics::crack_at_rest(int i) const {
  const auto found = crack_.find({0, i});
  const Index n = positions_[static_cast<size_t>(i)].size();
  return found == crack_.end() ? MatrixXd::Zero(n, n) : found->second;
}

void SystemDynamics::set_positions(const std::vector<double>& corner_gap, int steps) {
  corner_gap_ = corner_gap;
  friction_.setZero(meshes());
  positions_.assign(static_cast<size_t>(steps) + 1, {});
  std::vector<SystemPosition> placed;
  placed.reserve(static_cast<size_t>(steps));
  for (int i = 0; i < steps; ++i) placed.push_back(positioned(i));
  find_slots(placed);
  list_parts();
  constexpr double kMostMemory = 12e9;  // bytes
  const double in_stream = numbers(placed),
               memory = 8 * (in_stream +
                             (points_ > 1 ? 8.0 : 4.0) * steps * most_contacts_ * padded(most_contacts_));
  if (memory > kMostMemory)
    fail(Failure::input, "the positions of ", steps, " steps of a mesh period need ", 1e-9 * memory,
         " GB, at most ", 1e-9 * kMostMemory,
         " are allowed; lower min_sample_rate_kHz or modes, or raise the lowest speed");
  log_memory(text("the positions of ", steps, " steps of a mesh period"), memory);
  stream_.clear();
  stream_.reserve(static_cast<size_t>(in_stream) + 16 * part_.size() * static_cast<size_t>(steps + 1));
  couple();
  for (int i = 0; i < steps; ++i) {
    report_step("mesh positions", i, steps);
    positions_[static_cast<size_t>(i)] = filled(placed[static_cast<size_t>(i)], 0);
  }
  positions_.back() = filled(placed[0], 1);
  set_hunting_gaps(placed);
  set_cracks(placed);
  for (VectorXd* x : {&e_, &p_, &d_}) x->setZero(padded(most_contacts_));
  carrying_rows_.assign(static_cast<size_t>(most_contacts_), nullptr);
  carrying_forces_.assign(static_cast<size_t>(most_contacts_), 0);
  const int sums = kLanes * padded(most_contacts_);
  sums_.assign(static_cast<size_t>(sums), 0);
  loaded_.clear();
  loaded_.reserve(2 * static_cast<size_t>(most_contacts_));
  summed_.assign(static_cast<size_t>(padded(coordinates_.size())), 0);
  read_line_load_.setZero(padded(most_contacts_));
  steps_ = 0;
}

}  // namespace whine
