#include "contact/strip_compliance.h"

#include <algorithm>

namespace whine {

namespace {

bool any(const double* x) {
  return x[0] != 0 || x[1] != 0 || x[2] != 0 || x[3] != 0;
}

}  // namespace

void StripCompliance::add_product(const double* p, double* nodes, double* gap) const {
  static_assert(kWindowNodes == 6 && kPairNodes == 2 * kLanes);
  const int rows = kPairNodes * pairs;
  alignas(Lanes) double at_node[kPairNodes * kMostPairs] = {};
  for (int j = 0; j < pairs; ++j) {
    const double* own = p + j * strips;
    bool loaded = false;
    for (int s = 0; s < strips; s += kLanes)
      if (any(own + s)) {
        loaded = true;
        add_columns(gap + j * strips, half_plane[j] + s * strips, strips, own + s, kLanes, 0, strips);
      }
    double* moment = nodes + j * kPairNodes;
    if (loaded) {
      dot_columns(moment, interpolation[j], strips, kPairNodes, own, strips);
      add_columns(at_node, at_nodes + j * kWindowNodes * rows, rows, moment, kWindowNodes, 0, rows);
    } else {
      std::fill(moment, moment + kPairNodes, 0.0);
    }
  }
  for (int j = 0; j < pairs; ++j) {
    const double* y = at_node + j * kPairNodes;
    const double y0 = y[0], y1 = y[1], y2 = y[2], y3 = y[3], y4 = y[4], y5 = y[5];
    double* own = gap + j * strips;
    for (int i = 0; i < strips; i += kLanes) {
      const double* w = interpolation[j] + i;
      lanes(own + i) =
          (lanes(own + i) + y0 * lanes(w) + y1 * lanes(w + strips) + y2 * lanes(w + 2 * strips)) +
          (y3 * lanes(w + 3 * strips) + y4 * lanes(w + 4 * strips) + y5 * lanes(w + 5 * strips));
    }
  }
}

void StripCompliance::put_column(int strip, const int* first, const int* last, double* column) const {
  static_assert(kWindowNodes == 6);
  const int rows = kPairNodes * pairs, own = strip / strips, s = strip % strips;
  const double *from = at_nodes + own * kWindowNodes * rows, *w = interpolation[own] + s;
  const double w0 = w[0], w1 = w[strips], w2 = w[2 * strips], w3 = w[3 * strips], w4 = w[4 * strips],
               w5 = w[5 * strips];
  for (int j = 0; j < pairs; ++j) {
    alignas(Lanes) double y[kPairNodes];
    for (int i = 0; i < kPairNodes; i += kLanes) {
      const double* c = from + j * kPairNodes + i;
      lanes(y + i) = (w0 * lanes(c) + w1 * lanes(c + rows) + w2 * lanes(c + 2 * rows)) +
                     (w3 * lanes(c + 3 * rows) + w4 * lanes(c + 4 * rows) + w5 * lanes(c + 5 * rows));
    }
    const double y0 = y[0], y1 = y[1], y2 = y[2], y3 = y[3], y4 = y[4], y5 = y[5];
    double* to = column + j * strips;
    for (int i = first[j]; i < last[j]; i += kLanes) {
      const double* x = interpolation[j] + i;
      lanes(to + i) = (y0 * lanes(x) + y1 * lanes(x + strips) + y2 * lanes(x + 2 * strips)) +
                      (y3 * lanes(x + 3 * strips) + y4 * lanes(x + 4 * strips) + y5 * lanes(x + 5 * strips));
    }
  }
  const double* h = half_plane[own] + s * strips;
  for (int i = first[own]; i < last[own]; i += kLanes) lanes(column + own * strips + i) += lanes(h + i);
}

void StripCompliance::assemble(double* a) const {
  int first[kMostPairs] = {}, last[kMostPairs];
  std::fill(last, last + pairs, strips);
  for (int s = 0; s < size(); ++s) put_column(s, first, last, a + s * size());
}

void StripCompliance::assemble_columns(const std::vector<int>& of, double* a) const {
  int first[kMostPairs] = {}, last[kMostPairs] = {};
  for (int s : of) {
    const int j = s / strips, i = s % strips / kLanes * kLanes;
    if (last[j] == 0) first[j] = i;
    last[j] = i + kLanes;
  }
  for (int s : of) put_column(s, first, last, a + s * size());
}

}  // namespace whine
