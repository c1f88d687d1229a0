// What a step does to modes, relaxed loads and contact; see step_kernel.h for the equations.
#include "dynamics/step_kernel.h"

#include <algorithm>
#include <cmath>

#include "contact/friction.h"

namespace whine {

using Eigen::VectorXd;

// A candidate zone's basis in lanes: what a pair's shape rows move its nodes by, and what its nodes' forces are in them.
struct StepKernel::ShapeLanes {
  double column[kShapeRows][kPairNodes] = {}, row[kPairNodes][kLanes] = {};
  ShapeLanes() {
    for (int k = 0; k < kZoneNodes; ++k)
      for (int m = 0; m < kShapeRows; ++m) column[m][k] = row[k][m] = shape_basis()(k, m);
  }
  // m: (kPairNodes) of nodes that are moved by -moved (shape row).
  void put_moved(const double* moved, double* at_node) const {
    static_assert(kShapeRows == 2 && kPairNodes == 2 * kLanes);
    lanes(at_node) = -(moved[0] * lanes(column[0]) + moved[1] * lanes(column[1]));
    lanes(at_node + kLanes) = -(moved[0] * lanes(column[0] + kLanes) + moved[1] * lanes(column[1] + kLanes));
  }
  Lanes moments(const double* nodes) const {
    static_assert(kZoneNodes == 6);
    return (nodes[0] * lanes(row[0]) + nodes[1] * lanes(row[1]) + nodes[2] * lanes(row[2])) +
           (nodes[3] * lanes(row[3]) + nodes[4] * lanes(row[4]) + nodes[5] * lanes(row[5]));
  }
};
const StepKernel::ShapeLanes StepKernel::kShape;

void StepKernel::turn_doublets(double* y, int direction) const {
  for (const StepSystem::Turn& turn : system_.turns) {
    if (turn.sine < 0) {
      y[turn.cosine] = -y[turn.cosine];
    } else {
      // Z = cosine - i sine turns by exp(i turn).
      const double cosine = y[turn.cosine], sine = y[turn.sine], s = direction * turn.s;
      y[turn.cosine] = turn.c * cosine + s * sine;
      y[turn.sine] = turn.c * sine - s * cosine;
    }
  }
}

void StepKernel::advance_fields(double* fields) const {
  const int of_side = this->fields();
  for (int side = 0; side < kSides; ++side) {
    double* own = fields + side * of_side;
    std::copy_backward(own, own + of_side - kFields, own + of_side);
    std::fill(own, own + kFields,
              0.0);  // a tooth that comes into reach was unloaded for longer than any relaxation lasts
  }
}

Eigen::Vector4d StepKernel::reading(int position, int j, const double* z) const {
  const double* rows = shape_of(frame(position), j);
  Eigen::Vector4d result;
  lanes(result.data()) =
      system_.lines ? dot_rows<1>(rows, coordinates_, z) : dot_rows<kShapeRows>(rows, coordinates_, z);
  return result;
}

Eigen::Vector4d StepKernel::collect(int position, int j, const double* p, double* fields) const {
  const Frame& frame = this->frame(position);
  Eigen::Vector4d result;
  if (system_.lines) {
    const LineRecord record = this->record();
    const double* line = &stream_[frame.line + static_cast<size_t>(j * record.size())];
    for (int side = 0; side < kSides; ++side)
      for (int k = 0; k < kFields; k += kLanes)
        lanes(fields + side * kFields + k) = p[0] * lanes(line + record.weight(side) + k);
    lanes(result.data()) = Lanes{p[0]};
    return result;
  }
  double nodes[kPairNodes];
  dot_columns(nodes, &stream_[frame.pair[j].interpolation], frame.of_pair, kPairNodes, p, frame.of_pair);
  for (int side = 0; side < kSides; ++side)
    dot_columns(fields + side * kFields,
                &stream_[frame.pair[j].field + static_cast<size_t>(side * kPairNodes * kFields)], kPairNodes,
                kFields, nodes, kPairNodes);
  lanes(result.data()) = kShape.moments(nodes);
  return result;
}

void StepKernel::add_displacement(int side, int offset, const double* loads, double* field) const {
  const double* columns = system_.block(side, offset).data();
  if (offset == 0)
    add_columns_of_12(field, columns, kFields, loads, kFields);
  else
    add_columns_of_8(field, columns, loads, kSharedFields);
}

void StepKernel::displace(int side, const double* loads, double* field) const {
  std::fill(field, field + fields(), 0.0);
  for (int from = 0; from < system_.teeth(); ++from, loads += kFields) {
    if (std::all_of(loads, loads + kFields, [](double x) { return x == 0; })) continue;
    for (int tooth = 0; tooth < system_.teeth(); ++tooth)
      add_displacement(side, tooth - from, loads, field + tooth * kFields);
  }
}

void StepKernel::LiveTeeth::add(int slot) {
  if (first == last) first = last = slot;
  first = std::min(first, slot);
  last = std::max(last, slot + 1);
}

// Modal vectors of a step and what a step does to them. A pair has kRows rows.
template <int kRows>
struct StepKernel::Modes {
  int coordinates;
  double *z, *v, *force;
  const double* coefficients;
  HubLanes hub;
  explicit Modes(StepKernel& kernel)
      : coordinates(kernel.coordinates_),
        z(kernel.vectors_.z.data()),
        v(kernel.vectors_.v.data()),
        force(kernel.vectors_.force.data()),
        coefficients(kernel.coefficients_.number.data()),
        hub(kernel.hubs_) {}

