#pragma once

#include <hdf5.h>

#include <stdexcept>
#include <string>

namespace talus::core {

/// An identifier of the HDF5 library, closed by the function that fits its kind.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);
  /// @throws std::runtime_error where the library gave none
  Hdf5Handle(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0) throw std::runtime_error("the HDF5 library cannot open or make '" + what + "'");
  }
  ~Hdf5Handle() { close_(id_); }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  Close close_;
};

}  // namespace talus::core
