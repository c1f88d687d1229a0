// Time steps of rolling gears: how long one takes, what it computes and moves, and what the machine could.
#pragma once
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include "base/error.h"
#include "contact/lanes.h"
#include "dynamics/dynamics.h"
#include "studies/sweep.h"
#include "system/statics.h"

namespace whine {

// s of CPU of this thread.
inline double cpu_now() {
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Least CPU s of `repeats` calls.
template <class Call>
double least_seconds(int repeats, Call call) {
  double least = 1e300;
  for (int i = 0; i < repeats; ++i) {
    const double start = cpu_now();
    call();
    least = std::min(least, cpu_now() - start);
  }
  return least;
}

// Flops per second of fused multiply-adds that stay in registers: ten chains of four lanes.
inline double peak_flops() {
  constexpr int kCount = 200000;
  Lanes a[10];
  for (int k = 0; k < 10; ++k) a[k] = Lanes{1, 1, 1, 1} * (1 + k);
  Lanes b = Lanes{1, 1, 1, 1} * 0.999999, c = b * 1e-9;
  const double seconds = least_seconds(20, [&] {
    Lanes a0 = a[0], a1 = a[1], a2 = a[2], a3 = a[3], a4 = a[4], a5 = a[5], a6 = a[6], a7 = a[7], a8 = a[8],
          a9 = a[9];
    for (int i = 0; i < kCount; ++i) {
      a0 = a0 * b + c;
      a1 = a1 * b + c;
      a2 = a2 * b + c;
      a3 = a3 * b + c;
      a4 = a4 * b + c;
      a5 = a5 * b + c;
      a6 = a6 * b + c;
      a7 = a7 * b + c;
      a8 = a8 * b + c;
      a9 = a9 * b + c;
      asm volatile("" : "+x"(a0), "+x"(a1), "+x"(a2), "+x"(a3), "+x"(a4));
    }
    a[0] = a0 + a1 + a2 + a3 + a4 + a5 + a6 + a7 + a8 + a9;
  });
  volatile double sink = sum(a[0]);
  (void)sink;
  return 2.0 * kLanes * 10 * kCount / seconds;
}

// Bytes per second read in order from a block of that size, again and again.
inline double load_bandwidth(size_t bytes) {
  const std::vector<double> block(bytes / sizeof(double), 1.0);
  const size_t n = block.size() / (8 * kLanes) * 8 * kLanes;
  const int passes = static_cast<int>(std::max<size_t>(1, (16u << 20) / bytes));
  Lanes total{};
  const double seconds = least_seconds(20, [&] {
    Lanes s[8] = {};
    for (int pass = 0; pass < passes; ++pass) {
      const double* x = block.data();
      Lanes s0{}, s1{}, s2{}, s3{}, s4{}, s5{}, s6{}, s7{};
      for (size_t i = 0; i < n; i += 8 * kLanes) {
        s0 += lanes(x + i);
        s1 += lanes(x + i + 4);
        s2 += lanes(x + i + 8);
        s3 += lanes(x + i + 12);
        s4 += lanes(x + i + 16);
        s5 += lanes(x + i + 20);
        s6 += lanes(x + i + 24);
        s7 += lanes(x + i + 28);
      }
      s[pass % 8] += (s0 + s1 + s2 + s3) + (s4 + s5 + s6 + s7);
      asm volatile("" ::: "memory");
    }
    for (const Lanes& one : s) total += one;
  });
  volatile double sink = sum(total);
  (void)sink;
  return static_cast<double>(n * sizeof(double)) * passes / seconds;
}

// What a step works on; whole lanes.
struct StepSizes {
  int coordinates = 0;  // of both gears
  int pairs = 0;        // present
  int rows = 0;         // functions of a pair that modes go through
  int nodes = 0;        // of a pair
  int strips = 0;       // of a pair
  int edges = 0;        // candidate zones that end at a tip edge, and are like no other
  int fields = 0;       // residual, of one tooth
  int shared = 0;       // of them, those that other teeth depend on
  int teeth = 0;        // whose relaxed load is followed, per gear
};

// Work of one step, counted from sizes. n coordinates, T teeth of F fields (S of them shared by neighbours) followed per gear,
// P pairs of r shape rows, N nodes and s strips each, L of them with force, M = P s, k strips that touch. Flops, a
// multiply-add as two:
//   modes          12 n (propagator 8, share of the new force 4)
//   relaxed        2 T F + 4 L F (both gears)
//   modes read     2 P r n        and loaded: 2 L r n
//   relaxed read   strips: 4 P F N + 6 P F;                        lines, which hold the product: 4 P (T S + F - S)
//   relaxed loaded strips: 4 L F N + 4 L (F^2 + (P - 1) S^2);      lines: 2 L F
//   strips only: basis 2 (P + L) N r, interpolation 2 s (6 P + N L), contact problem 2 k^2 (inverse) and the gaps of all
// strips:
//   2 s k + 12 N P L + 12 s P (half-planes, between nodes, to strips)
// Laws and Newton steps of lines, signs and certificates are not counted. Bytes are those of other places in memory at each
// step: shapes, weights, gaps, compliance between nodes and the inverse on the strips that touch; what steps share (modal
// vectors and fields, candidate zones without an edge) stays in the first caches.
struct StepWork {
  double flops = 0, bytes = 0;
};
inline StepWork counted_work(const StepSizes& s, int loaded, int touching) {
  const double n = s.coordinates, P = s.pairs, L = loaded, r = s.rows, F = s.fields, S = s.shared,
               T = s.teeth, N = s.nodes, M = P * s.strips, k = touching;
  StepWork w;
  w.flops = 12 * n + 2 * T * F + 4 * L * F + 2 * (P + L) * r * n;
  w.bytes = P * r * n;
  if (N > 1) {
    w.flops += 4 * P * F * N + 6 * P * F + 4 * L * F * N + 4 * L * (F * F + (P - 1) * S * S) +
               2 * (P + L) * N * r + 2 * s.strips * (kZoneNodes * P + N * L) + 2 * k * k + 2 * s.strips * k +
               12 * N * P * L + 12 * s.strips * P;
    w.bytes += 2 * P * N * F + M + 6 * N * P * P + k * padded(touching) + s.edges * s.strips * (s.strips + N);
  } else {
    w.flops += 4 * P * (T * S + F - S) + 2 * L * F;
    w.bytes += P * (2 * (T * S + F - S) + 2 * F + kLanes) + P * P;
  }
  w.bytes *= sizeof(double);
  return w;
}

// A pair as a sweep sets it up, steady at one speed.
class RollingRig {
 public:
  RollingRig(const GearMeshModel& model, const StaticResult& statics, const SweepParameters& settings)
      : dynamics_(model,
                  dynamic_parameters(statics, statics.mean_stiffness, settings, settings.frequency_to)),
        settings_(settings) {
    finest_ = settings.time.steps_per_period;
    while (finest_ * settings.frequency_from < settings.time.min_sample_rate) finest_ *= 2;
    dynamics_.set_zone(candidate_zone(model, statics, MotionBounds(model, statics)), finest_);
  }
  void run_to_orbit(double frequency) {
    steps = settings_.time.steps_per_period;
    while (steps * frequency < settings_.time.min_sample_rate) steps *= 2;
    dynamics_.set_speed(frequency, steps);
    state = dynamics_.rest();
    for (int i = 0; i < 200; ++i) integrate(nullptr);
  }
  void integrate(EnergyBalance* energy_balance) {
    if (!dynamics_.integrate(state, period, energy_balance))
      fail(Failure::numerical, "the contact of the bench leaves its candidate zone");
  }
  RollingDynamics& dynamics() { return dynamics_; }
  StepSizes sizes(int sample) const {
    const MeshPosition& mesh =
        dynamics_.positions()[static_cast<size_t>(sample) * static_cast<size_t>(finest_ / steps)].mesh;
    const bool lines = !mesh.law.empty();
    StepSizes out;
    out.coordinates = dynamics_.kernel().coordinates();
    out.pairs = static_cast<int>(mesh.pairs.size());
    out.rows = lines ? 1 : StepKernel::kShapeRows;
    out.nodes = lines ? 1 : StepKernel::kPairNodes;
    out.strips = out.pairs > 0 ? mesh.strips() / out.pairs : 0;
    for (const PairStrips& strips : mesh.pairs)
      out.edges += !lines && (strips.low_is_edge || strips.high_is_edge);
    out.fields = StepKernel::kFields;
    out.shared = StepKernel::kSharedFields;
    out.teeth = 2 * dynamics_.reach() + 1;
    return out;
  }

  RollingDynamics::State state;
  RollingDynamics::Period period;
  int steps = 0;

 private:
  RollingDynamics dynamics_;
  const SweepParameters& settings_;
  int finest_ = 0;
};

}  // namespace whine
