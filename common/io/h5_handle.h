// HDF5's identifiers, errors and types, for h5.cpp alone.
#pragma once
#include <hdf5.h>

#include <cstdint>
#include <string>
#include <utility>

#include "base/error.h"

namespace whine::h5 {

// An HDF5 identifier that is closed by the function that its kind wants.
class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t), const std::string& what) : id_(id), close_(close) {
    if (id_ < 0) fail(Failure::numerical, "HDF5 refused to ", what, "; this is a fault of the program");
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;
  operator hid_t() const { return id_; }  // NOLINT: HDF5 calls take the number

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

// Our errors say what went wrong in one line; HDF5's stack of them would hide it.
inline void silence() {
  static const bool done = [] {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    return true;
  }();
  (void)done;
}

inline void check(herr_t status, const std::string& what) {
  if (status < 0) fail(Failure::numerical, "HDF5 refused to ", what, "; this is a fault of the program");
}

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