  // To the next instant, without new contact force.
  void propagate() const {
    for (int c = 0; c < coordinates; c += kLanes) {
      propagate_lanes(c, lanes(z + c), lanes(v + c), 0.5 * (lanes(force + c) + of(c, Coefficients::torque)));
    }
  }

  // The new contact force's own share. m: transmission error.
  double push(const ModalLoad& load) const {
    Lanes error{};
    for (int c = 0; c < coordinates; c += kLanes) {
      Lanes half{};
      for (int j = 0; j < load.count; ++j)
        for (int r = 0; r < kRows; ++r)
          half += load.half[j][r] * lanes(load.rows[j] + c * kRows + r * kLanes);
      const Lanes z1 = lanes(z + c) - of(c, Coefficients::bq) * half;
      lanes(v + c) -= of(c, Coefficients::a12) * half;
      lanes(z + c) = z1;
      lanes(force + c) = of(c, Coefficients::torque) - 2 * half;
      error += of(c, Coefficients::weight) * z1;
    }
    return sum(error);
  }

  // Both in one go, and `next` read off what comes out while it is in registers; the force itself is not kept.
  // rest: (coordinate), of the loads of more pairs than there are registers.
  double push_and_propagate(const ModalLoad& load, ModalReading& next, double* rest) const {
    switch (load.count) {
      case 0:
        return correct_and_propagate<0, kRows>(load.rows, load.half, next);
      case 1:
        return correct_and_propagate<1, kRows>(load.rows, load.half, next);
      case 2:
        return correct_and_propagate<2, kRows>(load.rows, load.half, next);
      default:
        break;
    }
    std::fill(rest, rest + coordinates, 0.0);
    for (int j = 0; j < load.count; ++j)
      for (int c = 0; c < coordinates; c += kLanes)
        for (int r = 0; r < kRows; ++r)
          lanes(rest + c) += load.half[j][r] * lanes(load.rows[j] + c * kRows + r * kLanes);
    const double* row = rest;
    const Lanes one{1};
    return correct_and_propagate<1, 1>(&row, &one, next);
  }

  void read(ModalReading& reading) const {
    for (int j = 0; j < reading.count; ++j) {
      const Lanes moved = dot_rows<kRows>(reading.rows[j], coordinates, z);
      for (int r = 0; r < kRows; ++r) reading.moved[j][r] = moved[r];
    }
  }

