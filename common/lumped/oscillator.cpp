#include "lumped/oscillator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "base/error.h"

namespace whine {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
constexpr int kMostEvents = 10000;  // in one piece; a motion that needs more is none

// (e^z - 1) / z and ((e^z - 1) / z - 1) / z for z <= 0.
double phi1(double z) {
  return z == 0 ? 1 : std::expm1(z) / z;
}
double phi2(double z) {
  if (std::abs(z) > 0.1) return (phi1(z) - 1) / z;
  double sum = 0, term = 0.5;
  for (int n = 3; n < 14; ++n) {
    sum += term;
    term *= z / n;
  }
  return sum;
}

// Gauss and Legendre's nodes and weights on (-1, 1), the positive half.
constexpr std::array<std::array<double, 2>, 4> kGauss{{{0.18343464249564980, 0.36268378337836198},
                                                       {0.52553240991632899, 0.31370664587788729},
                                                       {0.79666647741362674, 0.22238103445337447},
                                                       {0.96028985649753623, 0.10122853629037626}}};

}  // namespace

// NOLINTNEXTLINE(readability-function-size): the pieces of one period in the order of their derivation
LumpedOscillator::LumpedOscillator(const LumpedParameters& p, double force, int samples, int newmark_steps)
    : parameters_(p), force_(force), samples_(samples), newmark_steps_(newmark_steps) {
  if (!(p.mass > 0) || !std::isfinite(p.mass))
    fail(Failure::input, "lumped model: the mass is ", p.mass, " kg; it must be above 0");
  if (!(p.damper >= 0) || !std::isfinite(p.damper))
    fail(Failure::input, "lumped model: the damper is ", p.damper, " N s/m; it must be 0 or above");
  if (!(force > 0) || !std::isfinite(force))
    fail(Failure::input, "lumped model: the force is ", force, " N; it must be above 0");
  if (newmark_steps > 0 && p.damper_acts == DamperActs::contact && p.damper > 0)
    fail(
        Failure::input,
        "lumped model: Newmark's method takes the damper of Eq. 23, which acts always; for one that acts in ",
        "contact only take the exact integrator");
  if (samples < 1 || newmark_steps < 0)
    fail(Failure::input, "lumped model: ", samples, " samples and ", newmark_steps,
         " steps a period; 1 and 0 are the least");
  const Eigen::Index cells = p.cell_end.size();
  if (cells < 1 || p.stiffness.rows() != cells || p.gap.rows() != cells || p.gap.cols() != p.stiffness.cols())
    fail(Failure::input, "lumped model: ", cells, " cells, ", p.stiffness.rows(), " rows of stiffness and ",
         p.gap.rows(), " of gaps; all must be the same and at least 1");
  if (!p.stiffness.allFinite() || !p.gap.allFinite() || p.stiffness.minCoeff() < 0)
    fail(Failure::input, "lumped model: a stiffness is below 0 or a value is not finite");
  double before = 0;
  for (double end : p.cell_end) {
    if (!(end > before))
      fail(Failure::input, "lumped model: cells end at ", before, " and ", end, "; they must ascend");
    before = end;
  }
  if (before != 1)
    fail(Failure::input, "lumped model: the last cell ends at phase ", before, " instead of 1");

  // Rest in every cell, in SI, gives the units of all that follows.
  const auto sorted_springs = [&](Eigen::Index cell) {
    std::vector<std::pair<double, double>> springs;  // gap, stiffness
    for (Eigen::Index i = 0; i < p.stiffness.cols(); ++i)
      if (p.stiffness(cell, i) > 0) springs.emplace_back(p.gap(cell, i), p.stiffness(cell, i));
    std::sort(springs.begin(), springs.end());
    if (springs.empty()) fail(Failure::input, "lumped model: no spring has a stiffness in cell ", cell + 1);
    return springs;
  };
  const auto rest_under = [](const std::vector<std::pair<double, double>>& springs, double load) {
    double k = 0, kg = 0;
    for (std::size_t i = 0; i < springs.size(); ++i) {
      k += springs[i].second;
      kg += springs[i].second * springs[i].first;
      const double x = (load + kg) / k;
      if (i + 1 == springs.size() || x <= springs[i + 1].first) return std::pair{x, k};
    }
    return std::pair{0.0, 0.0};
  };
  before = 0;
  std::complex<double> harmonic = 0;
  const auto turn = [](double phase) { return std::polar(1.0, -2 * std::numbers::pi * phase); };
  for (Eigen::Index c = 0; c < cells; ++c) {
    const auto [x, k] = rest_under(sorted_springs(c), force);
    if (!(x > 0))
      fail(Failure::input, "lumped model: at rest x is ", x, " m in cell ", c + 1, "; it must be above 0");
    stiffness_ += force / x * (p.cell_end[c] - before);
    harmonic += force / x * (turn(before) - turn(p.cell_end[c]));
    cell_frequency_.push_back(std::sqrt(k / p.mass) / (2 * std::numbers::pi));
    mean_frequency_ += cell_frequency_.back() * (p.cell_end[c] - before);
    before = p.cell_end[c];
  }
  first_harmonic_ = std::abs(harmonic) / std::numbers::pi;
  length_ = force / stiffness_;
  rate_ = std::sqrt(stiffness_ / p.mass);
  frequency_ = rate_ / (2 * std::numbers::pi);

  const double damping = p.damper / (p.mass * rate_);
  for (Eigen::Index c = 0; c < cells; ++c) {
    const auto springs = sorted_springs(c);
    Cell cell{p.cell_end[c], {}};
    double k = 0, b = 1, low = -kInfinite;
    for (std::size_t i = 0; i <= springs.size(); ++i) {
      const double high = i < springs.size() ? springs[i].first / length_ : kInfinite;
      if (high > low) {
        Region r{k, k == 0 && p.damper_acts == DamperActs::contact ? 0 : damping, b, low, high, 0, kInfinite};
        const double d = r.k - 0.25 * r.d * r.d;
        r.slope = std::sqrt(std::abs(d));
        if (d > 0) r.longest = 0.5 * std::numbers::pi / r.slope;
        cell.regions.push_back(r);
        low = high;
      }
      if (i < springs.size()) {
        k += springs[i].second / stiffness_;
        b += springs[i].second / stiffness_ * high;
      }
    }
    cells_.push_back(cell);
  }
  integrating_ = pieces(newmark_steps > 0);
  recording_ = pieces(true);
}

