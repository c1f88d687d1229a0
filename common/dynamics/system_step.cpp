// One time step of a system: all that knows how the rows of a position lie in memory.
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "contact/lanes.h"
#include "dynamics/system_dynamics.h"
#include "dynamics/system_lanes.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kLeastRelaxed = 1e-20;  // of the mean load of the meshes

}  // namespace

// Propagators of steps of `seconds`, and room for a state.
void SystemDynamics::propagate_by(double seconds) {
  step_ = seconds;
  const Index n = coordinates_.size(), whole = n + 2 * kLanes;
  const auto propagator =
      motion_.fidelity.integrator == Integrator::newmark ? newmark_propagator : exact_propagator;
  for (VectorXd* x : {&a11_, &a12_, &a21_, &a22_, &bq_, &torque_, &z_, &v_, &force_}) x->setZero(whole);
  for (Index i = 0; i < n; ++i) {
    const Propagator a = propagator(coordinates_.frequency[i], coordinates_.damping[i], step_);
    a11_[i] = a.a11, a12_[i] = a.a12, a21_[i] = a.a21, a22_[i] = a.a22, bq_[i] = a.bq;
  }
  set_run();
  torque_.head(n) = coordinates_.torque;
  if (slides() && motion_.output >= 0)
    torque_.head(n) += motion_.loss.dot(friction_) * coordinates_.turning(motion_.output);
  if (frame_.turns()) {
    frame_.set_step(step_, bq_.head(n));
    frame_.add(frame_.constant(), torque_.head(n));
  }
  relaxed_step_ = relaxation_step(relaxation_, step_);
  relaxed_.setZero(relaxed_size());
  p_of_slot_.setZero(slots());
  for (VectorXd* x : {&p_of_tooth_, &remembered_}) x->setZero(meshes() * tooth_pairs());
  if (points_ > 1)
    for (VectorXd* x : {&line_load_, &present_line_load_, &next_line_load_}) x->setZero(slots());
  live_.assign(static_cast<size_t>(meshes()), {});
}

// Coefficients of the coordinates that no hub feels: kRun of each, four coordinates in turn.
void SystemDynamics::set_run() {
  run_.clear();
  for (Part& part : part_) {
    part.run = run_.size();
    run_.resize(part.run + static_cast<size_t>(kRun * (part.length() - part.hub)), 0.0);
    for (int c = part.hub; c < part.length(); ++c) {
      double* own =
          &run_[part.run + static_cast<size_t>((c - part.hub) / kLanes * kRun * kLanes + c % kLanes)];
      own[0] = own[3 * kLanes] = 1;  // what whole lanes reach of the next part stays as it is
      if (c >= part.count) continue;
      const Index i = part.first + c;
      const double of[kRun] = {a11_[i],
                               a12_[i],
                               a21_[i],
                               a22_[i],  // bv = a12
                               0.5 * (a11_[i] * bq_[i] + a12_[i] * a12_[i] + bq_[i]),
                               0.5 * (a21_[i] * bq_[i] + a22_[i] * a12_[i] + a12_[i])};
      for (int which = 0; which < kRun; ++which) own[which * kLanes] = of[which];
    }
  }
}

// Compliance of the contacts at the end of a step.
void SystemDynamics::close(Position& position) const {
  position.crack.resize(0, 0);
  auto whole = position.compliance.topRows(position.size());
  whole = position.instantaneous_compliance + relaxed_step_.from_new * position.relaxed +
          modal_compliance(position, 0.5 * bq_);
  if (points_ > 1) whole += relaxed_step_.from_new * position.uneven;
  const auto in_frame = [&](Place of) {
    const Index n = coordinates_.size();
    MatrixXd rows(n, position.size());
    for (int k = 0; k < position.size(); ++k)
      rows.col(k) = bq_.head(n).cwiseProduct(participation(position, k, of));
    return frame_.motions(rows);
  };
  if (frame_.turns()) {
    const MatrixXd read = in_frame(&Rows::row);
    whole += frame_.compliance(read, read);
  }
  position.friction.resize(0, 0);
  if (slides()) {
    position.friction = modal_compliance(position, 0.5 * bq_, &Rows::slide);
    if (frame_.turns()) position.friction += frame_.compliance(in_frame(&Rows::row), in_frame(&Rows::slide));
    for (int k = 0; k < position.size(); ++k)
      position.friction.col(k) *= friction_of(position.contact[static_cast<size_t>(k)]);
    whole += position.friction;
  }
  position.followed.forget();
}