 private:
  const Lanes& of(int c, Coefficients::Of which) const {
    return lanes(coefficients + Coefficients::place(which, c, coordinates));
  }
  Lanes propagate_lanes(int c, Lanes z0, Lanes v0, Lanes mean) const {
    const Lanes bq = of(c, Coefficients::bq), a12 = of(c, Coefficients::a12),
                z1 = of(c, Coefficients::a11) * z0 + a12 * v0 + bq * mean;
    lanes(z + c) = z1;
    lanes(v + c) = of(c, Coefficients::a21) * z0 + of(c, Coefficients::a22) * v0 + a12 * mean;
    return z1;
  }
  template <int kCount, int kRowsEach>
  double correct_and_propagate(const double* const* rows, const Lanes* factor, ModalReading& next) const {
    switch (next.count) {
      case 0:
        return correct_and_propagate<kCount, kRowsEach, 0>(rows, factor, next);
      case 2:
        return correct_and_propagate<kCount, kRowsEach, 2>(rows, factor, next);
      case 3:
        return correct_and_propagate<kCount, kRowsEach, 3>(rows, factor, next);
      default:
        break;
    }
    const double error = correct_and_propagate<kCount, kRowsEach, 0>(rows, factor, next);
    read(next);
    return error;
  }
  template <int kCount, int kRowsEach, int kRead>
  double correct_and_propagate(const double* const* rows, const Lanes* factor, ModalReading& next) const {
    const Modes here = *this;  // stores of lanes may change anything for all that the compiler knows
    const double *row[kCount + 1], *read_row[kRead + 1];
    double f[kCount + 1][kRowsEach];
    for (int j = 0; j < kCount; ++j) {
      row[j] = rows[j];
      for (int r = 0; r < kRowsEach; ++r) f[j][r] = factor[j][r];
    }
    for (int j = 0; j < kRead; ++j) read_row[j] = next.rows[j];
    Lanes error{}, moved[kRead + 1][kRows] = {};
    const auto run = [&](auto with_hub, int from, int to) __attribute__((always_inline)) {
      for (int c = from; c < to; c += kLanes) {
        Lanes half{};
        for (int j = 0; j < kCount; ++j)
          for (int r = 0; r < kRowsEach; ++r) half += f[j][r] * lanes(row[j] + c * kRowsEach + r * kLanes);
        const Lanes z0 = lanes(here.z + c), v0 = lanes(here.v + c);
        Lanes z2;
        if constexpr (with_hub) {
          const Lanes z1 = z0 - here.of(c, Coefficients::bq) * half;
          error += here.of(c, Coefficients::weight) * z1;
          z2 = here.propagate_lanes(c, z1, v0 - here.of(c, Coefficients::a12) * half,
                                    here.of(c, Coefficients::torque) - half);
        } else {
          z2 = here.of(c, Coefficients::a11) * z0 + here.of(c, Coefficients::a12) * v0 -
               here.of(c, Coefficients::push_z) * half;
          lanes(here.z + c) = z2;
          lanes(here.v + c) = here.of(c, Coefficients::a21) * z0 + here.of(c, Coefficients::a22) * v0 -
                              here.of(c, Coefficients::push_v) * half;
        }
        for (int j = 0; j < kRead; ++j)
          for (int r = 0; r < kRows; ++r) moved[j][r] += z2 * lanes(read_row[j] + c * kRows + r * kLanes);
      }
    };
    run(std::true_type{}, 0, here.hub.first_end);
    run(std::false_type{}, here.hub.first_end, here.hub.second);
    run(std::true_type{}, here.hub.second, here.hub.second_end);
    run(std::false_type{}, here.hub.second_end, here.coordinates);
    for (int j = 0; j < kRead; ++j)
      for (int r = 0; r < kRows; ++r) next.moved[j][r] = sum(moved[j][r]);
    return sum(error);
  }
};

struct StepKernel::StripContact {
  static constexpr int kRows = kShapeRows;
  explicit StripContact(StepKernel& of) : kernel(of), coordinates(of.coordinates_), fields(of.fields()) {}

  // Computes what does not depend on the modes: relaxed loads and the initial guess; selects the rows of the modes to read.
  // Relaxed loads are zero outside the live teeth.
  void read_ahead(const Frame& frame, Step&, ModalReading& modal) {
    follow(frame, kernel.vectors_.relaxed.data());
    const double* rows = kernel.stream_.data() + frame.shape;
    modal.count = frame.present;
    for (int j = 0; j < modal.count; ++j) modal.rows[j] = rows + j * kShapeRows * coordinates;
  }

