#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/files/file_ref.h>
#include <trochoid/signal/transmission.h>

#include <string>
#include <vector>

namespace trochoid::files {

struct TransmissionFile {
  signal::Transmission transmission;
  std::vector<base::Warning> notes;
};

/// @brief Read the measured response of a dynamometer: channel over force.
///
/// Two forms, told apart by their content. A universal file: every frequency response
/// (set 58, function type 4) of force over force, its directions 1 to 3 the channels. A
/// table: `freq_Hz`, and for channel i and a force along channel j `Hij_re` and `Hij_im`,
/// or `Hij_mag` and `Hij_phase_deg`; without a number (`re`, `im`) all channels alike.
/// A channel that is not there is rigid, a cross response zero.
/// @throws base::InputError with every problem
TransmissionFile read_transmission(const FileRef& file);

/// @brief The same from text.
/// @param name  of the file, for messages
TransmissionFile transmission_of(const std::string& text, const std::string& name);

}  // namespace trochoid::files