void SystemDynamics::take(const State& state, const Position& position) {
  const Index n = coordinates_.size();
  if (state.z.size() != n || state.relaxed.size() != relaxed_size() || state.p.size() != slots() ||
      state.line_load.size() != line_load_.size())
    fail(Failure::input, "the start state, of ", state.z.size(), " coordinates and ", state.p.size(),
         " slots, is of another system or of other positions: here there are ", n, " and ", slots());
  z_.head(n) = state.z;
  v_.head(n) = state.v;
  relaxed_ = state.relaxed;
  p_of_slot_ = state.p;
  for (int k = 0; k < position.size(); ++k) p_[k] = state.p[position.contact[static_cast<size_t>(k)].slot];
  force_ = torque_;
  for (int k = 0; k < position.size(); ++k)
    if (p_[k] != 0) push(position, k, p_[k], force_, pushing());
  if (frame_.turns()) frame_.add(frame_.stiffness() * frame_.motions(z_.head(n)), force_.head(n));
  sum_teeth();
  note_loads(position);
  line_load_ = state.line_load;
  if (points_ > 1) {
    present_line_load_.setZero();
    for (int k = 0; k < position.size(); ++k)
      present_line_load_[position.contact[static_cast<size_t>(k)].slot] = p_[k] / position.width[k];
  }
  find_live();
  ahead_ = false;
}

// Of a state from outside: what it has of relaxed and present loads.
void SystemDynamics::find_live() {
  remembered_ = tooth_force().cwiseAbs();
  for (size_t b = 0; b < system_.body.size(); ++b)
    for (size_t place = 0; place < meshes_of_[b].size(); ++place)
      for (int pair = 0; pair < tooth_pairs(); ++pair) {
        const Index at = relaxed_first_[b] + (static_cast<Index>(place) * tooth_pairs() + pair) * kFields;
        double& most = remembered_[meshes_of_[b][place] * tooth_pairs() + pair];
        most = std::max(most, relaxed_.segment<kFields>(at).cwiseAbs().maxCoeff());
      }
  for (int m = 0; m < meshes(); ++m) {
    Live& live = live_[static_cast<size_t>(m)];
    live = {tooth_pairs(), 0};
    for (int pair = 0; pair < tooth_pairs(); ++pair)
      if (remembered_[m * tooth_pairs() + pair] != 0) {
        live.first = std::min(live.first, pair);
        live.last = pair + 1;
      }
    if (live.last == 0) live.first = 0;
  }
}

// Coordinates at the end of a step, without new contact forces.
void SystemDynamics::propagate() {
  double *z = z_.data(), *v = v_.data();
  const double *force = force_.data(), *torque = torque_.data(), *a11 = a11_.data(), *a12 = a12_.data(),
               *a21 = a21_.data(), *a22 = a22_.data(), *bq = bq_.data();
  for (const Part& part : part_) {
    const int end = part.first + (ahead_ ? std::min(part.hub, part.count) : part.count);
#pragma GCC ivdep
    for (int i = part.first; i < end; ++i) {
      const double mean = 0.5 * (force[i] + torque[i]), before = z[i], speed = v[i];
      z[i] = a11[i] * before + a12[i] * speed + bq[i] * mean;
      v[i] = a21[i] * before + a22[i] * speed + a12[i] * mean;  // bv = a12
    }
  }
}

