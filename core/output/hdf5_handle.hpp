#pragma once

#include <hdf5.h>

#include <string>
#include <utility>

#include "core/errors.hpp"
#include "core/output/memory_file.hpp"

namespace talus::core {

/// To be called before anything else of the library. It prints its errors unless told not to; ours say what the
/// user has to know. And what it could not write it would try to write again when the program ends, and crash.
inline void silence_hdf5() {
  [[maybe_unused]] static const herr_t leaves_the_end_to_us = H5dont_atexit();
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// A new HDF5 file in memory; negative where the library makes none. Its default driver asks for a file's real
/// path, which a file in memory has not; the one over <stdio.h> does not ask.
inline hid_t create_hdf5_in(const MemoryFile& memory) {
  silence_hdf5();
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_stdio(access);
  const hid_t file = H5Fcreate(memory.path().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access);
  H5Pclose(access);
  return file;
}

/// An identifier of the HDF5 library, closed by the function that fits its kind.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  /// @throws MachineError where the library gave none
  Hdf5Handle(hid_t id, Close closing, const std::string& what) : id_(id), close_(closing) {
    if (id < 0) throw MachineError("the HDF5 library cannot open or make '" + what + "'");
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }
  /// False where what was still to be written could not be.
  bool close() { return close_(std::exchange(id_, H5I_INVALID_HID)) >= 0; }

 private:
  hid_t id_;
  Close close_;
};

}  // namespace talus::core
