// Compliance of the strips of all pairs at one position, kept as what it is made of: A = H + W C W^T. Half-planes H act within
// a pair; bodies and modes C act between the nodes of the candidate zones, whose values W interpolates to strips. Its product
// with forces reads the few numbers of C and H and W, which candidate zones without an edge share; A itself would be read anew
// at each step.
#pragma once
#include <array>
#include <vector>

#include "contact/lanes.h"
#include "contact/line_contact.h"
#include "contact/strips.h"

namespace whine {

struct StripCompliance {
  static constexpr int kPairNodes = padded(kZoneNodes);  // nodes of a pair with zeros up to whole lanes

  int pairs = 0;
  int strips = 0;                                         // of a pair, whole lanes
  std::array<const double*, kMostPairs> half_plane{};     // (strip, strip) m N-1
  std::array<const double*, kMostPairs> interpolation{};  // (strip, kPairNodes) 1
  const double* at_nodes = nullptr;                       // (kPairNodes pairs, kZoneNodes pairs) m N-1

  int size() const { return pairs * strips; }
  // gap += A p. p, gap: (strip of all pairs) N, m. nodes: (kPairNodes pairs) N, result: W^T p.
  void add_product(const double* p, double* nodes, double* gap) const;
  // a: (strip, strip) of all pairs, result: A.
  void assemble(double* a) const;
  // The same, in some columns and at least these rows (strips, ascending); what else a holds stays or means nothing.
  void assemble_columns(const std::vector<int>& columns, const std::vector<int>& rows, double* a) const;

 private:
  // Column `strip` in rows first[j] to last[j] - 1, whole lanes, of each pair j.
  void put_column(int strip, const int* first, const int* last, double* column) const;
};

}  // namespace whine
