#include <trochoid/files/hdf5_handle.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

#include <hdf5.h>

namespace trochoid::files {

static_assert(std::is_same_v<Hdf5Id, hid_t> && std::is_same_v<int, herr_t>);

namespace {

/// Longer texts are no unit.
constexpr std::size_t longest_read = 256;

Hdf5Handle attribute_of(hid_t object, const char* name) {
  if (H5Aexists(object, name) <= 0) return {-1, H5Aclose};
  Hdf5Handle attribute(H5Aopen(object, name, H5P_DEFAULT), H5Aclose);
  if (!attribute.open()) return attribute;
  const Hdf5Handle space(H5Aget_space(attribute.id()), H5Sclose);
  if (!space.open() || H5Sget_simple_extent_npoints(space.id()) != 1) {
    return {-1, H5Aclose};
  }
  return attribute;
}

}  // namespace

Hdf5Silence::Hdf5Silence() {
  H5Eget_auto2(H5E_DEFAULT, &print_, &where_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Hdf5Silence::~Hdf5Silence() {
  H5Eset_auto2(H5E_DEFAULT, print_, where_);
}

std::optional<std::string> hdf5_text(hid_t object, const char* attribute) {
  const auto found = attribute_of(object, attribute);
  if (!found.open()) return std::nullopt;
  const Hdf5Handle type(H5Aget_type(found.id()), H5Tclose);
  if (!type.open() || H5Tget_class(type.id()) != H5T_STRING) return std::nullopt;
  if (H5Tis_variable_str(type.id()) > 0) {
    char* text = nullptr;
    if (H5Aread(found.id(), type.id(), static_cast<void*>(&text)) < 0 ||
        text == nullptr) {
      return std::nullopt;
    }
    std::string copy(text, strnlen(text, longest_read));
    H5free_memory(text);
    return copy;
  }
  const std::size_t size = H5Tget_size(type.id());
  if (size == 0 || size > longest_read) return std::nullopt;
  std::string text(size, '\0');
  if (H5Aread(found.id(), type.id(), text.data()) < 0) return std::nullopt;
  text.resize(std::min(text.find('\0'), text.size()));
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::optional<double> hdf5_number(hid_t object, const char* attribute) {
  const auto found = attribute_of(object, attribute);
  if (!found.open()) return std::nullopt;
  const Hdf5Handle type(H5Aget_type(found.id()), H5Tclose);
  const auto kind = type.open() ? H5Tget_class(type.id()) : H5T_NO_CLASS;
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return std::nullopt;
  double value = 0.0;
  if (H5Aread(found.id(), H5T_NATIVE_DOUBLE, &value) < 0) return std::nullopt;
  return value;
}

}  // namespace trochoid::files
