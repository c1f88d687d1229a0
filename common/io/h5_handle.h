// HDF5's identifiers, errors and types, for h5.cpp alone.
#pragma once
#include <hdf5.h>

#include <cstdint>
#include <string>
#include <utility>

#include "base/error.h"

namespace whine::h5 {

// What the system refused to HDF5 while a file on disk is written: HDF5 may go on without what it could not write, also in a
// destructor, which throws nothing.
struct Refusal {
  std::string path;   // of the file; empty: none is written on disk
  std::string words;  // of the system; empty: nothing was refused
};
inline Refusal& refusal() {
  static Refusal refusal;
  return refusal;
}
// Behind a call that has failed: what HDF5's stack of errors says of the system.
void note_refusal();

[[noreturn]] inline void reject_deed(const std::string& what) {
  note_refusal();
  const Refusal& by_system = refusal();
  if (!by_system.words.empty())
    fail(Failure::io, by_system.path, ": cannot be written: HDF5 was to ", what, ": ", by_system.words,
         "; nothing was changed, an earlier file is whole");
  fail(Failure::numerical, "HDF5 refused to ", what, "; this is a fault of the program");
}

// An HDF5 identifier that is closed by the function that its kind wants.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) reject_deed(what);
  }
  ~Handle() {
    if (id_ >= 0 && close_(id_) < 0) note_refusal();
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: HDF5 calls take the number

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// Our errors say what went wrong in one line; HDF5's stack of them would hide it. At the end of the program it would try anew to write
// what a full disk has refused, and crash: our writers close their files themselves. And it loads no code that a file asks for.
inline void silence() {
  static const bool done = [] {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    H5PLset_loading_state(0);
    return true;
  }();
  (void)done;
}

inline void check(herr_t status, const std::string& what) {
  if (status < 0) reject_deed(what);
}

// Why the values of a dataset do not stand in the file itself, as they are or by the filters that are written here; "": they do.
std::string not_of_file(hid_t dataset);

template <class T>
struct Types;
template <>
struct Types<double> {
  static hid_t memory() { return H5T_NATIVE_DOUBLE; }
  static hid_t file() { return H5T_IEEE_F64LE; }
};
template <>
struct Types<float> {
  static hid_t memory() { return H5T_NATIVE_FLOAT; }
  static hid_t file() { return H5T_IEEE_F32LE; }
};
template <>
struct Types<int> {
  static hid_t memory() { return H5T_NATIVE_INT; }
  static hid_t file() { return H5T_STD_I32LE; }
};
template <>
struct Types<std::int64_t> {
  static hid_t memory() { return H5T_NATIVE_INT64; }
  static hid_t file() { return H5T_STD_I64LE; }
};
template <>
struct Types<std::uint8_t> {
  static hid_t memory() { return H5T_NATIVE_UINT8; }
  static hid_t file() { return H5T_STD_U8LE; }
};

}  // namespace whine::h5
