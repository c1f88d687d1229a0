#include "contact/strip_compliance.h"

#include <algorithm>

namespace whine {

namespace {

static_assert(kZoneNodes == 6);  // as add_six_columns has it

bool any(const double* x) {
  return x[0] != 0 || x[1] != 0 || x[2] != 0 || x[3] != 0;
}

}  // namespace

void StripCompliance::add_product(const double* p, double* nodes, double* gap) const {
  const int rows = kPairNodes * pairs;
  alignas(Lanes) double at_node[kPairNodes * kMostPairs];
  std::fill(at_node, at_node + rows, 0.0);
  for (int j = 0; j < pairs; ++j) {
    const double* own = p + j * strips;
    int first = strips, last = 0;  // lanes that have force
    for (int s = 0; s < strips; s += kLanes)
      if (any(own + s)) {
        first = std::min(first, s);
        last = s + kLanes;
      }
    double* moment = nodes + j * kPairNodes;
    if (first < last) {
      add_columns(gap + j * strips, half_plane[j] + first * strips, strips, own + first, last - first, 0,
                  strips);
      dot_columns(moment, interpolation[j], strips, kPairNodes, own, strips);
      add_columns(at_node, at_nodes + j * kZoneNodes * rows, rows, moment, kZoneNodes, 0, rows);
    } else {
      std::fill(moment, moment + kPairNodes, 0.0);
    }
  }
  for (int j = 0; j < pairs; ++j) {
    double* own = gap + j * strips;
    add_six_columns(own, own, interpolation[j], strips, at_node + j * kPairNodes, 1, strips);
  }
}

void StripCompliance::put_column(int strip, const int* first, const int* last, double* column) const {
  const int rows = kPairNodes * pairs, own = strip / strips, s = strip % strips;
  alignas(Lanes) double at_node[kPairNodes * kMostPairs];
  constexpr double kNothing[kPairNodes] = {};
  for (int j = 0; j < pairs; ++j)
    add_six_columns(at_node + j * kPairNodes, kNothing, at_nodes + own * kZoneNodes * rows + j * kPairNodes,
                    rows, interpolation[own] + s, strips, kPairNodes);
  for (int j = 0; j < pairs; ++j) {
    double* to = column + j * strips;
    const double* before = to;
    if (j == own)
      before = half_plane[own] + s * strips;
    else
      std::fill(to + first[j], to + last[j], 0.0);
    add_six_columns(to + first[j], before + first[j], interpolation[j] + first[j], strips,
                    at_node + j * kPairNodes, 1, last[j] - first[j]);
  }
}

void StripCompliance::assemble(double* a) const {
  int first[kMostPairs] = {}, last[kMostPairs];
  std::fill(last, last + pairs, strips);
  for (int s = 0; s < size(); ++s) put_column(s, first, last, a + s * size());
}

void StripCompliance::assemble_columns(const std::vector<int>& columns, const std::vector<int>& rows,
                                       double* a) const {
  int first[kMostPairs] = {}, last[kMostPairs] = {};
  for (int s : rows) {
    const int j = s / strips, i = s % strips / kLanes * kLanes;
    if (last[j] == 0) first[j] = i;
    last[j] = i + kLanes;
  }
  for (int s : columns) put_column(s, first, last, a + s * size());
}

}  // namespace whine