// Relaxed loads at the end of a step, without new contact forces.
void SystemDynamics::relax() {
  remembered_ = relaxed_step_.decay * remembered_ + relaxed_step_.from_old * tooth_force().cwiseAbs();
  if (points_ > 1)
    line_load_ = relaxed_step_.decay * line_load_ + relaxed_step_.from_old * present_line_load_;
  const double decay =
      relaxed_step_.decay;  // stores of lanes may change anything for all that the compiler knows
  for (size_t b = 0; b < meshes_of_.size(); ++b)
    for (size_t place = 0; place < meshes_of_[b].size(); ++place) {
      const Live live = live_[static_cast<size_t>(meshes_of_[b][place])];
      double* f = relaxed_.data() + relaxed_first_[b] + static_cast<int>(place) * tooth_pairs() * kFields;
      for (int i = live.first * kFields, end = live.last * kFields; i < end; i += kLanes)
        lanes(f + i) *= decay;
    }
  add_loads(relaxed_step_.from_old);
}

// To the relaxed loads a share of the present ones.
void SystemDynamics::add_loads(double share) {
  double* relaxed = relaxed_.data();
  for (const Loaded *own = loaded_.data(), *end = own + loaded_.size(); own < end; ++own) {
    const double by = share * own->force, *field = own->field;
    double* f = relaxed + own->at;
#pragma GCC unroll 3
    for (int i = 0; i < kFields; i += kLanes) lanes(f + i) += by * lanes(field + i);
  }
}

void SystemDynamics::start_gaps(const Position& position) {
  const double* gap = position.gap.data();
  double* sums = sums_.data();
  for (int k = 0, n = position.size(); k < n; ++k) lanes(sums + k * kLanes) = Lanes{gap[k], 0, 0, 0};
}

// Gaps without new contact forces.
void SystemDynamics::read_gaps(const Position& position) {
  const int n = position.size(), whole = padded(n);
  double* sums = sums_.data();
  if (!ahead_) start_gaps(position);
  for (size_t p = 0; p < part_.size(); ++p) {
    const int end = ahead_ ? part_[p].hub : part_[p].length();
    if (end > 0) subtract(position, p, 0, 0, end);
  }
  for (size_t b = 0; b < system_.body.size(); ++b) {
    const Rows& rows = position.rows[1 + b];
    const int count = rows.contacts();
    const int* contact = position.order.data() + rows.begin;
    for (size_t place = 0; place < meshes_of_[b].size(); ++place) {
      const Live& live = live_[static_cast<size_t>(meshes_of_[b][place])];
      const int from = static_cast<int>(place) * tooth_pairs() + live.first;
      const double* w = stream_.data() + rows.reading + static_cast<size_t>(from * count * kFields);
      const double* fields = relaxed_.data() + relaxed_first_[b] + from * kFields;
      in_fours(0, count, [&](auto rows_at_once, int first) {
        add_readings<kFields, rows_at_once>(w + first * kFields, count * kFields, fields,
                                            live.last - live.first, sums, contact + first);
      });
    }
    for (int c = 0; c < count; ++c)
      __builtin_prefetch(&stream_[rows.field + static_cast<size_t>(c * kFields)]);
  }
  for (int k = 0; k < whole; k += kLanes) {
    const double* four = sums + k * kLanes;
    lanes(&e_[k]) = whine::sums(lanes(four), lanes(four + 4), lanes(four + 8), lanes(four + 12));
  }
  for (int k = n; k < whole; ++k) e_[k] = 0;
  if (points_ > 1) read_uneven(position);
}

// Gaps by coordinates `from` to end - 1 of a part, of its contacts from number `first` on.
void SystemDynamics::subtract(const Position& position, size_t p, int first, int from, int end) {
  const Rows& rows = position.rows[p];
  const int length = part_[p].length();
  in_fours(first, rows.contacts(), [&](auto count, int at) {
    subtract_rows<count>(
        stream_.data() + rows.row + static_cast<size_t>(at) * static_cast<size_t>(length) + from, length,
        end - from, &z_[part_[p].first + from], sums_.data(), position.order.data() + rows.begin + at);
  });
}