  // Fills e, p and d. modal: the rows of read_ahead, without new contact force.
  Certificate solve(const Frame& frame, Step& step, const ModalReading& modal) {
    const double* stream = kernel.stream_.data();
    VectorXd &e = kernel.e_, &p = kernel.p_, &d = kernel.d_;
    const int present = frame.present, of_pair = frame.of_pair, strips = present * of_pair;
    for (int j = 0; j < present; ++j) {
      double at_node[kPairNodes];
      kShape.put_moved(modal.moved[j], at_node);
      for (int side = 0; side < kSides; ++side)
        add_columns_of_8(at_node, stream + frame.pair[j].field + side * kPairNodes * kFields,
                         field_of(frame, side, j), kFields);
      add_six_columns(e.data() + j * of_pair, stream + frame.gap + j * of_pair,
                      stream + frame.pair[j].interpolation, of_pair, at_node, 1, of_pair);
    }
    const StripCompliance a = kernel.strip_compliance(frame, step.compliance.data());
    return kernel.solver_.solve(a, e.head(strips), step.active, p.head(strips), d.head(strips),
                                kernel.nodes_.data());
  }

  // N, of pair j. zone_end: force stands on a candidate zone's end that is no tip edge.
  Contact carried(const Frame& frame, int j, double& force) const {
    const Frame::Pair& pair = frame.pair[j];
    const int of_pair = frame.of_pair;
    const double* own = &kernel.p_[j * of_pair];
    if ((!pair.low_is_edge && own[0] > 0) || (!pair.high_is_edge && own[of_pair - 1] > 0))
      return Contact::zone_end;
    Lanes total{};
    for (int k = 0; k < of_pair; k += kLanes) total += lanes(own + k);
    force = sum(total);
    return Contact::solved;
  }

  // After `carried` of all pairs, force: (pair) N. Fills the loads of the pairs that have force; `share` of it goes to the
  // relaxed load.
  void spread(const Frame& frame, const double* force, double share, ModalLoad& on_modes) {
    const double *stream = kernel.stream_.data(), *rows = stream + frame.load;
    double *load = kernel.vectors_.load.data(), *relaxed = kernel.vectors_.relaxed.data();
    const int present = frame.present;
    on_modes.count = 0;
    for (int j = 0; j < present; ++j) {
      if (force[j] == 0) continue;
      const double* own = &kernel.nodes_[j * kPairNodes];
      on_modes.add(rows + j * kShapeRows * coordinates, kShape.moments(own));
      for (int side = 0; side < kSides; ++side)
        dot_columns(load + side * fields + frame.pair[j].slot * kFields,
                    stream + frame.pair[j].field + side * kPairNodes * kFields, kPairNodes, kFields, own,
                    kPairNodes);
    }
    for (int side = 0; side < kSides; ++side)
      for (int i = 0; i < present; ++i) {
        double* moved = moved_of(frame, side, i);
        for (int k = 0; k < kFields; k += kLanes) lanes(moved + k) = Lanes{};
        for (int j = 0; j < present; ++j)
          if (force[j] != 0)
            kernel.add_displacement(side, frame.pair[i].slot - frame.pair[j].slot,
                                    load + side * fields + frame.pair[j].slot * kFields, moved);
        const int at = side * fields + frame.pair[i].slot * kFields;
        for (int k = at; force[i] != 0 && k < at + kFields; k += kLanes)
          lanes(relaxed + k) += share * lanes(load + k);
      }
  }

  StepKernel& kernel;
  int coordinates, fields;

 private:
  double* field_of(const Frame& frame, int side, int j) const {
    return &kernel.field_[side * fields + frame.pair[j].slot * kFields];
  }
  double* moved_of(const Frame& frame, int side, int j) const {
    return &kernel.moved_load_[side * fields + frame.pair[j].slot * kFields];
  }
  // The displacement of the teeth that are present by all relaxed loads: as the relaxed load itself goes on, or anew.
  void follow(const Frame& frame, const double* relaxed) {
    const Relaxation step = kernel.relaxed_step_;
    const unsigned long before = kernel.followed_;
    unsigned long now = 0;
    for (int j = 0; j < frame.present; ++j) {
      const int slot = frame.pair[j].slot;
      now |= 1ul << slot;
      for (int side = 0; side < kSides; ++side) {
        double* field = field_of(frame, side, j);
        if (before >> slot & 1) {
          const double* moved = moved_of(frame, side, j);
          for (int k = 0; k < kFields; k += kLanes)
            lanes(field + k) = step.decay * lanes(field + k) +
                               (step.from_new * step.decay + step.from_old) * lanes(moved + k);
          continue;
        }
        for (int k = 0; k < kFields; k += kLanes) lanes(field + k) = Lanes{};
        for (int tooth = 0; tooth < kernel.system_.teeth(); ++tooth)
          kernel.add_displacement(side, slot - tooth, relaxed + side * fields + tooth * kFields, field);
      }
    }
    kernel.followed_ = now;
  }
};

struct StepKernel::LineContact {
  static constexpr int kRows = 1;
  explicit LineContact(StepKernel& of) : kernel(of), record(of.record()) {}

