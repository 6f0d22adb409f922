#pragma once

#include <cstdint>
#include <optional>
#include <string>

/// Objects of the HDF5 library that close themselves, and what is small to read.
namespace trochoid::files {

/// The library's hid_t, without its headers.
using Hdf5Id = std::int64_t;

/// One open object; not open where its identifier is negative.
class Hdf5Handle {
 public:
  using Close = int (*)(Hdf5Id);

  Hdf5Handle(Hdf5Id id, Close close) : id_(id), close_(close) {}
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
  [[nodiscard]] Hdf5Id id() const noexcept { return id_; }

 private:
  Hdf5Id id_;
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
  int (*print_)(Hdf5Id, void*) = nullptr;
  void* where_ = nullptr;
};

/// @return an attribute that is one text; none: there is no such one
std::optional<std::string> hdf5_text(Hdf5Id object, const char* attribute);

/// @return an attribute that is one number; none: there is no such one
std::optional<double> hdf5_number(Hdf5Id object, const char* attribute);

}  // namespace trochoid::files
