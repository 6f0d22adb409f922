#pragma once

#include <trochoid/base/error.h>
#include <trochoid/cases/case.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

/// Case files made up by a test, in a folder of its own that goes away with it.
namespace trochoid::cases::test {

class CaseFolder {
 public:
  CaseFolder() {
    std::string name =
        (std::filesystem::temp_directory_path() / "trochoid-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;
  ~CaseFolder() {
    std::error_code error;
    std::filesystem::remove_all(path_, error);
  }

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }
  [[nodiscard]] Case read(const std::string& text,
                          std::optional<Command> command = Command::simulate) const {
    return read_case(write("case.toml", text), command);
  }
  /// What is wrong with a case, with the folder left out; empty: nothing.
  [[nodiscard]] std::string problems(
      const std::string& text,
      std::optional<Command> command = Command::simulate) const {
    try {
      static_cast<void>(read(text, command));
    } catch (const base::InputError& error) {
      std::string message = error.what();
      const std::string folder = path_.string() + "/";
      for (auto at = message.find(folder); at != std::string::npos;
           at = message.find(folder)) {
        message.erase(at, folder.size());
      }
      return message;
    }
    return "";
  }

 private:
  std::filesystem::path path_;
};

inline std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

inline const std::string tool = R"([tool]
teeth = 2
diameter_mm = 8.0
helix_deg = 30.0
)";
inline const std::string cut = R"([cut]
engagement = "slot"
axial_depth_mm = 2.0
feed_per_tooth_mm = 0.04
spindle_rpm = 875
)";
inline const std::string force = R"([force]
K_tc_MPa = 2620
K_rc_MPa = 1560
K_ac_MPa = 331
K_te_N_per_mm = 7
K_re_N_per_mm = 3
K_ae_N_per_mm = 1
)";
inline const std::string slot = tool + cut + force;

}  // namespace trochoid::cases::test