  // As of strips, all four.
  void read_ahead(const Frame& frame, Step& step, ModalReading& modal) {
    const double *line = kernel.stream_.data() + frame.line, *relaxed = kernel.vectors_.relaxed.data();
    double* e = kernel.e_.data();
    const LiveTeeth live = kernel.live_;
    const int fields = record.fields;
    modal.count = frame.present;
    for (int j = 0; j < modal.count; ++j, line += record.size()) {
      modal.rows[j] = line + LineRecord::kShape;
      static_assert(kFields - kSharedFields == kLanes && kSides == 2);
      const double *first_relaxed = relaxed + frame.pair[j].slot * kFields + kSharedFields,
                   *second_relaxed = first_relaxed + fields;
      Lanes first = lanes(line + record.own_reading(0)) * lanes(first_relaxed),
            second = lanes(line + record.own_reading(1)) * lanes(second_relaxed);
      for (int tooth = live.first; tooth < live.last; ++tooth) {
        const double *first_row = line + record.reading(0, tooth), *second_row = first_row + kSharedFields;
        first_relaxed = relaxed + tooth * kFields;
        second_relaxed = first_relaxed + fields;
        for (int k = 0; k < kSharedFields; k += kLanes) {
          first += lanes(first_row + k) * lanes(first_relaxed + k);
          second += lanes(second_row + k) * lanes(second_relaxed + k);
        }
      }
      e[j] = line[LineRecord::kGap] + sum(first + second);
    }
    if (step.start.known()) return;
    if (step.force.size() != modal.count) step.force.setZero(modal.count);
    step.start.look(step.compliance, frame.law, step.force);
  }

  Certificate solve(const Frame& frame, Step& step, const ModalReading& modal) {
    const int present = frame.present;
    VectorXd &e = kernel.e_, &p = kernel.p_;
    for (int j = 0; j < present; ++j) e[j] -= modal.moved[j][0];
    const Certificate certificate = solve_line_contact(step.compliance, frame.law, e.head(present),
                                                       step.start, step.force, kernel.d_.head(present));
    for (int j = 0; j < present; ++j) p[j] = step.force[j];
    return certificate;
  }

  Contact carried(const Frame& frame, int j, double& force) const {
    force = kernel.p_[j];
    return force <= kernel.stream_[frame.line + static_cast<size_t>(j * record.size() + LineRecord::kMost)]
               ? Contact::solved
               : Contact::beyond_law;
  }

  void spread(const Frame& frame, const double* force, double share, ModalLoad& on_modes) const {
    const int present = frame.present, fields = record.fields;
    double *load = kernel.vectors_.load.data(), *relaxed = kernel.vectors_.relaxed.data();
    const double *line = kernel.stream_.data() + frame.line, *rows = kernel.stream_.data() + frame.load;
    on_modes.count = 0;
    for (int j = 0; j < present; ++j, line += record.size(), rows += frame.load_apart) {
      if (force[j] == 0) continue;
      on_modes.add(rows, Lanes{force[j]});
      for (int side = 0; side < kSides; ++side) {
        const int at = side * fields + frame.pair[j].slot * kFields;
        for (int k = 0; k < kFields; k += kLanes) {
          const Lanes own = force[j] * lanes(line + record.weight(side) + k);
          lanes(load + at + k) = own;
          lanes(relaxed + at + k) += share * own;
        }
      }
    }
  }

