// One time step of a system: all that knows how the rows of a position lie in memory.
#include <algorithm>
#include <cmath>
#include <type_traits>

#include "base/error.h"
#include "contact/lanes.h"
#include "dynamics/system_dynamics.h"

namespace whine {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

constexpr double kLeastRelaxed = 1e-20;  // of the mean load of the meshes

// visit(rows, first): contacts in fours from number `first` on, then what is left; rows is a constant.
template <class Visit>
void in_fours(int count, const Visit& visit) {
  int first = 0;
  for (; first + 4 <= count; first += 4) visit(std::integral_constant<int, 4>(), first);
  switch (count - first) {
    case 3:
      return visit(std::integral_constant<int, 3>(), first);
    case 2:
      return visit(std::integral_constant<int, 2>(), first);
    case 1:
      return visit(std::integral_constant<int, 1>(), first);
    default:
      return;
  }
}

// sum[i] -= row[i] . z lane by lane, rows one after the other; of few rows two sums each, which do not wait for each other.
template <int kRows>
void subtract_rows(const double* rows, int length, const double* z, double* sums, const int* contact) {
  constexpr bool kTwice = kRows < 4;
  Lanes total[kRows], other[kRows] = {};
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) total[r] = lanes(sums + contact[r] * kLanes);
  int i = 0;
  for (; kTwice && i + 2 * kLanes <= length; i += 2 * kLanes)
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
      total[r] -= lanes(rows + r * length + i) * lanes(z + i);
      other[r] -= lanes(rows + r * length + i + kLanes) * lanes(z + i + kLanes);
    }
  for (; i < length; i += kLanes)
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) total[r] -= lanes(rows + r * length + i) * lanes(z + i);
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) lanes(sums + contact[r] * kLanes) = kTwice ? total[r] + other[r] : total[r];
}

// sum[i] += w[i] . fields of all pairs, which lie `apart` from one another in w.
template <int kRows>
void add_readings(const double* w, int apart, const double* fields, int pairs, double* sums,
                  const int* contact) {
  constexpr int kFields = SystemDynamics::kFields;
  Lanes total[kRows], other[kRows] = {};
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) total[r] = lanes(sums + contact[r] * kLanes);
  for (int pair = 0; pair < pairs; ++pair, w += apart, fields += kFields)
#pragma GCC unroll 4
    for (int r = 0; r < kRows; ++r) {
      const double* of = w + r * kFields;
      total[r] += lanes(of) * lanes(fields) + lanes(of + 4) * lanes(fields + 4);
      other[r] += lanes(of + 8) * lanes(fields + 8);
    }
#pragma GCC unroll 4
  for (int r = 0; r < kRows; ++r) lanes(sums + contact[r] * kLanes) = total[r] + other[r];
}

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
  torque_.head(n) = coordinates_.torque;
  if (slides() && motion_.output >= 0)
    torque_.head(n) += motion_.loss.dot(friction_) * coordinates_.turning(motion_.output);
  if (frame_.turns()) {
    frame_.set_step(step_, bq_.head(n));
    frame_.add(frame_.constant(), torque_.head(n));
  }
  relaxed_step_ = relaxation_step(relaxation_, step_);
  for (VectorXd* x : {&relaxed_, &load_}) x->setZero(relaxed_size());
  p_of_slot_.setZero(slots());
  for (VectorXd* x : {&p_of_tooth_, &remembered_}) x->setZero(meshes() * tooth_pairs());
  if (points_ > 1)
    for (VectorXd* x : {&line_load_, &present_line_load_, &next_line_load_}) x->setZero(slots());
  live_.assign(static_cast<size_t>(meshes()), {});
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
  line_load_ = state.line_load;
  if (points_ > 1) {
    present_line_load_.setZero();
    for (int k = 0; k < position.size(); ++k)
      present_line_load_[position.contact[static_cast<size_t>(k)].slot] = p_[k] / position.width[k];
  }
  load_.setZero();
  load(position, p_, load_);
  find_live();
}