std::vector<LumpedOscillator::Piece> LumpedOscillator::pieces(bool with_samples) const {
  std::vector<Piece> all;
  double at = 0;
  int sample = 0;
  for (int c = 0; c < static_cast<int>(cells_.size()); ++c)
    while (at < cells_[c].end) {
      const auto phase = [&](int i) { return static_cast<double>(i) / samples_; };
      const bool here = with_samples && sample < samples_ && phase(sample) <= at;
      const int next = sample + here;
      double end = cells_[c].end;
      if (with_samples && next < samples_) end = std::min(end, phase(next));
      all.push_back({c, at, end, here ? sample : -1, std::vector<Cached>(cells_[c].regions.size())});
      sample = next;
      at = end;
    }
  return all;
}

void LumpedOscillator::set_speed(double mesh_frequency) {
  if (!(mesh_frequency > 0) || !std::isfinite(mesh_frequency))
    fail(Failure::input, "lumped model: the mesh frequency is ", mesh_frequency, " Hz; it must be above 0");
  period_ = rate_ / mesh_frequency;
  for (auto* list : {&integrating_, &recording_})
    for (Piece& piece : *list)
      for (Cached& cached : piece.cache) cached.has_whole = cached.has_part = false;
}

LumpedOscillator::Flow LumpedOscillator::flow(const Region& r, double t) {
  Flow f;
  if (r.k == 0) {
    const double z = -r.d * t;
    f = {1, t * phi1(z), 0, std::exp(z), r.b * t * t * phi2(z), r.b * t * phi1(z)};
    return f;
  }
  const double s = 0.5 * r.d;
  double c, q;  // e^(-s t) times cos and sin / slope, or their hyperbolic kin
  if (r.longest < kInfinite) {
    const double e = std::exp(-s * t);
    c = e * std::cos(r.slope * t);
    q = e * std::sin(r.slope * t) / r.slope;
  } else {
    const double fast = s + r.slope, slow = r.k / fast, e1 = std::exp(-slow * t), e2 = std::exp(-fast * t);
    c = 0.5 * (e1 + e2);
    q = r.slope * t > 1e-8 ? 0.5 * (e1 - e2) / r.slope : t * e2;
  }
  f.a11 = c + s * q;
  f.a12 = q;
  f.a21 = -r.k * q;
  f.a22 = c - s * q;
  f.px = (1 - f.a11) * (r.b / r.k);
  f.pv = r.b * q;
  return f;
}

