#pragma once

#include <optional>
#include <string>

#include <H5public.h>

#include <H5Ipublic.h>

/// Objects of the HDF5 library that close themselves, and what is small to read.
namespace trochoid::inputs {

/// One open object; not open where its identifier is negative.
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }
  Hdf5Handle(Hdf5Handle&& other) noexcept : id_(other.id_), close_(other.close_) {
    other.id_ = -1;
  }
  Hdf5Handle(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(const Hdf5Handle&) = delete;
  Hdf5Handle& operator=(Hdf5Handle&&) = delete;

  [[nodiscard]] bool open() const noexcept { return id_ >= 0; }
  [[nodiscard]] hid_t id() const noexcept { return id_; }

 private:
  hid_t id_;
  Close close_;
};

/// Keeps the library from printing its errors, as long as this lives.
class Hdf5Silence {
 public:
  Hdf5Silence();
  ~Hdf5Silence();
  Hdf5Silence(const Hdf5Silence&) = delete;
  Hdf5Silence& operator=(const Hdf5Silence&) = delete;

 private:
  herr_t (*print_)(hid_t, void*) = nullptr;
  void* where_ = nullptr;
};

/// @return an attribute that is one text; none: there is no such one
std::optional<std::string> hdf5_text(hid_t object, const char* attribute);

/// @return an attribute that is one number; none: there is no such one
std::optional<double> hdf5_number(hid_t object, const char* attribute);

}  // namespace trochoid::inputs