// Contact forces, from what the coordinates and relaxed loads are without them.
void SystemDynamics::solve(Position& position) {
  const int n = position.size();
  for (int k = 0; k < n; ++k) p_[k] = p_of_slot_[position.contact[static_cast<size_t>(k)].slot];
  certificate_ =
      position.followed.solve(position.compliance, position.law, e_, p_.head(n), d_, position.friction);
  p_of_slot_.setZero();
  for (int k = 0; k < n; ++k) p_of_slot_[position.contact[static_cast<size_t>(k)].slot] = p_[k];
  sum_teeth();
}

// What contact forces move of the coordinates at the end of a step; parts follow one another, so what a row's whole lanes
// reach of the next part is written anew with it. Coordinates that no hub feels are taken on to the step that ends at `next`.
void SystemDynamics::push_all(const Position& position, const Position* next) {
  double *z = z_.data(), *v = v_.data(), *force = force_.data();
  const double *torque = torque_.data(), *bq = bq_.data(), *a12 = a12_.data();
  const Place through = pushing();
  const double* p = p_.data();
  const double** carrying_row = carrying_rows_.data();
  double* carrying_force = carrying_forces_.data();
  if (next) start_gaps(*next);
  for (size_t number = 0; number < part_.size(); ++number) {
    const Rows& rows = position.rows[number];
    const Part& part = part_[number];
    const int length = part.length();
    int carrying = 0;
    const int* contact = position.order.data() + rows.begin;
    const double* row = stream_.data() + rows.*through;
    for (int c = 0, count = rows.contacts(); c < count; ++c, row += length)
      if (const double own = p[contact[c]]; own > 0) {
        carrying_row[carrying] = row;
        carrying_force[carrying++] = own;
      }
    sum_rows(carrying_row, carrying_force, carrying, next ? part.hub : length,
             [=, first = part.first](int i, Lanes sum) {
               i += first;
               lanes(force + i) = lanes(torque + i) - sum;
               const Lanes half = 0.5 * sum;
               lanes(z + i) -= lanes(bq + i) * half;
               lanes(v + i) -= lanes(a12 + i) * half;
             });
    if (next && part.hub < length) run_ahead(number, carrying, *next);
  }
}

// The coordinates of a part that no hub feels, with the forces on the rows that carry, and the gaps of `next` that they move.
void SystemDynamics::run_ahead(size_t p, int carrying, const Position& next) {
  const Part& part = part_[p];
  const Rows& rows = next.rows[p];
  const int count = part.length() - part.hub, first = part.first + part.hub;
  const double** row = carrying_rows_.data();
  double* force = carrying_forces_.data();
  for (int j = 0; j < carrying; ++j) row[j] += part.hub;
  if (carrying > kLanes) {
    sum_rows(row, force, carrying, count, [to = summed_.data()](int i, Lanes sum) { lanes(to + i) = sum; });
    row[0] = summed_.data();
    force[0] = carrying = 1;
  }
  as_constant(carrying, [&](auto pushed) {
    as_constant(rows.contacts(), [&](auto read) {
      run_lanes<pushed, read>(&run_[part.run], count, row, force, &z_[first], &v_[first],
                              stream_.data() + rows.row + part.hub, part.length(), sums_.data(),
                              next.order.data() + rows.begin);
    });
  });
  subtract(next, p, 4, part.hub, part.length());
}

// Present loads, of p_ at a position.
void SystemDynamics::note_loads(const Position& position) {
  loaded_.clear();
  for (int k = 0; k < position.size(); ++k) {
    if (p_[k] == 0) continue;
    const Contact& contact = position.contact[static_cast<size_t>(k)];
    for (size_t s = 0; s < 2; ++s)
      loaded_.push_back({contact.load_at[s], field(position, contact, s).data(), p_[k]});
  }
}

// Slots with new force are live; those at the ends of which nothing is left no longer.
void SystemDynamics::keep_live() {
  const double least = kLeastRelaxed * load_of_mesh_.mean(), share = relaxed_step_.from_new;
  for (int m = 0; m < meshes(); ++m) {
    double* most = &remembered_[m * tooth_pairs()];
    const double* p = tooth_force().data() + m * tooth_pairs();
    Live now{tooth_pairs(), 0};
    for (int pair = 0; pair < tooth_pairs(); ++pair) {
      most[pair] += share * p[pair];
      if (!(most[pair] > least) && !(p[pair] > 0)) continue;
      now.first = std::min(now.first, pair);
      now.last = pair + 1;
    }
    if (now.last == 0) now.first = 0;
    const Live before = std::exchange(live_[static_cast<size_t>(m)], now);
    if (now.first > before.first || now.last < before.last) drop(m, before, now);
  }
}