  StepKernel& kernel;
  LineRecord record;
};

// Relaxed loads to the next instant, without new load; loaded: present loads still act.
void StepKernel::relax(bool loaded) {
  double *const relaxed = vectors_.relaxed.data(), *const load = vectors_.load.data();
  const Relaxation step = relaxed_step_;
  const LiveTeeth live = live_;
  for (int side = 0, of_side = fields(); side < kSides; ++side)
    for (int k = side * of_side + live.first * kFields; k < side * of_side + live.last * kFields;
         k += kLanes) {
      lanes(relaxed + k) *= step.decay;
      if (loaded) lanes(relaxed + k) += step.from_old * lanes(load + k);
    }
}

template <class Model>
void StepKernel::begin_with(Model model, int sample) {
  const Modes<Model::kRows> modes(*this);
  modes.propagate();
  relax(true);
  model.read_ahead(frame(position_of(sample)), steps_[sample], reading_);
  modes.read(reading_);
}

void StepKernel::predict(int sample) {
  system_.lines ? begin_with(LineContact(*this), sample) : begin_with(StripContact(*this), sample);
}

// The contact of a step with friction: gaps are read with what friction of the forces found last moves.
template <class Model>
Certificate StepKernel::solve_sliding(Model& model, const Frame& frame, Step& step) {
  constexpr int kRows = Model::kRows;
  using Shift = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostPairs * kRows, 1>;
  const ModalReading without = reading_;
  PairVector gaps;  // of lines, which take what modes move off them in place
  if (kRows == 1) gaps = e_.head(frame.present);
  double scale = 1e-9;  // m, of a pair that nothing moves
  for (int j = 0; j < frame.present; ++j)
    for (int r = 0; r < kRows; ++r) scale = std::max(scale, std::abs(without.moved[j][r]));
  Shift shift = Shift::Zero(frame.present * kRows);
  return solve_with_friction(
      shift, scale,
      [&](const Shift& by) {
        for (int j = 0; j < frame.present; ++j)
          for (int r = 0; r < kRows; ++r) reading_.moved[j][r] = without.moved[j][r] - by[j * kRows + r];
        if (kRows == 1) e_.head(frame.present) = gaps;
        return model.solve(frame, step, reading_);
      },
      [&] {
        PairVector force(frame.present);
        for (int j = 0; j < frame.present; ++j)
          force[j] = kRows == 1 ? p_[j] : p_.segment(j * frame.of_pair, frame.of_pair).sum();
        return Shift(step.friction * force);
      });
}

template <class Model>
StepKernel::End StepKernel::finish_with(Model model, int sample, int next) {
  const Frame& frame = this->frame(position_of(sample));
  const bool ahead = next >= 0;
  End end;
  if (ahead) relax(false);
  end.certificate = friction_ > 0 ? solve_sliding(model, frame, steps_[sample])
                                  : model.solve(frame, steps_[sample], reading_);
  for (int j = 0; j < frame.present; ++j) {
    const Contact contact = model.carried(frame, j, end.carried[j]);
    if (contact != Contact::solved) end.contact = contact;
    if (contact == Contact::zone_end) return end;
    if (end.carried[j] != 0) live_.add(frame.pair[j].slot);
  }
  if (!ahead) vectors_.load.setZero();  // of pairs that have no force now
  ModalLoad on_modes;
  model.spread(
      frame, end.carried,
      ahead ? relaxed_step_.decay * relaxed_step_.from_new + relaxed_step_.from_old : relaxed_step_.from_new,
      on_modes);
  const Modes<Model::kRows> modes(*this);
  if (!ahead) {
    end.error = modes.push(on_modes);
    return end;
  }
  model.read_ahead(this->frame(position_of(next)), steps_[next], reading_);
  end.error = modes.push_and_propagate(on_modes, reading_, rest_.data());
  return end;
}

StepKernel::End StepKernel::correct(int sample, int next) {
  return system_.lines ? finish_with(LineContact(*this), sample, next)
                       : finish_with(StripContact(*this), sample, next);
}

void StepKernel::rename() {
  for (double* y : {vectors_.z.data(), vectors_.v.data(), vectors_.force.data()}) turn_doublets(y);
  for (double* x : {vectors_.relaxed.data(), vectors_.load.data()}) advance_fields(x);
  followed_ = 0;
  live_ = {live_.first + (live_.first < live_.last), std::min(live_.last + 1, system_.teeth())};
}

}  // namespace whine
