// Writes the HDF5 files of this folder, each wrong in one way, and a sound one for
// fuzzing: make_broken_hdf5 tests/broken/record
#include "../../unit/files/hdf5_made.h"

using trochoid::files::made::hdf5_file;
using trochoid::files::made::Hdf5Set;

namespace {

std::vector<Hdf5Set> forces(const std::string& unit, std::size_t samples_of_Fy,
                            std::optional<double> rate) {
  std::vector<Hdf5Set> sets;
  for (const char* name : {"Fx", "Fy", "Fz"}) {
    const std::size_t count = name == std::string("Fy") ? samples_of_Fy : 4;
    sets.push_back({.path = name,
                    .values = std::vector<double>(count, 1.5),
                    .size = {},
                    .unit = unit,
                    .rate = rate});
  }
  return sets;
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return 2;
  const std::string folder = std::string(words[1]) + "/hdf5_";
  const std::string sound = hdf5_file(forces("N", 4, 1e4));
  write(folder + "cut_off.h5", sound.substr(0, sound.size() - 700));
  write(folder + "head_alone.h5", sound.substr(0, 96));
  write(folder + "empty.h5", hdf5_file({}));
  write(folder + "volts.h5", hdf5_file(forces("V", 4, 1e4)));
  write(folder + "two_lengths.h5", hdf5_file(forces("N", 3, 1e4)));
  write(folder + "no_rate.h5", hdf5_file(forces("N", 4, std::nullopt)));
  write(folder + "rate_below_zero.h5", hdf5_file(forces("N", 4, -5.0)));
  auto renamed = forces("N", 4, 1e4);
  for (auto& set : renamed) set.path = "run/" + set.path.substr(1) + "_force";
  write(folder + "no_forces.h5", hdf5_file(renamed));
  write(std::string(words[1]) + "/../../fuzz/seeds/record/hdf5",
        std::string(1, '\0') + sound);
}