// Of a state from outside: what it has of relaxed and present loads.
void SystemDynamics::find_live() {
  remembered_.setZero();
  for (size_t b = 0; b < system_.body.size(); ++b)
    for (size_t place = 0; place < meshes_of_[b].size(); ++place)
      for (int pair = 0; pair < tooth_pairs(); ++pair) {
        const Index at = relaxed_first_[b] + (static_cast<Index>(place) * tooth_pairs() + pair) * kFields;
        double& most = remembered_[meshes_of_[b][place] * tooth_pairs() + pair];
        most = std::max({most, relaxed_.segment<kFields>(at).cwiseAbs().maxCoeff(),
                         load_.segment<kFields>(at).cwiseAbs().maxCoeff()});
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

// Coordinates and relaxed loads at the end of a step, without new contact forces.
void SystemDynamics::propagate() {
  const auto whole = static_cast<int>(z_.size()) / kLanes * kLanes;
  double *z = z_.data(), *v = v_.data();
  const double *force = force_.data(), *torque = torque_.data(), *a11 = a11_.data(), *a12 = a12_.data(),
               *a21 = a21_.data(), *a22 = a22_.data(), *bq = bq_.data();
  for (int i = 0; i < whole; i += kLanes) {
    const Lanes mean = 0.5 * (lanes(force + i) + lanes(torque + i)), before = lanes(z + i),
                speed = lanes(v + i);
    lanes(z + i) = lanes(a11 + i) * before + lanes(a12 + i) * speed + lanes(bq + i) * mean;
    lanes(v + i) = lanes(a21 + i) * before + lanes(a22 + i) * speed + lanes(a12 + i) * mean;  // bv = a12
  }
  remembered_ = relaxed_step_.decay * remembered_ + relaxed_step_.from_old * p_of_tooth_.cwiseAbs();
  if (points_ > 1)
    line_load_ = relaxed_step_.decay * line_load_ + relaxed_step_.from_old * present_line_load_;
  each_live([&](double* f, const double* l, int count) {
    for (const double* end = f + count; f < end; f += kLanes, l += kLanes)
      lanes(f) = relaxed_step_.decay * lanes(f) + relaxed_step_.from_old * lanes(l);
  });
}

// Gaps without new contact forces.
void SystemDynamics::read_gaps(const Position& position) {
  const int n = position.size(), whole = padded(n);
  double* sums = sums_.data();
  for (int k = 0; k < n; ++k) lanes(sums + k * kLanes) = Lanes{position.gap[k], 0, 0, 0};
  for (size_t p = 0; p < part_.size(); ++p) {
    const Rows& rows = position.rows[p];
    const int* contact = position.order.data() + rows.begin;
    const int length = part_[p].length();
    in_fours(rows.contacts(), [&](auto count, int first) {
      subtract_rows<count>(
          stream_.data() + rows.row + static_cast<size_t>(first) * static_cast<size_t>(length), length,
          &z_[part_[p].first], sums, contact + first);
    });
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
      in_fours(count, [&](auto rows_at_once, int first) {
        add_readings<rows_at_once>(w + first * kFields, count * kFields, fields, live.last - live.first, sums,
                                   contact + first);
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
// reach of the next part is written anew with it.
void SystemDynamics::push_all(const Position& position) {
  double *z = z_.data(), *v = v_.data(), *force = force_.data();
  const double *torque = torque_.data(), *bq = bq_.data(), *a12 = a12_.data();
  const Place through = pushing();
  for (size_t p = 0; p < part_.size(); ++p) {
    const Rows& rows = position.rows[p];
    const int length = part_[p].length(), first = part_[p].first;
    const double** row = carrying_rows_.data();
    double* pushed = carrying_forces_.data();
    int carrying = 0;
    const auto add = [&](int i, Lanes sum) {
      lanes(force + i) = lanes(torque + i) - sum;
      const Lanes half = 0.5 * sum;
      lanes(z + i) -= lanes(bq + i) * half;
      lanes(v + i) -= lanes(a12 + i) * half;
    };
    for (int c = 0; c < rows.contacts(); ++c)
      if (const double own = p_[position.order.data()[rows.begin + c]]; own > 0) {
        row[carrying] = &stream_[rows.*through + static_cast<size_t>(c * length)];
        pushed[carrying++] = own;
      }
    int i = 0;
    for (; i + 2 * kLanes <= length; i += 2 * kLanes) {
      Lanes sum{}, next{};
      for (int c = 0; c < carrying; ++c) {
        sum += pushed[c] * lanes(row[c] + i);
        next += pushed[c] * lanes(row[c] + i + kLanes);
      }
      add(first + i, sum);
      add(first + i + kLanes, next);
    }
    if (i < length) {
      Lanes sum{};
      for (int c = 0; c < carrying; ++c) sum += pushed[c] * lanes(row[c] + i);
      add(first + i, sum);
    }
  }
}

// Present loads, and relaxed loads at the end of a step.
void SystemDynamics::load_all(const Position& position) {
  each_live([&](double*, double* l, int count) { std::fill_n(l, count, 0.0); });
  for (int k = 0; k < position.size(); ++k) {
    if (!(p_[k] > 0)) continue;
    const Contact& contact = position.contact[static_cast<size_t>(k)];
    for (size_t s = 0; s < 2; ++s) {
      double* to = &load_[contact.load_at[s]];
      const double* from = field(position, contact, s).data();
      for (int i = 0; i < kFields; i += kLanes) lanes(to + i) += p_[k] * lanes(from + i);
    }
  }
  keep_live();
  each_live([&](double* f, const double* l, int count) {
    for (const double* end = f + count; f < end; f += kLanes, l += kLanes)
      lanes(f) += relaxed_step_.from_new * lanes(l);
  });
}

// Slots with new force are live; those at the ends of which nothing is left no longer.
void SystemDynamics::keep_live() {
  const double least = kLeastRelaxed * load_of_mesh_.mean();
  remembered_ += relaxed_step_.from_new * p_of_tooth_;
  for (int m = 0; m < meshes(); ++m) {
    const double* most = &remembered_[m * tooth_pairs()];
    const double* p = &p_of_tooth_[m * tooth_pairs()];
    const auto left = [&](int pair) { return most[pair] > least || p[pair] > 0; };
    Live &live = live_[static_cast<size_t>(m)], before = live;
    live = {0, tooth_pairs()};
    while (live.last > 0 && !left(live.last - 1)) --live.last;
    while (live.first < live.last && !left(live.first)) ++live.first;
    if (live.first > before.first || live.last < before.last) drop(m, before, live);
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
        load_.segment<kFields>(at).setZero();
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

void SystemDynamics::step(Position& position) {
  const Index n = coordinates_.size();
  const bool turns = frame_.turns();
  if (turns) frame_.turn(v_.head(n));
  propagate();
  VectorXd of_frame, before;
  if (turns) {
    of_frame = close_frame(frame_.motions(z_.head(n)));
    before = frame_.motions(z_.head(n));
  }
  read_gaps(position);
  solve(position);
  push_all(position);
  if (turns) {
    of_frame += close_frame(frame_.motions(z_.head(n)) - before);
    frame_.add(of_frame, force_.head(n));
    frame_.turn(v_.head(n));
  }
  load_all(position);
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
