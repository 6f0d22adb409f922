#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

/// X3P and SDF files for tests.
namespace trochoid::files::made {

template <class Number>
std::string little(Number value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);  // the tests' machines are so
  return bytes;
}

template <class Number>
std::string all_little(const std::vector<Number>& values) {
  std::string bytes;
  for (const Number value : values) bytes += little(value);
  return bytes;
}

inline std::uint32_t check_of(const std::string& bytes) {
  std::uint32_t check = 0xFFFFFFFFU;
  for (const char c : bytes) {
    check ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) {
      check = (check >> 1U) ^ ((check & 1U) != 0 ? 0xEDB88320U : 0U);
    }
  }
  return ~check;
}

/// An archive whose files are stored as they are.
inline std::string zip_file(
    const std::vector<std::pair<std::string, std::string>>& files) {
  std::string body;
  std::string directory;
  for (const auto& [name, content] : files) {
    const auto size = little(static_cast<std::uint32_t>(content.size()));
    const std::string shared = std::string(8, '\0') + little(check_of(content)) + size +
                               size + little(static_cast<std::uint16_t>(name.size())) +
                               std::string(2, '\0');
    const auto offset = static_cast<std::uint32_t>(body.size());
    const std::string version = little(std::uint16_t{20});
    body += "PK\x03\x04" + version + shared + name + content;
    directory += "PK\x01\x02" + version + version + shared + std::string(10, '\0') +
                 little(offset) + name;
  }
  const auto count = little(static_cast<std::uint16_t>(files.size()));
  return body + directory + "PK\x05\x06" + std::string(4, '\0') + count + count +
         little(static_cast<std::uint32_t>(directory.size())) +
         little(static_cast<std::uint32_t>(body.size())) + std::string(2, '\0');
}

struct X3p {
  std::string type = "D";
  std::string z_axis = "<Increment>1</Increment><Offset>0</Offset>";
  std::string links;  ///< beside that of the points
  std::string size = "<SizeX>3</SizeX><SizeY>2</SizeY><SizeZ>1</SizeZ>";
  std::string feature = "SUR";
};

/// Points 0.5 mm apart along X and 0.25 mm along Y, from Y = 1 mm on.
inline std::string x3p_description(const X3p& x) {
  return R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- <Axes> of a comment count for nothing -->
<p:ISO5436_2 xmlns:p="http://www.opengps.eu/2008/ISO5436_2">
<Record1><Revision>ISO5436 - 2000</Revision><FeatureType>)" +
         x.feature + R"(</FeatureType><Axes>
<CX><AxisType>I</AxisType><DataType>D</DataType><Increment>5E-4</Increment></CX>
<CY><AxisType>I</AxisType><Increment> 2.5e-04 </Increment><Offset>1e-3</Offset></CY>
<CZ><AxisType>A</AxisType><DataType>)" +
         x.type + "</DataType>" + x.z_axis + R"(</CZ></Axes></Record1>
<Record3><MatrixDimension>)" +
         x.size +
         R"(</MatrixDimension><DataLink><PointDataLink>bindata/data.bin</PointDataLink>)" +
         x.links + "</DataLink></Record3></p:ISO5436_2>";
}

inline std::string x3p_file(const X3p& x, const std::string& points,
                            const std::string& valid = {}) {
  return zip_file({{"bindata/data.bin", points},
                   {"bindata/valid.bin", valid},
                   {"main.xml", x3p_description(x)}});
}

/// 3 x 2 points, 0.5 mm apart along X and 0.25 mm along Y.
inline std::string sdf_head(unsigned char type, double z_scale,
                            unsigned char packed = 0) {
  return "bISO-1.0" + std::string("trochoid  ") + std::string(24, '0') +
         little(std::uint16_t{3}) + little(std::uint16_t{2}) + little(5e-4) +
         little(2.5e-4) + little(z_scale) + little(-1.0) + little(packed) +
         little(type) + little(static_cast<unsigned char>(0));
}

inline std::string sdf_text(const std::string& data) {
  return "aISO-1.0\r\nManufacID = trochoid\r\nNumPoints = 3\r\nNumProfiles = 2\r\n"
         "Xscale = 5e-4\r\nYscale = 2.5E-4\r\nZscale = 1e-6\r\nZresolution = -1\r\n"
         "Compression = 0\r\nDataType = 7\r\nCheckType = 0\r\n*\r\n" +
         data + "\r\n*\r\n";
}

}  // namespace trochoid::files::made
