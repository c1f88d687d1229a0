// Whether the global heaps of an HDF5 file can be followed: what HDF5 itself does not check.
#pragma once
#include <string>

namespace whine::h5 {

// Global heaps, which hold texts of no fixed length, are the only structures without a checksum in the files that are
// made here, and HDF5 follows the sizes in them unchecked: for ever, if one is damaged. Whether all are sound to which the
// file refers, and none lies in another: their mark (with the version, without which HDF5 does not take it for one) may also
// stand among numbers.
bool heaps_are_sound(const std::string& bytes);

}  // namespace whine::h5