// On the border of two regions the motion is in the one that it goes to.
int LumpedOscillator::region_of(const Cell& cell, double x, double v) {
  int i = 0;
  while (i + 1 < static_cast<int>(cell.regions.size()) && x > cell.regions[i].high) ++i;
  const Region& r = cell.regions[i];
  if (x == r.high && (v > 0 || (v == 0 && r.b - r.k * x > 0))) ++i;
  return i;
}

double LumpedOscillator::rest_in(const Cell& cell) {
  for (const Region& r : cell.regions)
    if (r.k > 0 && r.b / r.k <= r.high) return r.b / r.k;
  return 0;
}

double LumpedOscillator::potential(int cell, double x) const {
  double sum = 0;
  for (Eigen::Index i = 0; i < parameters_.stiffness.cols(); ++i) {
    const double u = std::max(0.0, x - parameters_.gap(cell, i) / length_);
    sum += 0.5 * parameters_.stiffness(cell, i) / stiffness_ * u * u;
  }
  return sum;
}

// visit(region, x, v, time, x at its end, v at its end) sees every part between events.
template <class Visit>
// NOLINTNEXTLINE(readability-function-size): one loop over events, whose parts share all of its state
void LumpedOscillator::run_exact(Piece& piece, double& x, double& v, Matrix* derivative, const Visit& visit) {
  const Cell& cell = cells_[piece.cell];
  const double length = (piece.end - piece.begin) * period_;
  double left = length;
  int at = region_of(cell, x, v), events = 0;
  const auto apply = [](const Flow& f, double x0, double v0, double& x1, double& v1) {
    x1 = f.a11 * x0 + f.a12 * v0 + f.px;
    v1 = f.a21 * x0 + f.a22 * v0 + f.pv;
  };
  const auto derive = [&](const Flow& f) {
    if (!derivative) return;
    Matrix step;
    step << f.a11, f.a12, f.a21, f.a22;
    *derivative = step * *derivative;
  };
  while (left > 0) {
    const Region& r = cell.regions[at];
    Cached& cached = piece.cache[at];
    // Its energy keeps a damped oscillator within this amplitude about rest.
    if (r.k > 0) {
      const double rest = r.b / r.k, u = x - rest, reach = std::sqrt(u * u + v * v / r.k);
      if (rest - reach > r.low && rest + reach < r.high) {
        if (left == length && !cached.has_whole) {
          cached.whole = flow(r, left);
          cached.has_whole = true;
        }
        const Flow whole = left == length ? cached.whole : flow(r, left);
        const double x0 = x, v0 = v;
        apply(whole, x0, v0, x, v);
        derive(whole);
        visit(r, x0, v0, left, x, v);
        return;
      }
    }
    const double parts = std::max(1.0, std::ceil(left / r.longest)), h = left / parts;
    if (left == length && !cached.has_part) {
      cached.part = flow(r, h);
      cached.has_part = true;
    }
    const Flow part = left == length ? cached.part : flow(r, h);
    bool crossed = false;
    for (int i = 0; i < static_cast<int>(parts) && !crossed; ++i) {
      double x1, v1;
      apply(part, x, v, x1, v1);
      // Root of x - border (or of v) between times a < b at which it has signs `sign_a` and the other.
      const auto root = [&](double border, bool of_velocity, double a, double b, bool falling) {
        double t = 0.5 * (a + b);
        for (int n = 0; n < 200; ++n) {
          double xt, vt;
          apply(flow(r, t), x, v, xt, vt);
          const double value = of_velocity ? vt : xt - border;
          const double slope = of_velocity ? r.b - r.d * vt - r.k * xt : vt;
          ((value > 0) == falling ? a : b) = t;
          double next = t - value / slope;
          if (!(next > a && next < b)) next = 0.5 * (a + b);
          if (value == 0 || next == t || next <= a || next >= b) break;
          if (std::abs(next - t) < 4e-16 * h) {
            t = next;
            break;
          }
          t = next;
        }
        return t;
      };
      double event = -1;
      bool upwards = false;
      if (v < 0 ? v1 > 0 : v > 0 && v1 < 0) {
        const double turn = root(0, true, 0, h, v > 0);
        double xt, vt;
        apply(flow(r, turn), x, v, xt, vt);
        if (v < 0 && xt < r.low)
          event = root(r.low, false, 0, turn, true);
        else if (v > 0 && xt > r.high)
          event = root(r.high, false, 0, turn, false), upwards = true;
        else if (x1 > r.high)
          event = root(r.high, false, turn, h, false), upwards = true;
        else if (x1 < r.low)
          event = root(r.low, false, turn, h, true);
      } else if (x1 > r.high) {
        event = root(r.high, false, 0, h, false), upwards = true;
      } else if (x1 < r.low) {
        event = root(r.low, false, 0, h, true);
      }
      const double x0 = x, v0 = v;
      if (event < 0) {
        x = x1;
        v = v1;
        left = i + 1 == static_cast<int>(parts) ? 0 : left - h;
        derive(part);
        visit(r, x0, v0, h, x, v);
        continue;
      }
      const Flow f = flow(r, event);
      apply(f, x0, v0, x, v);
      derive(f);
      x = upwards ? r.high : r.low;
      visit(r, x0, v0, event, x, v);
      left = std::max(0.0, left - event);
      at += upwards ? 1 : -1;
      if (derivative && cell.regions[at].d != r.d) {
        Matrix saltation = Matrix::Identity();
        saltation(1, 0) = r.d - cell.regions[at].d;
        *derivative = saltation * *derivative;
      }
      crossed = true;
      if (++events > kMostEvents)
        fail(Failure::numerical, "lumped model: more than ", kMostEvents, " contacts come and go within ",
             piece.end - piece.begin, " of a mesh period");
    }
  }
}

