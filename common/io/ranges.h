// The range of every dataset of every artifact, in SI: what a reader takes. Parameters that are keys of a scene have theirs
// in the table of the keys (io/keys.h). Ranges are wide: they keep out what no computation of this program writes, and what
// would index beyond an array, overflow or never end.
//
// Private to the layer io/.
#pragma once
#include <string>

namespace whine {

struct Range {
  double least = 0, most = 0;
  bool open = false;  // least itself is not allowed
};

// Of a dataset by its path, such as "/compliance/offsets"; nullptr for what lies below /parameters and is none of the table's,
// a key of a scene. Error(numerical) for any other dataset without a range.
const Range* range_of(const std::string& dataset);

// "" or why a value is not within the range, in words that follow the name of the dataset.
std::string outside(const Range& range, double value);

}  // namespace whine