void SystemDynamics::drop(int m, const Live& before, const Live& now) {
  for (int pair = before.first; pair < before.last; ++pair) {
    if (pair >= now.first && pair < now.last) continue;
    remembered_[m * tooth_pairs() + pair] = 0;
    for (size_t b = 0; b < system_.body.size(); ++b)
      for (size_t place = 0; place < meshes_of_[b].size(); ++place) {
        if (meshes_of_[b][place] != m) continue;
        const Index at = relaxed_first_[b] + (static_cast<Index>(place) * tooth_pairs() + pair) * kFields;
        relaxed_.segment<kFields>(at).setZero();
      }
  }
}

// Forces of the frame at the end of a step, of coordinates that lack them: what they move. Result: (motion) N.
VectorXd SystemDynamics::close_frame(const VectorXd& without) {
  const Index n = coordinates_.size();
  const VectorXd force = frame_.closing(without), half = 0.5 * force;
  frame_.add(half, bq_.head(n), z_.head(n));
  frame_.add(half, a12_.head(n), v_.head(n));  // bv = a12
  return force;
}

// next: position of the step after this one, null where the whole state at the end of this one is wanted.
void SystemDynamics::step(Position& position, const Position* next) {
  const Index n = coordinates_.size();
  const bool turns = frame_.turns();
  if (turns) frame_.turn(v_.head(n));
  propagate();
  relax();
  VectorXd of_frame, before;
  if (turns) {
    of_frame = close_frame(frame_.motions(z_.head(n)));
    before = frame_.motions(z_.head(n));
  }
  read_gaps(position);
  solve(position);
  push_all(position, next);
  ahead_ = next != nullptr;
  if (turns) {
    of_frame += close_frame(frame_.motions(z_.head(n)) - before);
    frame_.add(of_frame, force_.head(n));
    frame_.turn(v_.head(n));
  }
  note_loads(position);
  keep_live();
  add_loads(relaxed_step_.from_new);
  if (points_ > 1) load_uneven(position);
  if (coordinates_.rigid_pins) {
    rate_ = force_.head(n).array() - coordinates_.frequency.array().square() * z_.head(n).array() -
            (coordinates_.damping.array() - motion_.damping.rayleigh_mass) * v_.head(n).array();
    if (turns) frame_.add(-frame_.coriolis(v_.head(n)), rate_);
  }
}

// Teeth get the names that they have in the next mesh period: pair i becomes i + 1.
void SystemDynamics::rename() {
  for (VectorXd* y : {&z_, &v_})
    for (const StepSystem::Turn& turn : coordinates_.turns) {
      if (turn.sine < 0) {
        (*y)[turn.cosine] *= -1;
        continue;
      }
      const double cosine = (*y)[turn.cosine], sine = (*y)[turn.sine];
      (*y)[turn.cosine] = turn.c * cosine + turn.s * sine;
      (*y)[turn.sine] = turn.c * sine - turn.s * cosine;
    }
  const auto shift = [&](double* of, int size) {  // blocks of `size` numbers, the slots of one mesh
    std::copy_backward(of, of + (tooth_pairs() - 1) * size, of + tooth_pairs() * size);
    std::fill(of, of + size, 0.0);
  };
  for (int m = 0; m < meshes(); ++m) {
    shift(&p_of_slot_[m * tooth_pairs() * points_], points_);
    if (points_ > 1) shift(&line_load_[m * tooth_pairs() * points_], points_);
  }
  for (int block = 0; block * tooth_pairs() * kFields < relaxed_size(); ++block)
    shift(&relaxed_[block * tooth_pairs() * kFields], kFields);
}

}  // namespace whine