template <class Visit>
void LumpedOscillator::run_newmark(const Piece& piece, double& x, double& v, Matrix* derivative,
                                   const Visit& visit) const {
  const Cell& cell = cells_[piece.cell];
  const double share = piece.end - piece.begin;
  const int steps = std::max(1, static_cast<int>(std::ceil(share * newmark_steps_ * (1 - 1e-12))));
  const double h = share * period_ / steps, d = cell.regions[0].d;
  const Region* now = &cell.regions[region_of(cell, x, v)];
  // Begins anew from equilibrium in every cell: the acceleration steps with the stiffness.
  double a = now->b - d * v - now->k * x;
  for (int i = 0; i < steps; ++i) {
    const double inertia = 4 / (h * h) + 2 * d / h,
                 load = 4 / (h * h) * (x + h * v) + a + d * (2 / h * x + v);  // and b
    const Region* next = &cell.regions.back();
    for (const Region& r : cell.regions)
      if ((load + r.b) / (inertia + r.k) <= r.high) {
        next = &r;
        break;
      }
    const double x1 = (load + next->b) / (inertia + next->k), v1 = 2 / h * (x1 - x) - v,
                 a1 = next->b - d * v1 - next->k * x1;
    if (derivative) {
      Matrix step;
      step(0, 0) = (inertia - now->k) / (inertia + next->k);
      step(0, 1) = 4 / h / (inertia + next->k);
      step(1, 0) = 2 / h * (step(0, 0) - 1);
      step(1, 1) = 2 / h * step(0, 1) - 1;
      *derivative = step * *derivative;
    }
    const double x0 = x, v0 = v;
    x = x1;
    v = v1;
    a = a1;
    now = next;
    visit(*now, x0, v0, h, x, v);
  }
}

void LumpedOscillator::integrate(State& state, Matrix* derivative) {
  double x = state[0] / length_, v = state[1] / (length_ * rate_);
  const auto nothing = [](const Region&, double, double, double, double, double) {};
  Matrix own = Matrix::Identity();
  Matrix* const wanted = derivative ? &own : nullptr;
  for (Piece& piece : integrating_)
    if (newmark_steps_ > 0)
      run_newmark(piece, x, v, wanted, nothing);
    else
      run_exact(piece, x, v, wanted, nothing);
  state = State(x * length_, v * length_ * rate_);
  if (!derivative) return;
  own(0, 1) /= rate_;
  own(1, 0) *= rate_;
  *derivative = own * *derivative;
}

LumpedRecord LumpedOscillator::record(State& state, LumpedEnergyBalance& energy_balance) {
  const Eigen::Index springs = parameters_.stiffness.cols();
  LumpedRecord out;
  out.x.resize(samples_);
  out.load.resize(samples_, springs);
  out.least = kInfinite;
  double x = state[0] / length_, v = state[1] / (length_ * rate_);
  double integral = 0, square = 0, damping = 0, work = 0, throughput = 0, switching = 0;
  const double kinetic = 0.5 * v * v, spring = potential(recording_.front().cell, x);
  int cell = recording_.front().cell;
  bool apart = region_of(cells_[cell], x, v) == 0;
  const bool exact = newmark_steps_ == 0;
  const auto visit = [&](const Region& r, double x0, double v0, double time, double x1, double v1) {
    if (exact) {
      const int parts = r.longest < kInfinite ? std::max(1, static_cast<int>(std::ceil(2 * time / r.longest)))
                                              : 1 + static_cast<int>(4 * time * std::max(1.0, r.d));
      const double half = 0.5 * time / parts;
      for (int i = 0; i < parts; ++i)
        for (const auto& [node, weight] : kGauss)
          for (double side : {-1.0, 1.0}) {
            const Flow f = flow(r, half * (2 * i + 1 + side * node));
            const double xt = f.a11 * x0 + f.a12 * v0 + f.px, vt = f.a21 * x0 + f.a22 * v0 + f.pv;
            integral += half * weight * (xt - 1);
            square += half * weight * (xt - 1) * (xt - 1);
            damping += half * weight * r.d * vt * vt;
          }
    } else {
      // Trapezoidal, as the method takes x; its damper works at the mean velocity.
      integral += 0.5 * time * (x0 + x1 - 2);
      square += 0.5 * time * ((x0 - 1) * (x0 - 1) + (x1 - 1) * (x1 - 1));
      damping += r.d * (x1 - x0) * (x1 - x0) / time;
    }
    work += x1 - x0;
    throughput += std::abs(x1 - x0);
    out.least = std::min(out.least, x1);
    out.largest_exit = std::max({out.largest_exit, r.low - x1, x1 - r.high});
    const bool now = r.k == 0;
    if (now && !apart) ++out.separations;
    apart = now;
    (void)v1;
  };
  for (Piece& piece : recording_) {
    if (piece.cell != cell) {
      const double step = potential(piece.cell, x) - potential(cell, x);
      switching += step;
      throughput += std::abs(step);
      cell = piece.cell;
    }
    if (piece.sample >= 0) {
      out.x[piece.sample] = x * length_;
      for (Eigen::Index i = 0; i < springs; ++i)
        out.load(piece.sample, i) =
            parameters_.stiffness(cell, i) * std::max(0.0, x * length_ - parameters_.gap(cell, i));
    }
    if (exact)
      run_exact(piece, x, v, nullptr, visit);
    else
      run_newmark(piece, x, v, nullptr, visit);
  }
  // Back to the springs of phase 0, where the next period begins.
  const int first = recording_.front().cell;
  const double last = potential(first, x) - potential(cell, x);
  switching += last;
  throughput += std::abs(last);
  state = State(x * length_, v * length_ * rate_);

  const double energy = force_ * length_;
  energy_balance.kinetic += energy * (0.5 * v * v - kinetic);
  energy_balance.spring += energy * (potential(first, x) - spring);
  energy_balance.force += energy * work;
  energy_balance.switching += energy * switching;
  energy_balance.damping += energy * damping;
  energy_balance.throughput += energy * throughput;
  out.mean = length_ * (1 + integral / period_);
  out.mean_square = length_ * length_ * square / period_;
  out.least *= length_;
  out.largest_exit *= length_;
  return out;
}

std::vector<LumpedCrossing> LumpedOscillator::crossings(State state) {
  std::vector<LumpedCrossing> all;
  double x = state[0] / length_, v = state[1] / (length_ * rate_), time = 0;
  int border = -1;  // that x is above; -1: not known
  for (Piece& piece : integrating_) {
    const std::vector<Region>& regions = cells_[piece.cell].regions;
    const auto visit = [&](const Region& r, double, double, double duration, double, double) {
      const int now = static_cast<int>(&r - regions.data());
      for (; border >= 0 && border < now; ++border) all.push_back({border + 1, true, time / period_});
      for (; border > now; --border) all.push_back({border, false, time / period_});
      border = now;
      time += duration;
    };
    if (newmark_steps_ > 0)
      run_newmark(piece, x, v, nullptr, visit);
    else
      run_exact(piece, x, v, nullptr, visit);
  }
  return all;
}

double LumpedOscillator::frequency_at(double phase) const {
  const double wrapped = phase - std::floor(phase);
  std::size_t c = 0;
  while (c + 1 < cells_.size() && cells_[c].end <= wrapped) ++c;
  return cell_frequency_[c];
}

LumpedOscillator::State LumpedOscillator::rest() const {
  return State(rest_in(cells_.front()) * length_, 0);
}

double LumpedOscillator::size(const State& difference) const {
  return std::hypot(difference[0] / length_, difference[1] / (length_ * rate_));
}

}  // namespace whine
